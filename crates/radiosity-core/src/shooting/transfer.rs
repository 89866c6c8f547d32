//! Light from one patch to a run of receiver points.
//!
//! Every point walks down the patch's cells as far as its distance and the light at stake
//! demand; form factor first, then, if anything arrives, one segment per cell. Points are
//! taken in runs, so that the segments of one cell share an origin.

use accel::{Occluder, Outlook, Segment, Target};
use form_factor::{Rule, centroid_kernel, lambert, three_point_kernel};
use glam::DVec3;
use scene::Rgb;

use super::blocks::Block;
use super::cell::{Cell, ORIGINS, Parts};
use super::detail::Detail;
use super::reach::Reach;
use crate::config::Exchange;
use crate::mesh::{Mesh, Patch, ReceiverPoint};
use crate::needs::{Channels, Needs};

/// Segments start and end this far above their surfaces, as a share of the scene's extent:
/// 80 ulps of f32 coordinates, and less than the thinnest gap worth modelling.
pub(crate) const SEGMENT_LIFT: f64 = 5e-6;

/// A receiver no higher above the shooter's plane than this share of the scene's extent lies
/// in it, and gets nothing; nor does one whose own plane the shooter does not rise above: points of the shooter itself and of its coplanar neighbours come
/// out at rounding errors, up to 1e-10 of the extent for scenes a million extents from the
/// origin, and a form factor of 1/2 must not hang on those.
pub(super) const IN_PLANE: f64 = 1e-9;

/// What all receivers of one shot have in common.
pub(super) struct Shot<'a> {
    pub(super) occluder: &'a dyn Occluder,
    pub(super) cells: &'a [Cell],
    /// Whether something may block its light.
    pub(super) segments: bool,
    /// Whether receivers are looked at one by one.
    pub(super) singles: bool,
    pub(super) channels: Channels,
    /// What is known of many segments at once.
    pub(super) outlook: Option<Outlook<'a>>,
    /// The sealed space it lies in, if that is known.
    pub(super) space: Option<u64>,
    /// The shooter's corners.
    pub(super) corners: [DVec3; 3],
    /// Unit normal of the shooter's lit side.
    pub(super) normal: DVec3,
    /// The shooter's input triangle.
    pub(super) triangle: u32,
    pub(super) exchange: Exchange,
    pub(super) rule: Rule,
    /// Whether form factors are exact, and cells are split for what may lie between alone.
    pub(super) exact: bool,
    /// The scene's extent.
    pub(super) extent: f64,
    /// Irradiance below which a cell need not be split, per channel; at least 0.
    pub(super) negligible: Rgb,
    /// A cell of several elements serves a point only beyond this many of its radii.
    pub(super) open_radii: f64,
}

impl<'a> Shot<'a> {
    /// A shot of a patch whose cells are laid out in `cells`; `mean` is the scene's mean
    /// irradiance.
    #[expect(clippy::too_many_arguments, reason = "each is a fact of its own")]
    pub(super) fn new(
        occluder: &'a dyn Occluder,
        cells: &'a [Cell],
        mesh: &Mesh,
        patch: &Patch,
        exchange: Exchange,
        needs: &Needs,
        detail: &Detail,
        mean: Rgb,
    ) -> Self {
        let node = &mesh.nodes[patch.node as usize];
        let root = &mesh.roots[node.root as usize];
        let corners = mesh.corners(node.vertices);
        let looks = needs.segments && !needs.singles;
        Self {
            occluder,
            segments: needs.segments,
            singles: needs.singles,
            channels: needs.channels,
            outlook: if looks { occluder.look_from(corners) } else { None },
            space: None,
            corners,
            cells,
            normal: root.normal,
            triangle: root.triangle.0,
            exchange,
            rule: Rule::for_tolerance(detail.tolerance),
            exact: detail.tolerance == 0.0,
            extent: mesh.extent,
            negligible: mean * detail.cell_share,
            open_radii: detail.open_radii,
        }
    }
}

/// A run of receiver points.
#[derive(Clone, Copy)]
pub(super) struct Receivers<'a> {
    pub(super) points: &'a [ReceiverPoint],
    /// Share of an element that each stands for; all of it if absent. A point that stands
    /// for little needs little care: its neighbours see the shooter from elsewhere.
    pub(super) shares: Option<&'a [f64]>,
    /// The number of the first, and the blocks that light may reach; all, if absent.
    pub(super) blocks: Option<(usize, &'a [Block])>,
}

impl Receivers<'_> {
    fn share(&self, index: u32) -> f64 {
        self.shares.map_or(1.0, |s| s[index as usize])
    }
}

/// What it took.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Counts {
    pub(super) rays: u64,
    pub(super) form_factors: u64,
}

