//! Writes small GLB files.

/// A GLB in the making: buffer data with an accessor for each piece.
#[derive(Default)]
pub(crate) struct Glb {
    bin: Vec<u8>,
    views: Vec<String>,
    accessors: Vec<String>,
}

impl Glb {
    /// Adds bytes as a buffer view of their own.
    pub(crate) fn view(&mut self, bytes: &[u8]) -> usize {
        self.bin.resize(self.bin.len().next_multiple_of(4), 0);
        let (offset, length) = (self.bin.len(), bytes.len());
        self.views.push(format!(r#"{{"buffer":0,"byteOffset":{offset},"byteLength":{length}}}"#));
        self.bin.extend_from_slice(bytes);
        self.views.len() - 1
    }

    /// Adds an accessor, given by its JSON without braces.
    pub(crate) fn accessor(&mut self, json: &str) -> usize {
        self.accessors.push(format!("{{{json}}}"));
        self.accessors.len() - 1
    }

    /// Adds floats, `N` to an entry.
    pub(crate) fn floats<const N: usize>(&mut self, entries: &[[f32; N]]) -> usize {
        let bytes: Vec<u8> = entries.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
        let view = self.view(&bytes);
        let bounds = if N == 3 { r#","min":[0,0,0],"max":[0,0,0]"# } else { "" };
        let count = entries.len();
        self.accessor(&format!(
            r#""bufferView":{view},"componentType":5126,"count":{count},"type":"VEC{N}"{bounds}"#
        ))
    }

    /// Adds 16-bit indices.
    pub(crate) fn indices(&mut self, indices: &[u16]) -> usize {
        let bytes: Vec<u8> = indices.iter().flat_map(|i| i.to_le_bytes()).collect();
        let view = self.view(&bytes);
        let count = indices.len();
        self.accessor(&format!(
            r#""bufferView":{view},"componentType":5123,"count":{count},"type":"SCALAR""#
        ))
    }

    /// Adds a PNG of RGB texels in rows from the top.
    pub(crate) fn png(&mut self, width: u32, texels: &[[u8; 3]]) -> usize {
        let height = texels.len() as u32 / width;
        let image = image::RgbImage::from_raw(width, height, texels.concat()).expect("whole rows");
        let mut bytes = std::io::Cursor::new(Vec::new());
        image.write_to(&mut bytes, image::ImageFormat::Png).expect("memory takes every byte");
        self.view(bytes.get_ref())
    }

    /// The JSON, with `rest` as its further members.
    pub(crate) fn json(&self, rest: &str) -> String {
        let (views, accessors) = (self.views.join(","), self.accessors.join(","));
        let length = self.bin.len();
        format!(
            r#"{{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":{length}}}],"bufferViews":[{views}],"accessors":[{accessors}],{rest}}}"#
        )
    }

    /// The binary data.
    pub(crate) fn bin(&self) -> &[u8] {
        &self.bin
    }

    /// The file, with `rest` as further members of its JSON.
    pub(crate) fn build(&self, rest: &str) -> Vec<u8> {
        pack(&self.json(rest), &self.bin)
    }
}

/// Joins JSON and data to a GLB.
pub(crate) fn pack(json: &str, bin: &[u8]) -> Vec<u8> {
    let mut json = json.as_bytes().to_vec();
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut bin = bin.to_vec();
    bin.resize(bin.len().next_multiple_of(4), 0);
    let total = 12 + 8 + json.len() + 8 + bin.len();
    let number = |n: usize| u32::try_from(n).expect("a small file").to_le_bytes();
    [
        b"glTF",
        &number(2),
        &number(total),
        &number(json.len()),
        b"JSON",
        json.as_slice(),
        &number(bin.len()),
        b"BIN\0",
        bin.as_slice(),
    ]
    .concat()
}

/// A right triangle over the unit square, in the plane z = 0, facing +z.
pub(crate) const TRIANGLE: [[f32; 3]; 3] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

/// A GLB of one triangle with one material, given by its JSON without braces.
pub(crate) fn with_material(material: &str) -> Vec<u8> {
    let mut glb = Glb::default();
    glb.floats(&TRIANGLE);
    glb.build(&format!(
        r#""materials":[{{{material}}}],"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"material":0}}]}}],"nodes":[{{"mesh":0}}]"#
    ))
}
