//! Triangles that stay whole, since what they carry cannot be interpolated: the light goes into the
//! vertices that are there.

use scene::{Face, Rgb, Shape};

use super::faces::{Column, Faces, Light, ordered};
use super::material::Look;

impl Light<'_> {
    /// The light at the document's own vertices on one side; none where that has no elements.
    /// A vertex shows the mean of its triangles, by their areas.
    pub(super) fn whole(
        &self,
        shape: &Shape,
        face: Face,
        vertices: usize,
        look: &Look,
    ) -> Option<Faces> {
        let elements = self.elements(shape);
        let mut sums = vec![(Rgb::ZERO, 0.0, shape.first); vertices];
        let mut indices = Vec::new();
        for mine in elements.chunk_by(|a, b| a.triangle == b.triangle) {
            let triangle = mine[0].triangle;
            let area = self.scene.area(triangle);
            if area == 0.0 || !mine.iter().any(|e| e.face == face) {
                continue;
            }
            let corners = ordered(shape, triangle);
            for (corner, place) in corners.into_iter().zip(self.scene.corners(triangle)) {
                // An element ends at each corner, unless it lies under another triangle.
                let points = mine
                    .iter()
                    .filter(|e| e.face == face)
                    .flat_map(|e| self.solution.corners(e).into_iter().zip(e.corner_exitance));
                let nearest = points.min_by(|(p, _), (q, _)| {
                    p.distance_squared(place).total_cmp(&q.distance_squared(place))
                });
                if let (Some((_, light)), Some(sum)) = (nearest, sums.get_mut(corner as usize)) {
                    sum.0 += light * area;
                    sum.1 += area;
                    sum.2 = triangle;
                }
            }
            let [a, b, c] = corners;
            // The back of a triangle winds the other way round, and so does a mirrored one.
            let turned = (face == Face::Back) != shape.mirrored;
            indices.extend(if turned { [a, c, b] } else { [a, b, c] });
        }
        if indices.is_empty() {
            return None;
        }
        let [mut colours, mut exitance] = Column::light();
        for (sum, area, triangle) in sums {
            let mean = if area > 0.0 { sum / area } else { Rgb::ZERO };
            let (colour, light) = self.bytes(triangle, mean.0, look);
            colours.bytes.extend(colour);
            exitance.bytes.extend(light);
        }
        let columns = vec![colours, exitance];
        Some(Faces { face, columns, vertices, indices: Some(indices), replaces: false })
    }
}
