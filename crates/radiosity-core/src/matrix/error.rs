//! What a matrix, or a solve through one, cannot do: one line each.

use std::fmt;

/// Why there is no matrix, no closure or no solution.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Error {
    /// Lists that belong together differ in length.
    Length {
        /// Which list.
        what: &'static str,
        /// How many items belong in it.
        expected: usize,
        /// How many are in it.
        found: usize,
    },
    /// An area that is not finite and above 0.
    Area {
        /// Which row, from 0.
        row: usize,
    },
    /// A row with a column out of range or out of order, or a number that is no form factor.
    Entry {
        /// Which row, from 0.
        row: usize,
    },
    /// A reflectance outside [0, 1].
    Reflectance {
        /// Of which surface, from 0.
        surface: usize,
    },
    /// An emittance that is below 0 or not finite.
    Emittance {
        /// Of which surface, from 0.
        surface: usize,
    },
    /// Light that nothing absorbs: its surfaces reflect all of it, and none of it leaves.
    Singular {
        /// One of the surfaces.
        name: String,
    },
    /// A row whose sum is further from 1 than the errors of its form factors allow.
    Open {
        /// Its name.
        name: String,
        /// Its sum.
        sum: f64,
        /// How far its sum may be from the truth.
        error: f64,
    },
    /// Rows that no factors bring to 1: some surface sees more area than looks back at it.
    NotClosable {
        /// The furthest from 1 that a row was left.
        defect: f64,
    },
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Length { what, expected, found } => {
                write!(f, "{found} {what}, expected {expected}")
            }
            Self::Area { row } => write!(f, "row {row}: expected a finite area above 0"),
            Self::Entry { row } => write!(
                f,
                "row {row}: expected ascending columns, and finite form factors and errors of at \
                 least 0"
            ),
            Self::Reflectance { surface } => {
                write!(f, "surface {surface}: expected a reflectance from 0 to 1")
            }
            Self::Emittance { surface } => {
                write!(f, "surface {surface}: expected a finite emittance of at least 0")
            }
            Self::Singular { name } => write!(
                f,
                "nothing absorbs the light that reaches {name:?}: every surface it can get to \
                 reflects all of it and none of it leaves, so there is no solution"
            ),
            Self::Open { name, sum, error } => write!(
                f,
                "row {name:?} sums to {sum:.6}, and the errors of its form factors allow only \
                 {error:.1e} from 1: it sees out of the scene or sees backs, and only closed \
                 scenes can be closed"
            ),
            Self::NotClosable { defect } => write!(
                f,
                "the rows cannot all sum to 1: {defect:.1e} is left over; surfaces are missing \
                 or lie in one another"
            ),
        }
    }
}

impl std::error::Error for Error {}
