//! Files written by gmsh itself are read alike, whatever their version and encoding.

use partita_mesh::gmsh::{ConvertError, ElementKind, Fault, GmshFile, Position, ReadError};
use partita_mesh::quality::measures;
use partita_mesh::{Facet, Mesh, MeshError};

pub(crate) const PLATE_2_TEXT: &[u8] = include_bytes!("../data/plate-with-hole-2.2-ascii.msh");
pub(crate) const PLATE_2_BINARY: &[u8] = include_bytes!("../data/plate-with-hole-2.2-binary.msh");
pub(crate) const PLATE_4_TEXT: &[u8] = include_bytes!("../data/plate-with-hole-4.1-ascii.msh");
pub(crate) const PLATE_4_BINARY: &[u8] = include_bytes!("../data/plate-with-hole-4.1-binary.msh");
pub(crate) const PRISM_2_TEXT: &[u8] = include_bytes!("../data/prism-2.2-ascii.msh");
pub(crate) const PRISM_2_BINARY: &[u8] = include_bytes!("../data/prism-2.2-binary.msh");
pub(crate) const PRISM_4_TEXT: &[u8] = include_bytes!("../data/prism-4.1-ascii.msh");
pub(crate) const PRISM_4_BINARY: &[u8] = include_bytes!("../data/prism-4.1-binary.msh");
pub(crate) const SECOND_ORDER: &[u8] = include_bytes!("../data/plate-second-order-4.1-binary.msh");

pub(crate) const ALL: [&[u8]; 9] = [
    PLATE_2_TEXT,
    PLATE_2_BINARY,
    PLATE_4_TEXT,
    PLATE_4_BINARY,
    PRISM_2_TEXT,
    PRISM_2_BINARY,
    PRISM_4_TEXT,
    PRISM_4_BINARY,
    SECOND_ORDER,
];

pub(crate) fn parse(bytes: &[u8]) -> GmshFile {
    GmshFile::parse(bytes).expect("a file from gmsh")
}

fn area<const D: usize>(mesh: &Mesh<D>) -> f64 {
    measures(mesh.points(), mesh.cells()).iter().sum()
}

#[test]
fn four_files_of_one_plate_are_read_identically() {
    let plate = parse(PLATE_4_TEXT);
    assert_eq!(parse(PLATE_2_TEXT), plate);
    assert_eq!(parse(PLATE_2_BINARY), plate);
    assert_eq!(parse(PLATE_4_BINARY), plate);
}

#[test]
fn four_files_of_one_prism_are_read_identically() {
    let prism = parse(PRISM_4_TEXT);
    assert_eq!(parse(PRISM_2_TEXT), prism);
    assert_eq!(parse(PRISM_2_BINARY), prism);
    assert_eq!(parse(PRISM_4_BINARY), prism);
}

#[test]
fn plate_has_its_area_and_its_named_boundaries() {
    let mesh = parse(PLATE_4_BINARY).into_mesh::<2>().expect("a plate of triangles");
    let groups: Vec<_> =
        mesh.groups().iter().map(|group| (group.name.as_str(), group.facets.len())).collect();
    assert_eq!(groups, [("bottom", 4), ("outflow", 4), ("top", 4), ("inflow", 4), ("hole", 6)]);
    assert_eq!(mesh.ungrouped_boundary(), []);
    // The hole is a regular hexagon in a circle of radius 0.2.
    let hexagon = 1.5 * 3.0_f64.sqrt() * 0.2 * 0.2;
    assert!((area(&mesh) - (1.0 - hexagon)).abs() < 1e-6, "area {}", area(&mesh));
    for facet in &mesh.group("inflow").expect("a group").facets {
        assert!(facet.normal(mesh.points())[0] < 0.0, "the inflow's normal points to the left");
    }
}

#[test]
fn prism_has_its_volume_and_a_group_without_a_name() {
    let mesh = parse(PRISM_2_BINARY).into_mesh::<3>().expect("a prism of tetrahedra");
    let names: Vec<_> = mesh.groups().iter().map(|group| group.name.as_str()).collect();
    assert_eq!(names, ["bottom", "top", "sides", "group-7"]);
    assert_eq!(mesh.ungrouped_boundary(), []);
    assert!((area(&mesh) - 0.5).abs() < 1e-14);
    let slanted = &mesh.group("group-7").expect("a group").facets;
    let face: f64 = slanted.iter().map(|facet: &Facet<3>| length(facet.area_vector(mesh.points()))).sum();
    assert!((face - 2.0_f64.sqrt()).abs() < 1e-14);
}

fn length(vector: [f64; 3]) -> f64 {
    vector.iter().map(|x| x * x).sum::<f64>().sqrt()
}

