//! Whole runs of the library.
#![expect(
    clippy::duplicate_mod,
    reason = "each example is read as it stands, with the tank that several share"
)]

mod examples;
mod run;
