//! Tabulated rules on triangles and tetrahedra.

/// A point of a rule on a simplex of `N` vertices: barycentric coordinates and weight.
pub type SimplexPoint<const N: usize> = ([f64; N], f64);

/// The highest degree of [`triangle`].
pub const TRIANGLE_DEGREE: usize = 5;

/// The highest degree of [`tetrahedron`].
pub const TETRAHEDRON_DEGREE: usize = 5;

/// A rule on the triangle that is exact for polynomials of total degree `degree`.
///
/// Sources: Strang and Fix 1973 (degree 2), Dunavant 1985 (4), Radon 1948 (5). Degree 3 takes the rule of
/// degree 4: the rule of degree 3 with four points has a negative weight.
///
/// ```
/// use partita_numerics::gauss;
///
/// let rule = gauss::triangle(2);
/// let mass: f64 = rule.iter().map(|(l, weight)| weight * l[0] * l[1]).sum();
/// assert!((mass - 1.0 / 12.0).abs() < 1e-15);
/// ```
///
/// # Panics
///
/// If `degree` exceeds [`TRIANGLE_DEGREE`].
#[must_use]
pub fn triangle(degree: usize) -> &'static [SimplexPoint<3>] {
    match degree {
        0 | 1 => &TRIANGLE_1,
        2 => &TRIANGLE_3,
        3 | 4 => &TRIANGLE_6,
        5 => &TRIANGLE_7,
        _ => panic!("no triangle rule of degree {degree}: the highest is {TRIANGLE_DEGREE}"),
    }
}

/// A rule on the tetrahedron that is exact for polynomials of total degree `degree`.
///
/// Sources: Stroud 1971 (degrees 2 and 3), Walkington 2000 (5). The rule of degree 3 has its points at the
/// vertices and at the centroids of the faces.
///
/// # Panics
///
/// If `degree` exceeds [`TETRAHEDRON_DEGREE`].
#[must_use]
pub fn tetrahedron(degree: usize) -> &'static [SimplexPoint<4>] {
    match degree {
        0 | 1 => &TETRAHEDRON_1,
        2 => &TETRAHEDRON_4,
        3 => &TETRAHEDRON_8,
        4 | 5 => &TETRAHEDRON_14,
        _ => panic!("no tetrahedron rule of degree {degree}: the highest is {TETRAHEDRON_DEGREE}"),
    }
}

static TRIANGLE_1: [SimplexPoint<3>; 1] = [([1.0 / 3.0; 3], 1.0)];

static TRIANGLE_3: [SimplexPoint<3>; 3] = {
    const P: [[f64; 3]; 3] = around_triangle(1.0 / 6.0);
    [(P[0], 1.0 / 3.0), (P[1], 1.0 / 3.0), (P[2], 1.0 / 3.0)]
};

static TRIANGLE_6: [SimplexPoint<3>; 6] = {
    const INNER: [[f64; 3]; 3] = around_triangle(0.445_948_490_915_964_9);
    const OUTER: [[f64; 3]; 3] = around_triangle(0.091_576_213_509_770_74);
    const W: [f64; 2] = [0.223_381_589_678_011_47, 0.109_951_743_655_321_87];
    [
        (INNER[0], W[0]),
        (INNER[1], W[0]),
        (INNER[2], W[0]),
        (OUTER[0], W[1]),
        (OUTER[1], W[1]),
        (OUTER[2], W[1]),
    ]
};

static TRIANGLE_7: [SimplexPoint<3>; 7] = {
    const INNER: [[f64; 3]; 3] = around_triangle(0.470_142_064_105_115_1);
    const OUTER: [[f64; 3]; 3] = around_triangle(0.101_286_507_323_456_33);
    const W: [f64; 2] = [0.132_394_152_788_506_2, 0.125_939_180_544_827_15];
    [
        ([1.0 / 3.0; 3], 0.225),
        (INNER[0], W[0]),
        (INNER[1], W[0]),
        (INNER[2], W[0]),
        (OUTER[0], W[1]),
        (OUTER[1], W[1]),
        (OUTER[2], W[1]),
    ]
};

static TETRAHEDRON_1: [SimplexPoint<4>; 1] = [([0.25; 4], 1.0)];

static TETRAHEDRON_4: [SimplexPoint<4>; 4] = {
    const P: [[f64; 4]; 4] = around_tetrahedron(0.138_196_601_125_010_5);
    [(P[0], 0.25), (P[1], 0.25), (P[2], 0.25), (P[3], 0.25)]
};

static TETRAHEDRON_8: [SimplexPoint<4>; 8] = {
    const VERTEX: [[f64; 4]; 4] = around_tetrahedron(0.0);
    const FACE: [[f64; 4]; 4] = around_tetrahedron(1.0 / 3.0);
    const W: [f64; 2] = [0.025, 0.225];
    [
        (VERTEX[0], W[0]),
        (VERTEX[1], W[0]),
        (VERTEX[2], W[0]),
        (VERTEX[3], W[0]),
        (FACE[0], W[1]),
        (FACE[1], W[1]),
        (FACE[2], W[1]),
        (FACE[3], W[1]),
    ]
};

