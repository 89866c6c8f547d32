//! VTK XML, read back by a small parser of its own, and by meshio where a Python has it.

use std::collections::HashMap;
use std::process::Command;

use glam::DVec3;
use output::{Format, Options};
use scene::{Face, Material, Rgb, Scene, Sides, Solution};

use crate::common::{Lit, bytes, rectangle, square};

/// A file in pieces: the text in front, and the numbers by section and name.
struct Vtu {
    text: String,
    arrays: HashMap<(String, String), Numbers>,
}

/// Tuples of numbers, widened; all that are written fit.
#[derive(Debug, PartialEq)]
struct Numbers {
    kind: String,
    tuples: Vec<Vec<f64>>,
}

fn attribute<'a>(tag: &'a str, name: &str) -> Option<&'a str> {
    let rest = tag.split_once(&format!(" {name}=\""))?.1;
    Some(rest.split_once('"').unwrap().0)
}

fn parse(bytes: &[u8]) -> Vtu {
    let start = b"<AppendedData encoding=\"raw\">\n_";
    let at = bytes.windows(start.len()).position(|w| w == start).unwrap();
    let text = String::from_utf8(bytes[..at].to_vec()).unwrap();
    let data = &bytes[at + start.len()..];
    assert!(text.contains("byte_order=\"LittleEndian\" header_type=\"UInt64\""));
    let (mut section, mut arrays, mut end) = (String::new(), HashMap::new(), 0);
    for line in text.lines() {
        let word = line.trim_start_matches('<').split([' ', '>']).next().unwrap();
        if word != "DataArray" {
            section = word.to_owned();
            continue;
        }
        let Some(offset) = attribute(line, "offset") else { continue };
        let offset: usize = offset.parse().unwrap();
        assert_eq!(offset, end, "arrays follow each other");
        let length = u64::from_le_bytes(data[offset..offset + 8].try_into().unwrap()) as usize;
        end = offset + 8 + length;
        let kind = attribute(line, "type").unwrap().to_owned();
        let raw = &data[offset + 8..end];
        let numbers: Vec<f64> = match kind.as_str() {
            "UInt8" => raw.iter().map(|b| f64::from(*b)).collect(),
            "Int32" => words(raw, |w| f64::from(i32::from_le_bytes(w))),
            "Int64" => words(raw, |w| i64::from_le_bytes(w) as f64),
            "Float32" => words(raw, |w| f64::from(f32::from_le_bytes(w))),
            "Float64" => words(raw, f64::from_le_bytes),
            other => panic!("{other}"),
        };
        let components = attribute(line, "NumberOfComponents").map_or(1, |n| n.parse().unwrap());
        let tuples = numbers.chunks_exact(components).map(<[f64]>::to_vec).collect();
        let name = attribute(line, "Name").unwrap().to_owned();
        arrays.insert((section.clone(), name), Numbers { kind, tuples });
    }
    assert_eq!(&data[end..], b"\n</AppendedData>\n</VTKFile>\n");
    Vtu { text, arrays }
}

fn words<const N: usize>(raw: &[u8], number: impl Fn([u8; N]) -> f64) -> Vec<f64> {
    assert!(raw.len().is_multiple_of(N));
    raw.chunks_exact(N).map(|w| number(w.try_into().unwrap())).collect()
}

impl Vtu {
    fn get(&self, section: &str, name: &str) -> &Numbers {
        &self.arrays[&(section.to_owned(), name.to_owned())]
    }

    fn column(&self, name: &str) -> Vec<f64> {
        self.get("CellData", name).tuples.iter().map(|t| t[0]).collect()
    }

    /// The corners of each cell, as numbers of points.
    fn cells(&self) -> Vec<[usize; 3]> {
        let flat = |name| self.get("Cells", name).tuples.iter().map(|t| t[0] as usize);
        let connectivity: Vec<_> = flat("connectivity").collect();
        let ends = flat("offsets").enumerate();
        assert!(flat("types").all(|kind| kind == 5));
        ends.map(|(i, end)| {
            assert_eq!(end, 3 * (i + 1));
            connectivity[3 * i..end].try_into().unwrap()
        })
        .collect()
    }
}

