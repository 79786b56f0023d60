//! What the tests of Partita share. No other code depends on it.

pub mod cantilever;
pub mod corpus;
mod hint;
mod noise;
pub mod timeless;

pub use hint::with_hint;
pub use noise::Noise;
