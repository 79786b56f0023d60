//! From the interface points of one field to those of the other.
//!
//! The operator `H` maps displacements of the second participant's points to those of the first one's,
//! `d = H x`; loads return by its transpose, `F = H^T f`. The transpose keeps the virtual work,
//! `f . (H delta) = (H^T f) . delta`; rows that sum to one keep the total force (Hosters et al. 2018). [`mortar`] builds rows
//! that keep the load of a constant traction, too.

pub mod mortar;

use sprs::{CsMat, TriMat};

use crate::participant::Participant;
use crate::port::{Block, Quantity};
use crate::setup::SetupError;

/// A linear map between the points of two blocks, and its transpose.
pub trait Transfer: Send {
    /// Columns of `H`: values at the second participant's points, which [`apply`](Self::apply) takes.
    fn columns(&self) -> usize;

    /// Rows of `H`: values at the first participant's points, which [`apply`](Self::apply) fills.
    fn rows(&self) -> usize;

    /// `to = H from`: displacements to the first participant's points.
    fn apply(&self, from: &[f64], to: &mut [f64]);

    /// `to = H^T from`: forces back to the second participant's points.
    fn apply_transpose(&self, from: &[f64], to: &mut [f64]);
}

/// The transfer between points that coincide.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct IdentityTransfer {
    len: usize,
}

impl IdentityTransfer {
    /// The identity on vectors of `len` values.
    #[must_use]
    pub fn new(len: usize) -> Self {
        Self { len }
    }
}

impl Transfer for IdentityTransfer {
    fn columns(&self) -> usize {
        self.len
    }
    fn rows(&self) -> usize {
        self.len
    }
    fn apply(&self, from: &[f64], to: &mut [f64]) {
        to.copy_from_slice(from);
    }
    fn apply_transpose(&self, from: &[f64], to: &mut [f64]) {
        to.copy_from_slice(from);
    }
}

/// A sparse matrix of point weights, applied to each component of interleaved vectors.
///
/// `to[i * components + c] = sum_j H[i, j] from[j * components + c]`
///
/// ```
/// use partita_coupling::{MatrixTransfer, Transfer};
///
/// // Three points of the first field between two of the second, two components each.
/// let rows = [vec![(0, 1.0)], vec![(0, 0.5), (1, 0.5)], vec![(1, 1.0)]];
/// let transfer = MatrixTransfer::from_rows(2, 2, &rows)?;
/// let mut forces = [0.0; 4];
/// transfer.apply_transpose(&[1.0, 0.0, 1.0, 0.0, 1.0, 0.0], &mut forces);
/// assert_eq!(forces, [1.5, 0.0, 1.5, 0.0]);
/// # Ok::<(), partita_coupling::SetupError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct MatrixTransfer {
    matrix: CsMat<f64>,
    components: usize,
}

impl MatrixTransfer {
    /// The transfer with the weights of `matrix` (first participant's points times second participant's points).
    #[must_use]
    pub fn new(matrix: CsMat<f64>, components: usize) -> Self {
        Self { matrix: matrix.into_csr(), components }
    }

    /// The transfer whose row `i` lists the points of the second participant, out of `points`, that carry
    /// point `i` of the first one, with their weights. Weights listed twice for one point add up.
    ///
    /// # Errors
    /// When a row is empty, names a point that does not exist, or holds a weight that is not finite.
    pub fn from_rows(
        points: usize,
        components: usize,
        rows: &[Vec<(usize, f64)>],
    ) -> Result<Self, SetupError> {
        let mut triplets = TriMat::new((rows.len(), points));
        for (row, weights) in rows.iter().enumerate() {
            let fault = |problem| Err(SetupError::TransferRow { row, problem });
            if weights.is_empty() {
                return fault("no weight at all".to_owned());
            }
            for &(point, weight) in weights {
                if point >= points {
                    return fault(format!("point {point} does not exist, there are {points}"));
                }
                if !weight.is_finite() {
                    return fault(format!("the weight of point {point} is {weight}"));
                }
                triplets.add_triplet(row, point, weight);
            }
        }
        Ok(Self { matrix: triplets.to_csr(), components })
    }

    /// The matrix of weights, compressed by rows.
    #[must_use]
    pub fn matrix(&self) -> &CsMat<f64> {
        &self.matrix
    }
}

impl Transfer for MatrixTransfer {
    fn columns(&self) -> usize {
        self.matrix.cols() * self.components
    }

    fn rows(&self) -> usize {
        self.matrix.rows() * self.components
    }

    fn apply(&self, from: &[f64], to: &mut [f64]) {
        assert!(from.len() == self.columns() && to.len() == self.rows(), "transfer of wrong length");
        let components = self.components;
        for (row, to) in self.matrix.outer_iterator().zip(to.chunks_exact_mut(components)) {
            to.fill(0.0);
            for (column, weight) in row.iter() {
                for (t, f) in to.iter_mut().zip(&from[column * components..]) {
                    *t += weight * f;
                }
            }
        }
    }

    fn apply_transpose(&self, from: &[f64], to: &mut [f64]) {
        assert!(from.len() == self.rows() && to.len() == self.columns(), "transfer of wrong length");
        let components = self.components;
        to.fill(0.0);
        for (row, from) in self.matrix.outer_iterator().zip(from.chunks_exact(components)) {
            for (column, weight) in row.iter() {
                for (t, f) in to[column * components..].iter_mut().zip(from) {
                    *t += weight * f;
                }
            }
        }
    }
}

