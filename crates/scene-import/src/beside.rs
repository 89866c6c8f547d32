//! Reading the files that a scene file names.

use std::fs;
use std::path::Path;

/// Reads the file `relative` beside the scene; the error is half a sentence.
pub(crate) fn read(folder: Option<&Path>, relative: &str) -> Result<Vec<u8>, String> {
    let folder = folder.ok_or("the scene was opened without its folder")?;
    // Material libraries written on Windows separate folders by backslashes.
    let relative = relative.replace('\\', "/");
    if Path::new(&relative).is_absolute() {
        return Err("its path is not relative to the scene".to_owned());
    }
    let path = folder.join(relative);
    // A device such as /dev/zero never ends, and a pipe may never begin.
    let metadata = fs::metadata(&path).map_err(|cause| cause.to_string())?;
    if !metadata.is_file() {
        return Err("it is not a plain file".to_owned());
    }
    fs::read(&path).map_err(|cause| cause.to_string())
}
