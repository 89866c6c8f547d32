//! From the text of a View3D file to its vertices and surfaces.

use glam::DVec3;

use super::words::{Word, Words};
use crate::{DiagnosticKind, Error};

const BASE: &str =
    "the number of an earlier surface or of an obstruction as base (0 for none, S only)";
const COMBINE: &str = "0 or the number of an earlier S surface to combine it with";

/// What a file holds, each in the order of the file.
#[derive(Default)]
pub(super) struct Records {
    pub(super) vertices: Vec<DVec3>,
    pub(super) surfaces: Vec<Surface>,
    /// Warnings, each with its line.
    pub(super) warnings: Vec<(u64, DiagnosticKind)>,
}

/// A surface: a triangle or a convex quadrilateral.
pub(super) struct Surface {
    pub(super) line: u64,
    pub(super) kind: Kind,
    /// Its corners, counter-clockwise seen from its front.
    pub(super) corners: Vec<DVec3>,
    /// The surface that it is a part of.
    pub(super) base: Option<usize>,
    /// The surface that it is one with in the results.
    pub(super) combine: Option<usize>,
    pub(super) emissivity: f64,
    pub(super) name: String,
}

/// What a surface does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// `S`: radiates.
    Radiating,
    /// `O`: blocks the view.
    Obstruction,
    /// `N`: the part of its base under it does not radiate.
    Null,
    /// `M`: faces its base and covers it.
    Masking,
}

/// Reads the lines up to the end of the data.
pub(super) fn parse(file: &str, text: &str) -> Result<Records, Error> {
    let mut records = Records::default();
    // Where the number of each surface's base stands: it may be known only later.
    let mut bases = Vec::new();
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    for (index, line) in text.split('\n').enumerate() {
        let mut words = Words::new(file, line, index as u64 + 1);
        let Some(first) = words.next_word() else { continue };
        let upper = first.text.to_ascii_uppercase();
        match upper.as_str() {
            "V" => records.vertex(&mut words)?,
            "S" => records.surface(Kind::Radiating, &mut words, &mut bases)?,
            "O" => records.surface(Kind::Obstruction, &mut words, &mut bases)?,
            "N" => records.surface(Kind::Null, &mut words, &mut bases)?,
            "M" => records.surface(Kind::Masking, &mut words, &mut bases)?,
            "F" => {
                let what = "format 3, which lists vertices and surfaces";
                words.whole(what, 3..=3)?;
                records.nothing_more(&mut words);
            }
            // The title, and how View3D shall integrate.
            "T" | "C" => {}
            "X" => records.warnings.push((
                words.line(),
                DiagnosticKind::Ignored { what: "a coordinate transformation".into() },
            )),
            _ if upper.starts_with('/') => {}
            _ if upper.starts_with(['E', '*']) => break,
            _ => {
                return Err(
                    words.expected(first, "a line that begins with T, C, F, V, S, M, N, O or E")
                );
            }
        }
    }
    records.resolve_bases(file, &bases)?;
    Ok(records)
}

impl Records {
    fn vertex(&mut self, words: &mut Words<'_>) -> Result<(), Error> {
        let number = self.vertices.len() + 1;
        words.whole(&format!("{number}, the number of the next vertex"), number..=number)?;
        let [x, y, z] = ["x", "y", "z"]
            .map(|axis| words.number(&format!("a finite number for {axis}"), f64::is_finite));
        self.vertices.push(DVec3::new(x?, y?, z?));
        self.nothing_more(words);
        Ok(())
    }

    fn surface<'a>(
        &mut self,
        kind: Kind,
        words: &mut Words<'a>,
        bases: &mut Vec<Option<Word<'a>>>,
    ) -> Result<(), Error> {
        let number = self.surfaces.len() + 1;
        words.whole(&format!("{number}, the number of the next surface"), number..=number)?;
        let vertices = self.vertices.len();
        let vertex = format!("the number of a vertex from 1 to {vertices}");
        let mut corners = Vec::with_capacity(4);
        for _ in 0..3 {
            corners.push(self.vertices[words.whole(&vertex, 1..=vertices)? - 1]);
        }
        match words.whole(&format!("{vertex}, or 0 for a triangle"), 0..=vertices)? {
            0 => {}
            fourth => corners.push(self.vertices[fourth - 1]),
        }
        let mut surface = Surface {
            line: words.line(),
            kind,
            corners,
            base: None,
            combine: None,
            emissivity: 1.0,
            name: String::new(),
        };
        let mut base = None;
        // View3D reads nothing more of an obstruction, and people write there what they like.
        if kind != Kind::Obstruction {
            base = Some(words.word(BASE)?);
            let combine = words.word(COMBINE)?;
            surface.combine = match combine.text.parse::<usize>().map(|n| n.checked_sub(1)) {
                Ok(Some(n)) if !self.surfaces.get(n).is_some_and(|s| s.kind == Kind::Radiating) => {
                    return Err(words.expected(combine, COMBINE));
                }
                Ok(earlier) => earlier,
                Err(_) => return Err(words.expected(combine, COMBINE)),
            };
            let share = |emissivity| (0.0..=1.0).contains(&emissivity);
            surface.emissivity = words.number("an emissivity from 0 to 1", share)?;
            words.word("the surface's name")?.text.clone_into(&mut surface.name);
            self.nothing_more(words);
        }
        bases.push(base);
        self.surfaces.push(surface);
        Ok(())
    }

    /// Warns about words that the format has no place for.
    fn nothing_more(&mut self, words: &mut Words<'_>) {
        if let Some(word) = words.next_word() {
            let what = format!("the line from {:?} on", word.text);
            self.warnings.push((words.line(), DiagnosticKind::Ignored { what }));
        }
    }

    /// Resolves the numbers of base surfaces. A base is an earlier surface or, as
    /// obstructions come last, any obstruction; so no surface is a part of itself.
    fn resolve_bases(&mut self, file: &str, bases: &[Option<Word<'_>>]) -> Result<(), Error> {
        for (index, word) in bases.iter().enumerate() {
            let Some(word) = word else { continue };
            let surface = &self.surfaces[index];
            let base = match word.text.parse::<usize>().map(|n| n.checked_sub(1)) {
                Ok(None) => matches!(surface.kind, Kind::Radiating).then_some(None),
                Ok(Some(n)) => {
                    let found = self.surfaces.get(n);
                    let fits = found.is_some_and(|s| n < index || s.kind == Kind::Obstruction);
                    fits.then_some(Some(n))
                }
                Err(_) => None,
            };
            let Some(base) = base else {
                let words = Words::new(file, "", surface.line);
                return Err(words.expected(*word, BASE));
            };
            self.surfaces[index].base = base;
        }
        Ok(())
    }
}
