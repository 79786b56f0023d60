//! Mesh motion: the nodes inside follow the boundary as an elastic or a harmonic body would.

mod settings;

pub use settings::{MotionLaw, MotionMode, MotionSettings};
