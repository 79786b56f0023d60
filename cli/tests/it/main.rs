//! Whole-crate tests: scenes, output, checkpoints, runs.

mod beam;
mod benchmarks;
mod checkpoint;
mod closed;
mod damping;
mod effects;
mod failures;
mod field_cases;
mod linear_tank;
mod output;
mod program;
mod relaxation;
mod retry;
mod scene;
mod solid;
mod stability;
mod static_tank;
mod study;
mod sweep;
mod tank;
mod warnings;
mod work;
