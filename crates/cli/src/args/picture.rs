//! Flags for pictures, and for the colours of other formats.

/// The size of a picture, if the command line does not say.
const SIZE: (u32, u32) = (1024, 768);

/// How pictures, and the colours in .ply and .glb, look.
#[derive(Clone, Debug, clap::Args)]
#[command(next_help_heading = "Pictures")]
pub(crate) struct PictureArgs {
    /// Camera of the scene to look through, by name [default: the first, or one chosen to
    /// see most of the scene]
    #[cfg(any(feature = "exr", feature = "png"))]
    #[arg(long, value_name = "NAME")]
    camera: Option<String>,

    /// Picture size in pixels [default: 1024x768]
    #[cfg(any(feature = "exr", feature = "png"))]
    #[arg(long, value_name = "WxH", value_parser = size)]
    size: Option<(u32, u32)>,

    /// Brighten by this many stops (doublings), relative to the automatic exposure; an .exr has no
    /// exposure
    #[arg(long, value_name = "STOPS", default_value_t = 0.0, allow_negative_numbers = true)]
    pub(crate) exposure: f64,
}

impl Default for PictureArgs {
    fn default() -> Self {
        Self {
            #[cfg(any(feature = "exr", feature = "png"))]
            camera: None,
            #[cfg(any(feature = "exr", feature = "png"))]
            size: None,
            exposure: 0.0,
        }
    }
}

impl PictureArgs {
    /// The camera that a picture is taken with, if one is named.
    pub(crate) fn camera(&self) -> Option<&str> {
        #[cfg(any(feature = "exr", feature = "png"))]
        return self.camera.as_deref();
        #[cfg(not(any(feature = "exr", feature = "png")))]
        None
    }

    /// Width and height of a picture, pixels.
    pub(crate) fn size(&self) -> (u32, u32) {
        #[cfg(any(feature = "exr", feature = "png"))]
        return self.size.unwrap_or(SIZE);
        #[cfg(not(any(feature = "exr", feature = "png")))]
        SIZE
    }
}

/// A size in pixels: `1024x768`.
#[cfg(any(feature = "exr", feature = "png"))]
fn size(text: &str) -> Result<(u32, u32), String> {
    let side = |t: &str| t.parse::<u32>().ok().filter(|n| (1..=16_384).contains(n));
    text.split_once(['x', 'X', '×'])
        .and_then(|(w, h)| Some((side(w)?, side(h)?)))
        .ok_or_else(|| "expected a width and a height from 1 to 16384, such as 1024x768".into())
}

#[cfg(all(test, any(feature = "exr", feature = "png")))]
mod tests {
    use super::*;

    #[test]
    fn sizes() {
        assert_eq!(size("640x480"), Ok((640, 480)));
        assert!(["640", "0x1", "1x99999", "x"].iter().all(|t| size(t).is_err()));
        assert_eq!(PictureArgs::default().size(), size("1024x768").unwrap());
    }
}
