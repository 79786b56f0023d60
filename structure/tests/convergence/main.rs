//! Orders of convergence in space and time.

mod lagrange;
mod space;
mod time;

#[path = "../it/common.rs"]
#[allow(dead_code, reason = "shared with the integration tests, which use all of it")]
mod common;
