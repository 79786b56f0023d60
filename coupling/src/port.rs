//! What the numbers in an interface vector mean.

use serde::{Deserialize, Serialize};

/// The physical quantity of a block.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Quantity {
    /// Displacement from the reference position \[m\].
    Displacement,
    /// Nodal forces, work-conjugate to displacements \[N, or N/m in two dimensions\].
    Force,
}

/// One stretch of an interface vector: `components` values at each of `points` points of one interface.
///
/// The value of component `c` at point `i` stands at index `i * components + c` of the stretch. The blocks
/// of a participant follow each other in the order in which it lists them.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Block {
    /// Name of the interface; both participants use the same one.
    pub interface: String,
    /// What the values are.
    pub quantity: Quantity,
    /// Values per point.
    pub components: usize,
    /// Number of points.
    pub points: usize,
}

impl Block {
    /// A block of `components` values at each of `points` points.
    ///
    /// ```
    /// use partita_coupling::{Block, Quantity};
    ///
    /// let wetted = Block::new("bottom", Quantity::Displacement, 2, 60);
    /// assert_eq!(wetted.len(), 120);
    /// ```
    #[must_use]
    pub fn new(interface: impl Into<String>, quantity: Quantity, components: usize, points: usize) -> Self {
        Self { interface: interface.into(), quantity, components, points }
    }

    /// Number of values in the block.
    #[must_use]
    pub fn len(&self) -> usize {
        self.components * self.points
    }

    /// Whether the block holds no value.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// Number of values in a list of blocks.
#[must_use]
pub fn total_len(blocks: &[Block]) -> usize {
    blocks.iter().map(Block::len).sum()
}

/// Names the place of value `index` in a vector made of `blocks`: `"interface bottom, point 3, component 1"`.
#[must_use]
pub fn place(blocks: &[Block], index: usize) -> String {
    let mut rest = index;
    for block in blocks {
        if rest < block.len() {
            let (point, component) = (rest / block.components, rest % block.components);
            return format!("interface {}, point {point}, component {component}", block.interface);
        }
        rest -= block.len();
    }
    format!("value {index}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn place_counts_through_the_blocks() {
        let blocks = [
            Block::new("left", Quantity::Displacement, 2, 3),
            Block::new("right", Quantity::Displacement, 2, 2),
        ];
        assert_eq!(total_len(&blocks), 10);
        assert_eq!(place(&blocks, 5), "interface left, point 2, component 1");
        assert_eq!(place(&blocks, 8), "interface right, point 1, component 0");
    }
}
