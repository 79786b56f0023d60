//! `partita-numerics` against dense algebra, and its promises about memory.

mod allocation;
mod assembly;
mod factor;
mod grid;
mod node_block;
mod random;
mod threads;
