//! The OBJ and MTL text of the Cornell box.

use std::fmt::Write;

use super::cornell::{MATERIALS, PARTS};

/// Groups by name, polygons as they were published.
pub(crate) fn obj() -> String {
    let mut text = String::from("# The Cornell box, millimetres.\nmtllib cornell.mtl\n");
    let mut vertices = 0;
    for part in &PARTS {
        let material = MATERIALS[part.material].name;
        line(&mut text, format_args!("g {}\nusemtl {material}", part.name));
        for corners in part.quads {
            for [x, y, z] in corners {
                line(&mut text, format_args!("v {x} {y} {z}"));
            }
            let [a, b, c, d] = [1, 2, 3, 4].map(|corner| vertices + corner);
            line(&mut text, format_args!("f {a} {b} {c} {d}"));
            vertices += 4;
        }
    }
    text
}

/// `Kd` is the reflectance, `Ke` the radiance.
pub(crate) fn mtl() -> String {
    let mut text = String::from("# Reflectances of the Cornell box, rounded to RGB.\n");
    for material in &MATERIALS {
        let ([r, g, b], [s, t, u]) = (material.reflectance, material.radiance);
        line(&mut text, format_args!("newmtl {}\nKd {r} {g} {b}\nKe {s} {t} {u}", material.name));
    }
    text
}

fn line(text: &mut String, words: std::fmt::Arguments<'_>) {
    writeln!(text, "{words}").expect("writing to a String cannot fail");
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Another transcription of the published data, where it lies beside the checkout.
    #[test]
    fn corners_and_faces_are_those_of_another_transcription() {
        let path = crate::root().join("../shared/scenes/cornell.obj");
        let Ok(other) = std::fs::read_to_string(&path) else {
            println!("skipped: no shared/scenes/cornell.obj beside the checkout");
            return;
        };
        let numbers = |text: &str| -> Vec<(char, Vec<f64>)> {
            let lines =
                text.lines().filter(|line| line.starts_with("v ") || line.starts_with("f "));
            lines
                .map(|line| {
                    let words = line[2..].split_whitespace().map(|word| word.parse().unwrap());
                    (line.chars().next().unwrap(), words.collect())
                })
                .collect()
        };
        assert_eq!(numbers(&obj()), numbers(&other));
    }
}
