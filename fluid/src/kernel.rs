//! The element kernel: residual and tangent of one simplex with N = D + 1 nodes.
//!
//! With c = u - w, L = grad u (`L_ij = du_i/dx_j`) and the residual of the strong form
//!
//! ```text
//! r_M = rho (D_t u + L c - b) + grad p
//! ```
//!
//! the rows of node a are
//!
//! ```text
//! momentum    (N_a, rho (D_t u + L c - b)) + (mu (L + L^T) - p I) grad N_a
//!             + tau_M (r_M (x) c) grad N_a + tau_C div u grad N_a
//! continuity  (N_a, div u) + tau_M / rho  grad N_a . r_M
//! ```
//!
//! integrated over the element. All fields are linear on it, so gradients are constants and what is left are
//! integrals of products of two linear functions. They are integrated exactly, from nodal values alone:
//!
//! ```text
//! (f, g) = V / (N (N + 1)) (sum_a f_a g_a + sum_a f_a sum_a g_a)
//! ```
//!
//! (a one-point rule would make the mass matrix singular, and a Gauss rule has N points for the same result).
//! tau is that of the centroid. The body force is interpolated at the nodes.
//!
//! The kernel is written for any [`Real`], so that several elements can stand side by side in the lanes of a vector
//! register; each lane has the bits that the element has alone.
#![allow(
    clippy::inline_always,
    reason = "vector code has to be part of the entry point of its instruction set"
)]

mod element;
pub mod facet;
mod tangent;
mod terms;

use partita_numerics::lanes::Real;

pub use crate::flow::Flow;
pub use element::{Element, Fields, shape};
pub use terms::{TERMS, Term, Terms};

/// Residual of one element, or of one a lane, and, where wanted, its tangent (row-major, N (D + 1) square, overwritten).
///
/// Local dofs are numbered like the global ones: `node * (D + 1) + component`, pressure last.
///
/// # Panics
///
/// If `tangent` does not have (N (D + 1))^2 entries.
#[inline(always)]
#[must_use]
pub fn element<const D: usize, const N: usize, R: Real>(
    fields: &Fields<D, N, R>,
    flow: &Flow<R>,
    tangent: Option<&mut [R]>,
) -> (Element<D, N, R>, Terms<D, N, R>) {
    let element = Element::new(fields, flow);
    if let Some(tangent) = tangent {
        element.tangent(tangent);
    }
    let terms = element.residual();
    (element, terms)
}
