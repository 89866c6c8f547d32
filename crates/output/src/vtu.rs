//! VTK XML, an unstructured grid: every element with its light and its surface, for ParaView.
//!
//! The numbers stand behind the text, raw, as ParaView itself writes them. What a surface is stands
//! per cell; exitance and irradiance per cell, as area means, and per point.

use std::fmt::Write as _;
use std::io::{self, Write};

use scene::{Face, Rgb, Scene, Solution};

use crate::weld::{Corner, Welded, corners};
use crate::{Error, ErrorKind};

/// VTK's number for a triangle, whose corners run counter-clockwise seen from the front.
const VTK_TRIANGLE: u8 = 5;

/// Numbers of one name: one tuple for each point or cell.
struct Array {
    name: &'static str,
    /// VTK's name for the type of the numbers.
    kind: &'static str,
    /// Whether a tuple is red, green, blue.
    colour: bool,
    /// Numbers in a tuple.
    components: usize,
    /// The numbers, little-endian.
    bytes: Vec<u8>,
}

/// Writes the elements as triangles over welded points; a point belongs to one material.
pub(crate) fn write(out: &mut dyn Write, scene: &Scene, solution: &Solution) -> Result<(), Error> {
    let mut mesh = Welded::default();
    for element in &solution.elements {
        let material = scene.triangles()[element.triangle.index()].material.0;
        mesh.push(corners(solution, element, [0.0; 3]).map(|c| Corner { material, ..c }))?;
    }
    let sections = [
        ("PointData Scalars=\"exitance\"", "PointData", point_data(scene, &mesh)),
        ("CellData Scalars=\"exitance\"", "CellData", cell_data(scene, solution)?),
        ("Points", "Points", vec![positions(&mesh)]),
        ("Cells", "Cells", cells(&mesh)),
    ];
    let (points, count) = (mesh.vertices.len(), mesh.faces.len());
    let mut text = format!(
        "<?xml version=\"1.0\"?>\n\
         <!-- Exitance and irradiance are W/m2 per channel, linear; irradiance is not a number where \
         nothing is reflected. face: 0 front, 1 back. triangle: the input triangle from 0. -->\n\
         <VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" \
         header_type=\"UInt64\">\n<UnstructuredGrid>\n<FieldData>\n{}</FieldData>\n\
         <Piece NumberOfPoints=\"{points}\" NumberOfCells=\"{count}\">\n",
        names(scene)
    );
    let mut offset = 0;
    for (open, close, arrays) in &sections {
        // Writing into a string cannot fail.
        let _ = writeln!(text, "<{open}>");
        for array in arrays {
            let _ = writeln!(text, "{}", array.tag(offset));
            offset += size_of::<u64>() + array.bytes.len();
        }
        let _ = writeln!(text, "</{close}>");
    }
    text += "</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
    let mut all = || {
        out.write_all(text.as_bytes())?;
        for array in sections.iter().flat_map(|(_, _, arrays)| arrays) {
            out.write_all(&(array.bytes.len() as u64).to_le_bytes())?;
            out.write_all(&array.bytes)?;
        }
        out.write_all(b"\n</AppendedData>\n</VTKFile>\n")
    };
    all().map_err(|e: io::Error| Error::write(e))
}

/// The irradiance that explains an exitance, where the surface reflects: elsewhere it is unknown, and
/// not a number.
fn irradiance(exitance: Rgb, material: &scene::Material) -> Rgb {
    let (emittance, reflectance) = (material.emittance, material.reflectance);
    let of = |c: usize| match reflectance[c] > 0.0 {
        true => (exitance[c] - emittance[c]) / reflectance[c],
        false => f64::NAN,
    };
    Rgb([0, 1, 2].map(of))
}

fn point_data(scene: &Scene, mesh: &Welded) -> Vec<Array> {
    let arrived = |corner: &Corner| {
        let material = &scene.materials()[corner.material as usize];
        irradiance(Rgb(corner.light.map(f64::from)), material).0.map(|c| c as f32)
    };
    let lights = mesh.vertices.iter().map(|corner| corner.light);
    vec![
        Array::single("exitance", lights),
        Array::single("irradiance", mesh.vertices.iter().map(arrived)),
    ]
}

