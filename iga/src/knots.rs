//! Validated knot vectors.

#![allow(
    clippy::float_cmp,
    reason = "equal knots are one knot with a multiplicity, near ones are an element"
)]

use std::ops::Range;

use crate::side::End;

/// Least length of an element as a share of the knots' range, for [`Knots::on_unit_interval`].
const SHORTEST_ELEMENT: f64 = 1e-10;

/// An open (clamped) knot vector together with its degree.
///
/// The first and the last knot stand `degree + 1` times, so that the spline starts and ends in a control point;
/// an inner knot of multiplicity `m <= degree` leaves the basis functions `degree - m` times continuously
/// differentiable there. A vector that is anything else is refused, never repaired.
///
/// ```
/// use partita_iga::{KnotError, Knots};
///
/// let knots = Knots::new(2, vec![0.0, 0.0, 0.0, 0.5, 1.0, 1.0, 1.0])?;
/// assert_eq!(knots.basis_count(), 4);
/// assert_eq!(knots.element_count(), 2);
/// assert_eq!(knots.greville(), [0.0, 0.25, 0.75, 1.0]);
///
/// let unsorted = Knots::new(1, vec![0.0, 0.0, 0.7, 0.3, 1.0, 1.0]);
/// assert!(matches!(unsorted, Err(KnotError::Decreasing { index: 3, .. })));
/// # Ok::<(), KnotError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Knots {
    degree: usize,
    values: Vec<f64>,
    /// Index of the left knot of each nonempty span.
    spans: Vec<usize>,
}

impl Knots {
    /// Checks a knot vector `values` for basis functions of `degree`.
    ///
    /// # Errors
    /// When the degree is zero, there are too few knots, a knot is not finite or smaller than the one before, the
    /// knots span a range that overflows, an end does not stand exactly `degree + 1` times, or an inner knot more than
    /// `degree` times.
    pub fn new(degree: usize, values: Vec<f64>) -> Result<Self, KnotError> {
        check_order(degree, &values)?;
        check_multiplicities(degree, &values)?;
        let spans = (degree..values.len() - degree - 1).filter(|&i| values[i] < values[i + 1]).collect();
        Ok(Self { degree, values, spans })
    }

    /// Knots for `elements` elements of equal length on [0, 1].
    ///
    /// # Errors
    /// When the degree or the number of elements is zero.
    pub fn uniform(degree: usize, elements: usize) -> Result<Self, KnotError> {
        if elements == 0 {
            return Err(KnotError::NoElements);
        }
        let inner = (1..elements).map(|i| i as f64 / elements as f64);
        let start = std::iter::repeat_n(0.0, degree + 1);
        let end = std::iter::repeat_n(1.0, degree + 1);
        Self::new(degree, start.chain(inner).chain(end).collect())
    }

    /// The same knots with their range mapped to [0, 1]: `xi -> (xi - first) / (last - first)`.
    ///
    /// The ends become 0 and 1 to the last bit, and knots from 0 to 1 stay as they are.
    ///
    /// # Errors
    /// When two different knots are closer than 1e-10 of the range: an element between them is lost in round-off.
    ///
    /// ```
    /// use partita_iga::Knots;
    ///
    /// let knots = Knots::new(1, vec![5.0, 5.0, 5.5, 7.0, 7.0])?;
    /// assert_eq!(knots.on_unit_interval()?.values(), [0.0, 0.0, 0.25, 1.0, 1.0]);
    /// # Ok::<(), partita_iga::KnotError>(())
    /// ```
    pub fn on_unit_interval(&self) -> Result<Self, KnotError> {
        let [first, last] = self.domain();
        // An end divided by itself is 1, and differences of neighbours are exact: order and ends survive.
        let mapped: Vec<f64> = self.values.iter().map(|knot| (knot - first) / (last - first)).collect();
        let close = |&span: &usize| mapped[span + 1] - mapped[span] < SHORTEST_ELEMENT;
        if let Some(&span) = self.spans.iter().find(|span| close(span)) {
            let [left, right] = [self.values[span], self.values[span + 1]];
            return Err(KnotError::TooClose { index: span, left, right, range: last - first });
        }
        Self::new(self.degree, mapped)
    }

    /// Degree of the basis functions.
    #[must_use]
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// All knots, repeated as often as their multiplicity.
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Number of basis functions.
    #[must_use]
    pub fn basis_count(&self) -> usize {
        self.values.len() - self.degree - 1
    }

    /// First and last knot.
    #[must_use]
    pub fn domain(&self) -> [f64; 2] {
        [self.values[0], self.values[self.values.len() - 1]]
    }

