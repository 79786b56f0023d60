//! What stops a run, or lets it pass, at the limits of the arithmetic.

mod backflow;
mod idle;
mod rest;
mod slender;
mod wrong_file;
