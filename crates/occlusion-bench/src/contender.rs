//! Who is measured: structures, and ways of asking them.

use std::sync::Arc;
use std::time::Instant;

use accel::{Bvh, BvhConfig, Occluder, Octree, OctreeConfig};

use crate::{
    Embree, EmbreeConfig, EmbreeLibrary, EmbreeScene, EmbreeWidth, Obvhs, ObvhsPreset, ObvhsShape,
    Triangle,
};

/// What is built over the occluders.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Structure {
    /// [`Bvh`] as configured by default.
    AccelBvh,
    /// [`Octree`] as configured by default.
    AccelOctree,
    /// [`Obvhs`].
    Obvhs(ObvhsShape, ObvhsPreset),
    /// [`EmbreeScene`].
    Embree(EmbreeConfig),
}

/// How a structure is asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Asking {
    /// One segment a call: [`Occluder::occluded`].
    Single,
    /// A source's targets a call: [`Occluder::occluded_batch`].
    Batch,
    /// Packets of Embree, marked as coherent or not.
    Packets(EmbreeWidth, bool),
}

/// A structure and a way of asking it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Contender {
    /// The name in tables and on the command line.
    pub name: &'static str,
    /// What is built.
    pub structure: Structure,
    /// How it is asked.
    pub asking: Asking,
}

const ROBUST: Structure = Structure::Embree(EmbreeConfig { robust: true, split: false });
const FAST: Structure = Structure::Embree(EmbreeConfig { robust: false, split: false });
const SPLIT: Structure = Structure::Embree(EmbreeConfig { robust: true, split: true });
const CWBVH: Structure = Structure::Obvhs(ObvhsShape::CwBvh, ObvhsPreset::VerySlow);
const CWBVH_MEDIUM: Structure = Structure::Obvhs(ObvhsShape::CwBvh, ObvhsPreset::Medium);
const BVH2: Structure = Structure::Obvhs(ObvhsShape::Bvh2, ObvhsPreset::VerySlow);

const fn packets(name: &'static str, structure: Structure, width: EmbreeWidth) -> Contender {
    Contender { name, structure, asking: Asking::Packets(width, false) }
}

const fn coherent(name: &'static str, structure: Structure) -> Contender {
    Contender { name, structure, asking: Asking::Packets(EmbreeWidth::Sixteen, true) }
}

const fn single(name: &'static str, structure: Structure) -> Contender {
    Contender { name, structure, asking: Asking::Single }
}

const fn batch(name: &'static str, structure: Structure) -> Contender {
    Contender { name, structure, asking: Asking::Batch }
}

/// Everyone, in the order of the tables.
pub const CONTENDERS: [Contender; 18] = [
    single("accel-bvh", Structure::AccelBvh),
    batch("accel-bvh-batch", Structure::AccelBvh),
    single("accel-octree", Structure::AccelOctree),
    batch("accel-octree-batch", Structure::AccelOctree),
    single("obvhs-cwbvh", CWBVH),
    single("obvhs-cwbvh-medium", CWBVH_MEDIUM),
    single("obvhs-bvh2", BVH2),
    packets("embree1", ROBUST, EmbreeWidth::One),
    packets("embree4", ROBUST, EmbreeWidth::Four),
    packets("embree8", ROBUST, EmbreeWidth::Eight),
    packets("embree16", ROBUST, EmbreeWidth::Sixteen),
    coherent("embree16-coherent", ROBUST),
    packets("embree16-split", SPLIT, EmbreeWidth::Sixteen),
    packets("embree1-fast", FAST, EmbreeWidth::One),
    packets("embree4-fast", FAST, EmbreeWidth::Four),
    packets("embree8-fast", FAST, EmbreeWidth::Eight),
    packets("embree16-fast", FAST, EmbreeWidth::Sixteen),
    coherent("embree16-fast-coherent", FAST),
];

/// The structures that some contenders need, each built once.
pub struct Structures {
    built: Vec<(Structure, Built)>,
}

