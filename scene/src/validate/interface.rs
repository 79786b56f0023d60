//! Whether fluid and structure meet: the same place, the same unit, the same corners.

mod facing;
mod wetted;

use partita_mesh::facet::Facet;
use partita_mesh::mesh::facet_nodes;
use partita_mesh::{Mesh, Place};
use partita_structure::{Boundary, Space};

use crate::check::Check;
use crate::finding::Finding;
use crate::models;
use crate::schema::{Condition, Coupling, Fluid, Scene, Structure};
use crate::shapes::Shapes;
use facing::Inside;
use wetted::Wetted;

/// The interface of both fields.
pub(super) fn check(check: &mut Check<'_>, scene: &Scene, shapes: &Shapes) {
    let (Some(fluid), Some(structure), Some(coupling)) = (&scene.fluid, &scene.structure, &scene.coupling)
    else {
        return;
    };
    let (Some(mesh), Some(space)) = (&shapes.fluid, &shapes.structure) else { return };
    let Some(meeting) = Meeting::new(fluid, structure, coupling, mesh, space) else { return };
    if let Some(finding) = meeting.other_unit(check).or_else(|| meeting.apart(check)) {
        check.add(finding);
    } else if let Some(finding) = meeting.corner_without_node(check) {
        check.add(finding);
    } else if let Some(finding) =
        meeting.on_one_side(check, mesh, space).or_else(|| meeting.covered(check, mesh, space))
    {
        check.add(finding);
    }
}

/// Nodes of the fluid's interface and the parts of the structure that they should lie on.
struct Meeting<'a> {
    /// A group that is the interface.
    group: &'a str,
    facets: Vec<Facet<2>>,
    nodes: Vec<[f64; 2]>,
    parts: Boundary,
    wetted: Wetted,
    /// Largest distance between them \[m\].
    tolerance: f64,
}

/// Ratios of one length unit to another that people mix up, and their names.
const UNITS: [(f64, &str, &str); 4] = [
    (1e3, "millimetres", "metres"),
    (1e2, "centimetres", "metres"),
    (10.0, "millimetres", "centimetres"),
    (25.4, "millimetres", "inches"),
];

impl<'a> Meeting<'a> {
    fn new(
        fluid: &'a Fluid,
        structure: &Structure,
        coupling: &Coupling,
        mesh: &Mesh<2>,
        space: &Space<2>,
    ) -> Option<Self> {
        let interface = || fluid.boundary.iter().filter(|(_, condition)| **condition == Condition::Interface);
        let groups = interface().filter_map(|(name, _)| mesh.group(name));
        let facets: Vec<_> = groups.flat_map(|group| &group.facets).copied().collect();
        let nodes: Vec<_> = facet_nodes(&facets).into_iter().map(|node| mesh.points()[node]).collect();
        let (group, _) = interface().next()?;
        let parts = models::boundary(space, &structure.wetted);
        if nodes.is_empty() || parts.is_empty() {
            return None;
        }
        let tolerance = coupling.projection_tolerance.get() * diagonal(&nodes);
        let wetted = Wetted::new(space, &parts, &nodes)?;
        Some(Self { group, facets, nodes, parts, wetted, tolerance })
    }

    /// Both have the same shape, but one is as many times larger as one unit of length is than another.
    fn other_unit(&self, check: &Check<'_>) -> Option<Finding> {
        let (fluid, structure) = (diagonal(&self.nodes), diagonal(&self.wetted.places));
        let ratio = (fluid / structure).max(structure / fluid);
        let (_, small, large) = UNITS.into_iter().find(|(factor, ..)| (ratio / factor - 1.0).abs() < 0.1)?;
        let (coarse, fine) = if fluid > structure { ("fluid", "structure") } else { ("structure", "fluid") };
        let lengths = |length: f64| Place(vec![length]).to_string().replace(['(', ')'], "");
        Some(
            Finding::new(format!(
                "the fluid's interface is {} across and the structure's {}: one of them is in {small}, the other in {large}",
                lengths(fluid),
                lengths(structure),
            ))
            .mark_if(check.value(&["fluid", "mesh"]), "the fluid's mesh")
            .mark_if(check.value(&["structure", "geometry"]), "the structure's geometry")
            .hint(format!(
                "give all lengths in metres: either the {coarse} is too large or the {fine} too small; \
                 `fluid.mesh.gmsh.scale = 0.001` reads a mesh in millimetres"
            )),
        )
    }