/// All transfers of a coupled problem, one a block, in the order of the blocks.
pub struct Transfers {
    parts: Vec<Box<dyn Transfer>>,
    /// Loads go to the second participant, displacements do not come back.
    one_way: bool,
}

impl Transfers {
    /// Checks that the blocks of two participants and the transfers fit, and keeps the transfers.
    ///
    /// Where the first participant takes nothing and the second hands nothing out, the coupling is one way: loads alone
    /// are transferred.
    ///
    /// # Errors
    /// When the numbers of blocks, the interfaces, the quantities or the lengths disagree.
    pub fn between(
        first: &impl Participant,
        second: &impl Participant,
        parts: Vec<Box<dyn Transfer>>,
    ) -> Result<Self, SetupError> {
        let lists = [first.input(), first.output(), second.input(), second.output()];
        let [first_in, first_out, second_in, second_out] = lists.map(<[Block]>::len);
        if [first_in, second_out] == [0; 2] && [first_out, second_in] == [parts.len(); 2] && !parts.is_empty()
        {
            for (index, transfer) in parts.iter().enumerate() {
                check_loads([&lists[1][index], &lists[2][index]], transfer.as_ref())?;
            }
            return Ok(Self { parts, one_way: true });
        }
        if lists.iter().any(|blocks| blocks.len() != parts.len()) {
            return Err(SetupError::BlockCount {
                first: first.name().to_owned(),
                second: second.name().to_owned(),
                first_input: lists[0].len(),
                first_output: lists[1].len(),
                second_input: lists[2].len(),
                second_output: lists[3].len(),
                transfers: parts.len(),
            });
        }
        for (index, transfer) in parts.iter().enumerate() {
            check_blocks(lists.map(|blocks| &blocks[index]), transfer.as_ref())?;
        }
        Ok(Self { parts, one_way: false })
    }

    /// `to = H from` for all blocks; nothing where the coupling is one way.
    pub fn apply(&self, from: &[f64], to: &mut [f64]) {
        if self.one_way {
            return;
        }
        let (mut from_rest, mut to_rest) = (from, to);
        for part in &self.parts {
            let (from_block, from_tail) = from_rest.split_at(part.columns());
            let (to_block, to_tail) = to_rest.split_at_mut(part.rows());
            part.apply(from_block, to_block);
            (from_rest, to_rest) = (from_tail, to_tail);
        }
    }

    /// `to = H^T from` for all blocks.
    pub fn apply_transpose(&self, from: &[f64], to: &mut [f64]) {
        let (mut from_rest, mut to_rest) = (from, to);
        for part in &self.parts {
            let (from_block, from_tail) = from_rest.split_at(part.rows());
            let (to_block, to_tail) = to_rest.split_at_mut(part.columns());
            part.apply_transpose(from_block, to_block);
            (from_rest, to_rest) = (from_tail, to_tail);
        }
    }
}

/// The two blocks that meet at a transfer of loads alone: force out of the first participant, into the second.
fn check_loads([first_out, second_in]: [&Block; 2], transfer: &dyn Transfer) -> Result<(), SetupError> {
    let fault =
        |problem: String| Err(SetupError::BlockMismatch { interface: first_out.interface.clone(), problem });
    if second_in.interface != first_out.interface {
        return fault(format!("meets interface {}", second_in.interface));
    }
    if first_out.quantity != second_in.quantity || first_out.quantity == Quantity::Displacement {
        return fault("the first participant must hand loads of one kind to the second".to_owned());
    }
    let lengths = [
        (first_out, transfer.rows(), "the output of the first participant"),
        (second_in, transfer.columns(), "the input of the second participant"),
    ];
    check_lengths(&lengths).or_else(fault)
}

/// What a block has to say other than its transfer.
fn check_lengths(lengths: &[(&Block, usize, &str)]) -> Result<(), String> {
    match lengths.iter().find(|(block, expected, _)| block.len() != *expected) {
        Some((block, expected, what)) => {
            Err(format!("{what} has {} values, the transfer {expected}", block.len()))
        }
        None => Ok(()),
    }
}

/// The four blocks that meet at one transfer: displacement out of the second, into the first; force out of
/// the first, into the second.
fn check_blocks(blocks: [&Block; 4], transfer: &dyn Transfer) -> Result<(), SetupError> {
    let [first_in, first_out, second_in, second_out] = blocks;
    let fault =
        |problem: String| Err(SetupError::BlockMismatch { interface: first_in.interface.clone(), problem });
    if let Some(other) = blocks.iter().find(|block| block.interface != first_in.interface) {
        return fault(format!("meets interface {}", other.interface));
    }
    if first_in.quantity != Quantity::Displacement || second_out.quantity != Quantity::Displacement {
        return fault("the second participant must hand displacements to the first".to_owned());
    }
    if first_out.quantity != second_in.quantity || first_out.quantity == Quantity::Displacement {
        return fault("the first participant must hand loads of one kind to the second".to_owned());
    }
    let lengths = [
        (first_in, transfer.rows(), "the input of the first participant"),
        (first_out, transfer.rows(), "the output of the first participant"),
        (second_in, transfer.columns(), "the input of the second participant"),
        (second_out, transfer.columns(), "the output of the second participant"),
    ];
    check_lengths(&lengths).or_else(fault)
}
