//! What every bundled scene must be: consistently oriented, without visible backs or overlaps.

mod flatten;

use std::collections::BTreeMap;

use super::mesh::Shape;
use super::mesh::{Point, Triangle, add, cross, dot, length, scale, sub};
use super::{blocks, church, cornell, gallery, hall, room};

/// A scene as the checks see it.
struct Subject {
    name: &'static str,
    triangles: Vec<Triangle>,
    /// By triangle: it may be seen from its back.
    two_sided: Vec<bool>,
    /// A place in the open, where the walk of the light starts.
    inside: Point,
    /// Where light may leave: below this z. The Cornell box has no front wall.
    open_below_z: f64,
}

fn subjects() -> Vec<Subject> {
    let tri = |name, model: super::tri_text::Model, inside| {
        let triangles: Vec<_> = model.triangles.into_iter().map(|(t, _)| t).collect();
        let two_sided = vec![false; triangles.len()];
        Subject { name, triangles, two_sided, inside, open_below_z: f64::NEG_INFINITY }
    };
    let glb = |name, bytes: &[u8], inside, open_below_z| {
        let (triangles, two_sided) = flatten::triangles(bytes).into_iter().unzip();
        Subject { name, triangles, two_sided, inside, open_below_z }
    };
    let mut cornell = glb("cornell", &cornell::glb(), [278.0, 273.0, 30.0], 0.0);
    // The light's back faces the ceiling over a gap of 0.1 mm, as the scene's README says.
    cornell.two_sided[10..12].fill(true);
    vec![
        cornell,
        glb("gallery", &gallery::glb(), [0.0, 3.0, 2.0], f64::NEG_INFINITY),
        tri("blocks", blocks::model(), [250.0, 500.0, 5.0]),
        tri("room", room::model(), [300.0, 200.0, 100.0]),
        tri("hall", hall::model(), [600.0, 300.0, 100.0]),
        tri("church", church::model(), [0.0, 500.0, 300.0]),
    ]
}

#[test]
fn counts_are_those_of_the_scenes_readme() {
    let counts: Vec<_> = subjects().iter().map(|s| (s.name, s.triangles.len())).collect();
    let readme = include_str!("../../../scenes/README.md");
    for (name, count) in counts {
        let row = readme.lines().find(|line| line.contains(&format!("`{name}.")));
        let row = row.unwrap_or_else(|| panic!("scenes/README.md has no row for {name}"));
        assert!(row.contains(&format!("| {count} |")), "{name} has {count} triangles: {row}");
    }
}

#[test]
fn no_triangle_is_degenerate() {
    for Subject { name, triangles, .. } in subjects() {
        for t in triangles {
            let longest = (0..3).map(|i| length(sub(t[i], t[(i + 1) % 3]))).fold(0.0, f64::max);
            let height = length(normal(&t)) / longest;
            // The narrowest sliver in use is a sill of the church's fans.
            assert!(height > 1e-3 * longest, "{name}: {t:?} is {height} high");
        }
    }
}

/// Where exactly two triangles share an edge, they run along it in opposite directions.
#[test]
fn neighbours_agree_on_the_front() {
    for Subject { name, triangles, .. } in subjects() {
        let mut uses: BTreeMap<[[u64; 3]; 2], Vec<bool>> = BTreeMap::new();
        for t in &triangles {
            for i in 0..3 {
                let (a, b) = (bits(t[i]), bits(t[(i + 1) % 3]));
                uses.entry([a.min(b), a.max(b)]).or_default().push(a < b);
            }
        }
        let pairs = uses.iter().filter(|(_, along)| along.len() == 2);
        let wrong = pairs.clone().filter(|(_, along)| along[0] == along[1]).count();
        assert_eq!(wrong, 0, "{name}: edges whose two triangles disagree");
        assert!(pairs.count() * 4 > triangles.len(), "{name}: hardly any shared edges");
    }
}

/// Walks as light does: from a place in the open along random directions, from what it meets on
/// into the hemisphere before it. Every triangle it meets shows its front, and it never escapes.
#[test]
fn light_meets_fronts_only() {
    for subject in subjects() {
        let wrong = walk(&subject, 400, 8);
        assert_eq!(wrong, None, "{}", subject.name);
    }
}

#[test]
fn a_turned_triangle_or_a_hole_is_noticed() {
    let mut subject = subjects().remove(2);
    subject.triangles[5].swap(1, 2);
    assert!(walk(&subject, 400, 8).is_some_and(|what| what.contains("back")));
    subject.triangles.remove(5);
    assert!(walk(&subject, 400, 8).is_some_and(|what| what.contains("escapes")));
}

/// No two fronts share a place and a direction: which of them is seen would be left to chance.
#[test]
fn no_two_fronts_coincide() {
    for Subject { name, triangles, .. } in subjects() {
        let overlap = first_overlap(&triangles);
        assert!(overlap.is_none(), "{name}: {overlap:?}");
    }
    let wall = super::shapes::quad([[0.0; 3], [2.0, 0.0, 0.0], [2.0, 2.0, 0.0], [0.0, 2.0, 0.0]]);
    let patch = wall.clone().moved([1.0, 0.5, 0.0]);
    assert!(first_overlap(&Shape::all([wall, patch]).0).is_some());
}

