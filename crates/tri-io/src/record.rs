//! One triangle, as the file spells it.

/// One record of a `.tri` file, in file units.
///
/// Nothing is interpreted here: what the colours mean is said in `docs/tri-format.md` and decided
/// by whoever turns records into a scene.
///
/// # Units
/// Colours are display units, 255 being white; coordinates have whatever unit the scene was
/// modelled in.
///
/// # Examples
/// ```
/// let record = tri_io::TriRecord {
///     front: [255, 0, 0],
///     back: [0, 0, 0],
///     vertices: [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
///     normals: None,
/// };
/// assert_eq!(record.vertices[1], [1.0, 0.0, 0.0]);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct TriRecord {
    /// Red, green and blue of the front, the side from which the vertices run anticlockwise.
    pub front: [u8; 3],
    /// Red, green and blue of the back.
    pub back: [u8; 3],
    /// Three corners, each x, y, z.
    pub vertices: [[f64; 3]; 3],
    /// One normal per corner, each x, y, z, where the file holds them; any length is allowed.
    pub normals: Option<[[f64; 3]; 3]>,
}