static TETRAHEDRON_14: [SimplexPoint<4>; 14] = {
    const INNER: [[f64; 4]; 4] = around_tetrahedron(0.310_885_919_263_300_6);
    const OUTER: [[f64; 4]; 4] = around_tetrahedron(0.092_735_250_310_891_23);
    const A: f64 = 0.045_503_704_125_649_65;
    const B: f64 = 0.5 - A;
    const W: [f64; 3] = [0.112_687_925_718_015_85, 0.073_493_043_116_361_95, 0.042_546_020_777_081_466];
    [
        (INNER[0], W[0]),
        (INNER[1], W[0]),
        (INNER[2], W[0]),
        (INNER[3], W[0]),
        (OUTER[0], W[1]),
        (OUTER[1], W[1]),
        (OUTER[2], W[1]),
        (OUTER[3], W[1]),
        ([A, A, B, B], W[2]),
        ([A, B, A, B], W[2]),
        ([A, B, B, A], W[2]),
        ([B, A, A, B], W[2]),
        ([B, A, B, A], W[2]),
        ([B, B, A, A], W[2]),
    ]
};

/// The three points with two coordinates `a`.
const fn around_triangle(a: f64) -> [[f64; 3]; 3] {
    let b = 1.0 - 2.0 * a;
    [[b, a, a], [a, b, a], [a, a, b]]
}

/// The four points with three coordinates `a`.
const fn around_tetrahedron(a: f64) -> [[f64; 4]; 4] {
    let b = 1.0 - 3.0 * a;
    [[b, a, a, a], [a, b, a, a], [a, a, b, a], [a, a, a, b]]
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "these values are exact")]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn factorial(n: usize) -> f64 {
        (1..=n).map(|k| k as f64).product()
    }

    /// The mean of `l_1^a l_2^b ...` over a simplex of dimension d: d! a! b! ... / (d + a + b + ...)!
    fn mean_of_monomial<const N: usize>(exponents: [usize; N]) -> f64 {
        let degree: usize = exponents.iter().sum();
        let product: f64 = exponents.iter().map(|&e| factorial(e)).product();
        factorial(N - 1) * product / factorial(N - 1 + degree)
    }

    /// All exponents of the first N - 1 barycentric coordinates with total degree `degree`.
    fn monomials<const N: usize>(degree: usize) -> Vec<[usize; N]> {
        let count = (degree + 1).pow(u32::try_from(N - 1).unwrap());
        (0..count)
            .map(|code| {
                let digit = |i| code / (degree + 1).pow(i) % (degree + 1);
                let mut exponents = std::array::from_fn(|i| digit(u32::try_from(i).unwrap()));
                exponents[N - 1] = 0;
                exponents
            })
            .filter(|exponents: &[usize; N]| exponents.iter().sum::<usize>() == degree)
            .collect()
    }

    fn sum_of_monomial<const N: usize>(rule: &[SimplexPoint<N>], exponents: [usize; N]) -> f64 {
        let monomial =
            |l: &[f64; N]| (0..N).map(|i| l[i].powi(exponents[i].try_into().unwrap())).product::<f64>();
        rule.iter().map(|(l, weight)| weight * monomial(l)).sum()
    }

    fn rule_is_sound_and_exact<const N: usize>(rule: &[SimplexPoint<N>], degree: usize) {
        for (l, weight) in rule {
            assert!(*weight > 0.0 && l.iter().all(|l| (0.0..=1.0).contains(l)));
            assert_relative_eq!(l.iter().sum::<f64>(), 1.0, epsilon = 1e-15);
        }
        for exponents in (0..=degree).flat_map(monomials::<N>) {
            let exact = mean_of_monomial(exponents);
            assert_relative_eq!(sum_of_monomial(rule, exponents), exact, max_relative = 5e-15);
        }
    }

    fn rule_fails_at<const N: usize>(rule: &[SimplexPoint<N>], degree: usize) -> bool {
        monomials::<N>(degree)
            .iter()
            .any(|&exponents| (sum_of_monomial(rule, exponents) - mean_of_monomial(exponents)).abs() > 1e-6)
    }

    #[test]
    fn triangle_rules_are_exact_up_to_their_degree() {
        for degree in 0..=TRIANGLE_DEGREE {
            rule_is_sound_and_exact(triangle(degree), degree);
        }
        for degree in [1, 2, 4, 5] {
            assert!(rule_fails_at(triangle(degree), degree + 1), "degree {degree} would integrate more");
        }
    }

    #[test]
    fn tetrahedron_rules_are_exact_up_to_their_degree() {
        for degree in 0..=TETRAHEDRON_DEGREE {
            rule_is_sound_and_exact(tetrahedron(degree), degree);
        }
        for degree in [1, 2, 3, 5] {
            assert!(rule_fails_at(tetrahedron(degree), degree + 1), "degree {degree} would integrate more");
        }
    }
}
