//! How an error falls as more is spent, and where it stops falling.

use super::Point;

/// What the points of a curve tell.
#[derive(Debug, Clone, PartialEq)]
pub struct Trend {
    /// The law that they follow before the floor; `None` where fewer than two are left or their error hardly changes.
    pub fit: Option<Fit>,
    /// Where the error stops falling.
    pub floor: Option<Floor>,
}

/// CPU seconds as a power of the error, by least squares of the logarithms: `log10(cpu) = a - b log10(error)`.
///
/// The error is what is chosen and the time what is paid, so the time is fitted to the error and not the reverse: along
/// a curve of tolerances the time hardly changes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fit {
    /// `a`: log10 of the seconds for an error of one.
    pub offset: f64,
    /// `b`: decades of time for a decade of error.
    pub decades_per_digit: f64,
    /// Points it rests on.
    pub points: usize,
    /// Largest and smallest error among these.
    pub errors: [f64; 2],
}

/// The end of a curve where more work no longer helps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Floor {
    /// First point on it.
    pub start: usize,
    /// Largest error on it.
    pub error: f64,
    /// Why the error stops.
    pub kind: FloorKind,
}

/// Why an error stops falling.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FloorKind {
    /// What is refined is no longer what the error comes from.
    OtherError,
    /// The reference is not known better than this.
    Reference,
}

/// Errors below this many uncertainties of the reference tell about the reference.
const BLURRED: f64 = 2.0;
/// A refinement that leaves more than this part of the error has not helped: half an order in h halves it to 0.71.
const NO_GAIN: f64 = 0.8;
/// Largest ratio of the errors on a floor.
const FLATNESS: f64 = 3.0;
/// Smallest ratio of errors from which a law is read.
const LEAST_SPAN: f64 = 2.0;

impl Trend {
    /// The trend of points from the coarsest to the finest, whose errors are told by a reference that is itself known to
    /// `uncertainty`.
    #[must_use]
    pub fn of(points: &[Point], uncertainty: f64) -> Self {
        let floor = floor(points, uncertainty);
        let falling = &points[..floor.map_or(points.len(), |floor| floor.start)];
        Self { fit: Fit::of(falling), floor }
    }
}

impl Fit {
    /// The fit through points, if their errors tell anything.
    fn of(points: &[Point]) -> Option<Self> {
        let usable: Vec<[f64; 2]> = points
            .iter()
            .filter(|point| point.error > 0.0 && point.cpu_seconds > 0.0)
            .map(|point| [point.error.log10(), point.cpu_seconds.log10()])
            .collect();
        let count = usable.len() as f64;
        let mean = |c: usize| usable.iter().map(|point| point[c]).sum::<f64>() / count;
        let [error, cpu] = [mean(0), mean(1)];
        let (mut covariance, mut variance) = (0.0, 0.0);
        let mut ends = [f64::NEG_INFINITY, f64::INFINITY];
        for point in &usable {
            covariance += (point[0] - error) * (point[1] - cpu);
            variance += (point[0] - error).powi(2);
            ends = [ends[0].max(point[0]), ends[1].min(point[0])];
        }
        if usable.len() < 2 || ends[0] - ends[1] < LEAST_SPAN.log10() {
            return None;
        }
        let decades_per_digit = -covariance / variance;
        Some(Self {
            offset: cpu + decades_per_digit * error,
            decades_per_digit,
            points: usable.len(),
            errors: ends.map(|end| 10_f64.powf(end)),
        })
    }

    /// Factor in time for a tenth of the error.
    #[must_use]
    pub fn digit_factor(&self) -> f64 {
        10_f64.powf(self.decades_per_digit)
    }

    /// Slope in the diagram: the exponent of the error as a power of the time, below zero where work helps.
    #[must_use]
    pub fn slope(&self) -> f64 {
        -1.0 / self.decades_per_digit
    }

    /// The time for an error \[s\].
    #[must_use]
    pub fn seconds(&self, error: f64) -> f64 {
        10_f64.powf(self.offset - self.decades_per_digit * error.log10())
    }

    /// Digits between the largest and the smallest error.
    #[must_use]
    pub fn digits(&self) -> f64 {
        (self.errors[0] / self.errors[1]).log10()
    }
}

