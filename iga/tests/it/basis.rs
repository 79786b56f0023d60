//! Basis functions, univariate and tensor products.

use partita_iga::{BasisValues, Derivatives, Knots, Spline, bspline};
use proptest::prelude::*;

use crate::support::{knots, naive, parameters_at, splines, splines_with_parameters};

fn table(knots: &Knots, span: usize, xi: f64, order: usize) -> Vec<Vec<f64>> {
    let width = knots.degree() + 1;
    let mut table = vec![f64::NAN; (order + 1) * width];
    bspline::derivatives(knots, span, xi, order, &mut table);
    table.chunks(width).map(<[f64]>::to_vec).collect()
}

fn close(a: f64, b: f64, tolerance: f64) -> bool {
    (a - b).abs() <= tolerance * (1.0 + a.abs().max(b.abs()))
}

#[test]
fn functions_on_one_element_are_bernstein_polynomials() {
    let knots = Knots::uniform(3, 1).unwrap();
    for t in [0.0, 0.125, 0.5, 0.8, 1.0] {
        let s = 1.0 - t;
        let exact = [
            [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t],
            [-3.0 * s * s, 3.0 * s * (s - 2.0 * t), 3.0 * t * (2.0 * s - t), 3.0 * t * t],
            [6.0 * s, 6.0 * (t - 2.0 * s), 6.0 * (s - 2.0 * t), 6.0 * t],
            [-6.0, 18.0, -18.0, 6.0],
            [0.0; 4],
        ];
        for (row, exact) in table(&knots, 3, t, 4).iter().zip(exact) {
            for (value, exact) in row.iter().zip(exact) {
                assert!((value - exact).abs() < 1e-14, "{value} is not {exact} at {t}");
            }
        }
    }
}

#[test]
fn at_clamped_ends_one_function_is_exactly_one_and_the_others_exactly_zero() {
    let third = 1.0 / 3.0;
    let values = [vec![0.1; 4], vec![third, 0.49, 0.49], vec![0.7; 4]].concat();
    let knots = Knots::new(3, values).unwrap();
    assert_eq!(table(&knots, knots.span_at(0.1), 0.1, 0)[0], [1.0, 0.0, 0.0, 0.0]);
    assert_eq!(table(&knots, knots.span_at(0.7), 0.7, 0)[0], [0.0, 0.0, 0.0, 1.0]);
}

