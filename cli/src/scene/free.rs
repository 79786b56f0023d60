//! Free pieces of a structure in words, for errors and warnings.

use partita_mesh::Place;
use partita_structure::rigid::FreePiece;

/// Free pieces that are named one by one.
pub(crate) const MOST_PIECES: usize = 3;

/// How a free piece is held.
pub(crate) const HOLD: &str = "name a part of its boundary in `clamped` or `held`; pieces of a mesh hold together where \
     they share nodes (`Coherence;` or `BooleanFragments` in the .geo file)";

/// A piece, its size and its place.
pub(crate) fn piece_of(piece: &FreePiece) -> String {
    let cells = if piece.cells == 1 { "1 element".to_owned() } else { format!("{} elements", piece.cells) };
    format!("the piece of {cells} round {}", Place::from(piece.place))
}

/// What a piece can do: `is held nowhere: it can move in x, ...`.
pub(crate) fn what_is_free(piece: &FreePiece) -> String {
    let motions: Vec<String> = piece.motions.iter().map(ToString::to_string).collect();
    let held = if piece.is_loose() { "is held nowhere" } else { "is not held enough" };
    format!("{held}: it can {}", motions.join(" and "))
}
