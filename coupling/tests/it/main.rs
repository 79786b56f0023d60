//! Integration tests: the parts of the crate at work together.

mod conformance;
mod eigenvalues;
mod march;
mod models;
mod quasi_newton;
mod resume;
mod support;
mod transfer;
mod work;
