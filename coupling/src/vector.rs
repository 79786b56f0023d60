//! Sums over plain slices, always in the same order.

/// `a . b`, summed in four interleaved partial sums.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len(), "dot product of vectors of different length");
    let (a_chunks, a_rest) = a.as_chunks::<4>();
    let (b_chunks, b_rest) = b.as_chunks::<4>();
    let mut sums = [0.0; 4];
    for (p, q) in a_chunks.iter().zip(b_chunks) {
        for lane in 0..4 {
            sums[lane] += p[lane] * q[lane];
        }
    }
    let rest: f64 = a_rest.iter().zip(b_rest).map(|(p, q)| p * q).sum();
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
}

/// `|a|`, the 2-norm.
pub(crate) fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

/// `y += factor x`.
pub(crate) fn add_scaled(factor: f64, x: &[f64], y: &mut [f64]) {
    assert_eq!(x.len(), y.len(), "sum of vectors of different length");
    for (yi, xi) in y.iter_mut().zip(x) {
        *yi += factor * xi;
    }
}

/// `result = a - b`.
pub(crate) fn subtract(a: &[f64], b: &[f64], result: &mut [f64]) {
    assert!(a.len() == b.len() && a.len() == result.len(), "difference of vectors of different length");
    for ((ri, ai), bi) in result.iter_mut().zip(a).zip(b) {
        *ri = ai - bi;
    }
}

/// `value / scale` with 0/0 = 0.
pub(crate) fn ratio(value: f64, scale: f64) -> f64 {
    if value == 0.0 { 0.0 } else { value / scale }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dot_counts_every_entry_once() {
        for n in 0..12 {
            let a: Vec<f64> = (1..=n).map(f64::from).collect();
            let expected = f64::from(n * (n + 1) * (2 * n + 1)) / 6.0;
            assert_eq!(dot(&a, &a).to_bits(), expected.to_bits());
        }
    }

    #[test]
    fn ratio_of_nothing_to_nothing_is_nothing() {
        assert_eq!(ratio(0.0, 0.0).to_bits(), 0.0_f64.to_bits());
        assert!(ratio(1.0, 0.0).is_infinite());
    }
}
