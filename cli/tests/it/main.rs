//! Whole-crate tests: scenes, output, checkpoints, runs.

mod beam;
mod checkpoint;
mod failures;
mod output;
mod program;
mod scene;
mod tank;
