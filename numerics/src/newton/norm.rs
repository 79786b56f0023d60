//! The size of a residual, and when it is small enough.

use crate::norms;

/// The norm of a residual, as it is and against the size of its own terms.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ResidualNorm {
    /// |R|_2 over the free dofs, in the unit of the residual.
    pub absolute: f64,
    /// |R|_2 / S with the scale S of the field; 0/0 = 0.
    pub relative: f64,
}

impl ResidualNorm {
    /// Relates the norm `absolute` to `scale`, the size of the terms that should cancel.
    ///
    /// ```
    /// use partita_numerics::newton::ResidualNorm;
    ///
    /// assert_eq!(ResidualNorm::new(2.0, 8.0).relative, 0.25);
    /// assert_eq!(ResidualNorm::new(0.0, 0.0).relative, 0.0);
    /// ```
    #[must_use]
    pub fn new(absolute: f64, scale: f64) -> Self {
        Self { absolute, relative: norms::relative(absolute, scale) }
    }

    /// The norm with the larger relative part: of several blocks, the worst one counts.
    ///
    /// A block that is not a number is the worst.
    #[must_use]
    pub fn worse(self, other: Self) -> Self {
        if other.relative > self.relative || other.relative.is_nan() { other } else { self }
    }

    /// The scale S behind the relative part, zero where there is none.
    #[must_use]
    pub fn scale(&self) -> f64 {
        if self.relative > 0.0 { self.absolute / self.relative } else { 0.0 }
    }

    /// Whether the residual could be evaluated at all.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        self.absolute.is_finite() && !self.relative.is_nan()
    }
}

/// The bound below which a residual counts as zero.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Bound {
    /// |R|_2 < bound * S.
    Relative(f64),
    /// |R|_2 < bound, in the unit of the residual.
    Absolute(f64),
}

impl Bound {
    /// The part of `residual` that is compared with the bound.
    #[must_use]
    pub fn measure(&self, residual: &ResidualNorm) -> f64 {
        match self {
            Self::Relative(_) => residual.relative,
            Self::Absolute(_) => residual.absolute,
        }
    }

    /// Whether `residual` lies below the bound.
    #[must_use]
    pub fn met(&self, residual: &ResidualNorm) -> bool {
        match *self {
            Self::Relative(bound) => residual.relative < bound,
            Self::Absolute(bound) => residual.absolute < bound,
        }
    }
}

impl std::fmt::Display for Bound {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Relative(bound) => write!(f, "{bound:e} (relative)"),
            Self::Absolute(bound) => write!(f, "{bound:e} (absolute)"),
        }
    }
}

impl std::fmt::Display for ResidualNorm {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:.3e} (relative {:.3e})", self.absolute, self.relative)
    }
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "these values are exact")]
mod tests {
    use super::*;

    #[test]
    fn bounds_look_at_their_own_part() {
        let residual = ResidualNorm { absolute: 1e-3, relative: 1e-11 };
        assert!(Bound::Relative(1e-10).met(&residual));
        assert!(!Bound::Absolute(1e-10).met(&residual));
        assert!(Bound::Absolute(1e-2).met(&residual));
        assert!(!Bound::Relative(1e-11).met(&residual), "the bound itself is not below the bound");
    }

    #[test]
    fn nothing_out_of_nothing_is_converged_but_not_a_number_never_is() {
        assert!(Bound::Relative(1e-10).met(&ResidualNorm::new(0.0, 0.0)));
        let broken = ResidualNorm::new(f64::NAN, 1.0);
        assert!(!Bound::Relative(1.0).met(&broken) && !Bound::Absolute(1.0).met(&broken));
    }

    #[test]
    fn the_worst_block_counts() {
        let (momentum, continuity) = (ResidualNorm::new(5.0, 1e3), ResidualNorm::new(1e-3, 1e-2));
        assert_eq!(momentum.worse(continuity), continuity);
        assert_eq!(continuity.worse(momentum), continuity);
        let broken = ResidualNorm::new(f64::NAN, 1.0);
        assert!(momentum.worse(broken).relative.is_nan() && broken.worse(momentum).relative.is_nan());
    }

    #[test]
    fn scale_is_recovered() {
        assert_eq!(ResidualNorm::new(3.0, 12.0).scale(), 12.0);
        assert_eq!(ResidualNorm::new(0.0, 0.0).scale(), 0.0);
        assert_eq!(ResidualNorm::new(3.0, 0.0).scale(), 0.0);
    }
}
