//! Scene files: read, checked, explained.

pub mod schema;
