//! Material libraries.

use std::fmt::Write;

use scene::Rgb;

use super::Warning;
use super::tokens::{self, Token};
use crate::{DiagnosticKind, Error, ErrorKind, range, units};

/// Texture options, and how many values can follow each.
const TEXTURE_OPTIONS: &[(&str, usize)] = &[
    ("-blendu", 1),
    ("-blendv", 1),
    ("-bm", 1),
    ("-boost", 1),
    ("-cc", 1),
    ("-clamp", 1),
    ("-imfchan", 1),
    ("-mm", 2),
    ("-o", 3),
    ("-s", 3),
    ("-t", 3),
    ("-texres", 1),
    ("-type", 1),
];

/// A material as its library spells it.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct MtlMaterial {
    pub(super) name: String,
    /// Its library, and the line where it begins.
    pub(super) place: String,
    /// `Kd`: diffuse reflectance.
    pub(super) reflectance: Option<[f64; 3]>,
    /// `Ke`: radiance.
    pub(super) radiance: Option<[f64; 3]>,
    /// `map_Kd`: a texture that multiplies `Kd`.
    pub(super) reflectance_map: Option<String>,
    /// `map_Ke`: a texture that multiplies `Ke`.
    pub(super) radiance_map: Option<String>,
}

/// The materials of a library in order, and its warnings.
pub(super) fn parse(file: &str, text: &str) -> Result<(Vec<MtlMaterial>, Vec<Warning>), Error> {
    let checked = String::with_capacity(text.len());
    let mut library = Library { file, checked, begun: Vec::new(), warnings: Vec::new() };
    tokens::for_each_line(text, |words| library.statement(words))?;
    let Library { checked, begun, warnings, .. } = library;
    let (materials, _) = tobj::load_mtl_buf(&mut checked.as_bytes()).map_err(|cause| {
        Error::new(ErrorKind::Syntax, file, format!("expected a material library: {cause}"))
            .because(cause)
    })?;
    // tobj makes one material of each `newmtl`.
    let materials = materials.into_iter().zip(begun).map(|(mut material, (_, line))| MtlMaterial {
        name: material.name,
        place: format!("{file}:{line}"),
        reflectance: material.diffuse,
        radiance: material.emissive,
        reflectance_map: material.diffuse_texture,
        radiance_map: material.unknown_param.remove("map_Ke"),
    });
    Ok((materials.collect(), warnings))
}

/// A library as far as it has been gone over.
struct Library<'a> {
    file: &'a str,
    /// The statements that matter here, checked and in full: tobj panics on a colour of two
    /// numbers and knows no single ones.
    checked: String,
    /// The materials so far, each with its line.
    begun: Vec<(String, u32)>,
    warnings: Vec<Warning>,
}

impl Library<'_> {
    fn statement(&mut self, words: &[Token<'_>]) -> Result<(), Error> {
        let (first, rest) = (words[0], &words[1..]);
        let written = match first.text {
            "newmtl" if rest.is_empty() => {
                return Err(first.expected(self.file, "a material's name after it"));
            }
            "newmtl" => {
                let name = tokens::name(rest);
                self.begun.push((name.clone(), first.line));
                writeln!(self.checked, "newmtl {name}")
            }
            "Kd" | "Ke" => {
                let [r, g, b] = self.colour(first, tokens::without_comment(rest))?;
                writeln!(self.checked, "{} {r} {g} {b}", first.text)
            }
            "map_Kd" | "map_Ke" => match texture_name(rest, first.line, &mut self.warnings) {
                name if name.is_empty() => {
                    return Err(first.expected(self.file, "a file's name after it"));
                }
                name => writeln!(self.checked, "{} {name}", first.text),
            },
            "d" | "Tr" => {
                let opaque = if first.text == "d" { 1.0 } else { 0.0 };
                // `d -halo 0.5` is a form of it too, so the last word is the number.
                let number = rest.last().and_then(|word| word.text.parse().ok());
                if number.is_some_and(|x: f64| x != opaque) {
                    let what = "transparency".to_owned();
                    self.warnings.push((first.line, DiagnosticKind::Ignored { what }));
                }
                Ok(())
            }
            _ => Ok(()),
        };
        written.expect("a string takes everything");
        Ok(())
    }

    /// One number for grey, or three.
    fn colour(&self, first: Token<'_>, rest: &[Token<'_>]) -> Result<[f64; 3], Error> {
        match rest {
            [grey] => Ok([self.channel(first, *grey)?; 3]),
            [r, g, b, ..] => {
                Ok([self.channel(first, *r)?, self.channel(first, *g)?, self.channel(first, *b)?])
            }
            [] => Err(first.expected(self.file, "red, green and blue after it")),
            [_, last] => Err(last.expected(self.file, "red, green and blue")),
        }
    }

    /// A channel of `Kd` or `Ke`, which must be one that a surface can have.
    fn channel(&self, first: Token<'_>, word: Token<'_>) -> Result<f64, Error> {
        let number = word.number(self.file)?;
        let (sound, what) = match first.text {
            "Kd" => (range::is_reflectance(number), "a reflectance from 0 to 1"),
            _ => {
                // Large radiance has an emittance that is no number.
                let emittance = units::emittance_of_radiance(Rgb::splat(number));
                (range::is_emittance(emittance[0]), "a finite radiance of at least 0")
            }
        };
        if sound {
            return Ok(number);
        }
        let of =
            self.begun.last().map_or_else(String::new, |(name, _)| format!(" of material {name}"));
        Err(word.expected(self.file, &format!("{what} as {}{of}", first.text)))
    }
}