/// A structure with what its build took.
pub(crate) struct Built {
    pub(crate) occluder: AnyOccluder,
    pub(crate) bytes: usize,
    /// The quickest build, from the f64 triangles to the first possible question.
    pub(crate) seconds: f64,
}

pub(crate) enum AnyOccluder {
    Plain(Box<dyn Occluder>),
    Embree(Arc<EmbreeScene>),
}

impl Structures {
    /// Builds what `contenders` need, several times within `seconds` each (once at least), and
    /// keeps the quickest time. Embree is left out without `library`, or when it refuses.
    pub fn build(
        contenders: &[Contender],
        triangles: &[Triangle],
        library: Option<&Arc<EmbreeLibrary>>,
        seconds: f64,
    ) -> Self {
        let mut built: Vec<(Structure, Built)> = Vec::new();
        for contender in contenders {
            let structure = contender.structure;
            if !built.iter().any(|(known, _)| *known == structure)
                && let Some(found) = build_in(structure, triangles, library, seconds)
            {
                built.push((structure, found));
            }
        }
        Self { built }
    }

    pub(crate) fn get(&self, structure: Structure) -> Option<&Built> {
        self.built.iter().find(|(known, _)| *known == structure).map(|(_, built)| built)
    }
}

/// Builds of one structure, at most.
const MOST_BUILDS: u32 = 7;

fn build_in(
    structure: Structure,
    triangles: &[Triangle],
    library: Option<&Arc<EmbreeLibrary>>,
    seconds: f64,
) -> Option<Built> {
    let begin = Instant::now();
    let mut best = build_once(structure, triangles, library)?;
    for _ in 1..MOST_BUILDS {
        // Another build is worth it only if it is likely to end in time.
        if begin.elapsed().as_secs_f64() + best.seconds > seconds {
            break;
        }
        let again = build_once(structure, triangles, library)?;
        if again.seconds < best.seconds {
            best = again;
        }
    }
    Some(best)
}

fn build_once(
    structure: Structure,
    triangles: &[Triangle],
    library: Option<&Arc<EmbreeLibrary>>,
) -> Option<Built> {
    let begin = Instant::now();
    let (occluder, bytes) = match structure {
        Structure::AccelBvh => {
            let bvh = Bvh::build(triangles, &BvhConfig::default());
            let bytes = bvh.bytes();
            (AnyOccluder::Plain(Box::new(bvh)), bytes)
        }
        Structure::AccelOctree => {
            let octree = Octree::build(triangles, &OctreeConfig::default());
            let bytes = octree.stats().bytes;
            (AnyOccluder::Plain(Box::new(octree)), bytes)
        }
        Structure::Obvhs(shape, preset) => {
            let obvhs = Obvhs::build(triangles, shape, preset);
            let bytes = obvhs.bytes();
            (AnyOccluder::Plain(Box::new(obvhs)), bytes)
        }
        Structure::Embree(config) => {
            let scene = EmbreeScene::build(library?.clone(), triangles, &config).ok()?;
            let bytes = scene.bytes();
            (AnyOccluder::Embree(scene), bytes)
        }
    };
    Some(Built { occluder, bytes, seconds: begin.elapsed().as_secs_f64() })
}

/// A structure ready to be asked in one way.
pub(crate) enum Subject<'a> {
    Single(&'a dyn Occluder),
    Batch(&'a dyn Occluder),
    Packets(Embree),
}

impl Built {
    pub(crate) fn subject(&self, asking: Asking) -> Subject<'_> {
        match (&self.occluder, asking) {
            (AnyOccluder::Plain(occluder), Asking::Batch) => Subject::Batch(&**occluder),
            (AnyOccluder::Plain(occluder), _) => Subject::Single(&**occluder),
            (AnyOccluder::Embree(scene), Asking::Packets(width, coherent)) => {
                Subject::Packets(Embree::new(scene.clone(), width, coherent))
            }
            (AnyOccluder::Embree(scene), _) => {
                Subject::Packets(Embree::new(scene.clone(), EmbreeWidth::One, false))
            }
        }
    }
}
