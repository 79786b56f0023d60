//! Partitioned fluid-structure interaction from a scene file.

pub mod scene;
