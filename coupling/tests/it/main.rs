//! Integration tests: the parts of the crate at work together.

mod conformance;
mod models;
mod support;
