//! Partitioned fluid-structure interaction from a scene file.

pub mod expression;
mod nearest;
pub mod scene;