/// Buffers of one run of receivers, kept from shot to shot.
#[derive(Default)]
pub(super) struct Scratch {
    /// A stack of runs of receivers that wait for finer cells.
    waiting: Vec<u32>,
    /// Receivers that nothing can hide.
    open: Vec<u32>,
    /// Receivers of the present cell by the place their segments start from, each with the
    /// form factor that visibility decides on.
    lit: [Vec<(u32, f64)>; ORIGINS],
    targets: [Vec<Target>; ORIGINS],
    blocked: Vec<bool>,
}

impl Shot<'_> {
    /// Adds the irradiance that reaches each of `receivers` to `arriving`, and the form factors to
    /// all that is visible of the shooter to `seen`, if asked.
    pub(super) fn light<const N: usize>(
        &self,
        receivers: Receivers,
        arriving: &mut [[f64; N]],
        seen: Option<&mut [f64]>,
        scratch: &mut Scratch,
    ) -> Counts {
        self.sort_out(&receivers, scratch);
        let mut run = Run {
            shot: self,
            receivers,
            arriving,
            seen,
            scratch,
            segments: self.segments,
            counts: Counts::default(),
        };
        run.descend(&self.cells[0], 0);
        if !run.scratch.open.is_empty() {
            run.segments = false;
            std::mem::swap(&mut run.scratch.waiting, &mut run.scratch.open);
            run.descend(&self.cells[0], 0);
        }
        run.counts
    }

    /// Lets those receivers wait that light may reach, and sets apart those that nothing can hide.
    fn sort_out(&self, receivers: &Receivers, scratch: &mut Scratch) {
        scratch.waiting.clear();
        scratch.open.clear();
        let Some((first, blocks)) = receivers.blocks else {
            scratch.waiting.extend(0..receivers.points.len() as u32);
            return;
        };
        for block in blocks {
            let all = block.receivers.start - first as u32..block.receivers.end - first as u32;
            match self.reach(block) {
                Reach::Behind | Reach::Apart | Reach::Hidden => {}
                // Where nothing is asked for, there is but one way to go.
                Reach::Open if self.segments => scratch.open.extend(all),
                Reach::Open | Reach::Asked => scratch.waiting.extend(all),
            }
        }
    }

    /// Length by which segments keep off their surfaces.
    fn lift(&self) -> f64 {
        SEGMENT_LIFT * self.extent
    }

    /// On which side of the shooter the receiver lies and with which normal it sees it:
    /// `None` if light cannot go between them.
    #[inline(always)]
    fn facing(&self, cell: &Cell, receiver: &ReceiverPoint) -> Option<(f64, DVec3)> {
        let height = self.normal.dot(receiver.position - cell.centroid);
        let in_plane = IN_PLANE * self.extent;
        let side = match self.exchange {
            _ if height.abs() <= in_plane => return None,
            Exchange::OneSided if height < 0.0 => return None,
            Exchange::OneSided => 1.0,
            Exchange::Paired => height.signum(),
        };
        let normal = receiver.normal * side;
        let above = |c: &DVec3| normal.dot(*c - receiver.position) > in_plane;
        cell.corners.iter().any(above).then_some((side, normal))
    }

    /// Whether the cell must be split for this receiver.
    #[inline(always)]
    fn too_coarse(
        &self,
        cell: &Cell,
        receiver: &ReceiverPoint,
        normal: DVec3,
        side: f64,
        share: f64,
    ) -> bool {
        let near = receiver.position.distance(cell.middle) < self.open_radii * cell.radius;
        match cell.parts {
            Parts::Quarters(0) => return false,
            Parts::Mesh(..) if near => return true,
            Parts::Quarters(_) if cell.open < 1.0 && near => return true,
            _ => {}
        }
        let (x, c) = (receiver.position, cell.centroid);
        let form_factor = centroid_kernel(x, normal, c, self.normal * side, cell.area);
        (0..3).any(|k| cell.unshot[k].abs() * form_factor * share > self.negligible[k])
    }

    /// Form factor, and where on the cell a segment should start if not at its centroid.
    #[inline(always)]
    fn form_factor(
        &self,
        cell: &Cell,
        receiver: &ReceiverPoint,
        normal: DVec3,
        side: f64,
    ) -> (f64, Option<DVec3>) {
        let x = receiver.position;
        let far = x.distance(cell.centroid) / cell.longest;
        let uncut = || cell.corners.iter().all(|c| normal.dot(*c - x) >= 0.0);
        if far > self.rule.three_points && uncut() {
            let shooter_normal = self.normal * side;
            let value = if far > self.rule.one_point {
                centroid_kernel(x, normal, cell.centroid, shooter_normal, cell.area)
            } else {
                three_point_kernel(x, normal, cell.corners, shooter_normal, cell.area)
            };
            return (value, None);
        }
        let seen = lambert(x, normal, cell.corners);
        (seen.form_factor, seen.cut.then_some(seen.middle))
    }
}

