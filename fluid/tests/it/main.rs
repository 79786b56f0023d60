//! Integration tests of the fluid.

mod kernel;
