//! Stabilized incompressible Navier-Stokes on a moving mesh.
//!
//! Linear velocity and pressure on simplices, stabilized by SUPG, PSPG and LSIC, in arbitrary
//! Lagrangian-Eulerian form, with BDF1 or BDF2 in time or steady:
//!
//! ```text
//! (q_u, rho (D_t u + (u - w).grad u - b)) + (eps(q_u), 2 mu eps(u)) - (div q_u, p) + (q_p, div u)
//! + sum_e tau_M ((u - w).grad q_u + grad q_p / rho, r_M)_e + sum_e tau_C (div q_u, div u)_e = <q_u, h>
//! ```
//!
//! | module | what it holds |
//! |---|---|
//! | [`model`] | properties, boundary conditions, initial state: data |
//! | [`settings`] | time scheme, tangent, Newton, mesh motion |
//! | [`kernel`] | residual and tangent of one element and of its boundary facets |
//! | [`stabilization`] | `tau_M`, `tau_C` and their derivatives |
//! | [`FluidSolver`] | one time step at a time: begin, impose, iterate, commit or rewind |
//! | [`FluidState`] | what a checkpoint holds |
//!
//! Vectors over the fluid are indexed `node * (D + 1) + c`: velocity `[m/s]` first, pressure `[Pa]` last.
//! Prescribed dofs are eliminated; the residual is kept on all dofs, so that its prescribed rows are the
//! forces that hold the values.

mod added_mass;
mod assembly;
mod backflow;
mod balance;
mod boundary;
mod error;
mod field;
mod flow;
mod force;
pub mod kernel;
pub mod model;
mod probe;
mod residual;
mod round_off;
pub mod settings;
mod shared;
mod solver;
pub mod stabilization;
mod state;
mod step;
mod trial;

pub use backflow::{Backflow, Outlet};
pub use boundary::holding_conditions;
pub use error::FluidError;
pub use model::{BodyForce, BoundaryCondition, FluidModel, InitialState, VectorField};
pub use partita_numerics::Field;
pub use settings::{FluidSettings, PressurePin, Tangent, TimeScheme};
pub use solver::FluidSolver;
pub use state::FluidState;
