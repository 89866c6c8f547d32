//! The solver against 33 exact solutions, where that data is present.
//!
//! An entry is run if a uniform mesh can meet it: its answer is that of the continuous
//! equation, or near enough to it. What is not run says why.

use std::fs;

use conformance::case::Surface;
use conformance::{Engine, Geometry, Solved, shared, solve};
use radiosity_core::ShootingConfig;
use scene::{Material, Rgb, Scene, Sides};
use serde_json::Value;

use crate::BALANCED;

/// Unshot share: a tenth of the tolerances below.
const UNSHOT: f64 = 1e-3;

/// The entries' closed forms hold for every point of the scene: form factors (1 % each, 1e-4
/// on average) and unshot light remain.
const EXACT: f64 = 1e-2;

/// The entries take one exitance per face; the light varies within a face. For a cube with
/// one lamp that alone makes 1.34 % (ρ = .5) and .92 % (ρ = .9) of the faces' means.
const ONE_PER_FACE: f64 = 2e-2;

/// Two plates a thousandth of their side apart, elements sixty times the gap: light falls off at
/// the rim within a gap, while the points at the corners of an element stand for half of it.
/// With elements of edge h that is at most 4·h/2·(1 − F at the rim, .5) of the light: 6 %.
const THIN_GAP: f64 = 6e-2;

/// Facets in the place of spheres, of edge .6 r: they light each other less evenly. 3 % for the
/// smallest inner sphere; a quarter of the size brings a quarter of it.
const FACETS: f64 = 4e-2;

/// The data, or `None` with a line that says so.
pub(crate) fn data() -> Option<Value> {
    let Some(path) = shared::find("cases/form_factors_and_solutions.json") else {
        println!("skipped: no shared/cases/form_factors_and_solutions.json beside the checkout");
        return None;
    };
    Some(serde_json::from_slice(&fs::read(path).unwrap()).unwrap())
}

#[test]
fn exact_solutions() {
    let Some(data) = data() else { return };
    let entries = data["solutions"].as_array().unwrap();
    let (mut run, mut not_run) = (0, 0);
    for entry in entries {
        let id = entry["id"].as_str().unwrap();
        match check(entry) {
            Ok((error, bound)) => {
                run += 1;
                println!("{id}: error {error:.1e}, at most {bound:.0e}");
                assert!(error <= bound, "{id}: {error}");
            }
            Err(reason) => {
                not_run += 1;
                println!("{id}: not run: {reason}");
            }
        }
    }
    println!("{run} solutions checked, {not_run} not run");
    assert!(run >= 23, "the data holds more solutions that can be checked: {run}");
}

/// Error and bound, or why it is not run.
fn check(entry: &Value) -> Result<(f64, f64), &'static str> {
    match entry["kind"].as_str().unwrap() {
        "solution_white_furnace" => Ok(white_furnace(entry)),
        "solution_general_furnace" => Ok(general_furnace(entry)),
        "solution_two_plates" => two_plates(entry),
        "solution_box_face_constant" => one_emitter(entry),
        "solution_concentric_spheres" => Ok(concentric_spheres(entry)),
        "solution_integrating_sphere" => Ok(integrating_sphere(entry)),
        "solution_cube_nxn_quads_exact_F" => Ok(refined_cube(entry)),
        _ => Err(ONE_EACH),
    }
}

/// Why an entry is not run here.
const ONE_EACH: &str = "one exitance per surface, while our surfaces are split and vary: \
                        radiosity-core's tests solve it as a matrix";

/// Rounding of the books, per light shot.
const ROUNDED: f64 = 1e-15;

const CUBE: Geometry = Geometry::Box { size: [1.0; 3] };
const FACES: [&str; 6] = ["x0", "x1", "y0", "y1", "z0", "z1"];

fn white_furnace(entry: &Value) -> (f64, f64) {
    let rho = number(&entry["rho"]);
    let all = surface(rho, number(&entry["E"]));
    let (_, solved) = run(&CUBE, 48, |_| all);
    let b = number(&entry["B"]);
    let elements = solved.solution.elements.iter();
    let worst = elements.map(|e| (e.exitance[0] / b - 1.0).abs()).fold(0.0, f64::max);
    (worst, EXACT)
}

fn general_furnace(entry: &Value) -> (f64, f64) {
    let rho = entry["rho_example"].as_array().unwrap();
    let of = |face: &str| {
        let rho = number(&rho[FACES.iter().position(|f| *f == face).unwrap()]);
        surface(rho, 1.0 - rho)
    };
    let (_, solved) = run(&CUBE, 48, of);
    let elements = solved.solution.elements.iter();
    (elements.map(|e| (e.exitance[0] - 1.0).abs()).fold(0.0, f64::max), EXACT)
}

fn two_plates(entry: &Value) -> Result<(f64, f64), &'static str> {
    let f = number(&entry["F12"]);
    let (gap, bound) = match f {
        1.0 => return Err("plates without end, which radiosity-core's tests solve as a matrix"),
        f if (0.19..0.21).contains(&f) => (1.0, ONE_PER_FACE),
        _ => (1e-3, THIN_GAP),
    };
    let names = ["lower", "upper"];
    let (geometry, of) = (Geometry::TwoPlates { side: 1.0, gap }, by_group(entry, &names));
    Ok((means_error(&geometry, 512, of, &names, |i| number(&entry["B"][i])), bound))
}

