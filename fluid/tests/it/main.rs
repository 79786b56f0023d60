//! Integration tests of the fluid.

#![allow(clippy::float_cmp, reason = "prescribed and restored values arrive to the bit")]

mod added_mass;
mod allocation;
mod balance;
mod closed;
mod common;
mod conditions;
mod errors;
mod exact;
mod factor;
mod interface;
mod kernel;
mod newton;
mod probe;
mod shared;
mod state;
mod stokes;
mod tangent;