/// What goes wrong on the way, if anything does.
fn walk(subject: &Subject, paths: u32, bounces: u32) -> Option<String> {
    let mut random = Random(0x9E37_79B9_7F4A_7C15);
    for _ in 0..paths {
        let (mut from, mut direction) = (subject.inside, random.direction());
        for _ in 0..bounces {
            let Some((distance, index)) = nearest(&subject.triangles, from, direction) else {
                if direction[2] < 0.0 && subject.open_below_z.is_finite() {
                    break;
                }
                return Some(format!("light from {from:?} along {direction:?} escapes"));
            };
            let n = normal(&subject.triangles[index]);
            let mut n = scale(n, 1.0 / length(n));
            if dot(n, direction) > 0.0 {
                if !subject.two_sided[index] {
                    let t = subject.triangles[index];
                    return Some(format!("light from {from:?} meets the back of {t:?}"));
                }
                n = scale(n, -1.0);
            }
            // Off the surface by a ten-millionth of the way, so that it is not met again.
            let at = add(from, scale(direction, distance));
            from = add(at, scale(n, 1e-7 * distance.max(1.0)));
            direction = random.direction();
            if dot(direction, n) < 0.0 {
                direction = scale(direction, -1.0);
            }
        }
    }
    None
}

/// Nearest hit from either side by Möller & Trumbore (1997), brute force.
fn nearest(triangles: &[Triangle], from: Point, direction: Point) -> Option<(f64, usize)> {
    let mut best: Option<(f64, usize)> = None;
    for (index, [a, b, c]) in triangles.iter().enumerate() {
        let (u, v) = (sub(*b, *a), sub(*c, *a));
        let p = cross(direction, v);
        let det = dot(u, p);
        if det == 0.0 {
            continue;
        }
        let t = sub(from, *a);
        let q = cross(t, u);
        let (x, y, z) = (dot(t, p) / det, dot(direction, q) / det, dot(v, q) / det);
        let inside = x >= 0.0 && y >= 0.0 && x + y <= 1.0 && z > 0.0;
        if inside && best.is_none_or(|(distance, _)| z < distance) {
            best = Some((z, index));
        }
    }
    best
}

/// Two triangles in one plane, with one direction, that overlap by more than a touch.
fn first_overlap(triangles: &[Triangle]) -> Option<(Triangle, Triangle)> {
    let size = triangles.iter().flatten().flatten().fold(0.0_f64, |m, x| m.max(x.abs()));
    // Far below a hundredth of a unit, the step of the written coordinates.
    let touch = 1e-7 * size;
    let mut planes: Vec<(i64, usize)> = Vec::new();
    for (index, t) in triangles.iter().enumerate() {
        let n = normal(t);
        planes.push(((dot(n, t[0]) / length(n) / touch).round() as i64, index));
    }
    planes.sort_unstable();
    for (rank, &(height, i)) in planes.iter().enumerate() {
        for &(other, j) in planes[rank + 1..].iter().take_while(|(other, _)| other - height <= 1) {
            let (a, b) = (&triangles[i], &triangles[j]);
            let (n, m) = (normal(a), normal(b));
            let parallel = dot(n, m) > (1.0 - 1e-12) * length(n) * length(m);
            if other - height <= 1 && parallel && !separated(a, b, n, touch) {
                return Some((*a, *b));
            }
        }
    }
    None
}

/// Whether an edge of one triangle has the other on its outer side (both lie in one plane).
fn separated(a: &Triangle, b: &Triangle, n: Point, touch: f64) -> bool {
    let edge_separates = |a: &Triangle, b: &Triangle| {
        (0..3).any(|i| {
            let outward = cross(sub(a[(i + 1) % 3], a[i]), n);
            let outward = scale(outward, 1.0 / length(outward));
            b.iter().all(|p| dot(sub(*p, a[i]), outward) > -touch)
        })
    };
    edge_separates(a, b) || edge_separates(b, a)
}

fn normal(t: &Triangle) -> Point {
    cross(sub(t[1], t[0]), sub(t[2], t[0]))
}

fn bits(p: Point) -> [u64; 3] {
    p.map(f64::to_bits)
}

/// Marsaglia's xorshift64* (2003): the same numbers on every machine.
struct Random(u64);

impl Random {
    /// Uniform in [-1, 1).
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        let word = self.0.wrapping_mul(0x2545_F491_4F6C_DD1D);
        (word >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    fn direction(&mut self) -> Point {
        loop {
            let p = [self.next(), self.next(), self.next()];
            let l = length(p);
            if l > 0.1 && l < 1.0 {
                return scale(p, 1.0 / l);
            }
        }
    }
}
