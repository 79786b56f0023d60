//! How large a residual is.

use partita_numerics::DofMap;
use partita_numerics::newton::ResidualNorm;

use crate::kernel::{TERMS, Terms};

/// A block of the residual counts as zero below this part of the size of its terms before they cancel. A direct
/// solve leaves 0.1 to 0.6 roundings of that size.
const ROUND_OFF: f64 = 16.0 * f64::EPSILON;

/// Sums over the elements of the squared sizes of their terms, before anything cancels.
#[derive(Debug, Default)]
pub(crate) struct Sizes {
    momentum: f64,
    continuity: f64,
}

impl Sizes {
    #[inline]
    pub(crate) fn add<const D: usize, const N: usize>(&mut self, terms: &Terms<D, N>) {
        self.momentum += terms.momentum_size * terms.momentum_size;
        self.continuity += terms.continuity_size * terms.continuity_size;
    }
}

/// Sums of squares over the rows of one block.
#[derive(Debug, Default, Clone, Copy)]
struct Block {
    residual: f64,
    terms: [f64; TERMS],
}

/// The norm over the free rows, and the right-hand side -R.
///
/// ```text
/// absolute   |R|_2
/// relative   max over the blocks momentum, continuity of |R_block|_2 / max over its terms of |term|_2
/// ```
///
/// A block whose residual is round-off counts as zero. That matters where all terms of a block vanish, as in
/// uniform flow or, for continuity, in any flow that is linear in space: there the quotient would be one of
/// round-off by round-off.
pub(crate) fn norm<const D: usize>(
    dofs: &DofMap,
    terms: &[[f64; TERMS]],
    sizes: &Sizes,
    right_hand_side: &mut [f64],
) -> ResidualNorm {
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
    let absolute = (momentum.residual + continuity.residual).sqrt();
    let worst = momentum.norm(sizes.momentum).worse(continuity.norm(sizes.continuity));
    ResidualNorm { absolute, relative: worst.relative }
}

impl Block {
    fn norm(&self, squared_size: f64) -> ResidualNorm {
        let residual = self.residual.sqrt();
        if residual <= ROUND_OFF * squared_size.sqrt() {
            return ResidualNorm { absolute: residual, relative: 0.0 };
        }
        let largest = self.terms.iter().fold(0.0, |largest: f64, term| largest.max(*term));
        ResidualNorm::new(residual, largest.sqrt())
    }
}