    /// First or last knot.
    #[must_use]
    pub fn end(&self, end: End) -> f64 {
        let [first, last] = self.domain();
        match end {
            End::Start => first,
            End::End => last,
        }
    }

    /// Number of elements: spans between different knots.
    #[must_use]
    pub fn element_count(&self) -> usize {
        self.spans.len()
    }

    /// Parameter range of an element.
    ///
    /// # Panics
    /// When there is no such element.
    #[must_use]
    pub fn element(&self, element: usize) -> [f64; 2] {
        let span = self.spans[element];
        [self.values[span], self.values[span + 1]]
    }

    /// Element that contains `xi`; at an inner knot the one to its right, at the last knot the last one.
    ///
    /// # Panics
    /// When `xi` lies outside the domain.
    #[must_use]
    pub fn element_at(&self, xi: f64) -> usize {
        let span = self.span_at(xi);
        self.spans.partition_point(|&s| s < span)
    }

    /// Span `i` of an element: it lies between `values()[i]` and `values()[i + 1]`, and the basis functions
    /// `i - degree ..= i` are the ones that do not vanish on it.
    ///
    /// # Panics
    /// When there is no such element.
    #[must_use]
    pub fn span(&self, element: usize) -> usize {
        self.spans[element]
    }

    /// Span that contains `xi`: Algorithm A2.1 of Piegl and Tiller, *The NURBS Book*.
    ///
    /// # Panics
    /// When `xi` lies outside the domain.
    #[must_use]
    pub fn span_at(&self, xi: f64) -> usize {
        let [first, last] = self.domain();
        assert!(first <= xi && xi <= last, "the parameter {xi} lies outside the knots [{first}, {last}]");
        // The last knot belongs to the last span: beyond it there is none.
        self.values.partition_point(|&knot| knot <= xi).min(self.basis_count()) - 1
    }

    /// Basis functions that do not vanish on an element.
    ///
    /// # Panics
    /// When there is no such element.
    #[must_use]
    pub fn active(&self, element: usize) -> Range<usize> {
        let span = self.spans[element];
        span - self.degree..span + 1
    }

    /// How often the knot `xi` stands in the vector; zero where there is no knot.
    #[must_use]
    pub fn multiplicity(&self, xi: f64) -> usize {
        let below = self.values.partition_point(|&knot| knot < xi);
        let up_to = self.values.partition_point(|&knot| knot <= xi);
        up_to - below
    }

    /// Different knots with their multiplicities, in ascending order.
    pub fn breaks(&self) -> impl Iterator<Item = (f64, usize)> + '_ {
        self.values.chunk_by(|a, b| a == b).map(|equal| (equal[0], equal.len()))
    }

    /// Greville abscissae `g_a = (xi_{a+1} + ... + xi_{a+degree}) / degree`, one for each basis function.
    ///
    /// Control points placed by them reproduce the coordinates: `sum_a N_a(xi) g_a = xi`.
    #[must_use]
    pub fn greville(&self) -> Vec<f64> {
        let mean = |knots: &[f64]| match (knots[0], knots[knots.len() - 1]) {
            (first, last) if first == last => first,
            _ => knots.iter().sum::<f64>() / knots.len() as f64,
        };
        (0..self.basis_count()).map(|a| mean(&self.values[a + 1..=a + self.degree])).collect()
    }
}

fn check_order(degree: usize, values: &[f64]) -> Result<(), KnotError> {
    if degree == 0 {
        return Err(KnotError::DegreeZero);
    }
    let needed = 2 * (degree + 1);
    if values.len() < needed {
        return Err(KnotError::TooFew { found: values.len(), needed, degree });
    }
    if let Some(index) = values.iter().position(|value| !value.is_finite()) {
        return Err(KnotError::NotFinite { index, value: values[index] });
    }
    if let Some(index) = (1..values.len()).find(|&i| values[i] < values[i - 1]) {
        return Err(KnotError::Decreasing { index, previous: values[index - 1], value: values[index] });
    }
    let [start, end] = [values[0], values[values.len() - 1]];
    if !(end - start).is_finite() {
        return Err(KnotError::Overflow { start, end });
    }
    Ok(())
}

fn check_multiplicities(degree: usize, values: &[f64]) -> Result<(), KnotError> {
    let groups: Vec<&[f64]> = values.chunk_by(|a, b| a == b).collect();
    let needed = degree + 1;
    let ends = [(End::Start, groups[0].len()), (End::End, groups[groups.len() - 1].len())];
    if let Some(&(end, found)) = ends.iter().find(|(_, found)| *found != needed) {
        return Err(KnotError::NotClamped { end, found, needed });
    }
    let inner = &groups[1..groups.len() - 1];
    match inner.iter().find(|group| group.len() > degree) {
        Some(group) => Err(KnotError::Multiplicity { value: group[0], found: group.len(), degree }),
        None => Ok(()),
    }
}

