//! `gallery.glb`: a small gallery, in metres, that uses what glTF offers a diffuse solver.
//!
//! Nested nodes with translation, rotation and non-uniform scale, a mirrored instance, meshes
//! used many times, a texture as reflectance and one as emission, a two-sided panel, metals.

use serde_json::{Value, json};

use super::glb::{Glb, Surface};
use super::mesh::{Point, Shape};
use super::png;
use super::shapes::{Faces, cuboid, disc, drum, grid, shell};

const HALF_WIDTH: f64 = 5.0;
const HEIGHT: f64 = 4.0;
const HALF_DEPTH: f64 = 4.0;
/// A glTF position is an f32; these lengths are multiples of a tenth of a millimetre.
const PER_UNIT: f64 = 10_000.0;

/// Indices of what the nodes refer to.
struct Meshes {
    plinth: usize,
    hook: usize,
    column: usize,
    housing: usize,
    light: usize,
}

pub(crate) fn glb() -> Vec<u8> {
    let mut glb = Glb::default();
    let room = add_room(&mut glb);
    let screen = add_screen(&mut glb);
    let meshes = add_meshes(&mut glb);
    let lamps = add_lamps(&mut glb, &meshes);
    let exhibits = add_exhibits(&mut glb, &meshes);
    let panel = add_panel(&mut glb);
    let camera = add_camera(&mut glb);
    glb.finish("gallery", &[room, screen, lamps, exhibits, panel, camera])
}

/// Floor with a checker of metre squares, walls, ceiling.
fn add_room(glb: &mut Glb) -> usize {
    let checker = [[204, 196, 180], [92, 70, 58], [92, 70, 58], [204, 196, 180]];
    let checker = glb.texture("checker", &png::encode(2, &checker));
    let floor =
        glb.material(&Surface { name: "floor", base_texture: Some(checker), ..Surface::default() });
    let plaster = material(glb, "plaster", [0.8, 0.79, 0.75]);
    let brick = material(glb, "brick", [0.55, 0.25, 0.18]);

    let (low, high) = ([-HALF_WIDTH, 0.0, -HALF_DEPTH], [HALF_WIDTH, HEIGHT, HALF_DEPTH]);
    let part = |faces: Faces| shell(low, high, [5, 2, 4], faces);
    let squares = shell(low, high, [10, 1, 8], Faces::BOTTOM);
    // The texture is two squares wide, and a square is a metre.
    let floor_map = |p: Point| [(p[0] + HALF_WIDTH) / 2.0, (p[2] + HALF_DEPTH) / 2.0];
    let floor = glb.mesh("floor", &squares, floor, Some(floor_map));
    let back = glb.mesh("back_wall", &part(Faces::BACK), brick, None);
    let walls = part(Faces::LEFT | Faces::RIGHT | Faces::FRONT);
    let walls = glb.mesh("walls", &walls, plaster, None);
    let ceiling = glb.mesh("ceiling", &part(Faces::TOP), plaster, None);
    let children = [("floor", floor), ("back_wall", back), ("walls", walls), ("ceiling", ceiling)]
        .map(|(name, mesh)| glb.node(json!({ "name": name, "mesh": mesh })));
    glb.node(json!({ "name": "room", "children": children }))
}

/// A lit screen in a dark case on the back wall; its picture is a texture of the emission.
fn add_screen(glb: &mut Glb) -> usize {
    const COLUMNS: u32 = 8;
    const BARS: [[u8; 3]; COLUMNS as usize] = [
        [255, 255, 255],
        [255, 230, 60],
        [60, 220, 230],
        [60, 200, 80],
        [200, 60, 200],
        [220, 50, 40],
        [40, 60, 210],
        [10, 10, 10],
    ];
    // Four rows of bars; the lowest runs the other way.
    let reversed = BARS.into_iter().rev();
    let pixels: Vec<_> = BARS.into_iter().cycle().take(24).chain(reversed).collect();
    let picture = glb.texture("bars", &png::encode(COLUMNS, &pixels));
    let case = glb.material(&Surface {
        name: "case",
        base_color: [0.1, 0.1, 0.12],
        roughness: 0.4,
        ..Surface::default()
    });
    let lit = glb.material(&Surface {
        name: "screen",
        base_color: [0.05; 3],
        radiance: [5.0; 3],
        emissive_texture: Some(picture),
        ..Surface::default()
    });
    let faces = Faces::ALL - Faces::BACK - Faces::FRONT;
    let case = glb.mesh("case", &cuboid([-1.2, -0.7, 0.0], [1.2, 0.7, 0.08], faces), case, None);
    // A cell for each pixel, as on the floor: a solver may take one colour per triangle.
    let front = grid([-1.2, -0.7, 0.08], [2.4, 0.0, 0.0], [0.0, 1.4, 0.0], COLUMNS, 4);
    let front_map = |p: Point| [(p[0] + 1.2) / 2.4, (0.7 - p[1]) / 1.4];
    let front = glb.mesh("screen", &front.snapped(PER_UNIT), lit, Some(front_map));
    let front = glb.node(json!({ "name": "screen", "mesh": front }));
    glb.node(json!({
        "name": "case", "mesh": case, "children": [front],
        "translation": [-1.5, 2.0, -HALF_DEPTH],
    }))
}

