//! Elements: the boxes of the parameter space between the knots.

use crate::spline::{MAX_PARAMETERS, Spline};

/// A box of the parameter space on which every basis function is smooth.
///
/// Elements are numbered like control points: along the first parameter first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Element {
    index: usize,
    parameters: usize,
    ranges: [[f64; 2]; MAX_PARAMETERS],
}

impl Element {
    /// Its number.
    #[must_use]
    pub fn index(&self) -> usize {
        self.index
    }

    /// Range of each parameter.
    #[must_use]
    pub fn ranges(&self) -> &[[f64; 2]] {
        &self.ranges[..self.parameters]
    }

    /// Size in the parameter space: the Jacobian of [`at`](Self::at).
    #[must_use]
    pub fn measure(&self) -> f64 {
        self.ranges().iter().map(|[start, end]| end - start).product()
    }

    /// Parameters at a point of the unit cube, `xi_i = start_i + unit_i (end_i - start_i)`.
    ///
    /// # Panics
    /// When `P` is not the number of parameters.
    #[must_use]
    pub fn at<const P: usize>(&self, unit: [f64; P]) -> [f64; P] {
        assert_eq!(P, self.parameters, "a point of an element has one coordinate for each parameter");
        std::array::from_fn(|i| {
            let [start, end] = self.ranges[i];
            // Exact at both ends, unlike start + unit (end - start).
            let xi = (1.0 - unit[i]) * start + unit[i] * end;
            // Far from zero the sum may round to a number outside of a short element.
            if (0.0..=1.0).contains(&unit[i]) { xi.clamp(start, end) } else { xi }
        })
    }
}

impl<const D: usize> Spline<D> {
    /// Number of elements.
    #[must_use]
    pub fn element_count(&self) -> usize {
        self.knots().iter().map(crate::Knots::element_count).product()
    }

    /// The elements in order.
    #[must_use]
    pub fn elements(&self) -> impl ExactSizeIterator<Item = Element> + '_ {
        (0..self.element_count()).map(|index| self.element(index))
    }

    /// One element.
    ///
    /// # Panics
    /// When there is no such element.
    #[must_use]
    pub fn element(&self, index: usize) -> Element {
        let position = self.element_position(index);
        let mut ranges = [[0.0; 2]; MAX_PARAMETERS];
        for (i, knots) in self.knots().iter().enumerate() {
            ranges[i] = knots.element(position[i]);
        }
        Element { index, parameters: self.parameters(), ranges }
    }

    /// Number of control points that act on an element.
    #[must_use]
    pub fn active_count(&self) -> usize {
        self.knots().iter().map(|knots| knots.degree() + 1).product()
    }

    /// Control points that act on an element, along the first parameter first.
    ///
    /// # Panics
    /// When there is no such element.
    #[must_use]
    pub fn active_on(&self, element: usize) -> Vec<usize> {
        let mut active = vec![0; self.active_count()];
        self.fill_active(self.element_spans(element), &mut active);
        active
    }

    /// Control points that act at the parameters `xi`.
    ///
    /// # Panics
    /// When `xi` lies outside the domain.
    #[must_use]
    pub fn active(&self, xi: &[f64]) -> Vec<usize> {
        let mut active = vec![0; self.active_count()];
        self.fill_active(self.spans_at(xi), &mut active);
        active
    }

    pub(crate) fn element_spans(&self, index: usize) -> [usize; MAX_PARAMETERS] {
        let position = self.element_position(index);
        let mut spans = [0; MAX_PARAMETERS];
        for (i, knots) in self.knots().iter().enumerate() {
            spans[i] = knots.span(position[i]);
        }
        spans
    }

    pub(crate) fn spans_at(&self, xi: &[f64]) -> [usize; MAX_PARAMETERS] {
        assert_eq!(xi.len(), self.parameters(), "one number for each parameter");
        let mut spans = [0; MAX_PARAMETERS];
        for (i, knots) in self.knots().iter().enumerate() {
            spans[i] = knots.span_at(xi[i]);
        }
        spans
    }

    pub(crate) fn fill_active(&self, spans: [usize; MAX_PARAMETERS], active: &mut [usize]) {
        let shape = self.shape();
        let degree = self.degrees();
        let mut next = active.iter_mut();
        for c in spans[2] - degree[2]..=spans[2] {
            for b in spans[1] - degree[1]..=spans[1] {
                for a in spans[0] - degree[0]..=spans[0] {
                    *next.next().expect("room for every active control point") =
                        (c * shape[1] + b) * shape[0] + a;
                }
            }
        }
    }

    /// Number of the element along each parameter.
    fn element_position(&self, index: usize) -> [usize; MAX_PARAMETERS] {
        let count = self.element_count();
        assert!(index < count, "there is no element {index}: the spline has {count}");
        let mut position = [0; MAX_PARAMETERS];
        let mut rest = index;
        for (i, knots) in self.knots().iter().enumerate() {
            position[i] = rest % knots.element_count();
            rest /= knots.element_count();
        }
        position
    }
}