#[test]
fn second_order_and_both_dimensions_stay_in_the_document() {
    let file = parse(SECOND_ORDER);
    let first = parse(PLATE_4_TEXT);
    assert_eq!(file.count(ElementKind::Triangle6), first.count(ElementKind::Triangle3));
    assert_eq!(file.count(ElementKind::Line3), 22);
    let triangle = file.blocks.iter().find(|block| block.kind == ElementKind::Triangle6).expect("triangles");
    for nodes in triangle.elements() {
        let [a, b, middle] = [nodes[0], nodes[1], nodes[3]].map(|node| file.points[node]);
        // On the hole the middle lies on the arc, a little off the chord.
        assert!((0..2).all(|i| (f64::midpoint(a[i], b[i]) - middle[i]).abs() < 0.03));
    }
}

#[test]
fn text_with_carriage_returns_is_read_alike() {
    for text in [PLATE_2_TEXT, PLATE_4_TEXT] {
        let text = str::from_utf8(text).expect("text").replace('\n', "\r\n");
        assert_eq!(parse(text.as_bytes()), parse(PLATE_4_TEXT));
    }
}

#[test]
fn sections_that_are_not_needed_are_leapt_over() {
    let text = str::from_utf8(PLATE_4_TEXT).expect("text");
    let comment = "$Comments\nanything $Nodes at all\n$EndComments\n";
    let text = text.replace("$PhysicalNames", &format!("{comment}$PhysicalNames")) + comment;
    assert_eq!(parse(text.as_bytes()), parse(PLATE_4_TEXT));
    let file = [PLATE_4_BINARY, b"$Periodic\n\x01\0\0$\n\0\n$EndPeriodic\n"].concat();
    assert_eq!(parse(&file), parse(PLATE_4_TEXT));
}

#[test]
fn big_endian_files_are_read_alike() {
    assert_eq!(parse(&big_endian_prism()), parse(PRISM_4_TEXT));
    assert_eq!(parse(&big_endian_prism_2()), parse(PRISM_4_TEXT));
}

/// The 4.1 text with every number of its data written from the most significant byte on.
pub(crate) fn big_endian_prism() -> Vec<u8> {
    let text = str::from_utf8(PRISM_4_TEXT).expect("text");
    let (head, rest) = text.split_once("$Entities\n").expect("entities");
    let (entities, rest) = rest.split_once("$EndEntities\n$Nodes\n").expect("nodes");
    let (nodes, elements) = rest.split_once("$EndNodes\n$Elements\n").expect("elements");
    let elements = elements.strip_suffix("$EndElements\n").expect("the end");
    let mut bytes = head.replace("4.1 0 8\n", "4.1 1 8\n\0\0\0\x01\n").into_bytes();
    bytes.extend(b"$Entities\n");
    encode_entities(entities, &mut bytes);
    bytes.extend(b"\n$EndEntities\n$Nodes\n");
    encode_blocks(nodes, "iiis", "s", "ddd", &mut bytes);
    bytes.extend(b"\n$EndNodes\n$Elements\n");
    encode_blocks(elements, "iiis", "sssss", "", &mut bytes);
    bytes.extend(b"\n$EndElements\n");
    bytes
}

/// The 2.2 text likewise, a header before every element.
pub(crate) fn big_endian_prism_2() -> Vec<u8> {
    let text = str::from_utf8(PRISM_2_TEXT).expect("text");
    let mut bytes = Vec::new();
    let mut section = "";
    for line in text.lines() {
        let words: Vec<_> = line.split_whitespace().collect();
        match (section, &words[..]) {
            (_, [mark]) => {
                section = mark.strip_prefix('$').unwrap_or(section);
                bytes.extend(format!("{line}\n").into_bytes());
            }
            (_, ["2.2", "0", "8"]) => bytes.extend(b"2.2 1 8\n\0\0\0\x01\n"),
            ("Nodes", _) => encode(line, "iddd", &mut bytes),
            ("Elements", [tag, kind, tags, rest @ ..]) => {
                let ints = [&[*kind, "1", *tags, *tag], rest].concat();
                encode(&ints.join(" "), &"i".repeat(ints.len()), &mut bytes);
            }
            _ => bytes.extend(format!("{line}\n").into_bytes()),
        }
    }
    bytes
}

fn encode(words: &str, kinds: &str, bytes: &mut Vec<u8>) {
    for (word, kind) in words.split_whitespace().zip(kinds.chars()) {
        match kind {
            'i' => bytes.extend(word.parse::<i32>().expect("an int").to_be_bytes()),
            's' => bytes.extend(word.parse::<u64>().expect("a size").to_be_bytes()),
            _ => bytes.extend(word.parse::<f64>().expect("a double").to_be_bytes()),
        }
    }
}