/// The meshes that several nodes show.
fn add_meshes(glb: &mut Glb) -> Meshes {
    let stone = material(glb, "stone", [0.7, 0.7, 0.68]);
    let blue = material(glb, "blue", [0.12, 0.25, 0.6]);
    // Half of a metal's light leaves as a mirror's would; the diffuse half is what counts here.
    let copper = glb.material(&Surface {
        name: "copper",
        base_color: [0.9, 0.6, 0.45],
        metallic: 0.5,
        roughness: 0.35,
        ..Surface::default()
    });
    let tin = glb.material(&Surface {
        name: "tin",
        base_color: [0.6, 0.6, 0.62],
        metallic: 0.25,
        roughness: 0.6,
        ..Surface::default()
    });
    let light = glb.material(&Surface {
        name: "light",
        radiance: [14.0, 12.6, 10.5],
        base_color: [0.8; 3],
        ..Surface::default()
    });

    let plinth = cuboid([-0.5, 0.0, -0.5], [0.5, 1.0, 0.5], Faces::STANDING);
    let column = Shape::all([
        drum(8, (0.0, 0.22), (0.8, 0.12)),
        drum(8, (0.8, 0.12), (1.1, 0.3)),
        disc(8, 1.1, 0.3),
    ]);
    let (low, high) = ([-0.6, -0.1, -0.2], [0.6, 0.0, 0.2]);
    Meshes {
        plinth: glb.mesh("plinth", &plinth, stone, None),
        hook: glb.mesh("hook", &hook(), blue, None),
        column: glb.mesh("column", &column.snapped(PER_UNIT), copper, None),
        housing: glb.mesh("housing", &cuboid(low, high, Faces::AROUND), tin, None),
        light: glb.mesh("light", &cuboid(low, high, Faces::BOTTOM), light, None),
    }
}

/// Three bars along three axes: no rotation turns it into its mirror image.
fn hook() -> Shape {
    let shape = Shape::all([
        cuboid([0.0, 0.0, 0.0], [0.6, 0.2, 0.2], Faces::STANDING),
        cuboid([0.0, 0.2, 0.0], [0.2, 0.7, 0.2], Faces::STANDING),
        cuboid([0.0, 0.5, 0.2], [0.2, 0.7, 0.6], Faces::ALL - Faces::BACK),
    ]);
    shape.moved([-0.3, 0.0, -0.1]).snapped(PER_UNIT)
}

/// Three instances of one lamp under a node at the ceiling.
fn add_lamps(glb: &mut Glb, meshes: &Meshes) -> usize {
    let lamps = [("west", -3.0), ("middle", 0.0), ("east", 3.0)].map(|(name, x)| {
        let light = glb.node(json!({ "name": format!("light_{name}"), "mesh": meshes.light }));
        glb.node(json!({
            "name": format!("lamp_{name}"), "mesh": meshes.housing, "children": [light],
            "translation": [x, 0.0, 0.0], "rotation": about_y(90.0),
        }))
    });
    glb.node(json!({ "name": "lamps", "translation": [0.0, HEIGHT, 0.0], "children": lamps }))
}