    /// Nodes off the parts: their load would have no place to go.
    fn apart(&self, check: &Check<'_>) -> Option<Finding> {
        let off = self.wetted.gaps.iter().filter(|(_, distance)| *distance > self.tolerance).count();
        let gaps = self.nodes.iter().zip(&self.wetted.gaps);
        let (node, (part, distance)) = gaps.max_by(|(_, (_, a)), (_, (_, b))| a.total_cmp(b))?;
        if off == 0 {
            return None;
        }
        Some(
            Finding::new(format!(
                "{off} of {} interface nodes of the fluid lie off the structure, the farthest, {}, by {distance:.3e} m from `{part}`",
                self.nodes.len(),
                Place::from(*node),
            ))
            .mark_if(check.value(&["fluid", "boundary", self.group]), "the fluid's side of it")
            .mark_if(check.value(&["structure", "wetted"]), "the structure's side of it")
            .hint(format!(
                "loads and displacements pass between points that coincide (here within {:.1e} m): compare the two \
                 boundaries in place and shape, name every wetted part, or raise `coupling.projection_tolerance`",
                self.tolerance
            )),
        )
    }

    /// Edges that have the structure on the side of the fluid.
    fn on_one_side(&self, check: &Check<'_>, mesh: &Mesh<2>, space: &Space<2>) -> Option<Finding> {
        let size = diagonal(&self.nodes);
        let Inside { count, place, part } =
            facing::inside(&self.facets, mesh.points(), space, &self.parts, size)?;
        Some(
            Finding::new(format!(
                "at {} fluid and structure lie on the same side of the interface: `{part}` is wetted from inside the structure",
                Place::from(place),
            ))
            .mark_if(
                check.value(&["fluid", "boundary", self.group]),
                format!("{count} of {} edges", self.facets.len()),
            )
            .mark_if(check.value(&["structure", "wetted"]), "the outward normals are the same")
            .hint(
                "the interface separates the two: name the side of the structure that faces the fluid in `wetted`, and move \
                 the structure's geometry (or the fluid's mesh) so that this side lies on the fluid's boundary",
            ),
        )
    }

    /// A place that both fill.
    fn covered(&self, check: &Check<'_>, mesh: &Mesh<2>, space: &Space<2>) -> Option<Finding> {
        let place = facing::covered(mesh, space, &self.parts, self.tolerance)?;
        Some(
            Finding::new(format!("at {} the structure lies inside the fluid's mesh", Place::from(place)))
                .mark_if(check.value(&["structure", "geometry"]), "this geometry")
                .mark_if(check.value(&["fluid", "mesh"]), "overlaps this mesh")
                .hint("leave the place of the structure out of the fluid's mesh: a hole, or a boundary along all of it"),
        )
    }

    /// Ends of wetted parts without a node there: the fluid would cut the corner.
    fn corner_without_node(&self, check: &Check<'_>) -> Option<Finding> {
        let reach =
            |point: &[f64; 2]| self.nodes.iter().map(|node| distance(node, point)).fold(f64::MAX, f64::min);
        let mut gaps = self.wetted.ends.iter().map(|(part, point)| (part, point, reach(point)));
        let (part, corner, gap) = gaps.find(|(.., gap)| *gap > self.tolerance)?;
        Some(
            Finding::new(format!(
                "`{part}` of the structure ends at {}, where the fluid has no interface node; the nearest is {gap:.3e} m away",
                Place::from(*corner),
            ))
            .mark_if(check.value(&["structure", "wetted"]), "wetted up to its ends")
            .mark_if(check.value(&["fluid", "boundary", self.group]), "ends or bends elsewhere")
            .hint(
                "the fluid's boundary and the wetted parts must begin, bend and end in the same points: put a point of \
                 the .geo file there, or leave the part out of `wetted`",
            ),
        )
    }
}

/// Length of the diagonal of the bounding box \[m\].
fn diagonal(points: &[[f64; 2]]) -> f64 {
    let side = |c: usize| {
        let values = || points.iter().map(|point| point[c]);
        values().fold(f64::MIN, f64::max) - values().fold(f64::MAX, f64::min)
    };
    side(0).hypot(side(1))
}

fn distance(a: &[f64; 2], b: &[f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}