proptest! {
    #[test]
    fn functions_agree_with_their_definition_and_vanish_outside_their_support(knots in knots(), share in 0.0..=1.0) {
        let [start, end] = knots.domain();
        let xi = (1.0 - share) * start + share * end;
        let span = knots.span_at(xi);
        let values = table(&knots, span, xi, 0).remove(0);
        for a in 0..knots.basis_count() {
            let value = if (span - knots.degree()..=span).contains(&a) { values[a + knots.degree() - span] } else { 0.0 };
            prop_assert!((value - naive(&knots, a, xi)).abs() < 1e-14, "function {a} at {xi}");
        }
    }

    #[test]
    fn functions_are_a_partition_of_unity_and_not_negative(knots in knots(), share in 0.0..=1.0) {
        let [start, end] = knots.domain();
        let xi = (1.0 - share) * start + share * end;
        let table = table(&knots, knots.span_at(xi), xi, 2);
        prop_assert!((table[0].iter().sum::<f64>() - 1.0).abs() < 1e-14);
        prop_assert!(table[0].iter().all(|value| *value >= 0.0));
        for derivatives in &table[1..] {
            let size: f64 = derivatives.iter().map(|value| value.abs()).sum();
            prop_assert!(derivatives.iter().sum::<f64>().abs() <= 1e-14 * size);
        }
    }

    #[test]
    fn each_derivative_is_the_difference_quotient_of_the_one_before(knots in knots(), share in 0.1..0.9, e in 0_usize..4) {
        let element = e % knots.element_count();
        let [start, end] = knots.element(element);
        let (xi, h) = (start + share * (end - start), 1e-4 * (end - start));
        let span = knots.span(element);
        let [below, here, above] = [xi - h, xi, xi + h].map(|xi| table(&knots, span, xi, 3));
        for k in 1..=3 {
            for j in 0..=knots.degree() {
                let quotient = (above[k - 1][j] - below[k - 1][j]) / (2.0 * h);
                // Central differences of cubics miss by h^2 / 6 times the third derivative.
                prop_assert!(close(here[k][j], quotient, 1e-5), "derivative {k}: {} {quotient}", here[k][j]);
            }
        }
    }

    /// With multiplicity m, derivatives up to degree - m are continuous and the next one is not.
    #[test]
    fn smoothness_across_a_knot_is_degree_minus_multiplicity(knots in knots()) {
        let degree = knots.degree();
        for element in 1..knots.element_count() {
            let (left, right) = (knots.span(element - 1), knots.span(element));
            let xi = knots.element(element)[0];
            let jump = |k: usize| {
                let (before, after) = (table(&knots, left, xi, k).remove(k), table(&knots, right, xi, k).remove(k));
                let at = |row: &[f64], span: usize, a: usize| (a + degree).checked_sub(span).and_then(|j| row.get(j).copied());
                let size: f64 = before.iter().chain(&after).map(|value| value.abs()).sum();
                let jumps = (0..knots.basis_count())
                    .map(|a| (at(&before, left, a).unwrap_or(0.0) - at(&after, right, a).unwrap_or(0.0)).abs());
                jumps.fold(0.0, f64::max) / size
            };
            let smoothness = degree - knots.multiplicity(xi);
            prop_assert!((0..=smoothness).all(|k| jump(k) < 1e-13), "{knots:?} at {xi}");
            prop_assert!(jump(smoothness + 1) > 1e-3, "{knots:?} at {xi}");
        }
    }

    #[test]
    fn a_blossom_is_symmetric_and_its_diagonal_is_the_basis(knots in knots(), arguments in [-1.0..2.0, -1.0..2.0, -1.0..2.0]) {
        let degree = knots.degree();
        let arguments: &[f64] = &arguments[..degree];
        let blossom = |arguments: &[f64]| {
            let mut values = vec![0.0; degree + 1];
            bspline::blossom(&knots, degree, arguments, &mut values);
            values
        };
        let reversed: Vec<f64> = arguments.iter().rev().copied().collect();
        let size: f64 = blossom(arguments).iter().map(|value| value.abs()).sum();
        for (a, b) in blossom(arguments).iter().zip(blossom(&reversed)) {
            prop_assert!((a - b).abs() < 1e-12 * size);
        }
        let xi = arguments[0];
        prop_assert_eq!(blossom(&vec![xi; degree]), table(&knots, degree, xi, 0).remove(0));
    }

    #[test]
    fn tensor_products_of_rational_functions_agree_with_their_definition((spline, xi) in splines_with_parameters::<3>(3)) {
        let mut basis = BasisValues::new(&spline);
        spline.basis(&xi, Derivatives::None, &mut basis);
        let [n, m] = [spline.knots()[0].basis_count(), spline.knots()[1].basis_count()];
        let weighted: Vec<f64> = (0..spline.control_points().len())
            .map(|a| {
                let indices = [a % n, a / n % m, a / (n * m)];
                (0..3).map(|i| naive(&spline.knots()[i], indices[i], xi[i])).product::<f64>() * spline.weights()[a]
            })
            .collect();
        let sum: f64 = weighted.iter().sum();
        let mut expected = weighted.iter().map(|w| w / sum).collect::<Vec<_>>();
        for (&a, value) in basis.active().iter().zip(basis.values()) {
            expected[a] -= value;
        }
        prop_assert!(expected.iter().all(|rest| rest.abs() < 1e-14));
    }

    #[test]
    fn rational_derivatives_are_difference_quotients(spline in splines::<3>(3), shares in [0.1..0.9, 0.1..0.9, 0.1..0.9]) {
        check_derivatives(&spline, shares)?;
    }

    #[test]
    fn a_workspace_is_left_in_no_state_that_matters(
        (spline, xi) in splines_with_parameters::<2>(2), other in [0.0..=1.0, 0.0..=1.0]
    ) {
        let mut used = BasisValues::new(&spline);
        spline.basis(&parameters_at(&spline, &other), Derivatives::Second, &mut used);
        spline.basis(&xi, Derivatives::First, &mut used);
        let mut fresh = BasisValues::new(&spline);
        spline.basis(&xi, Derivatives::First, &mut fresh);
        prop_assert_eq!((used.active(), used.values(), used.first()), (fresh.active(), fresh.values(), fresh.first()));
    }
}

fn check_derivatives(spline: &Spline<3>, shares: [f64; 3]) -> Result<(), TestCaseError> {
    let element = spline.element(spline.element_count() / 2);
    let xi = element.at(shares);
    let evaluated = |xi: &[f64; 3]| {
        let mut basis = BasisValues::new(spline);
        spline.basis_on(element.index(), xi, Derivatives::Second, &mut basis);
        basis
    };
    let here = evaluated(&xi);
    for i in 0..3 {
        let [start, end] = element.ranges()[i];
        let h = 1e-5 * (end - start);
        let moved = |by: f64| {
            let mut xi = xi;
            xi[i] += by;
            evaluated(&xi)
        };
        let (above, below) = (moved(h), moved(-h));
        for a in 0..here.values().len() {
            let first = (above.values()[a] - below.values()[a]) / (2.0 * h);
            prop_assert!(close(here.first()[a][i], first, 1e-6));
            for j in 0..3 {
                let second = (above.first()[a][j] - below.first()[a][j]) / (2.0 * h);
                prop_assert!(close(here.second()[a][i][j], second, 1e-5));
            }
        }
    }
    Ok(())
}

#[test]
#[should_panic(expected = "first derivatives were not computed")]
fn stale_derivatives_cannot_be_read() {
    let patch = partita_iga::build::rectangle([0.0; 2], [1.0; 2], [2, 2], [2, 2]).unwrap();
    let mut basis = BasisValues::new(&patch);
    patch.basis(&[0.2, 0.2], Derivatives::First, &mut basis);
    patch.basis(&[0.7, 0.2], Derivatives::None, &mut basis);
    let _ = basis.first();
}

#[test]
#[should_panic(expected = "other degrees")]
fn a_workspace_of_other_degrees_is_refused() {
    let patch = |degree| partita_iga::build::rectangle([0.0; 2], [1.0; 2], degree, [2, 2]).unwrap();
    let mut basis = BasisValues::new(&patch([2, 3]));
    patch([3, 2]).basis(&[0.2, 0.2], Derivatives::First, &mut basis);
}