/// What is wrong with a knot vector.
#[derive(Clone, Debug, PartialEq, thiserror::Error, miette::Diagnostic)]
pub enum KnotError {
    /// Basis functions of degree zero do not join.
    #[error("a spline of degree 0 falls apart at its knots")]
    #[diagnostic(help("take a degree of at least 1"))]
    DegreeZero,
    /// A uniform knot vector without elements was asked for.
    #[error("a knot vector needs at least one element")]
    #[diagnostic(help("take 1 or more elements for each parameter"))]
    NoElements,
    /// Fewer knots than both ends need.
    #[error("{found} knots are too few for degree {degree}")]
    #[diagnostic(help(
        "degree {degree} needs at least {needed} knots, \
         half of them at either end"
    ))]
    TooFew {
        /// Number of knots given.
        found: usize,
        /// Least number of knots.
        needed: usize,
        /// Degree of the basis functions.
        degree: usize,
    },
    /// A knot is infinite or not a number.
    #[error("knot {index} is {value}")]
    #[diagnostic(help("knots are finite numbers"))]
    NotFinite {
        /// Its index in the vector.
        index: usize,
        /// The value found there.
        value: f64,
    },
    /// A knot is smaller than its predecessor.
    #[error("knot {index} is {value}, smaller than {previous} before it")]
    #[diagnostic(help("list the knots in ascending order"))]
    Decreasing {
        /// Its index in the vector.
        index: usize,
        /// The knot before it.
        previous: f64,
        /// The value found there.
        value: f64,
    },
    /// The range of the knots is larger than any number.
    #[error("the knots run from {start:e} to {end:e}, a range that overflows")]
    #[diagnostic(help("divide all knots by the same number; only their ratios matter"))]
    Overflow {
        /// First knot.
        start: f64,
        /// Last knot.
        end: f64,
    },
    /// Two different knots with next to nothing between them.
    #[error("the knots {index} and {} differ by {:.1e} of the range, too little for an element between them", index + 1, (right - left) / range)]
    #[diagnostic(help("they are {left} and {right}: make them equal, or move them apart"))]
    TooClose {
        /// Index of the first of them.
        index: usize,
        /// Its value.
        left: f64,
        /// The value of the next.
        right: f64,
        /// Last knot less first knot.
        range: f64,
    },
    /// A knot to be inserted does not lie inside the domain.
    #[error("no knot can be inserted at {value}")]
    #[diagnostic(help("choose a place inside ({start}, {end})"))]
    Outside {
        /// The knot asked for.
        value: f64,
        /// First knot.
        start: f64,
        /// Last knot.
        end: f64,
    },
    /// An end of the vector does not stand `degree + 1` times.
    #[error("the knot at the {} stands {found} times", match end { End::Start => "start", End::End => "end" })]
    #[diagnostic(help(
        "repeat it {needed} times (degree + 1), so that the spline \
         begins and ends in a control point"
    ))]
    NotClamped {
        /// Which end.
        end: End,
        /// How often its knot stands there.
        found: usize,
        /// How often it should.
        needed: usize,
    },
    /// An inner knot stands so often that the spline would tear.
    #[error(
        "the inner knot {value} stands {found} times in a vector of degree {degree}, which tears the spline"
    )]
    #[diagnostic(help("an inner knot may stand at most {degree} times"))]
    Multiplicity {
        /// The knot.
        value: f64,
        /// How often it stands.
        found: usize,
        /// Degree of the basis functions.
        degree: usize,
    },
}

#[cfg(test)]
mod tests {
    use super::*;

    fn quadratic() -> Knots {
        Knots::new(2, vec![0.0, 0.0, 0.0, 0.2, 0.6, 0.6, 1.0, 1.0, 1.0]).unwrap()
    }

    #[test]
    fn elements_are_the_nonempty_spans() {
        let knots = quadratic();
        assert_eq!(knots.element_count(), 3);
        let elements: Vec<_> = (0..3).map(|e| knots.element(e)).collect();
        assert_eq!(elements, [[0.0, 0.2], [0.2, 0.6], [0.6, 1.0]]);
        assert_eq!(knots.active(2), 3..6);
    }

    #[test]
    fn a_knot_belongs_to_the_span_on_its_right_and_the_last_to_the_last() {
        let knots = quadratic();
        assert_eq!([0.0, 0.1, 0.2, 0.6, 1.0].map(|xi| knots.span_at(xi)), [2, 2, 3, 5, 5]);
        assert_eq!([0.0, 0.1, 0.2, 0.6, 1.0].map(|xi| knots.element_at(xi)), [0, 0, 1, 2, 2]);
    }

