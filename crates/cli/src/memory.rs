//! What a solve takes in memory: foreseen before each level, and looked up while it runs.
//!
//! The figures are upper bounds of the sizes in docs/performance/memory.md.

use output::Format;
use radiosity_core::Schedule;
use scene::{Scene, Sides};

use crate::failure::Failure;
use crate::settings::{Solve, Target};

/// The program with nothing read.
const PROGRAM: u64 = 8_000_000;

/// A triangle of the scene as read, in the hierarchies of occluders with what builds them, and what the
/// allocator keeps of what planning took.
const PER_TRIANGLE: u64 = 800;

/// A piece of the scene that is a patch of its own at least: directions of the census, its power.
const PER_PIECE: u64 = 500;

/// An element of the mesh that is solved: geometry and light.
const PER_ELEMENT: u64 = 450;

/// An element of a finished level, kept to compare with.
const PER_KEPT_ELEMENT: u64 = 320;

/// A copy of an element's light, for a snapshot.
const PER_COPIED_ELEMENT: u64 = 150;

/// An element of a page, packed.
#[cfg(feature = "html")]
const PER_PACKED_ELEMENT: u64 = 80;

/// An element that a picture shows, and a pixel of it.
const PER_DRAWN_ELEMENT: u64 = 50;
const PER_PIXEL: u64 = 60;

/// Points in the elements near one shooter. They are for large elements, and fewer in meshes of
/// more than [`NEAR_ELEMENTS`], or than half the scene's pieces.
const NEAR: u64 = 4_500_000;
const NEAR_ELEMENTS: usize = 1500;

/// Shooters of a step, and the slots for their receivers, if the command line does not say.
const SHOOTERS: u64 = 16;
const SLOTS: u64 = 8_000_000;

/// A slot for one receiver of one shooter; connected surfaces have less than one receiver an
/// element.
const PER_SLOT: u64 = 32;

/// With less than this for all levels, one patch shoots at a time: sixteen would take too much of
/// it.
const LEAST_FOR_MANY_SHOOTERS: u64 = 200_000_000;

/// Least growth from level to level: the one before has at most this share of the elements.
const KEPT_SHARE: f64 = 1.0 / 1.5;

/// What a solve of so many elements takes in all, from the coarsest level on: an upper bound.
pub(crate) fn foreseen(triangles: usize, patches: usize, elements: usize) -> u64 {
    let level = Level { pieces: patches, ..Level::default() };
    let kept = (elements as f64 * KEPT_SHARE) as u64 * PER_KEPT_ELEMENT;
    before(triangles) + level.bytes(NEAR_ELEMENTS).max(level.bytes(elements) + kept)
}

/// Before the first level.
fn before(triangles: usize) -> u64 {
    PROGRAM + triangles as u64 * PER_TRIANGLE
}

/// What a level takes beside what is there before.
#[derive(Clone, Copy, Debug)]
struct Level {
    schedule: Schedule,
    pieces: usize,
    /// Beside what the solver needs for an element: for copies and pictures.
    per_element: u64,
    /// Whatever the elements.
    fixed: u64,
}

impl Default for Level {
    fn default() -> Self {
        Self { schedule: Schedule::Auto, pieces: 0, per_element: 0, fixed: 0 }
    }
}

impl Level {
    /// Falls with the elements only where few of them make many points near shooters.
    fn bytes(&self, elements: usize) -> u64 {
        let n = elements as u64;
        let step = match self.schedule {
            Schedule::Auto => {
                let large = NEAR_ELEMENTS.max(self.pieces / 2) as f64 / elements.max(1) as f64;
                SLOTS + ((SHOOTERS * NEAR) as f64 * large.min(1.0)) as u64
            }
            Schedule::Single => NEAR,
            Schedule::Multi(count) => count.get() as u64 * (NEAR + PER_SLOT * n),
        };
        let pieces = self.pieces as u64 * PER_PIECE;
        self.fixed + step + pieces + (PER_ELEMENT + self.per_element) * n
    }

    /// The most elements that take no more than this, with the kept ones of the level before.
    fn fitting(&self, bytes: u64, kept: f64) -> usize {
        let of = |n: usize| self.bytes(n) + (n as f64 * kept * PER_KEPT_ELEMENT as f64) as u64;
        let (mut fits, mut too_many) = (0usize, 1usize << 31);
        while too_many - fits > 1 {
            let middle = fits.midpoint(too_many);
            if of(middle) <= bytes { fits = middle } else { too_many = middle }
        }
        fits
    }
}

/// The memory that a solve may take, and how much each part of it needs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Budget {
    limit: u64,
    before: u64,
    level: Level,
}

