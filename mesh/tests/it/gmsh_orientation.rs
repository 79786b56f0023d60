//! Meshes that were drawn clockwise are turned round, whatever they consist of.

use partita_mesh::gmsh::{ConvertError, GmshFile};
use partita_mesh::quality::measures;
use partita_mesh::{Mesh, SolidMesh};
use partita_testing::with_hint;

use crate::gmsh::{PLATE_4_TEXT, PRISM_4_TEXT, SECOND_ORDER, parse};
use crate::gmsh_kinds::fixture;

/// The file seen in a mirror: all its cells run the other way.
fn mirrored(mut file: GmshFile) -> GmshFile {
    file.points.iter_mut().for_each(|point| point[0] = -point[0]);
    file
}

fn signs<const D: usize>(mesh: &Mesh<D>) -> Vec<f64> {
    let mut all = measures(mesh.points(), mesh.cells());
    all.sort_by(f64::total_cmp);
    all
}

#[test]
fn a_mesh_that_is_all_clockwise_is_turned_round() {
    let (plain, mirror) = (parse(PLATE_4_TEXT), mirrored(parse(PLATE_4_TEXT)));
    assert_eq!((plain.is_inverted(2), mirror.is_inverted(2)), (false, true));
    let (plain, mirror) =
        (plain.into_mesh::<2>().expect("a plate"), mirror.into_mesh::<2>().expect("a plate"));
    assert!(signs(&plain).iter().zip(signs(&mirror)).all(|(a, b)| *a > 0.0 && (a - b).abs() < 1e-15));
    for (group, other) in plain.groups().iter().zip(mirror.groups()) {
        assert_eq!((&group.name, group.facets.len()), (&other.name, other.facets.len()));
        for facet in &other.facets {
            let [normal, centre] = [facet.normal(mirror.points()), facet.centroid(mirror.points())];
            let outwards = match &*group.name {
                "inflow" => normal[0],
                "outflow" => -normal[0],
                "top" => normal[1],
                "bottom" => -normal[1],
                // Out of the plate is into the hole, whose centre is (-0.5, 0.5).
                _ => (-0.5 - centre[0]) * normal[0] + (0.5 - centre[1]) * normal[1],
            };
            assert!(outwards > 0.0, "{}: {normal:?} at {centre:?}", group.name);
        }
    }
    let prism = mirrored(parse(PRISM_4_TEXT));
    assert!(prism.is_inverted(3) && !parse(PRISM_4_TEXT).is_inverted(3));
    assert!((signs(&prism.into_mesh::<3>().expect("a prism")).iter().sum::<f64>() - 0.5).abs() < 1e-14);
}

/// The area under the shape functions themselves, so that nodes on the edges count.
fn area(mesh: &SolidMesh<2>) -> f64 {
    let rule = partita_mesh::solid::reference::quadrature(mesh.cells().kind);
    let cells = 0..mesh.cells().len();
    cells.flat_map(|cell| rule.iter().map(move |&(xi, weight)| (cell, xi, weight))).fold(
        0.0,
        |sum, (cell, xi, weight)| {
            let [[a, b], [c, d]] = mesh.map(cell, xi).jacobian;
            sum + weight * (a * d - b * c)
        },
    )
}

#[test]
fn solid_cells_of_every_kind_are_turned_round() {
    let files = [
        parse(PLATE_4_TEXT),
        parse(SECOND_ORDER),
        parse(&fixture("plate-quadrilaterals", "4.1-ascii")),
        parse(&fixture("plate-quadrilaterals-8", "2.2-ascii")),
        parse(&fixture("plate-quadrilaterals-9", "4.1-binary")),
    ];
    for file in files {
        let mirror = mirrored(file.clone());
        assert!(mirror.is_inverted(2) && !file.is_inverted(2));
        let (plain, mirror) = (
            file.into_solid_mesh().expect("a plate"),
            mirror.into_solid_mesh().expect("a plate in the mirror"),
        );
        let kind = plain.cells().kind;
        assert_eq!((mirror.cells().kind, mirror.cells().len()), (kind, plain.cells().len()));
        assert!((area(&plain) - area(&mirror)).abs() < 1e-13, "{kind:?}");
        // Each cell has its nodes, and each group its edges, now in the other direction.
        let sorted = |nodes: &[usize]| {
            let mut nodes = nodes.to_vec();
            nodes.sort_unstable();
            nodes
        };
        for (cell, other) in plain.cells().iter().zip(mirror.cells()) {
            assert_eq!((cell[0], sorted(cell)), (other[0], sorted(other)), "{kind:?}");
        }
        for (group, other) in plain.groups().iter().zip(mirror.groups()) {
            for (edge, turned) in group.edges.iter().zip(&other.edges) {
                assert_eq!(
                    (edge[0], edge[1], edge.get(2)),
                    (turned[1], turned[0], turned.get(2)),
                    "{kind:?}"
                );
            }
        }
    }
}

#[test]
fn a_mesh_of_both_orientations_is_refused_with_a_place_and_a_way_out() {
    let mut few = parse(PLATE_4_TEXT);
    let cells = few.blocks.last_mut().expect("triangles");
    cells.nodes[30..33].swap(0, 1);
    let place = |error: &ConvertError| match error {
        ConvertError::Orientation { fewer, cells, place, .. } => (*fewer, *cells, place.clone()),
        other => panic!("{other}"),
    };
    assert!(!few.is_inverted(2));
    let error = few.clone().into_mesh::<2>().expect_err("one clockwise cell");
    insta::assert_snapshot!(with_hint(&error), @r#"
    1 of 50 cells are oriented against the others, the first at (0.359296, 0.0538927) m
    hint: if cells overlap, remesh; else turn the clockwise ones in Python (`pip install gmsh`):
    import gmsh
    gmsh.initialize(); gmsh.open("old.msh"); mesh = gmsh.model.mesh
    cells = mesh.getElementsByType(2)[0]
    z = mesh.getJacobians(2, [0, 0, 0])[0][8::9]
    mesh.reverseElements([cell for cell, up in zip(cells, z) if up < 0])
    gmsh.write("new.msh")
    "#);
    // In the mirror one cell is the right way round: it is the odd one, in the same place.
    let mirror = mirrored(few).into_mesh::<2>().expect_err("one counter-clockwise cell");
    let ((fewer, all, here), (fewer_there, all_there, there)) = (place(&error), place(&mirror));
    assert_eq!((fewer, all, fewer_there, all_there), (1, 50, 1, 50));
    assert!((here.0[0] + there.0[0]).abs() < 1e-15 && (here.0[1] - there.0[1]).abs() < 1e-15);

    let mut quadrilaterals = parse(&fixture("plate-quadrilaterals-9", "4.1-binary"));
    let nodes = &mut quadrilaterals.blocks.last_mut().expect("cells").nodes;
    nodes.swap(1, 3);
    nodes.swap(4, 7);
    nodes.swap(5, 6);
    let message = with_hint(&quadrilaterals.into_solid_mesh().expect_err("one clockwise cell"));
    assert!(message.starts_with("1 of ") && message.contains("getElementsByType(10)"), "{message}");
}
