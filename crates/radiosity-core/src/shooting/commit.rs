//! What arrived becomes irradiance and unshot exitance: each run of patches its own.

use std::ops::Range;

use scene::Rgb;

use super::near::Near;
use super::state::State;
use crate::executor::Executor;
use crate::mesh::Mesh;

/// Elements per run: enough to outweigh starting a task, few enough to balance.
const RUN: usize = 1024;

/// A run of patches with the slots of its elements.
struct Run<'a> {
    patches: Range<usize>,
    first_element: usize,
    irradiance: &'a mut [Rgb],
    unshot: &'a mut [Rgb],
    power: &'a mut [Rgb],
    received: &'a mut [Rgb],
}

/// Adds what arrived at the points (and inside near elements) to the elements, and sums the
/// patches' unshot and received power. `arriving` has been closed already; points inside near
/// elements take the mean of `closure` at the corners.
pub(super) fn commit<E: Executor>(
    mesh: &Mesh,
    arriving: &[Rgb],
    near: &Near,
    closure: Option<&[f64]>,
    state: &mut State,
    executor: &E,
) {
    let mut runs = runs(mesh, state);
    executor.for_each(&mut runs, |run| {
        for (slot, patch) in run.patches.clone().enumerate() {
            let mut received = Rgb::ZERO;
            let mut power = Rgb::ZERO;
            for id in mesh.patches[patch].elements.clone() {
                let element = &mesh.elements[id as usize];
                let corners: Rgb = element.points.iter().map(|&p| arriving[p as usize]).sum();
                let scale = || {
                    closure.map_or(1.0, |c| {
                        element.points.map(|p| c[p as usize]).iter().sum::<f64>() / 3.0
                    })
                };
                let mean = near.mean(id).map_or(corners / 3.0, |inside| inside * scale());
                let i = id as usize - run.first_element;
                if mean != Rgb::ZERO {
                    run.irradiance[i] += mean;
                    run.unshot[i] += mesh.root_of(element).reflectance * mean;
                    received += mean * element.area;
                }
                power += run.unshot[i].abs() * element.area;
            }
            run.power[slot] = power;
            run.received[slot] = received;
        }
    });
}

/// Cuts the state into runs at patch borders.
fn runs<'a>(mesh: &Mesh, state: &'a mut State) -> Vec<Run<'a>> {
    let mut irradiance = state.irradiance.as_mut_slice();
    let mut unshot = state.unshot.as_mut_slice();
    let mut power = state.patch_power.as_mut_slice();
    let mut received = state.patch_received.as_mut_slice();
    let mut runs = Vec::new();
    let (mut patch, mut element) = (0, 0);
    while patch < mesh.patches.len() {
        let full = |p: &usize| mesh.patches[*p].elements.end as usize >= element + RUN;
        let end = (patch..mesh.patches.len()).find(full).map_or(mesh.patches.len(), |p| p + 1);
        let last = mesh.patches[end - 1].elements.end as usize;
        runs.push(Run {
            patches: patch..end,
            first_element: element,
            irradiance: cut(&mut irradiance, last - element),
            unshot: cut(&mut unshot, last - element),
            power: cut(&mut power, end - patch),
            received: cut(&mut received, end - patch),
        });
        (patch, element) = (end, last);
    }
    runs
}

fn cut<'a>(rest: &mut &'a mut [Rgb], at: usize) -> &'a mut [Rgb] {
    rest.split_off_mut(..at).expect("a run ends at or before the end of its arrays")
}
