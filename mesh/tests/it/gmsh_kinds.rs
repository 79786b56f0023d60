//! Every kind of element and group, and what else gmsh writes: each in all versions and encodings.

use std::path::Path;

use partita_mesh::gmsh::{ElementBlock, ElementKind, Fault, GmshFile, GroupName};
use partita_mesh::quality::measures;

use crate::gmsh::{PRISM_4_TEXT, parse};

const FORMATS: [&str; 4] = ["2.2-ascii", "2.2-binary", "4.1-ascii", "4.1-binary"];

/// A file of the folder of fixtures.
pub(crate) fn fixture(stem: &str, format: &str) -> Vec<u8> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data");
    std::fs::read(folder.join(format!("{stem}-{format}.msh"))).expect("a fixture")
}

/// What all four files of a mesh hold.
fn common(stem: &str) -> GmshFile {
    let [first, others @ ..] = FORMATS.map(|format| parse(&fixture(stem, format)));
    for (file, format) in others.iter().zip(&FORMATS[1..]) {
        assert_eq!(*file, first, "{stem}-{format}");
    }
    first
}

/// Kind, groups and number of elements of each block.
fn blocks(file: &GmshFile) -> Vec<(ElementKind, &[u64], usize)> {
    file.blocks.iter().map(|block| (block.kind, &block.groups[..], block.len())).collect()
}

#[test]
fn points_lines_triangles_and_quadrilaterals_keep_their_groups() {
    use ElementKind::{Line2, Line3, Point1, Quadrilateral4, Quadrilateral8, Quadrilateral9};
    use ElementKind::{Triangle3, Triangle6};
    for (stem, line, triangle, quadrilateral) in [
        ("mixed", Line2, Triangle3, Quadrilateral4),
        ("mixed-second-order", Line3, Triangle6, Quadrilateral9),
        ("mixed-incomplete", Line3, Triangle6, Quadrilateral8),
    ] {
        let file = common(stem);
        let expected: [(_, &[u64], _); 6] = [
            (Point1, &[21], 1),
            (Point1, &[22], 2),
            (line, &[3], 3),
            (line, &[3000], 1),
            (triangle, &[40], 4),
            (quadrilateral, &[3], 2),
        ];
        assert_eq!(blocks(&file), expected, "{stem}");
        let probe = GroupName { dimension: 0, tag: 21, name: "probe".into() };
        assert_eq!((file.names.len(), &file.names[0]), (5, &probe));
        assert_eq!(file.group_name(0, 22), "group-22");
        assert_eq!((&*file.group_name(1, 3), &*file.group_name(2, 3)), ("bottom", "quadrilaterals"));
        let node = file.blocks[0].nodes[0];
        assert_eq!(file.points[node..=node], [[2.0, 1.0, 0.0]], "the probe's place");
    }
}

/// The nodes of second order stand in the middle of the corners that gmsh's manual puts them between.
#[test]
fn second_order_nodes_come_in_the_order_of_the_manual() {
    let triangle = [[0, 1], [1, 2], [2, 0]];
    let quadrilateral = [[0, 1], [1, 2], [2, 3], [3, 0]];
    let tetrahedron = [[0, 1], [1, 2], [2, 0], [3, 0], [3, 2], [3, 1]];
    let cases: [(_, _, usize, &[[usize; 2]]); 6] = [
        ("mixed-second-order", ElementKind::Line3, 2, &[[0, 1]]),
        ("mixed-second-order", ElementKind::Triangle6, 3, &triangle),
        ("mixed-second-order", ElementKind::Quadrilateral9, 4, &quadrilateral),
        ("mixed-incomplete", ElementKind::Quadrilateral8, 4, &quadrilateral),
        ("prism-second-order", ElementKind::Triangle6, 3, &triangle),
        ("prism-second-order", ElementKind::Tetrahedron10, 4, &tetrahedron),
    ];
    for (stem, kind, corners, edges) in cases {
        let file = common(stem);
        assert!(file.count(kind) > 0, "{stem} has no {kind}");
        for nodes in file.blocks.iter().filter(|block| block.kind == kind).flat_map(ElementBlock::elements) {
            for (edge, &middle) in edges.iter().zip(&nodes[corners..]) {
                let [a, b] = edge.map(|corner| file.points[nodes[corner]]);
                for i in 0..3 {
                    // The files hold six decimals.
                    let off = file.points[middle][i] - f64::midpoint(a[i], b[i]);
                    assert!(off.abs() < 1.1e-6, "{stem}: a middle of a {kind} is off by {off:e}");
                }
            }
        }
    }
}

