//! What must hold for splines of any degree, knots and weights, through the public interface.

#![allow(clippy::float_cmp, reason = "where a test compares exactly, exactness is the point")]

mod basis;
mod build;
mod file;
mod file_faults;
mod orientation;
mod patches;
mod project;
mod refine;
mod spline;
mod support;
mod transfer;
