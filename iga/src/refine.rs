//! Knot insertion, degree elevation, subdivision: more control points for the same map.
//!
//! All of them keep the spline as a function of its parameters. What they need is one idea, the blossom (polar
//! form): the control point of a degree-`p` spline on the knots `t` is the blossom of the spline at
//! `(t_{i+1}, ..., t_{i+p})` (Ramshaw, *Blossoms are polar forms*, 1989), and [`bspline::blossom`] says which
//! combination of the present control points that is. Every combination is convex, so round-off does not grow.

use crate::bspline;
use crate::knots::{KnotError, Knots};
use crate::spline::Spline;

/// A finer basis of one parameter, and how its control points follow from the present ones.
struct Refinement {
    knots: Knots,
    rows: Vec<Row>,
}

/// One new control point: `sum_j coefficients[j] P_{first + j}`, the coefficients summing to one.
struct Row {
    first: usize,
    coefficients: Vec<f64>,
}

impl<const D: usize> Spline<D> {
    /// The same spline with one more knot `xi` in the given parameter (Boehm's knot insertion).
    ///
    /// # Errors
    /// As for [`insert_knots`](Self::insert_knots).
    ///
    /// # Panics
    /// When the spline has no such parameter.
    pub fn insert_knot(&self, parameter: usize, xi: f64) -> Result<Self, KnotError> {
        self.insert_knots(parameter, &[xi])
    }

    /// The same spline with more knots in the given parameter, listed in any order, repeated as often as wanted.
    ///
    /// ```text
    /// Q_i = sum_a N_a[t_{i+1}, ..., t_{i+p}] P_a          (Oslo algorithm)
    /// ```
    ///
    /// # Errors
    /// When a new knot is not inside the domain, or stands more than `degree` times with those already there.
    ///
    /// # Panics
    /// When the spline has no such parameter.
    ///
    /// ```
    /// use partita_iga::build;
    ///
    /// let arc = build::arc([0.0, 0.0], 1.0, 0.0, 1.2)?;
    /// let fine = arc.insert_knots(0, &[0.25, 0.5, 0.75])?;
    /// assert_eq!(fine.element_count(), 4);
    /// let ([x, y], [u, v]) = (arc.point(&[0.3]), fine.point(&[0.3]));
    /// assert!((x - u).abs() < 1e-15 && (y - v).abs() < 1e-15);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn insert_knots(&self, parameter: usize, new: &[f64]) -> Result<Self, KnotError> {
        Ok(self.refined(parameter, insertion(self.knots_of(parameter), new)?))
    }

    /// The same spline with each element cut into `parts` of equal length in the given parameter.
    ///
    /// # Errors
    /// When `parts` is zero, or so large that a part has no length.
    ///
    /// # Panics
    /// When the spline has no such parameter.
    pub fn subdivide(&self, parameter: usize, parts: usize) -> Result<Self, KnotError> {
        if parts == 0 {
            return Err(KnotError::NoElements);
        }
        let knots = self.knots_of(parameter);
        let cuts = (0..knots.element_count()).flat_map(|e| {
            let [start, end] = knots.element(e);
            (1..parts).map(move |i| start + (end - start) * i as f64 / parts as f64)
        });
        self.insert_knots(parameter, &cuts.collect::<Vec<_>>())
    }

    /// The same spline with its degree in the given parameter raised by `by`.
    ///
    /// Each knot is repeated `by` times more, so the spline is as smooth as before. One degree at a time,
    /// each blossom is averaged over the ways of leaving out one argument:
    ///
    /// ```text
    /// Q_i = 1/(p+1) sum_j sum_a N_a[t_{i+1}, ..., (not t_{i+j}), ..., t_{i+p+1}] P_a
    /// ```
    ///
    /// # Panics
    /// When the spline has no such parameter.
    #[must_use]
    pub fn elevate_degree(&self, parameter: usize, by: usize) -> Self {
        let mut spline = self.clone();
        for _ in 0..by {
            spline = spline.refined(parameter, elevation(spline.knots_of(parameter)));
        }
        spline
    }

    /// One element's part of the spline over a range inside that element, in Bezier form: the blossoms at
    /// `p - j` times the start and `j` times the end of the range.
    pub(crate) fn restricted(&self, parameter: usize, range: [f64; 2]) -> Self {
        self.refined(parameter, restriction(self.knots_of(parameter), range))
    }

    fn knots_of(&self, parameter: usize) -> &Knots {
        self.knots().get(parameter).unwrap_or_else(|| panic!("the spline has no parameter {parameter}"))
    }

    /// Applies a refinement to each line of control points along a parameter.
    fn refined(&self, parameter: usize, refinement: Refinement) -> Self {
        let Refinement { knots, rows } = refinement;
        let shape = self.shape();
        let (stride, count) = (shape[..parameter].iter().product::<usize>(), shape[parameter]);
        let blocks = self.control_points().len() / (stride * count);

        let mut points = Vec::with_capacity(blocks * rows.len() * stride);
        let mut weights = Vec::with_capacity(points.capacity());
        for block in 0..blocks {
            for row in &rows {
                for offset in 0..stride {
                    let line = |j: usize| (block * count + row.first + j) * stride + offset;
                    let (point, weight) = self.combined(&row.coefficients, line);
                    points.push(point);
                    weights.push(weight);
                }
            }
        }
        let mut all = self.knots().to_vec();
        all[parameter] = knots;
        Self::rational(all, points, weights).expect("a refinement has one row for each new basis function")
    }

    /// Combines control points `a = index(j)`: `W = sum c_j w_a`, `Q = sum (c_j w_a / W) P_a`.
    fn combined(&self, coefficients: &[f64], index: impl Fn(usize) -> usize) -> ([f64; D], f64) {
        let weighted = coefficients.iter().enumerate().map(|(j, c)| (c * self.weights()[index(j)], index(j)));
        let sum: f64 = weighted.clone().map(|(w, _)| w).sum();
        let mut point = [0.0; D];
        for (w, a) in weighted {
            for (x, p) in point.iter_mut().zip(self.control_points()[a]) {
                *x += w / sum * p;
            }
        }
        // Equal weights stay equal to the last bit: the spline remains polynomial.
        (point, if self.is_rational() { sum } else { self.weights()[0] })
    }
}

