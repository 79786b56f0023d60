//! Orders of convergence of the coupled problem.

mod time;