fn cell_data(scene: &Scene, solution: &Solution) -> Result<Vec<Array>, Error> {
    let elements = &solution.elements;
    let surface = |e: &scene::SolutionElement| scene.triangles()[e.triangle.index()];
    let material = |e: &scene::SolutionElement| scene.material_of(e.triangle);
    let emittances = elements.iter().map(|e| material(e).emittance);
    let reflectances = elements.iter().map(|e| material(e).reflectance);
    let irradiances = elements.iter().map(|e| irradiance(e.exitance, material(e)));
    let faces = elements.iter().map(|e| u8::from(e.face == Face::Back)).collect();
    Ok(vec![
        Array::colour("exitance", elements.iter().map(|e| e.exitance)),
        Array::colour("irradiance", irradiances),
        Array::colour("emittance", emittances),
        Array::colour("reflectance", reflectances),
        Array::ids("triangle", elements.iter().map(|e| e.triangle.0))?,
        Array { name: "face", kind: "UInt8", colour: false, components: 1, bytes: faces },
        Array::ids("material", elements.iter().map(|e| surface(e).material.0))?,
        Array::ids("group", elements.iter().map(|e| surface(e).group.0))?,
    ])
}

fn positions(mesh: &Welded) -> Array {
    let positions = mesh.vertices.iter().map(|corner| Rgb(corner.position.to_array()));
    Array { colour: false, ..Array::colour("Points", positions) }
}

fn cells(mesh: &Welded) -> Vec<Array> {
    let corners = mesh.faces.iter().flatten().map(|i| i64::from(*i));
    let ends = (1..=mesh.faces.len() as i64).map(|n| 3 * n);
    let wide = |name, numbers: &mut dyn Iterator<Item = i64>| Array {
        name,
        kind: "Int64",
        colour: false,
        components: 1,
        bytes: numbers.flat_map(i64::to_le_bytes).collect(),
    };
    let types = vec![VTK_TRIANGLE; mesh.faces.len()];
    vec![
        wide("connectivity", &mut { corners }),
        wide("offsets", &mut { ends }),
        Array { name: "types", kind: "UInt8", colour: false, components: 1, bytes: types },
    ]
}

impl Array {
    fn colour(name: &'static str, values: impl Iterator<Item = Rgb>) -> Self {
        let bytes = values.flat_map(|v| v.0).flat_map(f64::to_le_bytes).collect();
        Self { name, kind: "Float64", colour: true, components: 3, bytes }
    }

    fn single(name: &'static str, values: impl Iterator<Item = [f32; 3]>) -> Self {
        let bytes = values.flatten().flat_map(f32::to_le_bytes).collect();
        Self { name, kind: "Float32", colour: true, components: 3, bytes }
    }

    /// Signed, as more filters take signed numbers.
    fn ids(name: &'static str, ids: impl Iterator<Item = u32>) -> Result<Self, Error> {
        let mut bytes = Vec::new();
        for id in ids {
            let id = i32::try_from(id)
                .map_err(|_| Error::new(ErrorKind::TooLarge("more than 2^31 triangles")))?;
            bytes.extend(id.to_le_bytes());
        }
        Ok(Self { name, kind: "Int32", colour: false, components: 1, bytes })
    }

    /// The element that describes the array, whose bytes begin at `offset`.
    fn tag(&self, offset: usize) -> String {
        let Self { name, kind, components, .. } = self;
        let channels = match self.colour {
            true => " ComponentName0=\"r\" ComponentName1=\"g\" ComponentName2=\"b\"",
            false => "",
        };
        // Told of one component, meshio makes a table of one column.
        let tuple = match components {
            1 => String::new(),
            n => format!(" NumberOfComponents=\"{n}\""),
        };
        format!(
            "<DataArray type=\"{kind}\" Name=\"{name}\"{tuple}{channels} format=\"appended\" \
             offset=\"{offset}\"/>"
        )
    }
}

/// Field data that says what the numbers of materials and groups mean: an array for each, whose
/// name holds the number and the name. VTK has arrays of text, too, but not every reader.
fn names(scene: &Scene) -> String {
    let materials = scene.materials().iter().map(|material| ("material", &material.name));
    let materials = materials.enumerate();
    let groups = scene.groups().iter().map(|name| ("group", name)).enumerate();
    let line = |(number, (what, name)): (usize, (&str, &String))| {
        format!(
            "<DataArray type=\"Int32\" Name=\"{what} {number}: {}\" NumberOfTuples=\"1\" \
             format=\"ascii\">{number}</DataArray>\n",
            escaped(name)
        )
    };
    materials.chain(groups).map(line).collect()
}

/// A name as XML takes it; what XML 1.0 has no place for, as the sign for an unknown character.
fn escaped(name: &str) -> String {
    let mut text = String::with_capacity(name.len());
    for c in name.chars() {
        match c {
            '&' => text += "&amp;",
            '<' => text += "&lt;",
            '>' => text += "&gt;",
            '"' => text += "&quot;",
            '\t' | '\n' | '\r' => text += &format!("&#{};", c as u32),
            '\0'..='\u{1f}' | '\u{fffe}' | '\u{ffff}' => text.push(char::REPLACEMENT_CHARACTER),
            c => text.push(c),
        }
    }
    text
}