impl Budget {
    /// That of `--max-memory`, if given.
    pub(crate) fn of(settings: &Solve, scene: &Scene) -> Option<Self> {
        let limit = settings.limits.memory?;
        let picture = |t: &Target| match t {
            Target::File(path) => {
                matches!(Format::from_path(path), Ok(Format::Png | Format::Exr))
            }
            _ => false,
        };
        #[cfg(feature = "html")]
        let paged = settings.outputs.iter().any(|t| matches!(t, Target::Page(_)));
        #[cfg(feature = "html")]
        let packed = if paged || settings.live.is_some() { PER_PACKED_ELEMENT } else { 0 };
        #[cfg(not(feature = "html"))]
        let packed = 0;
        let (drawn, (width, height)) =
            (settings.outputs.iter().any(picture), settings.picture.size());
        let pixels = u64::from(width) * u64::from(height);
        let copies = if settings.snapshot.is_some() || settings.live.is_some() {
            PER_COPIED_ELEMENT
        } else {
            0
        };
        let before = before(scene.triangles().len());
        let level = Level {
            schedule: match settings.shooting.schedule {
                Schedule::Auto if limit < before + LEAST_FOR_MANY_SHOOTERS => Schedule::Single,
                schedule => schedule,
            },
            pieces: sides(scene),
            per_element: copies + packed + if drawn { PER_DRAWN_ELEMENT } else { 0 },
            fixed: if drawn { pixels * PER_PIXEL } else { 0 },
        };
        Some(Self { limit, before, level })
    }

    /// The same for a scene that is cut into so many pieces.
    pub(crate) fn with_pieces(self, pieces: usize) -> Self {
        Self { level: Level { pieces, ..self.level }, ..self }
    }

    /// How many patches may shoot together.
    pub(crate) fn schedule(&self) -> Schedule {
        self.level.schedule
    }

    /// Refuses a scene that does not fit, even in as few elements as it has pieces.
    pub(crate) fn check(&self) -> Result<(), Failure> {
        let need = self.bytes(self.level.pieces);
        if need <= self.limit {
            return Ok(());
        }
        Err(Failure::Failed(format!(
            "--max-memory: {} is too little: the scene's own triangles need about {}",
            size(self.limit),
            size(need)
        )))
    }

    /// How many elements the last level may have, if there are levels before it or not; the same
    /// whenever it is asked.
    pub(crate) fn last_level(&self, levels: bool) -> usize {
        let kept = if levels { KEPT_SHARE } else { 0.0 };
        self.level.fitting(self.limit.saturating_sub(self.before), kept)
    }

    /// How many elements the next level may have beside one of `kept` elements, by what the
    /// program takes now.
    pub(crate) fn next_level(&self, kept: usize) -> usize {
        self.level.fitting(self.limit.saturating_sub(self.taken(kept)), 0.0)
    }

    /// What so many elements would take.
    pub(crate) fn bytes(&self, elements: usize) -> u64 {
        self.taken(0) + self.level.bytes(elements)
    }

    /// What the program takes now, and no less than it should before the first level.
    fn taken(&self, kept: usize) -> u64 {
        let foreseen = self.before + kept as u64 * PER_KEPT_ELEMENT;
        resident().unwrap_or(foreseen).max(self.before)
    }
}

/// How many elements there are at least: sides of triangles.
fn sides(scene: &Scene) -> usize {
    let both = |id: &scene::TriangleId| scene.material_of(*id).sides == Sides::Both;
    scene.triangles().len() + scene.ids().filter(both).count()
}

/// The resident size of this process, where /proc tells.
fn resident() -> Option<u64> {
    status("VmRSS:")
}

/// The largest resident size that this process ever had, where /proc tells.
pub(crate) fn peak() -> Option<u64> {
    status("VmHWM:")
}

/// A size in the list that Linux keeps of a process.
fn status(name: &str) -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix(name))?;
    Some(line.trim().strip_suffix("kB")?.trim_end().parse::<u64>().ok()? * 1024)
}

/// Bytes, readably.
pub(crate) fn size(bytes: u64) -> String {
    match bytes {
        b if b < 10_000_000 => format!("{:.1} MB", b as f64 / 1e6),
        b => format!("{} MB", crate::screen::count(b.div_ceil(1_000_000))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_fits_takes_no_more_and_one_more_would() {
        let level = Level { per_element: 100, fixed: 5_000_000, ..Level::default() };
        for bytes in [200_000_000, 1_000_000_000] {
            let n = level.fitting(bytes, 0.0);
            assert!(n > 1000 && level.bytes(n) <= bytes && level.bytes(n + 1) > bytes, "{n}");
        }
        assert_eq!(level.fitting(1_000_000, 0.0), 0);
        assert!(level.fitting(1 << 30, KEPT_SHARE) < level.fitting(1 << 30, 0.0));
    }

    #[test]
    fn this_process_takes_something() {
        if cfg!(target_os = "linux") {
            let bytes = resident().unwrap();
            assert!((100_000..100_000_000_000).contains(&bytes), "{bytes}");
            assert!(peak().unwrap() >= bytes);
        }
    }
}
