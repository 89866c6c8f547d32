//! Help that depends on what this build can do.

/// A scene file to read.
pub(super) const SCENE: &str = match (cfg!(feature = "obj"), cfg!(feature = "gltf")) {
    (true, true) => "Scene file: .tri, .vs3, .obj (with its .mtl), .gltf or .glb",
    (true, false) => "Scene file: .tri, .vs3 or .obj (with its .mtl)",
    (false, true) => "Scene file: .tri, .vs3, .gltf or .glb",
    (false, false) => "Scene file: .tri or .vs3",
};

/// The same where it may be left out.
pub(super) const SCENE_OR_BUNDLED: &str = match (cfg!(feature = "obj"), cfg!(feature = "gltf")) {
    (true, true) => {
        "Scene file: .tri, .vs3, .obj (with its .mtl), .gltf or .glb [default: the bundled Cornell box]"
    }
    (false, true) => "Scene file: .tri, .vs3, .gltf or .glb [default: the bundled Cornell box]",
    // The bundled box is a .glb.
    (_, false) => SCENE,
};

/// What `convert` writes.
pub(crate) const CONVERTED: &str = match cfg!(feature = "gltf") {
    true => ".tri, .glb or .ply",
    false => ".tri or .ply",
};

/// Lines of help, each with whether this build can do what it says.
fn lines(all: &[(bool, &str)]) -> String {
    all.iter().filter(|(can, _)| *can).map(|(_, line)| format!("{line}\n")).collect()
}

/// Below the flags of `solve`.
pub(super) fn solve() -> String {
    let (glb, png, exr) = (cfg!(feature = "gltf"), cfg!(feature = "png"), cfg!(feature = "exr"));
    let checkpoint = cfg!(feature = "checkpoint");
    let html = cfg!(feature = "html");
    let solve = lines(&[
        (true, "Examples:"),
        (
            true,
            "  radiosity solve room.tri -o room.csv                       exitance of each input triangle",
        ),
        (
            glb && png,
            "  radiosity solve hall.tri -o hall.glb -o hall.png           lit model and picture",
        ),
        (
            true,
            "  radiosity solve room.tri --error 0.5% --max-time 60s -o fine.csv --report fine.json",
        ),
        (true, "  radiosity solve room.tri --elements 50000 --converge 0.01% -o fixed.csv"),
        (true, "  radiosity solve room.tri --probe points.csv -o at-points.probe.csv"),
        (true, "  radiosity solve hall.tri --max-memory 2GB --snapshot 30s -o hall.ply"),
        (
            cfg!(feature = "live"),
            "  radiosity solve hall.tri -o hall.html --live               watch it in a browser",
        ),
        (checkpoint, "  radiosity solve hall.tri --error 0.1% -o hall.ply --checkpoint hall.ckpt"),
        (
            checkpoint,
            "  radiosity solve hall.tri --error 0.1% -o hall.ply --checkpoint hall.ckpt --resume hall.ckpt",
        ),
        (true, ""),
        (true, "Formats by extension:"),
        (
            true,
            "  .csv  triangle,area,B_r,B_g,B_b: area mean of exitance, a row per input triangle",
        ),
        (true, "  .tri  the elements, exitance as colours 0-255"),
        (true, "  .ply  elements with float exitance"),
        (glb, "  .glb  vertex colours and linear _RADIOSITY"),
        (true, "  .vtu  the elements with light and surface, for ParaView"),
        (png, "  .png  a picture"),
        (exr, "  .exr  a picture in linear, unclamped exitance"),
        (html, "  .html  a page to walk about in, with the report; needs no network"),
        (true, "  .probe.csv  exitance and irradiance at the places of --probe"),
        (true, ""),
    ]);
    solve + "Exit codes: 0 done, or stopped by a limit or Ctrl-C; 1 failed, 2 wrong command line."
}

/// Below the flags of `convert`.
pub(super) fn convert() -> String {
    let convert = lines(&[
        (true, ".tri    a scene again; what it cannot hold is listed as warnings"),
        (
            cfg!(feature = "gltf"),
            ".glb    a scene again, grouped by material, with its surfaces in `extras`",
        ),
    ]);
    convert + ".ply    the geometry alone, showing its emittance"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_this_build_lacks_is_not_offered() {
        for (word, on) in [
            ("glb", cfg!(feature = "gltf")),
            ("png", cfg!(feature = "png")),
            ("exr", cfg!(feature = "exr")),
            ("checkpoint", cfg!(feature = "checkpoint")),
            ("html", cfg!(feature = "html")),
        ] {
            assert_eq!(solve().contains(word), on, "{word}");
        }
        assert_eq!(convert().contains(".glb"), CONVERTED.contains(".glb"));
        assert_eq!(SCENE.contains(".obj"), cfg!(feature = "obj"));
        assert!(SCENE_OR_BUNDLED.starts_with(SCENE));
    }
}
