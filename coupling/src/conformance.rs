//! Checks that an implementation keeps the contract of its trait.
//!
//! They are part of the library, so that one and the same check runs on the models here and on the real
//! solvers elsewhere. Each returns the first violation it meets.

mod accelerator;
mod participant;

use thiserror::Error;

pub use accelerator::check_accelerator;
pub use participant::{ParticipantCheck, check_participant};

use crate::transfer::Transfer;
use crate::vector::{dot, norm};

/// A contract that is not kept.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{subject}: {what}")]
pub struct Violation {
    /// Who breaks it.
    pub subject: String,
    /// What was expected and what happened.
    pub what: String,
}

/// Fails with the message unless the condition holds.
fn expect(subject: &str, holds: bool, what: impl FnOnce() -> String) -> Result<(), Violation> {
    if holds { Ok(()) } else { Err(Violation { subject: subject.to_owned(), what: what() }) }
}

/// Checks that a transfer keeps virtual work and total force.
///
/// `f . (H x) = (H^T f) . x` and, for each of the `components`, `H 1 = 1`, both to `tolerance` relative to the
/// vectors: rows that sum to one keep the total force. A point that no other point carries (a basis
/// function that vanishes at the last knot) breaks the second.
///
/// # Errors
/// The first violation.
pub fn check_transfer(transfer: &dyn Transfer, components: usize, tolerance: f64) -> Result<(), Violation> {
    let subject = "transfer";
    let (rows, columns) = (transfer.rows(), transfer.columns());
    let (x, f) = (scattered(columns, 1), scattered(rows, 2));
    let (mut hx, mut htf) = (vec![f64::NAN; rows], vec![f64::NAN; columns]);
    transfer.apply(&x, &mut hx);
    transfer.apply_transpose(&f, &mut htf);
    let (fluid_work, structure_work) = (dot(&f, &hx), dot(&htf, &x));
    expect(subject, (fluid_work - structure_work).abs() <= tolerance * norm(&f) * norm(&hx), || {
        format!("virtual work {fluid_work:e} J becomes {structure_work:e} J")
    })?;
    for component in 0..components {
        let unit: Vec<f64> =
            (0..columns).map(|i| if i % components == component { 1.0 } else { 0.0 }).collect();
        transfer.apply(&unit, &mut hx);
        for (i, value) in hx.iter().enumerate() {
            let expected = if i % components == component { 1.0 } else { 0.0 };
            expect(subject, (value - expected).abs() <= tolerance, || {
                let (point, component_there) = (i / components, i % components);
                format!(
                    "a unit translation in component {component} moves component {component_there} of point {point} by {value:e}"
                )
            })?;
        }
    }
    Ok(())
}

/// Numbers between -1 and 1 without structure, the same in every run.
fn scattered(len: usize, seed: u32) -> Vec<f64> {
    let mut state = u64::from(seed).wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1;
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    };
    (0..len).map(|_| next()).collect()
}
