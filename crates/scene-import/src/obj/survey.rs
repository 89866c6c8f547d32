//! The first pass over OBJ text: checks it, and keeps what tobj forgets.

use std::collections::{BTreeSet, HashMap};
use std::fmt::Write;

use super::Warning;
use super::tokens::{self, Token};
use crate::{DiagnosticKind, Error};

/// Statements that say nothing about geometry or material.
const HARMLESS: &[&str] = &[
    "s",
    "vp",
    "mg",
    "bevel",
    "c_interp",
    "d_interp",
    "lod",
    "shadow_obj",
    "trace_obj",
    "cstype",
    "deg",
    "maplib",
    "usemap",
];

/// Kinds of other statements that are warned about one by one.
const MAX_UNKNOWN: usize = 16;

/// The group of faces that come before any `g` or `o`.
const DEFAULT_GROUP: &str = "default";

/// What an OBJ file says besides numbers.
pub(super) struct Survey {
    /// Its vertices, texture coordinates and faces, one a line, for tobj.
    pub(super) text: String,
    /// Its faces of three or more corners, in order.
    pub(super) faces: Vec<Face>,
    /// Names of `g` and `o`, each once, in order of appearance.
    pub(super) groups: Vec<String>,
    /// Names of `usemtl`, each once; a face before any has `None`.
    pub(super) materials: Vec<(Option<String>, u32)>,
    /// The `mtllib` statements: line and names.
    pub(super) libraries: Vec<(u32, String)>,
    /// What was odd, and the line of it.
    pub(super) warnings: Vec<Warning>,
}

/// A face of three or more corners.
pub(super) struct Face {
    pub(super) line: u32,
    pub(super) corners: u32,
    /// Into the groups.
    pub(super) group: u32,
    /// Counted from 1.
    pub(super) number_in_group: u32,
    /// Into the materials.
    pub(super) material: u32,
    /// Whether every corner has a texture coordinate.
    pub(super) has_uv: bool,
}

/// Goes over the text.
pub(super) fn survey(file: &str, text: &str) -> Result<Survey, Error> {
    let mut surveyor = Surveyor::new(file, text.len());
    tokens::for_each_line(text, |words| surveyor.line(words))?;
    surveyor.finish()
}

/// The three lists a face corner points into: the letter of each, and how to call an entry.
const LISTS: [&str; 3] = ["vertex", "texture coordinate", "normal"];

struct Surveyor<'a> {
    file: &'a str,
    survey: Survey,
    counts: [u64; 3],
    /// Corners that point past the entries so far; the file may still add those.
    ahead: Vec<(Ahead, usize, u64)>,
    group: Option<u32>,
    group_sizes: Vec<u32>,
    group_ids: HashMap<String, u32>,
    material: Option<u32>,
    material_ids: HashMap<Option<String>, u32>,
    unknown: BTreeSet<String>,
}

/// Where a corner stands that points ahead.
struct Ahead {
    text: String,
    line: u32,
    column: u32,
}

impl<'a> Surveyor<'a> {
    fn new(file: &'a str, bytes: usize) -> Self {
        let survey = Survey {
            text: String::with_capacity(bytes),
            faces: Vec::new(),
            groups: Vec::new(),
            materials: Vec::new(),
            libraries: Vec::new(),
            warnings: Vec::new(),
        };
        Self {
            file,
            survey,
            counts: [0; 3],
            ahead: Vec::new(),
            group: None,
            group_sizes: Vec::new(),
            group_ids: HashMap::new(),
            material: None,
            material_ids: HashMap::new(),
            unknown: BTreeSet::new(),
        }
    }

    fn line(&mut self, words: &[Token<'_>]) -> Result<(), Error> {
        let (first, rest) = (words[0], &words[1..]);
        match first.text {
            "v" => self.vertex(first, tokens::without_comment(rest))?,
            "vt" => self.texture_coordinate(first, tokens::without_comment(rest))?,
            "vn" => self.counts[2] += 1,
            "f" | "fo" => self.face(first, tokens::without_comment(rest))?,
            "g" | "o" => self.group = Some(self.group_id(&tokens::name(rest))),
            "usemtl" => {
                let name = tokens::name(rest);
                if name.is_empty() {
                    return Err(first.expected(self.file, "a material's name after it"));
                }
                self.material = Some(self.material_id(Some(name), first.line));
            }
            "mtllib" => self.survey.libraries.push((first.line, tokens::name(rest))),
            word if HARMLESS.contains(&word) => {}
            word => self.unknown(word, first.line),
        }
        Ok(())
    }

    fn unknown(&mut self, word: &str, line: u32) {
        if self.unknown.len() < MAX_UNKNOWN && self.unknown.insert(word.to_owned()) {
            let what = match word {
                "l" => "line elements".to_owned(),
                "p" => "point elements".to_owned(),
                _ => format!("statements {word:?}"),
            };
            self.survey.warnings.push((line, DiagnosticKind::Ignored { what }));
        }
    }

    fn vertex(&mut self, first: Token<'_>, rest: &[Token<'_>]) -> Result<(), Error> {
        // Three coordinates; then nothing, a weight, or a colour, which is left out.
        if !matches!(rest.len(), 3 | 4 | 6 | 7) {
            return Err(rest.last().unwrap_or(&first).expected(self.file, "three coordinates"));
        }
        self.survey.text.push('v');
        let mut most = 0.0_f64;
        for &word in &rest[..3] {
            most = most.max(word.finite(self.file)?.abs());
            self.push(word.text);
        }
        if let [_, _, _, weight] = rest {
            // The coordinates will be divided by it.
            let divisor = weight.finite(self.file)?;
            if divisor == 0.0 || !(most / divisor).is_finite() {
                let what = "a weight other than 0 that leaves the coordinates finite";
                return Err(weight.expected(self.file, what));
            }
            self.push(weight.text);
        }
        self.survey.text.push('\n');
        self.counts[0] += 1;
        Ok(())
    }