fn floor(points: &[Point], uncertainty: f64) -> Option<Floor> {
    let largest = |start: usize| points[start..].iter().map(|point| point.error).fold(0.0, f64::max);
    let blurred =
        (0..points.len()).find(|&start| largest(start) <= BLURRED * uncertainty.max(f64::MIN_POSITIVE));
    let flat = (0..points.len().saturating_sub(1)).find(|&start| is_flat(&points[start..]));
    let (start, kind) = match (blurred, flat) {
        (Some(blurred), Some(flat)) if flat < blurred => (flat, FloorKind::OtherError),
        (Some(blurred), _) => (blurred, FloorKind::Reference),
        (None, Some(flat)) => (flat, FloorKind::OtherError),
        (None, None) => return None,
    };
    Some(Floor { start, error: largest(start), kind })
}

/// Whether nothing that follows is much better than the first, and all are alike.
fn is_flat(points: &[Point]) -> bool {
    let errors = || points.iter().map(|point| point.error);
    let (least, largest) = (errors().fold(f64::INFINITY, f64::min), errors().fold(0.0, f64::max));
    least >= NO_GAIN * points[0].error && largest <= FLATNESS * least
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(errors: &[f64], seconds: &[f64]) -> Vec<Point> {
        errors
            .iter()
            .zip(seconds)
            .map(|(&error, &cpu_seconds)| Point { name: String::new(), error, cpu_seconds })
            .collect()
    }

    fn trend(errors: &[f64]) -> Trend {
        let seconds: Vec<f64> = (0..errors.len()).map(|i| 2_f64.powf(i as f64)).collect();
        Trend::of(&points(errors, &seconds), 0.0)
    }

    /// Error h^2 at a cost h^-3: a digit costs 10^(3/2).
    #[test]
    fn a_power_law_is_found_again() {
        let h = [1.0_f64, 0.5, 0.25, 0.125];
        let law = points(&h.map(|h| 0.3 * h * h), &h.map(|h| 0.02 * h.powi(-3)));
        let Trend { fit: Some(fit), floor: None } = Trend::of(&law, 0.0) else { panic!("no law") };
        assert!((fit.decades_per_digit - 1.5).abs() < 1e-12, "{fit:?}");
        assert!((fit.slope() + 2.0 / 3.0).abs() < 1e-12, "{fit:?}");
        assert!((fit.digit_factor() - 10_f64.powf(1.5)).abs() < 1e-9, "{fit:?}");
        assert!((fit.seconds(0.3) - 0.02).abs() < 1e-12, "{fit:?}");
        assert!((fit.digits() - 6.0 * 2_f64.log10()).abs() < 1e-12, "{fit:?}");
        assert_eq!(fit.points, 4);
    }

    #[test]
    fn a_floor_is_not_fitted() {
        let with_floor = trend(&[1e-1, 1e-2, 1e-3, 2e-5, 1.9e-5, 2.2e-5]);
        assert_eq!(with_floor.fit, trend(&[1e-1, 1e-2, 1e-3]).fit);
        assert_eq!(with_floor.floor, Some(Floor { start: 3, error: 2.2e-5, kind: FloorKind::OtherError }));
    }

    #[test]
    fn slow_and_uneven_convergence_is_no_floor() {
        for errors in [&[1.0, 0.71, 0.5, 0.35][..], &[1.0, 1.2, 0.3, 0.02], &[1e-2, 1e-3, 1e-6, 1e-4]] {
            assert_eq!(trend(errors).floor, None, "{errors:?}");
        }
    }

    #[test]
    fn an_error_that_never_falls_has_no_law() {
        let Trend { fit, floor } = trend(&[0.1, 0.11, 0.1]);
        assert_eq!((fit, floor.map(|floor| floor.start)), (None, Some(0)));
    }

    #[test]
    fn what_the_reference_cannot_tell_is_left_out() {
        let law = points(&[0.4, 0.1, 0.025, 0.006], &[1.0, 4.0, 16.0, 64.0]);
        let Trend { fit, floor } = Trend::of(&law, 0.004);
        assert_eq!(floor, Some(Floor { start: 3, error: 0.006, kind: FloorKind::Reference }));
        assert_eq!(fit.map(|fit| fit.points), Some(3));
    }

    #[test]
    fn an_exact_result_is_a_floor_and_one_point_no_law() {
        let Trend { fit, floor } = trend(&[0.1, 0.0]);
        assert_eq!((fit, floor.map(|floor| floor.start)), (None, Some(1)));
        assert_eq!(Trend::of(&[], 0.0), Trend { fit: None, floor: None });
    }
}
