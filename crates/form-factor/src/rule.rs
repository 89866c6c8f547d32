//! Which estimator serves which distance from a point to a triangle.

/// Distances, in longest edges of the shooter, beyond which a kernel rule is good enough.
///
/// From the estimators' measured 95th-percentile errors over random pairs; the receiver is
/// a point, so only the shooter's size counts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rule {
    /// Beyond this, one kernel value at the centroid.
    pub one_point: f64,
    /// Beyond this, the mean of three kernel values; nearer, the exact polygon form.
    pub three_points: f64,
}

impl Rule {
    /// The rule for a relative error of one form factor, rounded down to 1e-1, 1e-2, 1e-3;
    /// below 1e-3 the exact polygon form serves all distances.
    #[must_use]
    pub fn for_tolerance(tolerance: f64) -> Self {
        match tolerance {
            t if t >= 1e-1 => Self { one_point: 3.0, three_points: 0.9 },
            t if t >= 1e-2 => Self { one_point: 10.0, three_points: 2.0 },
            t if t >= 1e-3 => Self { one_point: 35.0, three_points: 4.0 },
            _ => Self { one_point: f64::INFINITY, three_points: f64::INFINITY },
        }
    }
}
