//! Parts of a file, chosen by the names of its physical surfaces or volumes.

use std::fmt::Write;

use partita_mesh::gmsh::{ConvertError, GmshFile, PhysicalGroup};
use partita_mesh::{CellKind, Mesh};
use partita_testing::with_hint;

use crate::gmsh::parse;

/// Water over a plate: two triangles below, two quadrilaterals above, with a curve between them and one inside the water.
///
/// ```text
/// 5 --- 6 --- 7     plate  (quadrilaterals)
/// |     |     |
/// 3 --- 4 --- 8     wet
/// |  /  |  \  |
/// 1 --- 2 --- 9     water
/// ```
const TWO: &str = "$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
8
0 1 \"probe\"
1 1 \"wet\"
1 2 \"sides\"
1 3 \"floor\"
1 4 \"middle\"
1 5 \"top\"
2 1 \"water\"
2 2 \"plate\"
$EndPhysicalNames
$Nodes
9
1 0 0 0
2 1 0 0
3 0 1 0
4 1 1 0
5 0 2 0
6 1 2 0
7 2 2 0
8 2 1 0
9 2 0 0
$EndNodes
$Elements
18
1 15 2 1 1 4
2 1 2 1 1 3 4
3 1 2 1 1 4 8
4 1 2 2 2 1 3
5 1 2 2 2 9 8
6 1 2 2 2 3 5
7 1 2 2 2 8 7
8 1 2 3 3 1 2
9 1 2 3 3 2 9
10 1 2 4 4 2 4
11 1 2 5 5 5 6
12 1 2 5 5 6 7
13 2 2 1 1 1 2 4
14 2 2 1 1 1 4 3
15 2 2 1 1 2 9 4
16 2 2 1 1 9 8 4
17 3 2 2 2 3 4 6 5
18 3 2 2 2 4 8 7 6
$EndElements
";

fn two() -> GmshFile {
    parse(TWO.as_bytes())
}

fn groups(mesh: &Mesh<2>) -> Vec<(&str, usize)> {
    mesh.groups().iter().map(|group| (&*group.name, group.facets.len())).collect()
}

#[test]
fn each_part_has_its_cells_and_the_groups_at_its_boundary() {
    let water = two().part(2, &["water"]).expect("a part").into_mesh::<2>().expect("a mesh");
    assert_eq!((water.cells().len(), water.points().len()), (4, 6));
    // `middle` lies between two cells of the water, and `top` is elsewhere.
    assert_eq!(groups(&water), [("wet", 2), ("sides", 2), ("floor", 2)]);
    assert!(water.ungrouped_boundary().is_empty());
    let wet = &water.group("wet").expect("a group").facets;
    assert!(wet.iter().all(|facet| facet.normal(water.points())[1] > 0.0));

    let plate = two().part(2, &["plate"]).expect("a part").into_solid_mesh().expect("a solid");
    assert_eq!(
        (plate.cells().kind, plate.cells().len(), plate.points().len()),
        (CellKind::Quadrilateral4, 2, 6)
    );
    let names: Vec<_> = plate.groups().iter().map(|group| (&*group.name, group.edges.len())).collect();
    assert_eq!(names, [("wet", 2), ("sides", 2), ("top", 2)]);
}

#[test]
fn without_a_choice_a_file_must_leave_none() {
    let error = |file: GmshFile| file.part(2, &[] as &[&str]).expect_err("a choice is open");
    assert_eq!(
        error(two()),
        ConvertError::SeveralRegions { dimension: 2, groups: vec!["water".into(), "plate".into()] }
    );
    // One surface and cells outside of it.
    let bare = TWO.replace(" 3 2 2 2 ", " 3 2 0 2 ");
    let unassigned = ConvertError::Unassigned { dimension: 2, cells: 2, groups: vec!["water".into()] };
    assert_eq!(error(parse(bare.as_bytes())), unassigned);
    let water = parse(bare.as_bytes()).part(2, &["water"]).expect("a part").into_mesh::<2>().expect("a mesh");
    assert_eq!(groups(&water), [("wet", 2), ("sides", 2), ("floor", 2)]);
    // A surface with its cells once within and once outside of a group, and files without any surface, are whole.
    let mut twice = parse(crate::gmsh::PLATE_2_TEXT);
    let mut again = twice.blocks.last().expect("triangles").clone();
    again.groups.clear();
    twice.blocks.push(again);
    let whole = parse(crate::gmsh::PLATE_2_TEXT).into_mesh::<2>().expect("a plate");
    assert_eq!(twice.part(2, &[] as &[&str]).expect("one surface").into_mesh::<2>().expect("a plate"), whole);
    let mut none = parse(crate::gmsh::PLATE_2_TEXT);
    none.blocks.last_mut().expect("triangles").groups.clear();
    assert_eq!(none.part(2, &[] as &[&str]).expect("no surface").into_mesh::<2>().expect("a plate"), whole);
}

