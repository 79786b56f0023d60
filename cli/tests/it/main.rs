//! Whole-crate tests: scenes, output, checkpoints, runs.

mod checkpoint;
mod output;
mod program;
mod scene;
mod tank;
