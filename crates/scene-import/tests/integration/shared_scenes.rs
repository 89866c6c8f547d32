//! The shared models, where they are at hand.

use std::path::PathBuf;

use scene::Rgb;
use scene_import::{DiagnosticKind, Imported, Options, open};

/// A file of the folder `shared` beside the checkout, or `None` after saying so.
#[expect(clippy::print_stdout, reason = "a test that is skipped says so")]
fn shared(path: &str) -> Option<PathBuf> {
    let here = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    let found = here.ancestors().map(|up| up.join("shared").join(path)).find(|file| file.is_file());
    if found.is_none() {
        println!("skipped: no shared/{path} beside the checkout");
    }
    found
}

fn reversed(imported: &Imported) -> Vec<u32> {
    let suspects =
        imported.diagnostics.iter().filter(|d| d.kind == DiagnosticKind::ReversedWinding);
    suspects.filter_map(|d| d.triangle).map(|id| id.0).collect()
}

#[test]
fn tri_models_have_their_published_counts_and_lamps() {
    for (name, triangles) in [("room", 156), ("blocks", 464), ("church", 9506), ("box", 16)] {
        let Some(path) = shared(&format!("scenes/{name}.tri")) else { return };
        let imported = open(&path, &Options::default()).unwrap();
        assert_eq!(imported.scene.triangles().len(), triangles, "{name}");
        let lamps: Vec<_> = imported.scene.materials().iter().filter(|m| m.emits()).collect();
        assert!(!lamps.is_empty(), "{name}");
        // A white lamp: 100 · 255.
        assert!(lamps.iter().all(|m| m.emittance == Rgb::splat(25_500.0)), "{name}: {lamps:?}");
        match name {
            "room" | "blocks" => assert_eq!(imported.diagnostics, [], "{name}"),
            // One wall of the box is known to be reversed.
            "box" => assert_eq!(reversed(&imported).len(), 2),
            // A pilaster from y = 699 to y = 704 whose two sides both face +y: the side at
            // 699, triangles 5743 to 5748, faces the stone.
            _ => assert!((5743..=5748).all(|id| reversed(&imported).contains(&id))),
        }
    }
}

#[cfg(feature = "obj")]
#[test]
fn cornell_box_matches_the_reference_row_by_row() {
    let (Some(scene), Some(reference)) =
        (shared("scenes/cornell.obj"), shared("reference/cornell.csv"))
    else {
        return;
    };
    let imported = open(&scene, &Options::default()).unwrap();
    assert_eq!(imported.diagnostics, []);
    let csv = std::fs::read_to_string(reference).unwrap();
    let rows: Vec<Vec<&str>> = csv.lines().skip(1).map(|row| row.split(',').collect()).collect();
    assert_eq!((imported.scene.triangles().len(), rows.len()), (32, 32));
    for (id, row) in imported.scene.ids().zip(rows) {
        let area: f64 = row[1].parse().unwrap();
        // The reference was rounded to f32.
        assert!((imported.scene.area(id) / area - 1.0).abs() < 1e-6, "triangle {}", id.0);
        assert_eq!(imported.scene.material_of(id).emits(), row[8] == "1", "triangle {}", id.0);
    }
    let light = imported.scene.materials().iter().find(|m| m.name == "light").unwrap();
    assert_eq!(light.emittance, Rgb::new(17.0, 12.0, 4.0) * std::f64::consts::PI);
}