#[test]
fn tetrahedra_of_second_order_are_as_many_as_of_first() {
    let (first, second) = (parse(PRISM_4_TEXT), common("prism-second-order"));
    assert_eq!(second.count(ElementKind::Tetrahedron10), first.count(ElementKind::Tetrahedron4));
    assert_eq!(second.names, first.names);
    let groups = |file: &GmshFile| file.blocks.iter().map(|block| block.groups.clone()).collect::<Vec<_>>();
    assert_eq!(groups(&second), groups(&first));
}

#[test]
fn periodicity_and_results_behind_the_mesh_are_passed_over() {
    for format in FORMATS {
        let file = fixture("mixed", format);
        for section in ["$Periodic", "$InterpolationScheme", "$NodeData", "$ElementData"] {
            let mark = [section.as_bytes(), b"\n"].concat();
            assert!(file.windows(mark.len()).any(|window| window == mark), "mixed-{format}: {section}");
        }
        let end = b"$EndElements\n";
        let place = file.windows(end.len()).position(|window| window == end).expect("elements") + end.len();
        assert_eq!(parse(&file[..place]), parse(&file), "mixed-{format}");
    }
}

#[test]
fn nodes_with_parameters_of_format_4_are_read() {
    for format in ["4.1-ascii", "4.1-binary"] {
        assert_eq!(parse(&fixture("prism-parametric", format)), parse(PRISM_4_TEXT), "{format}");
    }
    let error = GmshFile::parse(&fixture("prism-parametric", "2.2-ascii")).expect_err("parameters in 2.2");
    assert_eq!(error.fault, Fault::ParametricNodes);
}

#[test]
fn partitions_are_passed_over_in_format_2_and_refused_in_format_4() {
    let whole = parse(PRISM_4_TEXT);
    for format in ["2.2-ascii", "2.2-binary"] {
        let file = parse(&fixture("prism-partitioned", format));
        assert_eq!(sorted(&file), sorted(&whole), "gmsh gives other numbers to the same nodes");
        assert_eq!(blocks(&file), blocks(&whole));
        let mesh = file.into_mesh::<3>().expect("a prism");
        assert!((measures(mesh.points(), mesh.cells()).iter().sum::<f64>() - 0.5).abs() < 1e-14);
    }
    for format in ["4.1-ascii", "4.1-binary"] {
        let error = GmshFile::parse(&fixture("prism-partitioned", format)).expect_err("partitions");
        assert_eq!(error.fault, Fault::Partitioned);
    }
}

fn sorted(file: &GmshFile) -> Vec<[f64; 3]> {
    let mut points = file.points.clone();
    points.sort_by(|a, b| a.partial_cmp(b).expect("finite coordinates"));
    points
}

#[test]
fn tags_with_gaps_give_the_same_mesh() {
    let [text_2, binary_2, text_4, binary_4] = FORMATS.map(|format| parse(&fixture("gaps", format)));
    assert_eq!(text_4.node_tags, [70, 5, 2_000_000_000, 3]);
    assert_eq!(binary_4, text_4);
    // Into format 2.2 gmsh writes tags without gaps.
    assert_eq!(text_2.node_tags, [1, 2, 3, 4]);
    assert_eq!(binary_2, text_2);
    let mesh = text_4.into_mesh::<2>().expect("two triangles");
    assert_eq!(text_2.into_mesh::<2>().expect("two triangles"), mesh);
    assert_eq!(mesh.group_nodes("bottom"), Some(vec![2, 3]));
}

#[test]
fn every_text_file_is_read_alike_with_carriage_returns() {
    for stem in ["mixed", "mixed-second-order", "prism", "prism-second-order", "gaps"] {
        for format in ["2.2-ascii", "4.1-ascii"] {
            let plain = fixture(stem, format);
            let windows = String::from_utf8(plain.clone()).expect("text").replace('\n', "\r\n");
            assert_eq!(parse(windows.as_bytes()), parse(&plain), "{stem}-{format}");
        }
    }
}
