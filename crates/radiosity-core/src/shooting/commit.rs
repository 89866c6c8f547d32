//! What arrived becomes irradiance and unshot exitance: each run of patches or points its own.

use std::ops::Range;

use scene::Rgb;

use super::blocks::Blocks;
use super::light;
use super::shooter::Shooter;
use super::state::State;
use crate::executor::Executor;
use crate::mesh::Mesh;
use crate::needs::Channels;

/// Elements or points per run: enough to outweigh starting a task, few enough to balance.
const RUN: usize = 1024;

/// A part of the state that one thread takes up.
enum Run<'a> {
    Points(PointRun<'a>),
    Patches(PatchRun<'a>),
}

/// A run of receiver points and probes.
struct PointRun<'a> {
    first: usize,
    total: &'a mut [Rgb],
}

/// A run of patches with the slots of its elements.
struct PatchRun<'a> {
    patches: Range<usize>,
    first_element: usize,
    irradiance: &'a mut [Rgb],
    unshot: &'a mut [Rgb],
    power: &'a mut [Rgb],
    net: &'a mut [Rgb],
    received: &'a mut [Rgb],
}

/// What a commit reads.
#[derive(Clone, Copy)]
pub(super) struct Brought<'a> {
    pub(super) mesh: &'a Mesh,
    pub(super) shooters: &'a [Shooter],
    /// Factors on what arrives. Slots of points have been closed already; points inside near elements
    /// take the mean of those of the corners.
    pub(super) closure: Option<&'a [f64]>,
    pub(super) blocks: &'a Blocks,
    pub(super) channels: Channels,
    /// Roots that receive nothing; none if absent.
    pub(super) black: &'a [bool],
}

/// Adds what each shooter brought to the points (and inside near elements) to points and elements,
/// one shooter after the other, and sums the patches' unshot and received power.
pub(super) fn commit<E: Executor>(brought: Brought, state: &mut State, executor: &E) {
    match brought.channels.count() {
        1 => commit_channels::<1, E>(brought, state, executor),
        _ => commit_channels::<3, E>(brought, state, executor),
    }
}

fn commit_channels<const N: usize, E: Executor>(brought: Brought, state: &mut State, executor: &E) {
    let mut runs = runs(brought.mesh, state);
    executor.for_each(&mut runs, |run| match run {
        Run::Points(run) => run.take::<N>(brought),
        Run::Patches(run) => run.take::<N>(brought),
    });
}

impl PointRun<'_> {
    fn take<const N: usize>(&mut self, brought: Brought) {
        for shooter in brought.shooters {
            let arriving = shooter.arriving.as_chunks::<N>().0[self.first..].chunks(light::RUN);
            let lit = &shooter.lit[self.first / light::RUN..];
            let parts = self.total.chunks_mut(light::RUN).zip(arriving).zip(lit);
            for ((total, arriving), _) in parts.filter(|(_, lit)| **lit) {
                let arriving = arriving.iter().map(|a| brought.channels.spread(*a));
                total.iter_mut().zip(arriving).for_each(|(t, a)| *t += a);
            }
        }
    }
}

impl PatchRun<'_> {
    fn take<const N: usize>(&mut self, brought: Brought) {
        let Brought { mesh, shooters, blocks, .. } = brought;
        let mut lit: Vec<&Shooter> = Vec::with_capacity(shooters.len());
        for (slot, patch) in self.patches.clone().enumerate() {
            let (elements, runs) = (&mesh.patches[patch].elements, blocks.runs_of(patch));
            lit.clear();
            lit.extend(shooters.iter().filter(|shooter| {
                shooter.lit[runs.clone()].contains(&true) || shooter.near.any_of(elements)
            }));
            self.received[slot] = Rgb::ZERO;
            // What neither received nor shot is as it was.
            if !lit.is_empty() || shooters.iter().any(|shooter| shooter.patch == patch) {
                self.take_patch::<N>(brought, slot, elements.clone(), &lit);
            }
        }
    }

    fn take_patch<const N: usize>(
        &mut self,
        brought: Brought,
        slot: usize,
        elements: Range<u32>,
        lit: &[&Shooter],
    ) {
        let Brought { mesh, closure, channels, black, .. } = brought;
        let mut received = Rgb::ZERO;
        let (mut power, mut net) = (Rgb::ZERO, Rgb::ZERO);
        for id in elements {
            let element = &mesh.elements[id as usize];
            let reflectance = mesh.root_of(element).reflectance;
            let i = id as usize - self.first_element;
            let scale = || {
                closure.map_or(1.0, |c| {
                    element.points.map(|p| c[p as usize]).iter().sum::<f64>() / 3.0
                })
            };
            let receives = !black.get(element.root as usize).is_some_and(|black| *black);
            for Shooter { near, arriving, .. } in lit.iter().filter(|_| receives) {
                let mean = match near.mean::<N>(id) {
                    Some(inside) => channels.spread(inside) * scale(),
                    None => channels.spread(mean_of::<N>(arriving, element.points)),
                };
                if mean != Rgb::ZERO {
                    self.irradiance[i] += mean;
                    self.unshot[i] += reflectance * mean;
                    received += mean * element.area;
                }
            }
            power += self.unshot[i].abs() * element.area;
            net += self.unshot[i] * element.area;
        }
        self.power[slot] = power;
        self.net[slot] = net;
        self.received[slot] = received;
    }
}

/// The mean at three corners.
#[inline]
fn mean_of<const N: usize>(arriving: &[f64], points: [u32; 3]) -> [f64; N] {
    let arriving = arriving.as_chunks::<N>().0;
    let mut sum = [0.0; N];
    for point in points {
        let at = &arriving[point as usize];
        sum.iter_mut().zip(at).for_each(|(sum, at)| *sum += at);
    }
    sum.map(|sum| sum / 3.0)
}

/// Cuts the state into runs, elements at patch borders.
fn runs<'a>(mesh: &Mesh, state: &'a mut State) -> Vec<Run<'a>> {
    let mut irradiance = state.irradiance.as_mut_slice();
    let mut unshot = state.unshot.as_mut_slice();
    let mut power = state.patch_power.as_mut_slice();
    let mut net = state.patch_net.as_mut_slice();
    let mut received = state.patch_received.as_mut_slice();
    let points = state.at_points.chunks_mut(RUN).enumerate();
    let mut runs: Vec<Run> =
        points.map(|(i, total)| Run::Points(PointRun { first: i * RUN, total })).collect();
    let (mut patch, mut element) = (0, 0);
    while patch < mesh.patches.len() {
        let full = |p: &usize| mesh.patches[*p].elements.end as usize >= element + RUN;
        let end = (patch..mesh.patches.len()).find(full).map_or(mesh.patches.len(), |p| p + 1);
        let last = mesh.patches[end - 1].elements.end as usize;
        runs.push(Run::Patches(PatchRun {
            patches: patch..end,
            first_element: element,
            irradiance: cut(&mut irradiance, last - element),
            unshot: cut(&mut unshot, last - element),
            power: cut(&mut power, end - patch),
            net: cut(&mut net, end - patch),
            received: cut(&mut received, end - patch),
        }));
        (patch, element) = (end, last);
    }
    runs
}

fn cut<'a>(rest: &mut &'a mut [Rgb], at: usize) -> &'a mut [Rgb] {
    rest.split_off_mut(..at).expect("a run ends at or before the end of its arrays")
}
