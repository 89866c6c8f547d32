//! The next shooter.

use scene::Rgb;

/// The patch with the most unshot power, as a share of the emitted in the channel where that
/// is largest; the first of equals; `None` when all is shot.
///
/// Ranked by the sum of the channels, a channel with little light and much reflectance would
/// be left behind.
pub(super) fn brightest(patch_power: &[Rgb], emitted: Rgb) -> Option<usize> {
    let mut best = None;
    let mut most = 0.0;
    for (patch, power) in patch_power.iter().enumerate() {
        let share = power.share_of(emitted).max_channel();
        if share > most {
            most = share;
            best = Some(patch);
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ties_go_to_the_first_and_darkness_to_nobody() {
        let power = [0.0, 2.0, 3.0, 3.0, 1.0].map(Rgb::splat);
        let emitted = Rgb::splat(10.0);
        assert_eq!(brightest(&power, emitted), Some(2));
        assert_eq!(brightest(&[Rgb::ZERO; 3], emitted), None);
        assert_eq!(brightest(&[], emitted), None);
    }

    #[test]
    fn a_faint_channel_counts_as_much_as_a_bright_one() {
        let power = [Rgb::new(5.0, 0.0, 0.0), Rgb::new(0.0, 0.0, 0.9)];
        assert_eq!(brightest(&power, Rgb::new(10.0, 10.0, 1.0)), Some(1));
    }
}
