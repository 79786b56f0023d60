//! Arbitrary splines, and a second, slow way to evaluate them.

use partita_iga::{Knots, Spline};
use proptest::prelude::*;

/// Knots of degree 1 to 3 with up to three inner knots of any admissible multiplicity, on a domain off the origin.
pub(crate) fn knots() -> impl Strategy<Value = Knots> {
    let inner = |degree| prop::collection::vec((0.1..1.0, 1..=degree), 0..=3);
    (1_usize..=3).prop_flat_map(move |degree| (Just(degree), -1.0..1.0, inner(degree), 0.1..1.0)).prop_map(
        |(degree, start, inner, last)| {
            let mut values = vec![start; degree + 1];
            let mut xi = start;
            for (gap, multiplicity) in inner {
                xi += gap;
                values.extend(std::iter::repeat_n(xi, multiplicity));
            }
            values.extend(std::iter::repeat_n(xi + last, degree + 1));
            Knots::new(degree, values).unwrap()
        },
    )
}

/// NURBS of `parameters` parameters with control points in the cube [-1, 1]^D and weights that differ.
pub(crate) fn splines<const D: usize>(parameters: usize) -> impl Strategy<Value = Spline<D>> {
    prop::collection::vec(knots(), parameters).prop_flat_map(|knots| {
        let count = knots.iter().map(Knots::basis_count).product::<usize>();
        let points = prop::collection::vec(prop::array::uniform::<_, D>(-1.0..1.0), count);
        let weights = prop::collection::vec(0.3..3.0, count);
        (Just(knots), points, weights)
            .prop_map(|(knots, points, weights)| Spline::rational(knots, points, weights).unwrap())
    })
}

/// A spline and a point of its parameter space.
pub(crate) fn splines_with_parameters<const D: usize>(
    parameters: usize,
) -> impl Strategy<Value = (Spline<D>, Vec<f64>)> {
    let shares = prop::collection::vec(0.0..=1.0, parameters);
    (splines(parameters), shares).prop_map(|(spline, shares)| {
        let xi = parameters_at(&spline, &shares);
        (spline, xi)
    })
}

/// Parameters at shares (0 to 1) of the domain.
pub(crate) fn parameters_at<const D: usize>(spline: &Spline<D>, shares: &[f64]) -> Vec<f64> {
    let domains = spline.knots().iter().map(Knots::domain);
    domains.zip(shares).map(|([start, end], share)| (1.0 - share) * start + share * end).collect()
}

/// Basis function `a` by the definition: Cox-de Boor as a recursion, with 0/0 = 0.
pub(crate) fn naive(knots: &Knots, a: usize, xi: f64) -> f64 {
    naive_of_degree(knots.values(), a, knots.degree(), xi, knots.domain()[1])
}

fn naive_of_degree(knots: &[f64], a: usize, degree: usize, xi: f64, last: f64) -> f64 {
    let share =
        |numerator: f64, denominator: f64| if denominator > 0.0 { numerator / denominator } else { 0.0 };
    if degree == 0 {
        let in_last_span = xi >= last && knots[a + 1] >= last && knots[a] < last;
        return f64::from(u8::from(knots[a] <= xi && xi < knots[a + 1] || in_last_span));
    }
    share(xi - knots[a], knots[a + degree] - knots[a]) * naive_of_degree(knots, a, degree - 1, xi, last)
        + share(knots[a + degree + 1] - xi, knots[a + degree + 1] - knots[a + 1])
            * naive_of_degree(knots, a + 1, degree - 1, xi, last)
}

pub(crate) fn distance<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
}

/// A generator of numbers in [-1, 1] that are arbitrary but always the same.
pub(crate) fn noise(seed: u64) -> impl FnMut() -> f64 {
    let mut noise = partita_testing::Noise::new(seed);
    move || noise.number()
}
