//! What was odd about a file that could still be read.

use std::fmt;

use scene::{Rgb, Sides, TriangleId};

use crate::shortened::OneLine;

/// A warning about one place of a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnostic {
    /// What was found.
    pub kind: DiagnosticKind,
    /// The triangle it concerns, if it concerns one.
    pub triangle: Option<TriangleId>,
    /// The way to it in the file, such as `room.tri:31`,
    /// `cornell.obj:64: group tall, face 3` or
    /// `nodes[2].mesh[0].primitives[1].triangle 17`.
    pub place: String,
}

/// What a warning is about.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum DiagnosticKind {
    /// A triangle without area; it stays in its place.
    Degenerate,
    /// A triangle over the same three points as an earlier one, facing the same way.
    Duplicate {
        /// The earlier one.
        of: TriangleId,
    },
    /// A triangle that a transform of finite numbers takes to a coordinate that is not
    /// finite: collapsed to a point in its place.
    NonFinite,
    /// A reflectance above 1 by no more than 10⁻⁶, as rounding leaves it: brought to 1.
    ReflectanceClamped {
        /// What the file says.
        stated: Rgb,
    },
    /// A reflectance of exactly 1: such a surface loses no light.
    ReflectanceOne,
    /// A material or a material library that is not there: grey of reflectance 0.5 instead.
    MissingMaterial {
        /// The missing name, or a few words where the file names none.
        name: String,
    },
    /// A triangle that runs against its neighbours in a mostly closed surface.
    ReversedWinding,
    /// A triangle whose stated normals point to its back.
    NormalDisagrees,
    /// A texture that cannot be used: white instead.
    MissingTexture {
        /// Its file, or its place in the scene file.
        name: String,
        /// Why not.
        reason: String,
    },
    /// A face of fewer than three corners: it makes no triangle.
    TooFewCorners {
        /// How many it has.
        corners: usize,
    },
    /// A part that has no counterpart on the other side of a conversion and is left out.
    Ignored {
        /// Which part, in words.
        what: String,
    },
    /// A surface that breaks a rule of its format; it is read as it stands.
    BrokenRule {
        /// What is wrong, in words.
        what: String,
    },
    /// A reflectance that a .tri file cannot hold.
    ReflectanceChanged {
        /// The scene's.
        from: Rgb,
        /// The one that the file stands for.
        to: Rgb,
    },
    /// An emittance that a .tri file cannot hold.
    EmittanceChanged {
        /// The scene's.
        from: Rgb,
        /// The one that the file stands for.
        to: Rgb,
    },
    /// Sides that a .tri file, which tells nothing of sides, will not come back with.
    SidesChanged {
        /// The scene's.
        from: Sides,
        /// Those that the import gives to every surface.
        to: Sides,
    },
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", OneLine(&self.place), OneLine(&self.kind.to_string()))
    }
}

impl fmt::Display for DiagnosticKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Degenerate => f.write_str("the triangle has no area"),
            Self::Duplicate { of } => write!(f, "the triangle repeats triangle {}", of.0),
            Self::NonFinite => {
                f.write_str("a coordinate is not finite: the triangle is collapsed to a point")
            }
            Self::ReflectanceClamped { stated: Rgb(c) } => {
                write!(f, "reflectance {c:?} is above 1 by a rounding: 1 is used")
            }
            Self::ReflectanceOne => f.write_str("a reflectance of exactly 1 loses no light"),
            Self::MissingMaterial { name } => {
                write!(f, "{name} is missing: grey of reflectance 0.5 is used")
            }
            Self::ReversedWinding => {
                f.write_str("the triangle faces against its neighbours: reversed winding?")
            }
            Self::NormalDisagrees => f.write_str("the normals point to the triangle's back"),
            Self::MissingTexture { name, reason } => {
                write!(f, "texture {name} is left out, white is used: {reason}")
            }
            Self::TooFewCorners { corners } => {
                write!(f, "a face of {corners} corners makes no triangle")
            }
            Self::Ignored { what } => write!(f, "left out: {what}"),
            Self::BrokenRule { what } => f.write_str(what),
            Self::ReflectanceChanged { from: Rgb(from), to: Rgb(to) } => {
                write!(f, "reflectance {from:?} becomes {to:?}, beyond which .tri cannot go")
            }
            Self::EmittanceChanged { from: Rgb(from), to: Rgb(to) } => {
                write!(f, "emittance {from:?} becomes {to:?}, the one strength of .tri emitters")
            }
            Self::SidesChanged { from, to } => {
                write!(f, "{} becomes {}: .tri has no sides", sidedness(*from), sidedness(*to))
            }
        }
    }
}

fn sidedness(sides: Sides) -> &'static str {
    match sides {
        Sides::Front => "one-sided",
        Sides::Both => "two-sided",
    }
}
