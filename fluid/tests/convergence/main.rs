//! Orders of convergence in space and time, each with a bound on the error of the finest level.

mod common;
mod force;
mod kovasznay;
mod space;
mod taylor_green;
mod time;
