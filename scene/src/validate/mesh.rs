//! Whether the fluid's mesh is one piece, all of its boundary is spoken for, and its points lie where the scene looks.

use partita_mesh::simplex;
use partita_mesh::{Mesh, Place};

use super::{fluid as conditions, groups};
use crate::check::Check;
use crate::finding::Finding;
use crate::schema::{Fluid, FluidMesh, Line, Probe, Real, Scene};
use crate::shapes::Content;

/// The fluid's mesh against what the scene says about it.
pub(super) fn check(
    check: &mut Check<'_>,
    scene: &Scene,
    fluid: &Fluid,
    mesh: &Mesh<2>,
    file: Option<&Content>,
) {
    if matches!(fluid.mesh, FluidMesh::Gmsh(_)) {
        let names: Vec<&str> = mesh.groups().iter().map(|group| group.name.as_str()).collect();
        let known = groups::check(check, scene, fluid, &names, file);
        if !uncovered(check, mesh) && known {
            conditions::complete(check, scene, fluid);
        }
    }
    pieces(check, mesh);
    for (name, probe) in &scene.output.probes {
        match probe {
            Probe::FluidValue(point) => {
                probed(check, mesh, &["output", "probes", name, "fluid_value"], point.map(Real::get));
            }
            Probe::FluidExtremes(Line { from, to }) => {
                for (key, end) in [("from", from), ("to", to)] {
                    let path = ["output", "probes", name, "fluid_extremes", key];
                    probed(check, mesh, &path, end.map(Real::get));
                }
            }
            _ => {}
        }
    }
}

/// Every edge of the boundary needs a condition, so it needs a group; tells whether one has none.
fn uncovered(check: &mut Check<'_>, mesh: &Mesh<2>) -> bool {
    let open = mesh.ungrouped_boundary();
    let Some(first) = open.first() else { return false };
    let place = Place::from(first.centroid(mesh.points()));
    let edges = if open.len() == 1 { "edge belongs" } else { "edges belong" };
    check.add(
        Finding::new(format!("{} boundary {edges} to no group of the mesh, the first at {place}", open.len()))
            .mark_if(check.value(&["fluid", "mesh"]), "this mesh")
            .mark_if(check.key(&["fluid", "boundary"]), "cannot say what holds there")
            .hint(
                "without a condition on every edge the equations are not closed: put the curve into a group in the \
                 .geo file, `Physical Curve(\"wall\") = {...};`, mesh again, and give the group a condition",
            ),
    );
    true
}

/// A fluid in two pieces is a mistake of the mesh: nothing carries a force or a flow from one to the other.
fn pieces(check: &mut Check<'_>, mesh: &Mesh<2>) {
    let pieces = components(mesh);
    let [first, second, ..] = &pieces[..] else { return };
    let place = Place::from(centroid(mesh, second.first));
    check.add(
        Finding::new(format!(
            "the mesh falls into {} parts that share no edge, of {} and {} triangles, the second at {place}",
            pieces.len(),
            first.cells,
            second.cells,
        ))
        .mark_if(check.value(&["fluid", "mesh"]), "this mesh")
        .hint(
            "the flow cannot pass from one part to the other: where surfaces meet, let them share their curves \
             (`Coherence;` or `BooleanFragments` in the .geo file), or leave the other part out",
        ),
    );
}

/// Cells that hang together by their edges.
struct Piece {
    first: usize,
    cells: usize,
}

fn components(mesh: &Mesh<2>) -> Vec<Piece> {
    let mut seen = vec![false; mesh.cells().len()];
    let mut pieces = Vec::new();
    let mut open = Vec::new();
    for start in 0..seen.len() {
        if std::mem::replace(&mut seen[start], true) {
            continue;
        }
        let mut piece = Piece { first: start, cells: 0 };
        open.push(start);
        while let Some(cell) = open.pop() {
            piece.cells += 1;
            for &next in mesh.topology().neighbours(cell).iter().flatten() {
                if !std::mem::replace(&mut seen[next], true) {
                    open.push(next);
                }
            }
        }
        pieces.push(piece);
    }
    pieces
}

fn centroid(mesh: &Mesh<2>, cell: usize) -> [f64; 2] {
    let vertices = simplex::vertices(mesh.points(), mesh.cells().cell(cell));
    simplex::centroid(&vertices[..3])
}

/// A value is probed at the nearest node, which must not be another place than the one meant.
fn probed(check: &mut Check<'_>, mesh: &Mesh<2>, path: &[&str], point: [f64; 2]) {
    if inside(mesh, point) {
        return;
    }
    check.add(
        Finding::new(format!("probe `{}` lies outside the fluid's mesh", path[2]))
            .mark_if(check.value(path), format!("no triangle holds {}", Place::from(point)))
            .hint("give a point [m] inside the undeformed mesh"),
    );
}

/// Whether a triangle holds the point; its edges are taken a little wider than they are.
fn inside(mesh: &Mesh<2>, point: [f64; 2]) -> bool {
    mesh.cells().iter().any(|nodes| {
        let [a, b, c] = [0, 1, 2].map(|i| mesh.points()[nodes[i]]);
        let area = cross(a, b, c);
        [(a, b), (b, c), (c, a)].into_iter().all(|(from, to)| cross(from, to, point) >= -1e-9 * area)
    })
}

/// Twice the signed area of the triangle a, b, c.
fn cross(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}
