//! What a build without some features leaves out, and how it says so.

use clap::error::{ContextKind, ContextValue};

use crate::failure::Failure;

/// Commands and flags that this build leaves out, each with its feature.
const WORDS: &[(&str, &str)] = &[
    #[cfg(not(feature = "checkpoint"))]
    ("--checkpoint", "checkpoint"),
    #[cfg(not(feature = "checkpoint"))]
    ("--every", "checkpoint"),
    #[cfg(not(feature = "checkpoint"))]
    ("--resume", "checkpoint"),
    #[cfg(not(feature = "config"))]
    ("--config", "config"),
    #[cfg(not(feature = "form-factors"))]
    ("form-factors", "form-factors"),
    #[cfg(not(feature = "manual"))]
    ("completions", "manual"),
    #[cfg(not(feature = "manual"))]
    ("man", "manual"),
    #[cfg(not(any(feature = "exr", feature = "png")))]
    ("--camera", "png"),
    #[cfg(not(any(feature = "exr", feature = "png")))]
    ("--size", "png"),
    #[cfg(not(feature = "verify"))]
    ("verify", "verify"),
    #[cfg(not(feature = "html"))]
    ("view", "html"),
    #[cfg(not(feature = "live"))]
    ("--live", "live"),
    #[cfg(not(feature = "live"))]
    ("--live-port", "live"),
];

/// Refuses what needs a feature that this build lacks.
pub(crate) fn refused(what: &str, feature: &str) -> Failure {
    let message = format!(
        "{what}: this program was built without the feature `{feature}`; build it with --features {feature}"
    );
    Failure::Usage(message)
}

/// Refuses an output whose format this build leaves out, if that is the error.
pub(crate) fn format(error: &output::Error) -> Option<Failure> {
    let output::ErrorKind::FeatureOff(feature) = error.kind() else { return None };
    // One feature of this program reads glTF and writes GLB.
    let feature = if *feature == "glb" { "gltf" } else { feature };
    let path = error.path().map_or_else(|| feature.into(), |path| path.to_string_lossy());
    Some(refused(&path, feature))
}

/// Why a command line was not understood, if a build with more features would.
pub(crate) fn of(error: &clap::Error) -> Option<Failure> {
    let unknown = [ContextKind::InvalidSubcommand, ContextKind::InvalidArg];
    let ContextValue::String(word) = unknown.into_iter().find_map(|kind| error.get(kind))? else {
        return None;
    };
    let (word, feature) = WORDS.iter().find(|(known, _)| known == word)?;
    Some(refused(word, feature))
}
