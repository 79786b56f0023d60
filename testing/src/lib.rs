//! What the tests of Partita share. No other code depends on it.

pub mod corpus;
mod noise;
pub mod timeless;

pub use noise::Noise;
