//! Meshes of solids: from gmsh, from the generator, and where points lie in them.

use partita_mesh::generate::{SolidRectangle, solid_rectangle};
use partita_mesh::gmsh::GmshFile;
use partita_mesh::solid::reference;
use partita_mesh::vtu::{Encoding, VtuFile, write_vtu};
use partita_mesh::{CellKind, SolidMesh};

use crate::gmsh::{PLATE_4_TEXT, SECOND_ORDER};

pub(crate) const QUADRILATERALS_4: &[u8] = include_bytes!("../data/plate-quadrilaterals-4.1-ascii.msh");
pub(crate) const QUADRILATERALS_8: &[u8] = include_bytes!("../data/plate-quadrilaterals-8-2.2-ascii.msh");
pub(crate) const QUADRILATERALS_9: &[u8] = include_bytes!("../data/plate-quadrilaterals-9-4.1-binary.msh");

pub(crate) const KINDS: [CellKind; 5] = [
    CellKind::Triangle3,
    CellKind::Triangle6,
    CellKind::Quadrilateral4,
    CellKind::Quadrilateral8,
    CellKind::Quadrilateral9,
];

/// The plate with a hole from gmsh, in every kind of cells.
pub(crate) fn plates() -> Vec<SolidMesh<2>> {
    [PLATE_4_TEXT, SECOND_ORDER, QUADRILATERALS_4, QUADRILATERALS_8, QUADRILATERALS_9]
        .map(|file| GmshFile::parse(file).expect("a file from gmsh").into_solid_mesh().expect("a plate"))
        .into()
}

/// The unit square in n x n squares of any kind of cells, bent and with its inner nodes moved: edges are curved where
/// the kind can be.
pub(crate) fn bent_square(kind: CellKind, n: usize) -> SolidMesh<2> {
    let square = SolidRectangle { origin: [0.0; 2], size: [1.0; 2], divisions: [n, n] };
    let straight = solid_rectangle(&square, kind).expect("a square");
    let bend = |&[x, y]: &[f64; 2]| {
        [x + 0.1 * (3.0 * y).sin() * x * (1.0 - x), y + 0.15 * x * x + 0.05 * (4.0 * x).sin() * y]
    };
    straight.with_points(straight.points().iter().map(bend).collect()).expect("not folded")
}

fn area(mesh: &SolidMesh<2>) -> f64 {
    let rule = reference::quadrature(mesh.cells().kind);
    let of_cell = |cell| {
        rule.iter().map(move |&(xi, weight)| {
            let [[a, b], [c, d]] = mesh.map(cell, xi).jacobian;
            weight * (a * d - b * c)
        })
    };
    (0..mesh.cells().len()).flat_map(of_cell).sum()
}

#[test]
fn files_of_gmsh_make_solids_of_every_kind_with_their_named_boundaries() {
    let disc = std::f64::consts::PI * 0.2 * 0.2;
    for (mesh, kind) in plates().iter().zip(KINDS) {
        assert_eq!(mesh.cells().kind, kind);
        let names: Vec<&str> = mesh.groups().iter().map(|group| group.name.as_str()).collect();
        assert_eq!(names, ["bottom", "outflow", "top", "inflow", "hole"]);
        // Six straight edges make the hole a hexagon; a parabola misses the segment of an arc of 60 degrees by 5.1e-5 m^2.
        let bound = if kind.node_count() < 6 { 0.0218 } else { 3.05e-4 };
        let missing = area(mesh) - (1.0 - disc);
        assert!(missing.abs() < bound && missing.abs() > 1e-7, "{kind:?}: {missing}");
        for edge in &mesh.group("inflow").expect("a group").edges {
            let [start, end] = [edge[0], edge[1]].map(|node| mesh.points()[node]);
            assert!(start[1] > end[1], "the solid lies to the left of an edge that runs down");
        }
        let hole = mesh.group_nodes("hole").expect("a group");
        for &node in &hole {
            let [x, y] = mesh.points()[node];
            assert!(((x - 0.5).hypot(y - 0.5) - 0.2).abs() < 2e-6, "node {node} lies on the circle");
        }
        let around: usize = mesh.groups().iter().map(|group| group.edges.len()).sum();
        let nodes_of_edge = if kind.node_count() < 6 { 1 } else { 2 };
        assert_eq!(mesh.boundary_nodes().len(), around * nodes_of_edge, "two closed curves");
    }
}

#[test]
fn generated_rectangles_have_their_area_and_sides() {
    for kind in KINDS {
        let plate = SolidRectangle { origin: [1.0, -2.0], size: [3.0, 0.5], divisions: [4, 2] };
        let mesh = solid_rectangle(&plate, kind).expect("a plate");
        assert!((area(&mesh) - 1.5).abs() < 1e-14);
        let per_square = if reference::corner_count(kind) == 3 { 2 } else { 1 };
        assert_eq!(mesh.cells().len(), 8 * per_square);
        for (name, axis, at, edges) in
            [("left", 0, 1.0, 2), ("right", 0, 4.0, 2), ("bottom", 1, -2.0, 4), ("top", 1, -1.5, 4)]
        {
            assert_eq!(mesh.group(name).expect("a side").edges.len(), edges);
            for node in mesh.group_nodes(name).expect("a side") {
                assert!((mesh.points()[node][axis] - at).abs() < 1e-15, "{name}");
            }
        }
    }
}

#[test]
fn points_are_found_where_they_are_and_nodes_to_the_last_bit() {
    let meshes = plates().into_iter().chain(KINDS.map(|kind| bent_square(kind, 3)));
    for mesh in meshes {
        let kind = mesh.cells().kind;
        for cell in 0..mesh.cells().len() {
            for xi in [[0.2, 0.3], [0.01, 0.6], [0.98, 0.01]] {
                let place = mesh.map(cell, xi).place;
                let found = mesh.locate(&place).expect("inside");
                assert_eq!(found.cell, cell, "{kind:?}");
                assert!((0..2).all(|i| (found.xi[i] - xi[i]).abs() < 1e-9), "{kind:?}: {found:?}");
                let back = mesh.evaluate(found, mesh.points());
                assert!((0..2).all(|i| (back[i] - place[i]).abs() < 1e-14), "{kind:?}");
            }
        }
        for point in mesh.points() {
            let found = mesh.locate(point).expect("a node");
            let back = mesh.evaluate(found, mesh.points());
            assert_eq!(back.map(f64::to_bits), point.map(f64::to_bits));
        }
        assert_eq!(mesh.locate(&[3.0, 0.5]), None);
    }
    for plate in plates() {
        assert_eq!(plate.locate(&[0.5, 0.5]), None, "the middle of the hole");
        assert_eq!(plate.locate(&[0.5, -1e-3]), None, "below the plate");
    }
}

#[test]
fn viewers_get_the_kind_of_the_cells() {
    for (kind, vtk_id) in KINDS.into_iter().zip([5.0, 22.0, 9.0, 23.0, 28.0]) {
        let mesh = bent_square(kind, 2);
        let mut file = Vec::new();
        write_vtu(&mut file, mesh.points(), mesh.cells(), &[], &[], Encoding::Ascii).expect("memory");
        let file = VtuFile::parse(&String::from_utf8(file).expect("XML is text")).expect("a grid");
        assert_eq!(file.arrays["types"].values, vec![vtk_id; mesh.cells().len()]);
        assert_eq!(file.arrays["connectivity"].values.len(), mesh.cells().nodes.len());
    }
}
