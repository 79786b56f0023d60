//! Structures that can move as a whole, and structures that pull a wall's corner along.

use partita_fluid::FluidSolver;
use partita_iga::seam;
use partita_mesh::Place;
use partita_structure::{Space, StructureSolver, rigid};

use super::{Found, Kind};
use partita_scene::free::{HOLD, MOST_PIECES, in_words};
use partita_scene::schema::{Component, Condition, Fluid, Structure};

/// Pieces that the supports leave free to move as rigid bodies.
pub(super) fn pieces(found: &mut Found<'_>, structure: &Structure, solver: &StructureSolver<2>) {
    let space = solver.space();
    let held: Vec<bool> = (0..2 * space.node_count()).map(|dof| solver.is_held(dof / 2, dof % 2)).collect();
    let free = rigid::free_pieces(space, &held);
    let path = if structure.clamped.is_empty() && structure.held.is_empty() {
        &["structure"][..]
    } else {
        &["structure", "clamped"]
    };
    for piece in free.iter().take(MOST_PIECES) {
        let more = free.len().saturating_sub(MOST_PIECES);
        let others = if more > 0 { format!(" (and {more} more pieces)") } else { String::new() };
        let what = format!("{}{others}", in_words(piece));
        found.warn(Kind::FreeStructure, path, what, HOLD);
    }
}

/// A ring that was not quite closed.
pub(super) fn gap(found: &mut Found<'_>, solver: &StructureSolver<2>) {
    let Space::Patch(patch) = solver.space() else { return };
    let Some((parameter, gap)) = seam::narrow_gap(patch.spline(), patch.seams()) else { return };
    let [side, other] = if parameter == 0 { ["left", "right"] } else { ["bottom", "top"] };
    let what =
        format!("a gap of {gap:.1e} m keeps the sides `{side}` and `{other}` apart: they are not joined");
    let remedy = "let them coincide for a closed shape, or widen the gap";
    found.warn(Kind::OpenSeam, &["structure", "geometry"], what, remedy);
}

/// A node of the fluid on a fixed wall that the structure moves off that wall.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct DraggedCorner {
    /// The boundary group of the wall.
    pub(super) group: String,
    /// Where the corner is at rest \[m\].
    pub(super) place: [f64; 2],
    /// Outward normal of the wall.
    pub(super) normal: [f64; 2],
    /// Nodes of the structure that move it.
    pub(super) nodes: Vec<usize>,
}

/// The part of a motion that leads off a wall, below which it is not one: a wall that is drawn askew by round-off.
const OFF: f64 = 1e-3;

/// Corners between the interface and walls with a prescribed velocity where the structure is not held in the direction
/// normal to the wall. Along the wall a corner may move: the wall keeps its shape. Openings have no shape to keep.
pub(super) fn dragged_corners(
    conditions: &Fluid,
    fluid: &FluidSolver<2>,
    structure: &StructureSolver<2>,
) -> Vec<DraggedCorner> {
    let mesh = fluid.mesh();
    let mut corners = Vec::new();
    for (group, condition) in &conditions.boundary {
        let is_wall = match condition {
            Condition::NoSlip | Condition::Slip | Condition::Velocity(_) => true,
            Condition::Interface
            | Condition::WallMotion(_)
            | Condition::Traction(_)
            | Condition::DoNothing(_)
            | Condition::StressFree(_) => false,
        };
        let Some(wall) = mesh.group(group).filter(|_| is_wall) else { continue };
        for facet in &wall.facets {
            let normal = facet.normal(mesh.points());
            for node in facet.nodes.into_iter().filter(|node| fluid.interface_nodes().contains(node)) {
                let place = mesh.points()[node];
                let Ok(rows) = structure.interface_rows(&[place], f64::INFINITY) else { continue };
                let leaves =
                    |node: &usize| (0..2).any(|c| normal[c].abs() > OFF && !structure.is_held(*node, c));
                let nodes: Vec<usize> = rows[0].iter().map(|(node, _)| *node).filter(leaves).collect();
                if !nodes.is_empty() {
                    corners.push(DraggedCorner { group: group.clone(), place, normal, nodes });
                }
            }
        }
    }
    corners
}

/// Walls that the structure deforms.
pub(super) fn corners(
    found: &mut Found<'_>,
    conditions: &Fluid,
    fluid: &FluidSolver<2>,
    structure: &StructureSolver<2>,
) {
    for DraggedCorner { group, place, normal, nodes } in dragged_corners(conditions, fluid, structure) {
        let what = format!(
            "the structure moves the corner of the fixed wall `{group}` at {} off the wall",
            Place::from(place)
        );
        let component = match normal {
            [x, y] if y.abs() <= OFF * x.abs() => Some(Component::X),
            [x, y] if x.abs() <= OFF * y.abs() => Some(Component::Y),
            _ => None,
        };
        let part = end_at(structure, &nodes);
        let remedy = match (component, part) {
            (Some(component), Some(part)) => format!(
                "hold that end, `structure.held = {{ {part} = [\"{}\"] }}`, or name `{part}` in `clamped`",
                component.name()
            ),
            (Some(component), None) => format!(
                "hold the part of the structure that ends there in {} (`structure.held`), or clamp it",
                component.name()
            ),
            (None, _) => "clamp the part of the structure that ends there".to_owned(),
        };
        found.warn(Kind::DraggedCorner, &["fluid", "boundary", &group], what, remedy);
    }
}

/// A part of the structure's boundary that is not wetted and holds one of these nodes.
fn end_at(structure: &StructureSolver<2>, nodes: &[usize]) -> Option<String> {
    use partita_iga::Side;
    use partita_structure::Boundary;
    let wetted = &structure.model().wetted;
    match (structure.space(), wetted) {
        (Space::Patch(patch), Boundary::Sides(wetted)) => {
            let sides = [Side::LEFT, Side::RIGHT, Side::BOTTOM, Side::TOP];
            let ends = |side: &Side| {
                !wetted.contains(side)
                    && patch.side_nodes(*side).is_ok_and(|of_side| nodes.iter().any(|n| of_side.contains(n)))
            };
            sides.into_iter().find(ends).map(|side| side.to_string())
        }
        (Space::Lagrange(mesh), Boundary::Groups(wetted)) => {
            let ends = |name: &&str| {
                !wetted.iter().any(|other| other == name)
                    && mesh
                        .group_nodes(name)
                        .is_some_and(|of_group| nodes.iter().any(|n| of_group.contains(n)))
            };
            mesh.groups().iter().map(|group| group.name.as_str()).find(ends).map(str::to_owned)
        }
        (Space::Patch(_), Boundary::Groups(_)) | (Space::Lagrange(_), Boundary::Sides(_)) => None,
    }
}