    #[test]
    fn multiplicities_are_counted() {
        let knots = quadratic();
        assert_eq!(knots.breaks().collect::<Vec<_>>(), [(0.0, 3), (0.2, 1), (0.6, 2), (1.0, 3)]);
        assert_eq!([0.2, 0.3, 0.6].map(|xi| knots.multiplicity(xi)), [1, 0, 2]);
    }

    #[test]
    fn greville_abscissae_at_full_multiplicity_are_the_knot_itself() {
        let third = 1.0 / 3.0;
        let knots = Knots::new(3, [[0.1; 4].as_slice(), &[third; 3], &[0.7; 4]].concat()).unwrap();
        let greville = knots.greville();
        assert_eq!((greville[0], greville[3], greville[6]), (0.1, third, 0.7));
    }

    #[test]
    fn any_range_is_mapped_to_the_unit_interval_with_exact_ends() {
        for (start, length) in [
            (5.0, 2.0),
            (-3.0, 1e-12),
            (0.0, 1e-300),
            (0.0, 5e-324),
            (1e16, 2.0),
            (-1e308, 1e308),
            (-8e307, 1.6e308),
        ] {
            let knots = Knots::new(2, [[start; 3], [start + length; 3]].concat()).unwrap();
            let mapped = knots.on_unit_interval().unwrap();
            assert_eq!(mapped.values(), [0.0, 0.0, 0.0, 1.0, 1.0, 1.0], "{start} {length}");
        }
        let inner = Knots::new(1, [-2e-300, -2e-300, 0.0, 6e-300, 6e-300].to_vec()).unwrap();
        assert_eq!(inner.on_unit_interval().unwrap().values(), [0.0, 0.0, 0.25, 1.0, 1.0]);
        assert_eq!(quadratic().on_unit_interval(), Ok(quadratic()));
    }

    #[test]
    fn knots_that_floating_point_cannot_tell_apart_are_refused() {
        let sum = 0.1 + 0.2;
        let slip = Knots::new(1, vec![0.0, 0.0, 0.3, sum, 1.0, 1.0]).unwrap();
        assert!(matches!(slip.on_unit_interval(), Err(KnotError::TooClose { index: 2, .. })));
        // Beside a huge range, two knots become one.
        let hidden = Knots::new(1, vec![0.0, 0.0, 1e-300, 1e300, 1e300]).unwrap();
        assert!(matches!(hidden.on_unit_interval(), Err(KnotError::TooClose { index: 1, .. })));
        let wide = Knots::new(1, vec![-1.7e308, -1.7e308, 1.7e308, 1.7e308]);
        assert!(matches!(wide, Err(KnotError::Overflow { .. })));
    }

    #[test]
    #[should_panic(expected = "outside the knots [0, 1]")]
    fn a_parameter_outside_the_domain_is_refused() {
        let _ = quadratic().span_at(1.0 + 1e-9);
    }

    #[test]
    #[should_panic(expected = "outside the knots")]
    fn a_parameter_that_is_not_a_number_is_refused() {
        let _ = quadratic().span_at(f64::NAN);
    }

    #[test]
    fn malformed_vectors_are_refused_with_the_place() {
        let error = |degree, values: &[f64]| Knots::new(degree, values.to_vec()).unwrap_err();
        assert_eq!(error(0, &[0.0, 1.0]), KnotError::DegreeZero);
        assert_eq!(error(2, &[0.0, 1.0]), KnotError::TooFew { found: 2, needed: 6, degree: 2 });
        assert!(matches!(error(1, &[0.0, 0.0, f64::NAN, 1.0, 1.0]), KnotError::NotFinite { index: 2, .. }));
        assert!(matches!(error(1, &[0.0, 0.0, 0.5, 0.4, 1.0, 1.0]), KnotError::Decreasing { index: 3, .. }));
        assert_eq!(
            error(2, &[0.0, 0.0, 0.0, 0.5, 1.0, 1.0]),
            KnotError::NotClamped { end: End::End, found: 2, needed: 3 }
        );
        assert_eq!(error(1, &[0.0; 4]), KnotError::NotClamped { end: End::Start, found: 4, needed: 2 });
        assert_eq!(
            error(1, &[0.0, 0.0, 0.5, 0.5, 1.0, 1.0]),
            KnotError::Multiplicity { value: 0.5, found: 2, degree: 1 }
        );
        assert_eq!(Knots::uniform(2, 0), Err(KnotError::NoElements));
    }
}
