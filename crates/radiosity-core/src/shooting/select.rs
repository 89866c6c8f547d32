//! The next shooter.

use scene::Rgb;

/// The patch with the most unshot power, summed over the channels; the first of equals;
/// `None` when all is shot.
pub(super) fn brightest(patch_power: &[Rgb]) -> Option<usize> {
    let mut best = None;
    let mut most = 0.0;
    for (patch, power) in patch_power.iter().enumerate() {
        if power.sum() > most {
            most = power.sum();
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
        assert_eq!(brightest(&power), Some(2));
        assert_eq!(brightest(&[Rgb::ZERO; 3]), None);
        assert_eq!(brightest(&[]), None);
    }
}
