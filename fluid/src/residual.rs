//! How large a residual is.

use partita_numerics::DofMap;
use partita_numerics::lanes::Real;
use partita_numerics::newton::ResidualNorm;

use crate::kernel::{TERMS, Terms};

/// The scale of a block is at least this part of the size of its terms before they cancel. A direct solve leaves
/// 0.1 to 0.6 roundings of that size, so a block without any term to speak of can still get below 1e-10 of its
/// scale, but not below round-off.
const CANCELLATION: f64 = 1e-5;

/// Sums over the elements of the squared sizes of their terms, before anything cancels.
#[derive(Debug, Default, Clone, Copy, PartialEq)]
pub(crate) struct Sizes {
    pub(crate) momentum: f64,
    pub(crate) continuity: f64,
}

impl Sizes {
    /// Adds those of the element in one lane.
    #[inline]
    pub(crate) fn add<const D: usize, const N: usize, R: Real>(
        &mut self,
        terms: &Terms<D, N, R>,
        lane: usize,
    ) {
        let (momentum, continuity) = (terms.momentum_size.lanes()[lane], terms.continuity_size.lanes()[lane]);
        self.momentum += momentum * momentum;
        self.continuity += continuity * continuity;
    }
}

/// Sums of squares over the rows of one block.
#[derive(Debug, Default, Clone, Copy)]
struct Block {
    residual: f64,
    terms: [f64; TERMS],
}

/// How large a residual is, and of which block.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Measured {
    pub(crate) norm: ResidualNorm,
    /// Whether continuity is the block of the larger relative part.
    pub(crate) continuity_is_worse: bool,
    /// Squared norms of the residual in the two blocks.
    pub(crate) squares: Sizes,
}

/// The norm over the free rows, and the right-hand side -R.
///
/// ```text
/// absolute   |R|_2
/// relative   max over the blocks momentum, continuity of |R_block|_2 / max over its terms of |term|_2
/// ```
///
/// The scale of a block does not fall below [`CANCELLATION`] times the size of its terms before they cancel. That
/// matters where all terms of a block vanish, as in uniform flow or, for continuity, in any flow that is linear in
/// space: there the quotient would be one of round-off by round-off.
pub(crate) fn norm<const D: usize>(
    dofs: &DofMap,
    terms: &[[f64; TERMS]],
    sizes: &Sizes,
    right_hand_side: &mut [f64],
) -> Measured {
    let mut blocks = [Block::default(); 2];
    for (entry, &dof) in right_hand_side.iter_mut().zip(dofs.free()) {
        let row = &terms[dof];
        let residual: f64 = row.iter().sum();
        *entry = -residual;
        let block = &mut blocks[usize::from(dof % (D + 1) == D)];
        block.residual += residual * residual;
        for (sum, term) in block.terms.iter_mut().zip(row) {
            *sum += term * term;
        }
    }
    let [momentum, continuity] = blocks;
    let squares = Sizes { momentum: momentum.residual, continuity: continuity.residual };
    let absolute = (momentum.residual + continuity.residual).sqrt();
    let [momentum, continuity] = [momentum.norm(sizes.momentum), continuity.norm(sizes.continuity)];
    let worst = momentum.worse(continuity);
    Measured {
        norm: ResidualNorm { absolute, relative: worst.relative },
        continuity_is_worse: !momentum.relative.is_nan() && worst == continuity && worst != momentum,
        squares,
    }
}

impl Block {
    fn norm(&self, squared_size: f64) -> ResidualNorm {
        let largest = self.terms.iter().fold(0.0, |largest: f64, term| largest.max(*term));
        ResidualNorm::new(self.residual.sqrt(), largest.sqrt().max(CANCELLATION * squared_size.sqrt()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two nodes in 2D, the first velocity prescribed; rows hold two terms.
    fn measured(rows: [[f64; 2]; 6]) -> (Measured, Vec<f64>) {
        let dofs = DofMap::new(&[true, false, false, false, false, false]);
        let mut terms = [[0.0; TERMS]; 6];
        for (terms, row) in terms.iter_mut().zip(rows) {
            terms[..2].copy_from_slice(&row);
        }
        let mut right_hand_side = vec![0.0; 5];
        let sizes = Sizes { momentum: 100.0, continuity: 1.0 };
        (norm::<2>(&dofs, &terms, &sizes, &mut right_hand_side), right_hand_side)
    }

    fn norm_of(rows: [[f64; 2]; 6]) -> (ResidualNorm, Vec<f64>) {
        let (measured, right_hand_side) = measured(rows);
        (measured.norm, right_hand_side)
    }

    #[test]
    fn each_block_is_measured_against_its_own_largest_term() {
        // Momentum: |(1, 2)| against |(4, 3)|. Continuity: 0.02 against 0.04.
        let rows = [[7.0, 0.0], [4.0, -3.0], [0.0, 0.0], [0.0, 0.0], [-3.0, 5.0], [0.04, -0.02]];
        let (found, right_hand_side) = norm_of(rows);
        assert_eq!(right_hand_side, [-1.0, 0.0, 0.0, -2.0, -0.02]);
        assert!((found.absolute - f64::sqrt(5.0 + 4e-4)).abs() < 1e-15);
        assert!((found.relative - 0.5).abs() < 1e-15, "continuity is the worse one: {}", found.relative);
        assert!(measured(rows).0.continuity_is_worse);
        let mut rows = rows;
        rows[5] = [0.04, -0.04 + 1e-6];
        let momentum = f64::sqrt(5.0) / f64::sqrt(9.0 + 25.0);
        assert!((norm_of(rows).0.relative - momentum).abs() < 1e-15);
        assert!(!measured(rows).0.continuity_is_worse);
    }

    #[test]
    fn terms_that_cancel_are_measured_against_their_size() {
        let mut rows = [[0.0; 2]; 6];
        rows[5] = [3e-16, -1e-16];
        let found = norm_of(rows).0.relative;
        assert!((found - 2e-11).abs() < 1e-20, "round-off passes the usual bound, but is not zero: {found}");
        assert_eq!(norm_of([[0.0; 2]; 6]).0, ResidualNorm::default());
        assert!(norm_of([[f64::NAN; 2]; 6]).0.relative.is_nan());
    }
}
