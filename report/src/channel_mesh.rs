//! The mesh of the channel around a beam of another thickness.

use std::path::{Path, PathBuf};

use crate::task::{self, TaskError};

const MIDDLE: f64 = 3.0;
/// Half the thickness of the beam in the scene's mesh \[m\].
const HALF: f64 = 0.03;
const MESH: &str = "scenes/beam-in-channel/channel.msh";

/// Writes the scene's mesh to `folder`, with the beam's sides moved to its new `thickness` \[m\] and the channel on both
/// sides stretched linearly, and returns the file's path.
pub(crate) fn with_beam(root: &Path, folder: &Path, thickness: f64) -> Result<PathBuf, TaskError> {
    let text = task::read(&root.join(MESH))?;
    let moved = moved(&text, thickness / 2.0)
        .ok_or_else(|| TaskError::Failed(format!("{MESH}: no mesh of format 4.1 in text")))?;
    let path = folder.join(format!("channel-{thickness}.msh"));
    task::write(&path, &moved)?;
    Ok(path)
}

/// Piecewise linear in x; ends of the channel and the middle stay.
fn stretched(x: f64, half: f64) -> f64 {
    let distance = (x - MIDDLE).abs();
    let moved = if distance <= HALF {
        distance * half / HALF
    } else {
        MIDDLE - (MIDDLE - distance) * (MIDDLE - half) / (MIDDLE - HALF)
    };
    // Round-off would move the sides off the beam by an ulp; the file looks better without.
    ((MIDDLE + moved.copysign(x - MIDDLE)) * 1e12).round() / 1e12
}

/// Moves the nodes of a mesh file; all other lines stay.
fn moved(text: &str, half: f64) -> Option<String> {
    let (before, rest) = text.split_once("$Nodes\n")?;
    let (nodes, after) = rest.split_once("$EndNodes")?;
    let mut lines = nodes.lines();
    let mut out = format!("{}\n", lines.next()?);
    // Blocks: a line that ends in the number of nodes, their tags, their coordinates.
    while let Some(head) = lines.next() {
        out += &format!("{head}\n");
        let count: usize = head.split_whitespace().last()?.parse().ok()?;
        for _ in 0..count {
            out += &format!("{}\n", lines.next()?);
        }
        for _ in 0..count {
            let (x, others) = lines.next()?.split_once(' ')?;
            out += &format!("{} {others}\n", stretched(x.parse().ok()?, half));
        }
    }
    Some(format!("{before}$Nodes\n{out}$EndNodes{after}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sides_move_and_the_ends_stay() {
        for (x, expected) in [(0.0, 0.0), (2.97, 2.96), (3.0, 3.0), (3.03, 3.04), (6.0, 6.0), (3.015, 3.02)] {
            assert!((stretched(x, 0.04) - expected).abs() < 1e-14, "{x}");
        }
    }

    #[test]
    fn only_first_coordinates_of_nodes_change() {
        let text = "$Entities\n3.03 0\n$EndEntities\n$Nodes\n1 2 1 2\n0 1 0 2\n1\n2\n3.03 1 0\n6 3.03 0\n$EndNodes\n$Elements\n";
        let expected = text.replace("3.03 1 0", "3.04 1 0");
        assert_eq!(moved(text, 0.04).expect("a mesh"), expected);
        assert!(moved("$Nodes\n1 1 1 1\n0 1 0 1\n1\n", 0.04).is_none());
    }
}