    fn texture_coordinate(&mut self, first: Token<'_>, rest: &[Token<'_>]) -> Result<(), Error> {
        let (u, v) = match rest {
            [u] => (u.text, "0"),
            [u, v, ..] => {
                v.finite(self.file)?;
                (u.text, v.text)
            }
            [] => return Err(first.expected(self.file, "two numbers after it")),
        };
        rest[0].finite(self.file)?;
        self.survey.text.push_str("vt");
        self.push(u);
        self.push(v);
        self.survey.text.push('\n');
        self.counts[1] += 1;
        Ok(())
    }

    fn push(&mut self, word: &str) {
        self.survey.text.push(' ');
        self.survey.text.push_str(word);
    }

    fn face(&mut self, first: Token<'_>, rest: &[Token<'_>]) -> Result<(), Error> {
        let mut corners = Vec::with_capacity(rest.len());
        for &word in rest {
            corners.push(self.corner(word)?);
        }
        if corners.len() < 3 {
            let kind = DiagnosticKind::TooFewCorners { corners: corners.len() };
            self.survey.warnings.push((first.line, kind));
            return Ok(());
        }
        let group = match self.group {
            Some(group) => group,
            None => self.group_id(DEFAULT_GROUP),
        };
        let material = match self.material {
            Some(material) => material,
            None => self.material_id(None, first.line),
        };
        self.group_sizes[group as usize] += 1;
        let has_uv = corners.iter().all(|(_, uv)| uv.is_some());
        self.survey.faces.push(Face {
            line: first.line,
            corners: corners.len() as u32,
            group,
            number_in_group: self.group_sizes[group as usize],
            material,
            has_uv,
        });
        self.survey.text.push('f');
        for (vertex, uv) in corners {
            let text = &mut self.survey.text;
            let written = match uv {
                Some(uv) if has_uv => write!(text, " {vertex}/{uv}"),
                _ => write!(text, " {vertex}"),
            };
            written.expect("a string takes everything");
        }
        self.survey.text.push('\n');
        Ok(())
    }

    /// Resolves `v`, `v/vt`, `v//vn` or `v/vt/vn` to indices that count from 1.
    fn corner(&mut self, word: Token<'_>) -> Result<(u64, Option<u64>), Error> {
        const FORM: &str = "a corner such as 1, 1/2, 1//3 or 1/2/3";
        let mut indices = [None; 3];
        let mut offset = 0;
        for (list, part) in word.text.split('/').enumerate() {
            if list >= 3 {
                return Err(word.expected(self.file, FORM));
            }
            if !part.is_empty() {
                let index: i64 = part.parse().map_err(|_| word.expected(self.file, FORM))?;
                let token = Token { text: part, ..word.skip(offset) };
                indices[list] = Some(self.index(token, list, index)?);
            }
            offset += part.len() + 1;
        }
        let vertex = indices[0].ok_or_else(|| word.expected(self.file, FORM))?;
        Ok((vertex, indices[1]))
    }

    /// An index that counts from 1: negative ones count back from the last entry.
    fn index(&mut self, token: Token<'_>, list: usize, index: i64) -> Result<u64, Error> {
        let count = self.counts[list];
        let distance = index.unsigned_abs();
        if index == 0 || (index < 0 && distance > count) {
            return Err(token.expected(self.file, &range(list, count)));
        }
        if index < 0 {
            return Ok(count + 1 - distance);
        }
        if distance > count {
            let Token { text, line, column } = token;
            self.ahead.push((Ahead { text: text.to_owned(), line, column }, list, distance));
        }
        Ok(distance)
    }

    fn group_id(&mut self, name: &str) -> u32 {
        let name = if name.is_empty() { DEFAULT_GROUP } else { name };
        if let Some(&id) = self.group_ids.get(name) {
            return id;
        }
        let id = self.survey.groups.len() as u32;
        self.survey.groups.push(name.to_owned());
        self.group_sizes.push(0);
        self.group_ids.insert(name.to_owned(), id);
        id
    }

    fn material_id(&mut self, name: Option<String>, line: u32) -> u32 {
        let materials = &mut self.survey.materials;
        *self.material_ids.entry(name).or_insert_with_key(|name| {
            materials.push((name.clone(), line));
            materials.len() as u32 - 1
        })
    }

    fn finish(self) -> Result<Survey, Error> {
        for (place, list, index) in &self.ahead {
            let count = self.counts[*list];
            if *index > count {
                let Ahead { text, line, column } = place;
                let token = Token { text, line: *line, column: *column };
                return Err(token.expected(self.file, &range(*list, count)));
            }
        }
        Ok(self.survey)
    }
}

fn range(list: usize, count: u64) -> String {
    match count {
        0 => format!("no {} index, as there is no {0} yet", LISTS[list]),
        _ => format!("a {} index from 1 to {count} or from -{count} to -1", LISTS[list]),
    }
}