fn encode_entities(text: &str, bytes: &mut Vec<u8>) {
    for (index, line) in text.lines().enumerate() {
        let words: Vec<_> = line.split_whitespace().collect();
        let kinds = match index {
            0 => "ssss".into(),
            // Points have three coordinates and no boundary.
            1..=6 => "iddds".into(),
            _ => format!("idddddds{}s{}", "i".repeat(words[7].parse().expect("a count")), "i".repeat(9)),
        };
        encode(line, &kinds, bytes);
    }
}

/// A header of sizes, then blocks: a line `head`, lines `first` and (if any) as many lines `second`.
fn encode_blocks(text: &str, head: &str, first: &str, second: &str, bytes: &mut Vec<u8>) {
    let mut lines = text.lines();
    encode(lines.next().expect("a header"), "ssss", bytes);
    while let Some(line) = lines.next() {
        encode(line, head, bytes);
        let count: usize = line.split_whitespace().nth(3).expect("a count").parse().expect("a number");
        lines.by_ref().take(count).for_each(|line| encode(line, first, bytes));
        if !second.is_empty() {
            lines.by_ref().take(count).for_each(|line| encode(line, second, bytes));
        }
    }
}

#[test]
fn parameters_of_nodes_are_passed_over() {
    let text = str::from_utf8(PLATE_4_TEXT).expect("text");
    let plain = "1 1 0 3\n7\n8\n9\n0.25 0 0\n0.5 0 0\n0.75 0 0\n";
    let parametric = "1 1 1 3\n7\n8\n9\n0.25 0 0 0.25\n0.5 0 0 0.5\n0.75 0 0 0.75\n";
    assert!(text.contains(plain));
    assert_eq!(parse(text.replace(plain, parametric).as_bytes()), parse(PLATE_4_TEXT));
}

#[test]
fn tags_with_gaps_and_unused_nodes_are_fine() {
    let text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n70 0 1 0\n5 0.5 0.5 0\n2000000000 1 0 0\n3 0 0 0\n\
        $EndNodes\n$Elements\n2\n9 1 2 4 1 3 2000000000\n4 2 0 3 2000000000 70\n$EndElements\n";
    let mesh = parse(text.as_bytes()).into_mesh::<2>().expect("a triangle");
    assert_eq!(mesh.points(), [[0.0, 1.0], [1.0, 0.0], [0.0, 0.0]]);
    assert_eq!(mesh.cells().nodes, [2, 1, 0]);
    assert_eq!(mesh.group_nodes("group-4"), Some(vec![1, 2]));
}

#[test]
fn a_cell_in_two_groups_counts_once() {
    let text = str::from_utf8(PLATE_4_TEXT).expect("text");
    let text = text.replace("1 0 0 0 1 1 0 1 11 6", "1 0 0 0 1 1 0 2 -12 11 6");
    let file = parse(text.as_bytes());
    assert_eq!(file.blocks.last().expect("triangles").groups, [11, 12]);
    let mesh = file.into_mesh::<2>().expect("the plate");
    let mut twice = parse(PLATE_2_TEXT);
    let triangles = twice.blocks.last().expect("triangles").clone();
    twice.blocks.push(partita_mesh::gmsh::ElementBlock { groups: vec![12], ..triangles });
    assert_eq!(twice.into_mesh::<2>().expect("the plate"), mesh);
    assert_eq!(parse(PLATE_2_TEXT).into_mesh::<2>().expect("the plate"), mesh);
}

#[test]
fn errors_carry_their_data() {
    let error = GmshFile::parse(b"$MeshFormat\n4.0 0 8\n").expect_err("an old version");
    assert_eq!((error.position, error.section.as_deref()), (Position::Line(2), Some("MeshFormat")));
    assert_eq!(error.fault, Fault::Version { found: "4.0".into() });
    let mut flat = parse(PLATE_2_TEXT);
    flat.names.push(partita_mesh::gmsh::GroupName { dimension: 1, tag: 99, name: "nowhere".into() });
    let error = flat.into_mesh::<2>().expect_err("an empty group");
    assert_eq!(error, ConvertError::Mesh(MeshError::EmptyGroup { name: "nowhere".into() }));
}

#[test]
fn files_are_read_from_disk_and_named_in_errors() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("plate.msh");
    assert!(matches!(GmshFile::read(&path), Err(ReadError::File { .. })));
    std::fs::write(&path, PLATE_4_BINARY).expect("a writable folder");
    assert_eq!(GmshFile::read(&path).expect("a good file"), parse(PLATE_4_TEXT));
    std::fs::write(&path, "solid cube\n").expect("a writable folder");
    let message = GmshFile::read(&path).expect_err("an STL file").to_string();
    assert!(message.contains("plate.msh, line 1: a gmsh file begins with"), "{message}");
}
