//! Whole-crate tests: scenes, output, checkpoints, runs.

mod checkpoint;
mod output;
mod scene;
mod tank;