#[test]
fn a_choice_that_cannot_be_met_is_refused() {
    let mut all = String::new();
    let mut bare = two();
    bare.blocks.retain(|block| block.kind.dimension() < 2);
    for (file, name) in [(two(), "watr"), (two(), "wet"), (two(), ""), (bare, "water")] {
        let error = file.part(2, &["water", name][usize::from(name != "water")..]).expect_err(name);
        writeln!(all, "{}", with_hint(&error)).expect("strings grow");
    }
    writeln!(all, "{}", with_hint(&two().part(2, &[] as &[&str]).expect_err("two surfaces")))
        .expect("strings grow");
    let quadrilaterals =
        two().part(2, &["plate"]).expect("a part").into_mesh::<2>().expect_err("no triangles");
    writeln!(all, "{}", with_hint(&quadrilaterals)).expect("strings grow");
    insta::assert_snapshot!(all, @r"
    the file has no physical surface `watr` with elements
    hint: it has `water`, `plate`
    the file has no physical surface `wet` with elements
    hint: it has `water`, `plate`
    the file has no physical surface `` with elements
    hint: it has `water`, `plate`
    the file has no physical surface `water` with elements
    hint: it has no physical surfaces at all: choose none, and all its cells are taken
    the file has several physical surfaces: `water`, `plate`
    hint: choose those that make this mesh by their names
    the 4-node quadrilaterals of the file (2) cannot be used, only 3-node triangles
    hint: mesh without `Recombine Surface` and with Mesh.ElementOrder = 1
    ");
}

#[test]
fn parts_of_either_orientation_are_turned_each_for_itself() {
    let clockwise = TWO.replace("3 4 6 5", "3 5 6 4").replace("4 8 7 6", "4 6 7 8");
    let file = parse(clockwise.as_bytes());
    let water = file.clone().part(2, &["water"]).expect("a part");
    let plate = file.part(2, &["plate"]).expect("a part");
    assert_eq!((water.is_inverted(2), plate.is_inverted(2)), (false, true));
    let of_plain = two().part(2, &["plate"]).expect("a part").into_solid_mesh().expect("a solid");
    assert_eq!(plate.into_solid_mesh().expect("a solid"), of_plain);
}

#[test]
fn groups_are_listed_with_their_elements() {
    let listed: Vec<(usize, String, usize)> = two()
        .groups()
        .into_iter()
        .map(|PhysicalGroup { dimension, name, elements }| (dimension, name, elements))
        .collect();
    let expected = [
        (0, "probe", 1),
        (1, "wet", 2),
        (1, "sides", 4),
        (1, "floor", 2),
        (1, "middle", 1),
        (1, "top", 2),
        (2, "water", 4),
        (2, "plate", 2),
    ];
    assert_eq!(listed, expected.map(|(dimension, name, elements)| (dimension, name.to_owned(), elements)));
}

/// Two tetrahedra with a face between them, each a volume of its own.
const SPACE: &str = "$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
4
2 1 \"between\"
2 2 \"outside\"
3 1 \"left\"
3 2 \"right\"
$EndPhysicalNames
$Nodes
5
1 -1 0 0
2 0 0 0
3 0 1 0
4 0 0 1
5 1 0 0
$EndNodes
$Elements
5
1 2 2 1 1 2 3 4
2 2 2 2 2 1 2 3
3 2 2 2 2 5 2 3
4 4 2 1 1 1 2 3 4
5 4 2 2 2 5 3 2 4
$EndElements
";

#[test]
fn volumes_are_chosen_like_surfaces() {
    let file = parse(SPACE.as_bytes());
    assert!(matches!(
        file.clone().part(3, &[] as &[&str]),
        Err(ConvertError::SeveralRegions { dimension: 3, .. })
    ));
    for (name, towards) in [("left", 1.0), ("right", -1.0)] {
        let mesh = file.clone().part(3, &[name]).expect("a part").into_mesh::<3>().expect("a mesh");
        assert_eq!((mesh.cells().len(), mesh.groups().len()), (1, 2), "{name}");
        let between = mesh.group("between").expect("a group").facets[0];
        let along = between.normal(mesh.points())[0];
        assert!((along - towards).abs() < 1e-15, "{name}: {along}");
    }
    let both = file.part(3, &["left", "right"]).expect("all").into_mesh::<3>().expect("a mesh");
    let names: Vec<_> = both.groups().iter().map(|group| &*group.name).collect();
    assert_eq!(names, ["outside"], "the face between them is inside");
}