/// A lamp, a table seen from both sides, and a floor that reflects no red.
fn room() -> (Scene, Solution) {
    let mut lit = Lit::default();
    let groups = ["room", "a \"lamp\" & <more>"].map(|name| lit.builder.group(name));
    let lamp = lit.material("lamp", 3.0, Sides::Front);
    let table = lit.material("table", 0.5, Sides::Both);
    let floor = lit
        .builder
        .material(Material {
            name: "floor".into(),
            reflectance: Rgb::new(0.0, 0.5, 1.0),
            emittance: Rgb::ZERO,
            sides: Sides::Front,
        })
        .unwrap();
    lit.quad(rectangle(2.0), groups[1], lamp, |_| Rgb::ZERO);
    lit.quad(rectangle(1.0), groups[0], table, |_| Rgb::ZERO);
    lit.quad(rectangle(0.0), groups[0], floor, |_| Rgb::ZERO);
    let (scene, _) = lit.finish();
    let mut solution = output::unlit(&scene);
    for (i, element) in solution.elements.iter_mut().enumerate() {
        let own = scene.material_of(element.triangle);
        let arriving = [0.0, 1.0, 2.0].map(|step| Rgb::new(0.5, 4.0, 8.0 + step + i as f64));
        element.corner_exitance = arriving.map(|h| own.emittance + own.reflectance * h);
        element.exitance = element.corner_exitance.into_iter().sum::<Rgb>() / 3.0;
    }
    (scene, solution)
}

#[test]
fn cells_are_the_elements_and_show_their_fronts() {
    let (scene, solution) = room();
    let vtu = parse(&bytes(Format::Vtu, &(scene.clone(), solution.clone()), &Options::default()));
    let points = vtu.get("Points", "Points");
    assert_eq!(points.kind, "Float64");
    let cells = vtu.cells();
    assert_eq!(cells.len(), solution.elements.len());
    let faces = vtu.column("face");
    assert!(faces.contains(&0.0) && faces.contains(&1.0));
    for ((cell, element), face) in cells.iter().zip(&solution.elements).zip(faces) {
        let corners = cell.map(|i| DVec3::from_slice(&points.tuples[i]));
        assert_eq!(corners, solution.corners(element));
        // VTK's normal of a triangle is (b − a) × (c − a): up for fronts, here, and down for backs.
        let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        assert!(if face == 0.0 { normal.z > 0.0 } else { normal.z < 0.0 });
        assert_eq!(face == 1.0, element.face == Face::Back);
    }
    let ids = |name| vtu.column(name).into_iter().map(|x| x as u32).collect::<Vec<_>>();
    let of = |f: &dyn Fn(&scene::Triangle) -> u32| -> Vec<u32> {
        let elements = solution.elements.iter();
        elements.map(|e| f(&scene.triangles()[e.triangle.index()])).collect()
    };
    let triangles: Vec<_> = solution.elements.iter().map(|e| e.triangle.0).collect();
    assert_eq!(ids("triangle"), triangles);
    assert_eq!(ids("material"), of(&|t| t.material.0));
    assert_eq!(ids("group"), of(&|t| t.group.0));
}

#[test]
fn light_and_surface_of_a_cell_explain_each_other() {
    let (scene, solution) = room();
    let vtu = parse(&bytes(Format::Vtu, &(scene.clone(), solution.clone()), &Options::default()));
    let cell = |name, i: usize| {
        Rgb::from(<[f64; 3]>::try_from(&*vtu.get("CellData", name).tuples[i]).unwrap())
    };
    let mut unknown = 0;
    for (i, element) in solution.elements.iter().enumerate() {
        let own = scene.material_of(element.triangle);
        assert_eq!(cell("exitance", i), element.exitance);
        assert_eq!(cell("emittance", i), own.emittance);
        assert_eq!(cell("reflectance", i), own.reflectance);
        // The mean of the three corners that the scene was lit with.
        let expected = [0.5, 4.0, 9.0 + i as f64];
        for (c, arrived) in cell("irradiance", i).0.into_iter().enumerate() {
            if own.reflectance[c] == 0.0 {
                unknown += 1;
                assert!(arrived.is_nan());
            } else {
                // Sums and quotients of four numbers below 20.
                assert!((arrived - expected[c]).abs() < 1e-13, "{arrived} {expected:?}");
            }
        }
    }
    assert_eq!(unknown, 2);
    let points = (vtu.get("PointData", "exitance"), vtu.get("PointData", "irradiance"));
    for (i, (element, cell)) in solution.elements.iter().zip(vtu.cells()).enumerate() {
        for (k, point) in cell.into_iter().enumerate() {
            let light = element.corner_exitance[k].0.map(|c| f64::from(c as f32));
            assert_eq!(points.0.tuples[point], light);
            let (arrived, expected) = (points.1.tuples[point][2], 8.0 + (k + i) as f64);
            // Exitance was narrowed to f32: 2⁻²⁴ of at most 16, over a reflectance of 0.75.
            assert!((arrived - expected).abs() < 2e-6, "{arrived} {expected}");
        }
    }
}