fn one_emitter(entry: &Value) -> Result<(f64, f64), &'static str> {
    match entry["id"].as_str().unwrap() {
        id if !id.starts_with("cube_one_emitter") => Err(ONE_EACH),
        _ => {
            let of = by_group(entry, &FACES);
            let exact = |i| number(&entry["B"][i]);
            Ok((means_error(&CUBE, 600, of, &FACES, exact), ONE_PER_FACE))
        }
    }
}

fn refined_cube(entry: &Value) -> (f64, f64) {
    let table = entry["face_averages"].as_array().unwrap();
    let mut worst = 0.0f64;
    for rho in [0.5, 0.9] {
        let rows = table.iter().filter(|row| row["rho"] == rho);
        let finest = rows.max_by_key(|row| row["n"].as_u64()).unwrap();
        let of = |face: &str| surface(rho, f64::from(u8::from(face == "z0")));
        let exact = |i: usize| {
            let name = ["side", "side", "side", "side", "emitter", "opposite"][i];
            finest[name].as_f64().unwrap()
        };
        let error = means_error(&CUBE, 600, of, &FACES, exact);
        println!("cube with one lamp, ρ = {rho}, {} a side: E1 {error:.1e}", finest["n"]);
        worst = worst.max(error);
    }
    (worst, EXACT)
}

fn concentric_spheres(entry: &Value) -> (f64, f64) {
    let names = ["inner", "outer"];
    let [inner, outer] = [0, 1].map(|i| number(&entry["r"][i]));
    // The gap must be some facets wide.
    let (level, elements) = if inner > 0.8 { (2, 1280) } else { (1, 640) };
    let geometry = Geometry::ConcentricSpheres { inner, outer, level };
    let exact = |i| number(&entry["B"][i]);
    (means_error(&geometry, elements, by_group(entry, &names), &names, exact), FACETS)
}

fn integrating_sphere(entry: &Value) -> (f64, f64) {
    let rho = number(&entry["rho"]);
    let share = number(&entry["port_fraction"]);
    // Facets of half a per cent of the area make any share to a quarter of a per cent.
    let geometry = |share| Geometry::CappedSphere { level: 2, share };
    if share == 0.0 {
        let of = |group: &str| surface(rho, f64::from(u8::from(group == "cap")));
        let exact = |i: usize| number(&entry[["B_off_cap", "B_on_cap"][i]]);
        return (means_error(&geometry(0.1), 320, of, &["wall", "cap"], exact), FACETS);
    }
    let wall = surface(rho, number(&entry["E_wall"]));
    let of = |group: &str| if group == "wall" { wall } else { surface(0.0, 0.0) };
    let exact = |_| number(&entry["B_wall"]);
    (means_error(&geometry(share), 320, of, &["wall"], exact), FACETS)
}

/// E1 of the groups' area means: Σ A·|B − B*| / Σ A·B*.
fn means_error(
    geometry: &Geometry,
    elements: usize,
    of: impl Fn(&str) -> Surface,
    names: &[&str],
    exact: impl Fn(usize) -> f64,
) -> f64 {
    let (scene, solved) = run(geometry, elements, of);
    let light = solved.solution.triangle_exitance(&scene);
    let (mut error, mut total) = (0.0, 0.0);
    for (i, name) in names.iter().enumerate() {
        let (mut power, mut area) = (0.0, 0.0);
        for id in scene.ids() {
            if scene.groups()[scene.triangles()[id.index()].group.index()] == *name {
                power += scene.area(id) * light[id.index()][0];
                area += scene.area(id);
            }
        }
        error += (power - area * exact(i)).abs();
        total += area * exact(i);
    }
    error / total
}

/// Reflectance and emittance of the entry's i-th surface for the i-th name.
fn by_group<'a>(entry: &'a Value, names: &'a [&str]) -> impl Fn(&str) -> Surface + 'a {
    move |group| {
        let i = names.iter().position(|name| *name == group).unwrap();
        surface(number(&entry["rho"][i]), number(&entry["E"][i]))
    }
}

fn surface(reflectance: f64, emittance: f64) -> Surface {
    Surface { reflectance: [reflectance; 3], emittance: [emittance; 3] }
}

fn run(geometry: &Geometry, elements: usize, of: impl Fn(&str) -> Surface) -> (Scene, Solved) {
    let scene = geometry.scene(|group| {
        let Surface { reflectance, emittance } = of(group);
        let (reflectance, emittance) = (Rgb(reflectance), Rgb(emittance));
        Ok(Material { name: group.into(), reflectance, emittance, sides: Sides::Front })
    });
    let scene = scene.unwrap();
    let solved = solve(&scene, elements, ShootingConfig::until(UNSHOT), Engine::FIRST).unwrap();
    let imbalance = solved.ledger.imbalance();
    // Of all the light that is shot, 1 / (1 − ρ) times what is emitted, some roundings.
    let used = scene.ids().map(|id| scene.material_of(id).reflectance.max_channel());
    let shot = 1.0 / (1.0 - used.fold(0.0, f64::max));
    assert!(imbalance < BALANCED.max(ROUNDED * shot), "{geometry:?}: {imbalance:e}");
    (scene, solved)
}

/// Numbers are strings where they have more digits than an f64.
fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| value.as_str().unwrap().parse().unwrap())
}
