//! Orders of convergence of the coupled problem.

mod manufactured;
mod time;