/// One run of receivers on its way down the cells.
struct Run<'a, const N: usize> {
    shot: &'a Shot<'a>,
    receivers: Receivers<'a>,
    arriving: &'a mut [[f64; N]],
    seen: Option<&'a mut [f64]>,
    scratch: &'a mut Scratch,
    /// Whether something may lie between.
    segments: bool,
    counts: Counts,
}

impl<const N: usize> Run<'_, N> {
    /// Serves the receivers waiting from `first` on, by this cell or by parts of it.
    fn descend(&mut self, cell: &Cell, first: usize) {
        let shot = self.shot;
        if cell.unshot == Rgb::ZERO && self.seen.is_none() {
            return;
        }
        if first == self.scratch.waiting.len() {
            return;
        }
        self.scratch.lit.iter_mut().for_each(Vec::clear);
        self.scratch.targets.iter_mut().for_each(Vec::clear);
        let last = self.scratch.waiting.len();
        // What shines alike everywhere and is seen whole is one cell, however bright.
        let alike = matches!(cell.parts, Parts::Quarters(_)) && cell.open == 1.0;
        let segments = self.segments;
        let whole = alike && shot.exact && !segments;
        for i in first..last {
            let index = self.scratch.waiting[i];
            let receiver = &self.receivers.points[index as usize];
            let Some((side, normal)) = shot.facing(cell, receiver) else { continue };
            let share = self.receivers.share(index);
            if !whole && shot.too_coarse(cell, receiver, normal, side, share) {
                self.scratch.waiting.push(index);
                continue;
            }
            let (form_factor, from) = shot.form_factor(cell, receiver, normal, side);
            self.counts.form_factors += 1;
            if form_factor <= 0.0 {
                continue;
            }
            if !segments {
                self.arrives(cell, index, form_factor);
                continue;
            }
            let to = receiver.position + normal * shot.lift();
            if from.is_none() && side > 0.0 {
                let start = index as usize % cell.places;
                self.scratch.lit[start].push((index, form_factor));
                let target = Target { point: to, ignore: receiver.triangle };
                self.scratch.targets[start].push(target);
                continue;
            }
            let from = from.unwrap_or(cell.centroid) + shot.normal * (side * shot.lift());
            let ignore = [shot.triangle, receiver.triangle];
            self.counts.rays += 1;
            if !shot.occluder.occluded(&Segment { from, to, ignore }) {
                self.arrives(cell, index, form_factor);
            }
        }
        self.test_visibility(cell);
        if self.scratch.waiting.len() > last {
            match cell.parts {
                Parts::Mesh(first, end) => {
                    for c in &shot.cells[first as usize..end as usize] {
                        self.descend(c, last);
                    }
                }
                Parts::Quarters(left) => {
                    for quarter in cell.quarters(left) {
                        self.descend(&quarter, last);
                    }
                }
            }
        }
        self.scratch.waiting.truncate(last);
    }

    /// Books a form factor to a cell in sight.
    #[inline(always)]
    fn arrives(&mut self, cell: &Cell, index: u32, form_factor: f64) {
        let slot = &mut self.arriving[index as usize];
        let light: [f64; N] = self.shot.channels.pick(cell.unshot);
        for (slot, light) in slot.iter_mut().zip(light) {
            *slot += light * form_factor;
        }
        if let Some(seen) = self.seen.as_deref_mut() {
            seen[index as usize] += form_factor;
        }
    }

    /// One segment per lit receiver, in batches that share a start.
    fn test_visibility(&mut self, cell: &Cell) {
        let light: [f64; N] = self.shot.channels.pick(cell.unshot);
        let Scratch { lit, targets, blocked, .. } = &mut *self.scratch;
        for ((lit, targets), origin) in lit.iter().zip(&*targets).zip(cell.origins) {
            if lit.is_empty() {
                continue;
            }
            let from = origin + self.shot.normal * self.shot.lift();
            blocked.clear();
            blocked.resize(targets.len(), false);
            self.shot.occluder.occluded_batch(from, self.shot.triangle, targets, blocked);
            self.counts.rays += targets.len() as u64;
            let open = lit.iter().zip(&*blocked).filter(|(_, blocked)| !**blocked);
            for (&(index, form_factor), _) in open {
                let slot = &mut self.arriving[index as usize];
                for (slot, light) in slot.iter_mut().zip(light) {
                    *slot += light * form_factor;
                }
                if let Some(seen) = self.seen.as_deref_mut() {
                    seen[index as usize] += form_factor;
                }
            }
        }
    }
}
