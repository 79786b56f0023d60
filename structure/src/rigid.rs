//! Pieces of a plane structure that its supports let move without deforming.
//!
//! Cells that share an edge, or two nodes in another way, move as one rigid body; a node that two bodies share is a hinge
//! between them. A rigid body moves by `u(x) = t + omega e_z x (x - c)`. Supports and hinges are linear equations for the
//! `t` and `omega` of all bodies; what their null space lets a body do is what nothing but inertia holds.

mod bodies;
mod equations;

use std::fmt;

use partita_mesh::Place;

use crate::space::Space;
use bodies::Body;
use equations::Equations;

/// A piece of a structure that can move without deforming.
#[derive(Debug, Clone, PartialEq)]
pub struct FreePiece {
    /// Number of its cells, or elements of a patch.
    pub cells: usize,
    /// Middle of its nodes `[m]`.
    pub place: [f64; 2],
    /// Independent motions that nothing holds, translations first; at least one.
    pub motions: Vec<RigidMotion>,
}

impl FreePiece {
    /// Whether nothing holds the piece at all.
    #[must_use]
    pub fn is_loose(&self) -> bool {
        self.motions.len() == 3
    }
}

/// A motion without deformation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RigidMotion {
    /// In this direction, a unit vector.
    Translation([f64; 2]),
    /// About this point `[m]`.
    Rotation([f64; 2]),
}

impl fmt::Display for RigidMotion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Translation([_, 0.0]) => f.write_str("move in x"),
            Self::Translation([0.0, _]) => f.write_str("move in y"),
            Self::Translation([x, y]) => write!(f, "move along ({x:.3}, {y:.3})"),
            Self::Rotation(centre) => write!(f, "turn about {}", Place::from(*centre)),
        }
    }
}

/// Part of a piece's size below which a number is round-off.
const ROUND_OFF: f64 = 1e-9;

/// The pieces of a structure that can move without deforming, in the order of their cells; `held` says which dofs
/// `node * 2 + c` do not move, see [`Space::held_dofs`].
///
/// # Panics
/// When `held` does not have two entries a node.
///
/// ```
/// use partita_iga::{Side, build};
/// use partita_structure::{Boundary, Held, Space, rigid};
///
/// let space = Space::from(build::rectangle([0.0; 2], [2.0, 1.0], [1, 1], [2, 1])?);
/// let roller = Held { parts: Side::BOTTOM.into(), components: [false, true] };
/// let held = space.held_dofs(&Boundary::NONE, &[roller])?;
/// let free = rigid::free_pieces(&space, &held);
/// assert_eq!(free[0].motions, [rigid::RigidMotion::Translation([1.0, 0.0])]);
///
/// let held = space.held_dofs(&Side::LEFT.into(), &[])?;
/// assert!(rigid::free_pieces(&space, &held).is_empty());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn free_pieces(space: &Space<2>, held: &[bool]) -> Vec<FreePiece> {
    assert_eq!(held.len(), space.node_count() * 2, "two components a node");
    let bodies = bodies::of(space);
    let mut free: Vec<(usize, FreePiece)> = Vec::new();
    for assembly in bodies::assemblies(&bodies, space.node_count()) {
        let equations = Equations::new(&assembly, space.points(), held);
        for (body, motion) in assembly.iter().zip(equations.motions()) {
            let motions = motions(body, space.points(), &motion);
            if !motions.is_empty() {
                free.push((
                    body.first_cell,
                    FreePiece {
                        cells: body.cells,
                        place: snapped(body.centre(space.points()), body.size(space.points())),
                        motions,
                    },
                ));
            }
        }
    }
    free.sort_by_key(|(first, _)| *first);
    free.into_iter().map(|(_, piece)| piece).collect()
}

/// A place without coordinates that are round-off.
fn snapped(place: [f64; 2], size: f64) -> [f64; 2] {
    place.map(|x| if x.abs() > ROUND_OFF * size { x } else { 0.0 })
}

/// Translations and a rotation that span `basis`: vectors `(t_x, t_y, omega size)` about the body's centre.
fn motions(body: &Body, points: &[[f64; 2]], basis: &[[f64; 3]]) -> Vec<RigidMotion> {
    let turning = basis.iter().copied().max_by(|a, b| a[2].abs().total_cmp(&b[2].abs()));
    let turning = turning.filter(|v| v[2].abs() > ROUND_OFF).map(|v| v.map(|x| x / v[2]));
    // Without the turning one, the others only translate.
    let mut translations: Vec<[f64; 2]> = Vec::new();
    for v in basis {
        let turn = turning.unwrap_or_default();
        let mut t = [v[0] - v[2] * turn[0], v[1] - v[2] * turn[1]];
        for known in &translations {
            let along = known[0] * t[0] + known[1] * t[1];
            t = [t[0] - along * known[0], t[1] - along * known[1]];
        }
        let length = t[0].hypot(t[1]);
        if length > ROUND_OFF {
            translations.push(t.map(|x| if x.abs() > ROUND_OFF * length { x / length } else { 0.0 }));
        }
    }
    if translations.len() == 2 {
        translations = vec![[1.0, 0.0], [0.0, 1.0]];
    }
    let rotation = turning.map(|v| {
        let mut t = [v[0], v[1]];
        for known in &translations {
            let along = known[0] * t[0] + known[1] * t[1];
            t = [t[0] - along * known[0], t[1] - along * known[1]];
        }
        // u(x) = t + omega e_z x (x - c) vanishes at the centre of rotation.
        let (centre, size) = (body.centre(points), body.size(points));
        RigidMotion::Rotation(snapped([centre[0] - t[1] * size, centre[1] + t[0] * size], size))
    });
    let positive = |[x, y]: [f64; 2]| if x < 0.0 || x == 0.0 && y < 0.0 { [-x, -y] } else { [x, y] };
    let translations =
        translations.into_iter().map(|t| RigidMotion::Translation(positive(t).map(|x| x + 0.0)));
    translations.chain(rotation).collect()
}
