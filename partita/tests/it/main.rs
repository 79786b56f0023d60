//! Whole runs of the library.

mod examples;
mod run;
