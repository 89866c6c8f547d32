//! Numbers of the JSON that no surface can have: refused with the way to them.
//!
//! Numbers that their type cannot hold never come here: serde_json refuses them, with their
//! line and column in the JSON.

use std::fmt::Display;

use gltf::json::{Material, Root};

use super::stated::Stated;
use crate::{Error, ErrorKind, range};

const REFLECTANCE: &str = "a reflectance from 0 to 1";
const EMISSION: &str = "a finite number of at least 0";

/// Looks at every material, used or not. Those that state their surface are judged by that
/// alone, as nothing else of them counts.
pub(super) fn check(file: &str, json: &Root, stated: &Stated) -> Result<(), Error> {
    let checker = Checker { file };
    for (index, material) in json.materials.iter().enumerate() {
        let path = format!("materials[{index}]");
        match stated.surface(index) {
            Some(surface) => {
                let path = format!("{path}.extras.radiosity");
                let (reflectance, emittance) = (surface.reflectance().0, surface.emittance().0);
                checker.reflectance(&format!("{path}.reflectance"), &reflectance)?;
                checker.emission(&format!("{path}.emittance"), &emittance)?;
            }
            None => checker.appearance(&path, material)?,
        }
    }
    Ok(())
}

struct Checker<'a> {
    file: &'a str,
}

impl Checker<'_> {
    /// What glTF's own rule makes a surface of.
    fn appearance(&self, path: &str, material: &Material) -> Result<(), Error> {
        let pbr = &material.pbr_metallic_roughness;
        let pbr_path = format!("{path}.pbrMetallicRoughness");
        // The fourth component is alpha, which is left out.
        let base = &pbr.base_color_factor.0[..3];
        self.reflectance(&format!("{pbr_path}.baseColorFactor"), base)?;
        let metallic = pbr.metallic_factor.0;
        if !(0.0..=1.0).contains(&metallic) {
            let path = format!("{pbr_path}.metallicFactor");
            return Err(self.expected(&path, "a number from 0 to 1", metallic));
        }
        self.emission(&format!("{path}.emissiveFactor"), &material.emissive_factor.0)?;
        let strength = material.extensions.as_ref().and_then(|e| e.emissive_strength.as_ref());
        let strength = strength.map_or(1.0, |strength| strength.emissive_strength.0);
        if !range::is_emittance(strength.into()) {
            let extension = "extensions.KHR_materials_emissive_strength.emissiveStrength";
            return Err(self.expected(&format!("{path}.{extension}"), EMISSION, strength));
        }
        Ok(())
    }

    fn reflectance<T: Copy + Into<f64> + Display>(
        &self,
        path: &str,
        channels: &[T],
    ) -> Result<(), Error> {
        self.each(path, channels, REFLECTANCE, range::is_reflectance)
    }

    fn emission<T: Copy + Into<f64> + Display>(
        &self,
        path: &str,
        channels: &[T],
    ) -> Result<(), Error> {
        self.each(path, channels, EMISSION, range::is_emittance)
    }

    /// Names the first number of a list that is not sound.
    fn each<T: Copy + Into<f64> + Display>(
        &self,
        path: &str,
        numbers: &[T],
        what: &str,
        sound: impl Fn(f64) -> bool,
    ) -> Result<(), Error> {
        match numbers.iter().position(|&number| !sound(number.into())) {
            Some(index) => Err(self.expected(&format!("{path}[{index}]"), what, numbers[index])),
            None => Ok(()),
        }
    }

    fn expected(&self, path: &str, what: &str, found: impl Display) -> Error {
        let message = format!("{path}: expected {what}, found {found}");
        Error::new(ErrorKind::Invalid, self.file, message)
    }
}