fn insertion(knots: &Knots, new: &[f64]) -> Result<Refinement, KnotError> {
    let degree = knots.degree();
    let [start, end] = knots.domain();
    if let Some(&value) = new.iter().find(|xi| !(start < **xi && **xi < end)) {
        return Err(KnotError::Outside { value, start, end });
    }
    let mut fine = [knots.values(), new].concat();
    fine.sort_by(f64::total_cmp);
    let fine = Knots::new(degree, fine)?;
    let rows = (0..fine.basis_count()).map(|i| {
        let span = knots.span_at(fine.values()[i]);
        let mut coefficients = vec![0.0; degree + 1];
        bspline::blossom(knots, span, &fine.values()[i + 1..=i + degree], &mut coefficients);
        Row { first: span - degree, coefficients }
    });
    Ok(Refinement { rows: rows.collect(), knots: fine })
}

fn restriction(knots: &Knots, [start, end]: [f64; 2]) -> Refinement {
    let degree = knots.degree();
    let span = knots.span_at(start);
    let ends = [vec![start; degree + 1], vec![end; degree + 1]].concat();
    let rows = (0..=degree).map(|j| {
        let mut coefficients = vec![0.0; degree + 1];
        bspline::blossom(knots, span, &ends[j + 1..=j + degree], &mut coefficients);
        Row { first: span - degree, coefficients }
    });
    Refinement { rows: rows.collect(), knots: Knots::new(degree, ends).expect("a range has a length") }
}

fn elevation(knots: &Knots) -> Refinement {
    let degree = knots.degree();
    let repeated = knots.breaks().flat_map(|(xi, multiplicity)| std::iter::repeat_n(xi, multiplicity + 1));
    let fine = Knots::new(degree + 1, repeated.collect()).expect("each multiplicity grows with the degree");
    let rows = (0..fine.basis_count()).map(|i| {
        let span = knots.span_at(fine.values()[i]);
        let arguments = &fine.values()[i + 1..=i + degree + 1];
        Row { first: span - degree, coefficients: mean_blossom(knots, span, arguments) }
    });
    Refinement { rows: rows.collect(), knots: fine }
}

/// Mean of the blossoms at all but one of the arguments.
fn mean_blossom(knots: &Knots, span: usize, arguments: &[f64]) -> Vec<f64> {
    let mut sum = vec![0.0; knots.degree() + 1];
    let mut one = sum.clone();
    for left_out in 0..arguments.len() {
        let remaining = [&arguments[..left_out], &arguments[left_out + 1..]].concat();
        bspline::blossom(knots, span, &remaining, &mut one);
        sum.iter_mut().zip(&one).for_each(|(sum, one)| *sum += one);
    }
    sum.iter().map(|sum| sum / arguments.len() as f64).collect()
}
