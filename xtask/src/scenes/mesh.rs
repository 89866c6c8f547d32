//! Triangles in space: the shapes that scenes are put together from, and how they are moved.

/// A place in space; y is up in every bundled scene.
pub(crate) type Point = [f64; 3];

/// Three places, counter-clockwise as seen from the front.
pub(crate) type Triangle = [Point; 3];

/// A list of triangles that are placed and painted together.
#[derive(Clone, Debug, Default)]
pub(crate) struct Shape(pub(crate) Vec<Triangle>);

/// Where a shape's own axes x, y and z point in the scene, and where its origin lies.
pub(crate) struct Frame {
    pub(crate) origin: Point,
    pub(crate) x: Point,
    pub(crate) y: Point,
    pub(crate) z: Point,
}

impl Frame {
    /// The place in the scene of a point given along the frame's axes.
    pub(crate) fn at(&self, [x, y, z]: Point) -> Point {
        let along = add(scale(self.x, x), scale(self.y, y));
        add(self.origin, add(along, scale(self.z, z)))
    }
}

impl Shape {
    /// Puts several shapes into one.
    pub(crate) fn all(shapes: impl IntoIterator<Item = Shape>) -> Shape {
        Shape(shapes.into_iter().flat_map(|shape| shape.0).collect())
    }

    /// Swaps front and back.
    pub(crate) fn flipped(self) -> Shape {
        Shape(self.0.into_iter().map(|[a, b, c]| [a, c, b]).collect())
    }

    pub(crate) fn moved(self, by: Point) -> Shape {
        self.map(|p| add(p, by))
    }

    /// Turns about the y axis, counter-clockwise as seen from above.
    pub(crate) fn turned(self, degrees: f64) -> Shape {
        let (sin, cos) = match degrees.rem_euclid(360.0) {
            0.0 => (0.0, 1.0),
            90.0 => (1.0, 0.0),
            180.0 => (0.0, -1.0),
            270.0 => (-1.0, 0.0),
            other => other.to_radians().sin_cos(),
        };
        self.map(|[x, y, z]| [x * cos + z * sin, y, z * cos - x * sin])
    }

    /// Mirrors at the plane x = 0 and keeps fronts fronts.
    pub(crate) fn mirrored(self) -> Shape {
        self.map(|[x, y, z]| [-x, y, z]).flipped()
    }

    /// Moves the shape into `frame`, whose axes must be right-handed so that fronts stay fronts.
    pub(crate) fn placed(self, frame: &Frame) -> Shape {
        debug_assert!(dot(cross(frame.x, frame.y), frame.z) > 0.0);
        self.map(|p| frame.at(p))
    }

    /// Rounds every coordinate to a multiple of `1 / per_unit`, so that the written bytes depend
    /// neither on the platform's sine nor on the order of a sum.
    pub(crate) fn snapped(self, per_unit: f64) -> Shape {
        // Adding zero turns -0 into 0, which is written differently.
        self.map(|p| p.map(|x| (x * per_unit).round() / per_unit + 0.0))
    }

    fn map(self, f: impl Fn(Point) -> Point) -> Shape {
        Shape(self.0.into_iter().map(|corners| corners.map(&f)).collect())
    }
}

pub(crate) fn add(a: Point, b: Point) -> Point {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

pub(crate) fn sub(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(crate) fn scale(a: Point, by: f64) -> Point {
    a.map(|x| x * by)
}

pub(crate) fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn cross(a: Point, b: Point) -> Point {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(crate) fn length(a: Point) -> f64 {
    dot(a, a).sqrt()
}
