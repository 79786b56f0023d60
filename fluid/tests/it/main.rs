//! Integration tests of the fluid.

mod balance;
mod common;
mod conditions;
mod errors;
mod exact;
mod interface;
mod kernel;
mod newton;
mod state;
mod tangent;
