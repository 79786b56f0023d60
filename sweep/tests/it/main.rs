//! Sweeps through the library: what is read, what is refused, what is left in the folder, and how it goes on.

mod broken;
mod corners;
mod fingerprints;
mod folder;
mod resume;
mod study;
mod support;
