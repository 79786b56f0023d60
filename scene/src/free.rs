//! Free pieces of a structure in words, for errors and warnings.

use partita_mesh::Place;
use partita_structure::rigid::FreePiece;

/// Free pieces that are named one by one.
pub const MOST_PIECES: usize = 3;

/// How a free piece is held.
pub const HOLD: &str = "name a part of its boundary in `clamped` or `held`; pieces of a mesh hold together where \
     they share nodes (`Coherence;` or `BooleanFragments` in the .geo file)";

/// What holds a piece or not: `nothing holds the piece of 3 elements at (1, 2) m`.
pub fn in_words(piece: &FreePiece) -> String {
    let cells = if piece.cells == 1 { "1 element".to_owned() } else { format!("{} elements", piece.cells) };
    let place = Place::from(piece.place);
    if piece.is_loose() {
        return format!("nothing holds the piece of {cells} at {place}");
    }
    let motions: Vec<String> = piece.motions.iter().map(ToString::to_string).collect();
    format!("the supports let the piece of {cells} at {place} {}", motions.join(" and "))
}
