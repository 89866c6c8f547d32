//! How something grows: the exponent of a power law.

/// The power law y = c·xᵏ through pairs of x and y above 0, by least squares on logarithms: k and
/// c; nothing where there are fewer than two different x.
pub(super) fn power(pairs: &[(f64, f64)]) -> Option<(f64, f64)> {
    let logs: Vec<_> = pairs.iter().map(|(x, y)| (x.ln(), y.ln())).collect();
    let n = logs.len() as f64;
    let (mean_x, mean_y) =
        (logs.iter().map(|l| l.0).sum::<f64>() / n, logs.iter().map(|l| l.1).sum::<f64>() / n);
    let (mut products, mut squares) = (0.0, 0.0);
    for (x, y) in &logs {
        products += (x - mean_x) * (y - mean_y);
        squares += (x - mean_x) * (x - mean_x);
    }
    (squares > 0.0).then(|| {
        let k = products / squares;
        (k, (mean_y - k * mean_x).exp())
    })
}

/// What one more x costs between the two largest: y's difference over x's.
pub(super) fn slope_at_the_end(pairs: &[(f64, f64)]) -> Option<f64> {
    let mut sorted = pairs.to_vec();
    sorted.sort_by(|a, b| a.0.total_cmp(&b.0));
    let [.., (x0, y0), (x1, y1)] = sorted[..] else { return None };
    (x1 > x0).then(|| (y1 - y0) / (x1 - x0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_power_law_is_found() {
        let law = |k: f64| [1.0, 10.0, 300.0].map(|x: f64| (x, 2.0 * x.powf(k)));
        for exponent in [0.5, 1.0, 1.25] {
            let (k, c) = power(&law(exponent)).unwrap();
            assert!((k - exponent).abs() < 1e-12 && (c - 2.0).abs() < 1e-11, "{k} {c}");
        }
        assert_eq!(power(&[(2.0, 3.0), (2.0, 4.0)]), None);
        assert_eq!(power(&[]), None);
    }

    /// ln y over ln x: 0, 1 and 3 at 0, 1 and 2; the slope is Σ xy/Σ x² about the means, 3/2.
    #[test]
    fn readings_off_the_law_are_weighed_by_least_squares() {
        let e = std::f64::consts::E;
        let (k, _) = power(&[(1.0, 1.0), (e, e), (e * e, e * e * e)]).unwrap();
        assert!((k - 1.5).abs() < 1e-12, "{k}");
    }

    #[test]
    fn the_end_has_its_own_slope() {
        assert_eq!(slope_at_the_end(&[(4.0, 9.0), (1.0, 1.0), (2.0, 5.0)]), Some(2.0));
        assert_eq!(slope_at_the_end(&[(4.0, 9.0)]), None);
    }
}