#[test]
fn points_are_shared_within_a_material_and_a_light() {
    let points = |lit: &(Scene, Solution)| {
        let vtu = parse(&bytes(Format::Vtu, lit, &Options::default()));
        vtu.get("Points", "Points").tuples.len()
    };
    assert_eq!(points(&square(Rgb::splat(1.0))), 4);
    let two = |same: bool, crease: f64| {
        let mut lit = Lit::default();
        let group = lit.builder.group("g");
        let first = lit.material("first", 0.0, Sides::Front);
        let second = if same { first } else { lit.material("second", 0.0, Sides::Front) };
        lit.quad(rectangle(0.0), group, first, |_| Rgb::splat(1.0));
        lit.quad(rectangle(0.0).map(|p| p + DVec3::Y), group, second, |_| Rgb::splat(crease));
        points(&lit.finish())
    };
    assert_eq!([two(true, 1.0), two(true, 2.0), two(false, 1.0)], [6, 8, 8]);
}

#[test]
fn field_data_names_materials_and_groups() {
    let vtu = parse(&bytes(Format::Vtu, &room(), &Options::default()));
    for (name, number) in [
        ("material 0: lamp", 0),
        ("material 2: floor", 2),
        ("group 0: room", 0),
        ("group 1: a &quot;lamp&quot; &amp; &lt;more&gt;", 1),
    ] {
        let line = format!(
            "<DataArray type=\"Int32\" Name=\"{name}\" NumberOfTuples=\"1\" format=\"ascii\">{number}</DataArray>\n"
        );
        assert!(vtu.text.contains(&line), "{line}");
    }
}

#[test]
fn a_scene_without_elements_is_a_grid_without_cells() {
    let empty = (Scene::default(), Solution::default());
    let vtu = parse(&bytes(Format::Vtu, &empty, &Options::default()));
    assert!(
        vtu.cells().is_empty() && vtu.text.contains("NumberOfPoints=\"0\" NumberOfCells=\"0\"")
    );
}

/// What meshio read, a number a line: points, cells, then sums that every number enters.
const MESHIO: &str = "
import sys, meshio, numpy
m = meshio.read(sys.argv[1])
cells = m.cells_dict['triangle']
a, b, c = (m.points[cells[:, i]] for i in range(3))
print(len(m.points), len(cells), repr(0.5 * numpy.cross(b - a, c - a)[:, 2].sum()))
for name in ('exitance', 'irradiance'):
    print(repr(numpy.nansum(m.cell_data[name][0])), repr(numpy.nansum(m.point_data[name].astype(float))))
print(numpy.isnan(m.cell_data['irradiance'][0]).sum(), m.cell_data['material'][0].sum())
print(sorted(m.field_data)[0])
";

/// meshio is not ours: it needs a `python3` that has it, as after `pip install meshio`.
#[test]
fn meshio_reads_the_same() {
    let python = |arguments: &[&str]| Command::new("python3").args(arguments).output();
    if !python(&["-c", "import meshio"]).is_ok_and(|ran| ran.status.success()) {
        println!("skipped: no python3 with meshio");
        return;
    }
    let lit = room();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("lit.vtu");
    output::write_file(&path, &lit.0, &lit.1, &Options::default()).unwrap();
    let ran = python(&["-c", MESHIO, path.to_str().unwrap()]).unwrap();
    assert!(ran.status.success(), "{}", String::from_utf8_lossy(&ran.stderr));
    let text = String::from_utf8(ran.stdout).unwrap();
    let ours = parse(&bytes(Format::Vtu, &lit, &Options::default()));
    let sum = |section: &str, name: &str| -> f64 {
        let numbers = ours.get(section, name).tuples.iter().flatten();
        numbers.copied().filter(|x| !x.is_nan()).sum()
    };
    let lines: Vec<&str> = text.lines().collect();
    let read = |text: &str| -> f64 {
        text.trim_start_matches("np.float64(").trim_end_matches(')').parse().unwrap()
    };
    let numbers: Vec<f64> = lines[..4].iter().flat_map(|l| l.split(' ')).map(read).collect();
    // Two rectangles of area 2 up, and one both up and down.
    let points = ours.get("Points", "Points").tuples.len() as f64;
    assert_eq!(numbers[..3], [points, 8.0, 4.0]);
    for (i, (section, name)) in [
        ("CellData", "exitance"),
        ("PointData", "exitance"),
        ("CellData", "irradiance"),
        ("PointData", "irradiance"),
    ]
    .into_iter()
    .enumerate()
    {
        // Another order of summation, of numbers below 20.
        assert!((numbers[3 + i] - sum(section, name)).abs() < 1e-10, "{text}");
    }
    assert_eq!(numbers[7..], [2.0, 8.0]);
    assert_eq!(lines[4], "group 0: room");
}
