//! The next shooters.

use scene::Rgb;

use crate::config::Schedule;

/// Patches with at least this share of the brightest one's power shoot together with it. What they
/// bring each other is reflected power, so few of them would have been overtaken in between. About
/// a half; patches are halves of patches, and rounding must not decide who is alike.
const ALIKE: f64 = 0.45;

/// At most so many shoot together: enough for any number of threads to be busy.
const MOST: usize = 16;

/// At most one patch in so many shoots together with others: all at once would shoot the light of the
/// step before, and a sweep would carry light by one bounce.
const OF_PATCHES: usize = 16;

/// Receivers times shooters of a step, at most: 24 bytes each, 6 MB.
const MOST_SLOTS: usize = 1 << 18;

/// The brightest patches, those with the most unshot power as a share of the emitted in the channel
/// where that is largest; the first of equals first; none when all is shot.
///
/// Ranked by the sum of the channels, a channel with little light and much reflectance would
/// be left behind.
pub(super) fn brightest(
    patch_power: &[Rgb],
    emitted: Rgb,
    schedule: Schedule,
    receivers: usize,
) -> Vec<usize> {
    let share = |patch: usize| patch_power[patch].share_of(emitted).max_channel();
    let most = (0..patch_power.len()).map(share).fold(0.0, f64::max);
    let (least, count) = match schedule {
        Schedule::Auto => (most * ALIKE, at_once(schedule, patch_power.len(), receivers)),
        Schedule::Single => (0.0, 1),
        Schedule::Multi(count) => (0.0, count.get()),
    };
    let mut bright: Vec<(f64, usize)> = (0..patch_power.len())
        .map(|patch| (share(patch), patch))
        .filter(|(share, _)| *share > 0.0 && *share >= least)
        .collect();
    // In single precision, for the same reason: what is alike but for rounding counts as equal.
    let rank = |share: f64| share as f32;
    let first =
        |a: &(f64, usize), b: &(f64, usize)| rank(b.0).total_cmp(&rank(a.0)).then(a.1.cmp(&b.1));
    if bright.len() > count {
        bright.select_nth_unstable_by(count - 1, first);
        bright.truncate(count);
    }
    bright.sort_unstable_by(first);
    bright.into_iter().map(|(_, patch)| patch).collect()
}

/// How many patches may shoot together, however bright they are.
pub(super) fn at_once(schedule: Schedule, patches: usize, receivers: usize) -> usize {
    match schedule {
        Schedule::Auto => MOST.min(MOST_SLOTS / receivers.max(1)).min(patches / OF_PATCHES).max(1),
        Schedule::Single => 1,
        Schedule::Multi(count) => count.get(),
    }
}

#[cfg(test)]
mod tests {
    use std::num::NonZeroUsize;

    use super::*;

    #[test]
    fn ties_go_to_the_first_and_darkness_to_nobody() {
        let mut power = [0.0; 48].map(Rgb::splat);
        power[..5].copy_from_slice(&[0.0, 2.0, 3.0, 3.0, 1.0].map(Rgb::splat));
        let emitted = Rgb::splat(10.0);
        let chosen = |schedule| brightest(&power, emitted, schedule, 100);
        assert_eq!(chosen(Schedule::Single), [2]);
        assert_eq!(chosen(Schedule::Auto), [2, 3, 1]);
        let multi = |k| Schedule::Multi(NonZeroUsize::new(k).unwrap());
        assert_eq!(chosen(multi(2)), [2, 3]);
        assert_eq!(chosen(multi(9)), [2, 3, 1, 4]);
        assert!(brightest(&[Rgb::ZERO; 3], emitted, Schedule::Auto, 100).is_empty());
        assert!(brightest(&[], emitted, Schedule::Single, 100).is_empty());
    }

    #[test]
    fn many_receivers_or_few_patches_leave_room_for_few_shooters() {
        let power = [Rgb::splat(1.0); 20 * OF_PATCHES];
        let chosen = |n| brightest(&power, Rgb::splat(1.0), Schedule::Auto, n).len();
        assert_eq!([10, 1 << 16, 1 << 30].map(chosen), [16, 4, 1]);
        let few = brightest(&power[..40], Rgb::splat(1.0), Schedule::Auto, 10);
        assert_eq!(few, [0, 1]);
    }

    #[test]
    fn a_faint_channel_counts_as_much_as_a_bright_one() {
        let power = [Rgb::new(5.0, 0.0, 0.0), Rgb::new(0.0, 0.0, 0.9)];
        assert_eq!(brightest(&power, Rgb::new(10.0, 10.0, 1.0), Schedule::Single, 1), [1]);
    }
}