/// Plinths with what stands on them.
fn add_exhibits(glb: &mut Glb, meshes: &Meshes) -> usize {
    // As it is modelled, and its mirror image, side by side.
    let plain = on_plinth(glb, meshes, "plain", json!({}), [0.8, 0.9, 0.6]);
    let mirrored =
        on_plinth(glb, meshes, "mirrored", json!({ "scale": [-1.0, 1.0, 1.0] }), [0.8, 0.9, 0.6]);
    let pair = [
        group(glb, "plain", [-0.8, 0.0, 0.0], 0.0, &plain),
        group(glb, "mirrored", [0.8, 0.0, 0.0], 0.0, &mirrored),
    ];
    let pair = group(glb, "pair", [-2.6, 0.0, 0.6], 30.0, &pair);

    // A turned thing inside a stretched one is sheared: no translation, rotation and scale of a
    // single node could place it.
    let turned = glb.node(json!({
        "name": "sheared_hook", "mesh": meshes.hook, "rotation": about_y(40.0),
        "translation": [0.0, 1.0, 0.0], "scale": [0.9, 0.8, 0.9],
    }));
    let stretched = glb.node(json!({
        "name": "stretched_plinth", "mesh": meshes.plinth, "children": [turned],
        "translation": [2.6, 0.0, 1.6], "rotation": about_y(-20.0), "scale": [1.4, 0.7, 0.8],
    }));

    let columns = [-0.9, 0.9].map(|x| {
        glb.node(json!({
            "name": "column", "mesh": meshes.column, "translation": [x, 0.0, 0.0],
            "scale": [1.0, 1.0 + x / 3.0, 1.0],
        }))
    });
    let columns = group(glb, "columns", [2.4, 0.0, -2.6], 10.0, &columns);
    glb.node(json!({ "name": "exhibits", "children": [pair, stretched, columns] }))
}

/// A plinth of a given size and a hook on it, the hook's node as `placed`.
fn on_plinth(
    glb: &mut Glb,
    meshes: &Meshes,
    name: &str,
    mut placed: Value,
    size: [f64; 3],
) -> [usize; 2] {
    placed["name"] = json!(format!("{name}_hook"));
    placed["mesh"] = json!(meshes.hook);
    placed["translation"] = json!([0.0, size[1], 0.0]);
    let plinth = json!({ "name": format!("{name}_plinth"), "mesh": meshes.plinth, "scale": size });
    [glb.node(plinth), glb.node(placed)]
}

fn group(glb: &mut Glb, name: &str, at: Point, degrees: f64, children: &[usize]) -> usize {
    glb.node(json!({
        "name": name, "translation": at, "rotation": about_y(degrees), "children": children,
    }))
}

/// A free-standing sheet without thickness that is seen from both sides.
fn add_panel(glb: &mut Glb) -> usize {
    let paper = glb.material(&Surface {
        name: "paper",
        base_color: [0.75, 0.7, 0.3],
        double_sided: true,
        ..Surface::default()
    });
    let sheet = grid([-0.9, 0.0, 0.0], [1.8, 0.0, 0.0], [0.0, 1.9, 0.0], 2, 2);
    let mesh = glb.mesh("panel", &sheet, paper, None);
    glb.node(json!({
        "name": "panel", "mesh": mesh,
        "translation": [1.6, 0.0, 0.4], "rotation": about_y(-35.0),
    }))
}

/// A camera on a tripod: the tripod stands in a corner, the camera looks across and down.
fn add_camera(glb: &mut Glb) -> usize {
    let camera = glb.camera("camera", 0.9, 1.5, 0.05, 50.0);
    // A turn about x by -8 degrees, rounded like about_y.
    let (sin, cos) = (-4.0_f64).to_radians().sin_cos();
    let head = glb.node(json!({
        "name": "camera", "camera": camera, "rotation": [rounded(sin), 0.0, 0.0, rounded(cos)],
    }));
    glb.node(json!({
        "name": "tripod", "children": [head],
        "translation": [-4.4, 1.9, 3.6], "rotation": about_y(-48.0),
    }))
}

fn material(glb: &mut Glb, name: &str, base_color: [f64; 3]) -> usize {
    glb.material(&Surface { name, base_color, ..Surface::default() })
}

/// The quaternion of a turn about y.
fn about_y(degrees: f64) -> [f64; 4] {
    let (sin, cos) = (degrees / 2.0).to_radians().sin_cos();
    [0.0, rounded(sin), 0.0, rounded(cos)]
}

/// To nine digits, so that the bytes do not depend on the platform's sine; an f32 holds seven.
fn rounded(x: f64) -> f64 {
    (x * 1e9).round() / 1e9
}