/// The file of a texture statement, after its options.
fn texture_name(mut rest: &[Token<'_>], line: u32, warnings: &mut Vec<Warning>) -> String {
    while let Some((option, after)) = rest.split_first()
        && let Some((name, most)) = TEXTURE_OPTIONS.iter().find(|(name, _)| *name == option.text)
    {
        // Options of several numbers may leave the last ones out; the file's name must stay.
        let is_value = |word: &Token<'_>| *most == 1 || word.text.parse::<f64>().is_ok();
        let values = after.iter().take(*most).take_while(|word| is_value(word)).count();
        rest = &after[values..];
        let what = format!("texture option {name}");
        warnings.push((line, DiagnosticKind::Ignored { what }));
    }
    tokens::name(rest)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_may_be_grey_and_textures_may_have_options() {
        let text = "newmtl two words\nKd 0.25\nKe 1 2 3 # warm\nmap_Kd -s 2 2 -clamp on my wall.png\n\
                    map_Ke glow.png\nd 0.5\nNs 10\nillum oops";
        let (materials, warnings) = parse("a.mtl", text).unwrap();
        let expected = MtlMaterial {
            name: "two words".into(),
            place: "a.mtl:1".into(),
            reflectance: Some([0.25; 3]),
            radiance: Some([1.0, 2.0, 3.0]),
            reflectance_map: Some("my wall.png".into()),
            radiance_map: Some("glow.png".into()),
        };
        assert_eq!(materials, [expected]);
        let lines: Vec<_> = warnings.iter().map(|(line, kind)| format!("{line} {kind}")).collect();
        assert_eq!(
            lines,
            [
                "4 left out: texture option -s",
                "4 left out: texture option -clamp",
                "6 left out: transparency"
            ]
        );
    }

    #[test]
    fn mistakes_are_named_with_line_and_column() {
        for (text, message) in [
            ("newmtl a\nKd 1 2", "a.mtl:2:6: expected red, green and blue, found \"2\""),
            ("newmtl", "a.mtl:1:1: expected a material's name after it, found \"newmtl\""),
            ("newmtl a\nKd spectral x.rfl 1", "a.mtl:2:4: expected a number, found \"spectral\""),
            ("newmtl a\nKe", "a.mtl:2:1: expected red, green and blue after it, found \"Ke\""),
            (
                "newmtl b c\nKd 0.5 1.2 0",
                "a.mtl:2:8: expected a reflectance from 0 to 1 as Kd of material b c, found \"1.2\"",
            ),
            (
                "newmtl a\n  Ke -1",
                "a.mtl:2:6: expected a finite radiance of at least 0 as Ke of material a, found \"-1\"",
            ),
            ("Kd nan", "a.mtl:1:4: expected a reflectance from 0 to 1 as Kd, found \"nan\""),
            ("map_Kd -s 1 1 1", "a.mtl:1:1: expected a file's name after it, found \"map_Kd\""),
        ] {
            assert_eq!(parse("a.mtl", text).unwrap_err().to_string(), message);
        }
    }

    #[test]
    fn damaged_text_never_panics() {
        let whole =
            b"newmtl a\nKd 0.5 0.5 0.5\nKe 1 2 3\nmap_Kd -s 1 1 1 a.png\nd 1\nmap_Ke b.png\n";
        for position in 0..whole.len() {
            for damage in *b" \n\\#-9e\xff\0" {
                let mut bytes = whole.to_vec();
                bytes[position] = damage;
                let _ = parse("a.mtl", &String::from_utf8_lossy(&bytes));
                let _ = parse("a.mtl", &String::from_utf8_lossy(&bytes[..position]));
            }
        }
    }
}
