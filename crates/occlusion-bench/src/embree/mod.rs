//! Embree 4 behind [`Occluder`].

mod library;

pub use library::{EmbreeError, EmbreeLibrary, LIBRARY_NAMES, LIBRARY_VARIABLE};

use std::sync::Arc;

use accel::{Occluder, Segment, Target};
use glam::{DVec3, Vec3};

use crate::{INSIDE, Triangle, bounds};
use library::{Arguments, CommittedScene, Packet, Ray, Valid};

/// How Embree builds a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EmbreeConfig {
    /// Whether edges must not leak (`RTC_SCENE_FLAG_ROBUST`), as those of accel do not.
    pub robust: bool,
    /// Whether the build may split triangles for a better tree (`RTC_BUILD_QUALITY_HIGH`).
    pub split: bool,
}

impl Default for EmbreeConfig {
    /// The same task as accel's: watertight, each triangle once.
    fn default() -> Self {
        Self { robust: true, split: false }
    }
}

/// An Embree scene of one triangle mesh, recentred before its positions become f32.
pub struct EmbreeScene {
    committed: CommittedScene,
    centre: DVec3,
}

impl EmbreeScene {
    /// Builds the scene on the calling thread.
    ///
    /// # Errors
    /// Returns the error that Embree reports.
    ///
    /// # Panics
    /// Panics if there are 2³² / 3 triangles or more.
    pub fn build(
        library: Arc<EmbreeLibrary>,
        triangles: &[Triangle],
        config: &EmbreeConfig,
    ) -> Result<Arc<Self>, EmbreeError> {
        let centre = bounds(triangles).map_or(DVec3::ZERO, |(lo, hi)| lo * 0.5 + hi * 0.5);
        let local: Vec<[[f32; 3]; 3]> =
            triangles.iter().map(|t| t.map(|v| (v - centre).as_vec3().to_array())).collect();
        let committed = CommittedScene::build(library, &local, config)?;
        Ok(Arc::new(Self { committed, centre }))
    }

    /// Returns the memory that Embree holds, its copy of the mesh included, in bytes.
    pub fn bytes(&self) -> usize {
        self.committed.bytes()
    }

    /// The origin and direction of a segment whose far end is at 1; `None` where the answer is
    /// that nothing blocks.
    #[inline]
    fn ray(&self, (from, to): (DVec3, DVec3)) -> Option<(Vec3, Vec3)> {
        let (origin, direction) = ((from - self.centre).as_vec3(), (to - from).as_vec3());
        let usable = origin.is_finite() && direction.is_finite() && direction != Vec3::ZERO;
        usable.then_some((origin, direction))
    }
}

/// How many segments a call of Embree takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EmbreeWidth {
    /// `rtcOccluded1`.
    One,
    /// `rtcOccluded4`.
    Four,
    /// `rtcOccluded8`.
    Eight,
    /// `rtcOccluded16`.
    Sixteen,
}

/// An Embree scene and the way it is asked.
///
/// What a segment or a target ignores is not supported: it would take a callback per hit, which
/// is not what is compared here. Questions that ignore a triangle are answered as if they did not.
#[derive(Clone)]
pub struct Embree {
    scene: Arc<EmbreeScene>,
    width: EmbreeWidth,
    coherent: bool,
}

impl Embree {
    /// Asks `scene` in calls of `width` segments; `coherent` lets Embree follow a packet as one
    /// (`RTC_RAY_QUERY_FLAG_COHERENT`).
    pub fn new(scene: Arc<EmbreeScene>, width: EmbreeWidth, coherent: bool) -> Self {
        Self { scene, width, coherent }
    }

    /// Answers segments that need not share an end, in calls of the chosen width.
    ///
    /// # Panics
    /// Panics if `segments` and `blocked` differ in length.
    pub fn occluded_stream(&self, segments: &[Segment], blocked: &mut [bool]) {
        assert_eq!(segments.len(), blocked.len(), "one answer per segment");
        self.ask(segments, |segment| (segment.from, segment.to), blocked);
    }

    fn ask<S>(&self, asked: &[S], ends: impl Fn(&S) -> (DVec3, DVec3), blocked: &mut [bool]) {
        let scene = &self.scene.committed;
        match self.width {
            EmbreeWidth::One => {
                let mut arguments = Arguments::new(self.coherent);
                for (segment, answer) in asked.iter().zip(blocked) {
                    *answer = self.ask_one(ends(segment), &mut arguments);
                }
            }
            EmbreeWidth::Four => {
                self.ask_packets(asked, ends, blocked, |v, p, a| scene.occluded_4(v, p, a));
            }
            EmbreeWidth::Eight => {
                self.ask_packets(asked, ends, blocked, |v, p, a| scene.occluded_8(v, p, a));
            }
            EmbreeWidth::Sixteen => {
                self.ask_packets(asked, ends, blocked, |v, p, a| scene.occluded_16(v, p, a));
            }
        }
    }

    fn ask_one(&self, ends: (DVec3, DVec3), arguments: &mut Arguments) -> bool {
        let Some((origin, direction)) = self.scene.ray(ends) else { return false };
        let mut ray = Ray {
            origin: origin.to_array(),
            near: INSIDE.0,
            direction: direction.to_array(),
            time: 0.0,
            far: INSIDE.1,
            mask: u32::MAX,
            id: 0,
            flags: 0,
        };
        self.scene.committed.occluded(&mut ray, arguments);
        ray.far < 0.0
    }

    fn ask_packets<const N: usize, S>(
        &self,
        asked: &[S],
        ends: impl Fn(&S) -> (DVec3, DVec3),
        blocked: &mut [bool],
        occluded: impl Fn(&Valid<N>, &mut Packet<N>, &mut Arguments),
    ) {
        let mut arguments = Arguments::new(self.coherent);
        let mut packet = Packet {
            origin: [[0.0; N]; 3],
            near: [INSIDE.0; N],
            direction: [[0.0; N]; 3],
            time: [0.0; N],
            far: [0.0; N],
            mask: [u32::MAX; N],
            id: [0; N],
            flags: [0; N],
        };
        for (asked, answers) in asked.chunks(N).zip(blocked.chunks_mut(N)) {
            let mut valid = Valid([0; N]);
            packet.far = [INSIDE.1; N];
            for (lane, segment) in asked.iter().enumerate() {
                let Some((origin, direction)) = self.scene.ray(ends(segment)) else { continue };
                valid.0[lane] = -1;
                for axis in 0..3 {
                    packet.origin[axis][lane] = origin[axis];
                    packet.direction[axis][lane] = direction[axis];
                }
            }
            occluded(&valid, &mut packet, &mut arguments);
            for (answer, far) in answers.iter_mut().zip(&packet.far) {
                *answer = *far < 0.0;
            }
        }
    }
}

impl Occluder for Embree {
    fn occluded(&self, segment: &Segment) -> bool {
        self.ask_one((segment.from, segment.to), &mut Arguments::new(self.coherent))
    }

    fn occluded_batch(&self, from: DVec3, _ignore: u32, targets: &[Target], blocked: &mut [bool]) {
        assert_eq!(targets.len(), blocked.len(), "one answer per target");
        self.ask(targets, |target| (from, target.point), blocked);
    }
}
