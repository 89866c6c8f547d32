//! What a caller may decide about the reading of a file.

use scene::Sides;

/// How files are turned into scenes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Factor on the light of .tri emitters, finite and at least 0; 1 by default.
    pub tri_light: f64,
    /// Reflectance of a .tri surface whose front is 255, in [0, 1]; 0.5 by default.
    pub tri_reflect: f64,
    /// Which sides of the surfaces take part.
    pub sides: SidesRule,
    /// Whether the scene's glTF document is handed out beside it, as
    /// [`Imported::document`](crate::Imported::document).
    pub keep_document: bool,
    /// Whether the files that a scene names may lie outside its folder; not by default, as a scene
    /// may come from anywhere.
    pub allow_outside: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            tri_light: 1.0,
            tri_reflect: 0.5,
            sides: SidesRule::Scene,
            keep_document: false,
            allow_outside: false,
        }
    }
}

/// Who decides which sides of a surface take part.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SidesRule {
    /// The file: glTF's `doubleSided`; the front alone in .tri and OBJ, which cannot say.
    #[default]
    Scene,
    /// The front of every surface.
    Front,
    /// Both sides of every surface.
    Both,
}

impl SidesRule {
    /// The sides of a surface for which the file says `from_file`.
    pub(crate) fn decide(self, from_file: Sides) -> Sides {
        match self {
            Self::Scene => from_file,
            Self::Front => Sides::Front,
            Self::Both => Sides::Both,
        }
    }
}
