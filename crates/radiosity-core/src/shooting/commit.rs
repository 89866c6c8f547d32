//! What arrived becomes irradiance and unshot exitance: each run of patches or points its own.

use std::ops::Range;

use scene::Rgb;

use super::shooter::Shooter;
use super::state::State;
use crate::executor::Executor;
use crate::mesh::Mesh;

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

/// Adds what each shooter brought to the points (and inside near elements) to points and elements,
/// one shooter after the other, and sums the patches' unshot and received power. What arrived at
/// points has been closed already; points inside near elements take the mean of `closure` at the
/// corners.
pub(super) fn commit<E: Executor>(
    mesh: &Mesh,
    shooters: &[Shooter],
    closure: Option<&[f64]>,
    state: &mut State,
    executor: &E,
) {
    let mut runs = runs(mesh, state);
    executor.for_each(&mut runs, |run| match run {
        Run::Points(run) => run.take(shooters),
        Run::Patches(run) => run.take(mesh, shooters, closure),
    });
}

impl PointRun<'_> {
    fn take(&mut self, shooters: &[Shooter]) {
        for shooter in shooters {
            let arriving = &shooter.arriving[self.first..];
            self.total.iter_mut().zip(arriving).for_each(|(t, a)| *t += *a);
        }
    }
}

impl PatchRun<'_> {
    fn take(&mut self, mesh: &Mesh, shooters: &[Shooter], closure: Option<&[f64]>) {
        for (slot, patch) in self.patches.clone().enumerate() {
            let mut received = Rgb::ZERO;
            let (mut power, mut net) = (Rgb::ZERO, Rgb::ZERO);
            for id in mesh.patches[patch].elements.clone() {
                let element = &mesh.elements[id as usize];
                let reflectance = mesh.root_of(element).reflectance;
                let i = id as usize - self.first_element;
                let scale = || {
                    closure.map_or(1.0, |c| {
                        element.points.map(|p| c[p as usize]).iter().sum::<f64>() / 3.0
                    })
                };
                for Shooter { near, arriving, .. } in shooters {
                    let corners: Rgb = element.points.iter().map(|&p| arriving[p as usize]).sum();
                    let mean = near.mean(id).map_or(corners / 3.0, |inside| inside * scale());
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
