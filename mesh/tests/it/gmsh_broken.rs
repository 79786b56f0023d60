//! Broken files: each has its own message, which says where, what and a remedy.

use std::collections::HashSet;
use std::fmt::Write;

use partita_mesh::gmsh::{ConvertError, ElementBlock, ElementKind, GmshFile, GroupName};
use partita_testing::with_hint;

use crate::gmsh::{
    PLATE_2_BINARY, PLATE_2_TEXT, PLATE_4_BINARY, PLATE_4_TEXT, PRISM_4_TEXT, SECOND_ORDER, parse,
};

type Case = (&'static str, Vec<u8>);

/// The file with one piece replaced where it first occurs.
fn edit(file: &[u8], old: impl AsRef<[u8]>, new: impl AsRef<[u8]>) -> Vec<u8> {
    let (old, new) = (old.as_ref(), new.as_ref());
    let place = file.windows(old.len()).position(|window| window == old).expect("the piece is in the file");
    [&file[..place], new, &file[place + old.len()..]].concat()
}

/// The file up to and with a piece.
fn cut_after(file: &[u8], piece: impl AsRef<[u8]>) -> Vec<u8> {
    let piece = piece.as_ref();
    let place =
        file.windows(piece.len()).position(|window| window == piece).expect("the piece is in the file");
    file[..place + piece.len()].to_vec()
}

/// A table of titles and messages; no message may occur twice.
fn table(messages: impl Iterator<Item = (&'static str, String)>) -> String {
    let mut known = HashSet::new();
    messages.fold(String::new(), |mut table, (title, message)| {
        assert!(message.contains("\nhint: "), "{title}: {message}");
        assert!(known.insert(message.clone()), "{title} has a message that was there before: {message}");
        write!(table, "## {title}\n{message}\n\n").expect("strings grow");
        table
    })
}

fn parse_messages(cases: Vec<Case>) -> String {
    table(cases.into_iter().map(|(title, file)| {
        let error = GmshFile::parse(&file).expect_err(title);
        (title, with_hint(&error))
    }))
}

#[test]
fn broken_headers_and_sections() {
    let (two, four) = (PLATE_2_TEXT, PLATE_4_TEXT);
    let comment = edit(&edit(four, "$Entities\n", "$Comments\n"), "$EndEntities\n", "$EndComments\n");
    let late_entities = [&comment, &b"$Entities\n0 0 0 0\n$EndEntities\n"[..]].concat();
    let messages = parse_messages(vec![
        ("empty file", b"\n \n".to_vec()),
        ("another format", b"solid plate\n facet normal 0 0 1\n".to_vec()),
        ("format 1", b"$NOD\n3\n1 0 0 0\n".to_vec()),
        (
            "a geometry in bytes that are not text",
            b"\x89PNG\x00\xff\x1b[2J and so on and so on and on".to_vec(),
        ),
        ("version 4.0", edit(four, "4.1 0 8", "4 0 8")),
        ("a version to come", edit(four, "4.1 0 8", "5.0 0 8")),
        ("file type", edit(two, "2.2 0 8", "2.2 2 8")),
        ("data size", edit(two, "2.2 0 8", "2.2 0 4")),
        ("header without size", edit(two, "2.2 0 8", "2.2 0")),
        ("header with more", edit(two, "2.2 0 8", "2.2 0 8 1")),
        ("header without end", edit(two, "$EndMeshFormat\n", "")),
        ("text in a file that says binary", edit(two, "2.2 0 8", "2.2 1 8")),
        ("data in a file that says text", edit(PLATE_2_BINARY, "2.2 1 8", "2.2 0 8")),
        ("byte order", edit(PLATE_4_BINARY, "\x01\0\0\0\n", "\0\x01\0\0\n")),
        ("two headers", edit(two, "$PhysicalNames", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames")),
        ("no nodes section", cut_after(two, "$EndPhysicalNames\n")),
        ("no elements section", cut_after(four, "$EndNodes\n")),
        ("elements before nodes", edit(two, "$Nodes\n", "$Elements\n0\n$EndElements\n$Nodes\n")),
        ("entities after elements", late_entities),
        ("nodes twice", edit(two, "$Elements\n", "$Nodes\n0\n$EndNodes\n$Elements\n")),
        ("two files in one", [two, two].concat()),
        ("partitioned", edit(four, "$Nodes\n", "$PartitionedEntities\n2\n$EndPartitionedEntities\n$Nodes\n")),
        ("parametric nodes of format 2", edit(two, "$Nodes\n", "$ParametricNodes\n")),
        ("misspelt section", edit(two, "$Nodes\n", "$Node\n")),
        ("misspelt end", edit(two, "$EndNodes\n", "$Endnodes\n")),
        ("text after the last section", [two, b"73 1 2 1 1 1 7\n"].concat()),
        ("an end without a section", edit(four, "$Entities\n", "$EndEntities\n$Entities\n")),
    ]);
    insta::assert_snapshot!(messages);
}

#[test]
fn broken_names() {
    let two = PLATE_2_TEXT;
    let messages = parse_messages(vec![
        ("more names than lines", edit(two, "$PhysicalNames\n6\n", "$PhysicalNames\n7\n")),
        ("fewer names than lines", edit(two, "$PhysicalNames\n6\n", "$PhysicalNames\n5\n")),
        ("a huge number of names", edit(two, "$PhysicalNames\n6\n", "$PhysicalNames\n99999999999\n")),
        ("name without quotes", edit(two, "\"inflow\"", "inflow")),
        ("empty name", edit(two, "\"inflow\"", "\"\"")),
        ("name in another encoding", edit(two, "\"inflow\"", b"\"Einstr\xf6mung\"")),
        ("name without an end", edit(two, "\"inflow\"", "\"inflow")),
        ("names of one group", edit(two, "1 4 \"inflow\"", "1 3 \"inflow\"")),
        ("dimension of a group", edit(two, "1 4 \"inflow\"", "4 4 \"inflow\"")),
        ("negative group", edit(two, "1 4 \"inflow\"", "1 -4 \"inflow\"")),
    ]);
    insta::assert_snapshot!(messages);
}

#[test]
fn broken_text_of_format_2() {
    let two = PLATE_2_TEXT;
    let messages = parse_messages(vec![
        ("more nodes than lines", edit(two, "$Nodes\n36\n", "$Nodes\n37\n")),
        ("fewer nodes than lines", edit(two, "$Nodes\n36\n", "$Nodes\n35\n")),
        ("a huge number of nodes", edit(two, "$Nodes\n36\n", "$Nodes\n18446744073709551615\n")),
        ("a number of nodes beyond 64 bits", edit(two, "$Nodes\n36\n", "$Nodes\n18446744073709551616\n")),
        ("negative number of nodes", edit(two, "$Nodes\n36\n", "$Nodes\n-36\n")),
        ("node without z", edit(two, "\n3 1 1 0\n", "\n3 1 1\n")),
        ("node with a fourth coordinate", edit(two, "\n3 1 1 0\n", "\n3 1 1 0 0\n")),
        ("coordinate is not a number", edit(two, "\n3 1 1 0\n", "\n3 1 nan 0\n")),
        ("coordinate is infinite", edit(two, "\n3 1 1 0\n", "\n3 -inf 1 0\n")),
        ("coordinate overflows", edit(two, "\n3 1 1 0\n", "\n3 1 1e999 0\n")),
        ("coordinate with a decimal comma", edit(two, "\n5 0.7 0.5", "\n5 0,7 0.5")),
        ("duplicate node", edit(two, "\n3 1 1 0\n", "\n2 1 1 0\n")),
        ("node 0", edit(two, "\n3 1 1 0\n", "\n0 1 1 0\n")),
        ("negative node", edit(two, "\n3 1 1 0\n", "\n-3 1 1 0\n")),
        ("cut within the nodes", cut_after(two, "\n3 1 1")),
        ("cut after the nodes", cut_after(two, "$EndNodes\n$Elements\n")),
        ("more elements than lines", edit(two, "$Elements\n72\n", "$Elements\n73\n")),
        ("fewer elements than lines", edit(two, "$Elements\n72\n", "$Elements\n71\n")),
        ("a huge number of elements", edit(two, "$Elements\n72\n", "$Elements\n4000000000\n")),
        ("hexahedron", edit(two, "\n3 1 2 1 1 8 9\n", "\n3 5 2 1 1 8 9\n")),
        ("tetrahedron of third order", edit(two, "\n3 1 2 1 1 8 9\n", "\n3 29 2 1 1 8 9\n")),
        ("unknown element type", edit(two, "\n3 1 2 1 1 8 9\n", "\n3 1000 2 1 1 8 9\n")),
        ("element on a missing node", edit(two, "\n3 1 2 1 1 8 9\n", "\n3 1 2 1 1 8 99\n")),
        ("element without its last node", edit(two, "\n3 1 2 1 1 8 9\n", "\n3 1 2 1 1 8\n")),
        ("element with a node too many", edit(two, "\n3 1 2 1 1 8 9\n", "\n3 1 2 1 1 8 9 10\n")),
        ("negative number of tags", edit(two, "\n3 1 2 1 1 8 9\n", "\n3 1 -2 1 1 8 9\n")),
        ("a huge number of tags", edit(two, "\n3 1 2 1 1 8 9\n", "\n3 1 2000000000 1 1 8 9\n")),
    ]);
    insta::assert_snapshot!(messages);
}

#[test]
fn broken_text_of_format_4() {
    let four = PLATE_4_TEXT;
    let messages = parse_messages(vec![
        ("a huge number of curves", edit(four, "\n7 6 1 0\n", "\n7 600000 1 0\n")),
        ("more curves than lines", edit(four, "\n7 6 1 0\n", "\n7 8 1 0\n")),
        ("a huge number of groups", edit(four, "\n1 0 0 0 1 0 0 1 1 2", "\n1 0 0 0 1 0 0 1000000000000 1 2")),
        ("entity twice", edit(four, "\n2 1 0 0 1 1 0", "\n1 1 0 0 1 1 0")),
        ("nodes: wrong total", edit(four, "\n13 36 1 36\n", "\n13 40 1 36\n")),
        ("nodes: huge total", edit(four, "\n13 36 1 36\n", "\n13 9999999999999999999 1 36\n")),
        ("nodes: huge number of blocks", edit(four, "\n13 36 1 36\n", "\n1300000000 36 1 36\n")),
        ("nodes: too many blocks", edit(four, "\n13 36 1 36\n", "\n14 36 1 36\n")),
        ("nodes: too few blocks", edit(four, "\n13 36 1 36\n", "\n12 36 1 36\n")),
        ("nodes: huge block", edit(four, "\n1 1 0 3\n7\n", "\n1 1 0 123456789\n7\n")),
        ("nodes: block too short", edit(four, "\n1 1 0 3\n7\n", "\n1 1 0 4\n7\n")),
        ("nodes: dimension", edit(four, "\n1 1 0 3\n7\n", "\n5 1 0 3\n7\n")),
        ("nodes: parameters are neither there nor not", edit(four, "\n1 1 0 3\n7\n", "\n1 1 2 3\n7\n")),
        ("nodes: parameters missing", edit(four, "\n1 1 0 3\n7\n", "\n1 1 1 3\n7\n")),
        ("duplicate node", edit(four, "\n1 1 0 3\n7\n", "\n1 1 0 3\n6\n")),
        ("elements: wrong total", edit(four, "\n7 72 1 72\n", "\n7 71 1 72\n")),
        ("elements: huge total", edit(four, "\n7 72 1 72\n", "\n7 720000 1 72\n")),
        ("elements: entity is missing", edit(four, "\n1 1 1 4\n1 1 7", "\n1 17 1 4\n1 1 7")),
        ("elements: dimension of the type", edit(four, "\n1 1 1 4\n1 1 7", "\n1 1 2 4\n1 1 7")),
        ("elements: prism", edit(four, "\n2 1 2 50\n", "\n2 1 6 50\n")),
        ("elements: huge block", edit(four, "\n2 1 2 50\n", "\n2 1 2 5000\n")),
        ("elements: missing node", edit(four, "\n23 6 17 23", "\n23 6 17 37")),
        ("elements: fraction for a node", edit(four, "\n23 6 17 23", "\n23 6 17.5 23")),
        ("cut within the elements", cut_after(four, "\n23 6 17 ")),
    ]);
    insta::assert_snapshot!(messages);
}

#[test]
fn broken_binary_files() {
    let (two, four) = (PLATE_2_BINARY, PLATE_4_BINARY);
    let size = |value: u64| value.to_le_bytes();
    let int = |value: i32| value.to_le_bytes();
    let node_3 = [&int(3)[..], &1.0_f64.to_le_bytes(), &1.0_f64.to_le_bytes()].concat();
    let node_3_is = |tag, x: f64, y: f64| [&int(tag)[..], &x.to_le_bytes(), &y.to_le_bytes()].concat();
    let node_total = [size(13), size(36)].concat();
    let block_3 = [&int(1)[..], &int(1), &int(0), &size(3)].concat();
    let block_is = |dimension, count| [&int(dimension)[..], &int(1), &int(0), &size(count)].concat();
    let triangles = [&int(2)[..], &int(1), &int(2), &size(50)].concat();
    let triangles_are = |code, count| [&int(2)[..], &int(1), &int(code), &size(count)].concat();
    let first_line = [&int(1)[..], &int(1), &int(2)].concat();
    let first_is = |code, count, tags| [int(code), int(count), int(tags)].concat();
    let messages = parse_messages(vec![
        ("2.2: cut within a node", cut_after(two, &node_3)),
        ("2.2: huge number of nodes", edit(two, "$Nodes\n36\n", "$Nodes\n360000000\n")),
        ("2.2: too many nodes", edit(two, "$Nodes\n36\n", "$Nodes\n37\n")),
        ("2.2: too few nodes", edit(two, "$Nodes\n36\n", "$Nodes\n35\n")),
        ("2.2: coordinate is not a number", edit(two, &node_3, node_3_is(3, f64::NAN, 1.0))),
        ("2.2: coordinate is infinite", edit(two, &node_3, node_3_is(3, 1.0, f64::INFINITY))),
        ("2.2: duplicate node", edit(two, &node_3, node_3_is(2, 1.0, 1.0))),
        ("2.2: negative node", edit(two, &node_3, node_3_is(-3, 1.0, 1.0))),
        (
            "2.2: carriage returns from a transfer in text mode",
            edit(two, "$Nodes\n36\n", "$Nodes\r\n36\r\n\r"),
        ),
        ("2.2: pyramid", edit(two, &first_line, first_is(7, 1, 2))),
        ("2.2: batch with more than all", edit(two, &first_line, first_is(1, 73, 2))),
        ("2.2: negative batch", edit(two, &first_line, first_is(1, -1, 2))),
        ("2.2: huge number of tags", edit(two, &first_line, first_is(1, 1, i32::MAX))),
        ("4.1: huge total of nodes", edit(four, &node_total, [size(13), size(u64::MAX)].concat())),
        ("4.1: huge number of blocks", edit(four, &node_total, [size(1 << 60), size(36)].concat())),
        ("4.1: wrong total of nodes", edit(four, &node_total, [size(13), size(30)].concat())),
        ("4.1: huge block of nodes", edit(four, &block_3, block_is(1, 1 << 40))),
        ("4.1: dimension", edit(four, &block_3, block_is(-1, 3))),
        ("4.1: quadratic triangles", edit(four, &triangles, triangles_are(9, 50))),
        ("4.1: huge block of elements", edit(four, &triangles, triangles_are(2, u64::MAX / 8))),
        ("4.1: hexahedra", edit(four, &triangles, triangles_are(12, 50))),
        ("4.1: unknown type", edit(four, &triangles, triangles_are(-2, 50))),
        ("4.1: cut within the elements", cut_after(four, &triangles)),
        ("4.1: read as 2.2", edit(four, "4.1 1 8", "2.2 1 8")),
        ("2.2: read as 4.1", edit(two, "2.2 1 8", "4.1 1 8")),
    ]);
    insta::assert_snapshot!(messages);
}

fn plate(change: impl FnOnce(&mut GmshFile)) -> String {
    let mut file = parse(PLATE_4_TEXT);
    change(&mut file);
    with_hint(&file.into_mesh::<2>().expect_err("a broken document"))
}

fn swap_all(triangles: &mut [usize]) {
    triangles.chunks_exact_mut(3).for_each(|nodes| nodes.swap(0, 1));
}

fn triangles(file: &mut GmshFile) -> &mut ElementBlock {
    file.blocks.last_mut().expect("the plate ends with its triangles")
}

fn quadrilateral() -> ElementBlock {
    ElementBlock { kind: ElementKind::Quadrilateral4, groups: vec![11], nodes: vec![0, 1, 2, 3] }
}

fn name(tag: u64, name: &str) -> GroupName {
    GroupName { dimension: 1, tag, name: name.into() }
}

#[test]
fn files_that_make_no_mesh() {
    let prism = || parse(PRISM_4_TEXT);
    let text = |made: Result<(), ConvertError>| with_hint(&made.expect_err("broken"));
    let space = |file: GmshFile| text(file.into_mesh::<3>().map(|_| ()));
    let cases = vec![
        ("no elements at all", plate(|file| file.blocks.clear())),
        ("a plate in space", space(parse(PLATE_4_TEXT))),
        ("a prism in the plane", text(prism().into_mesh::<2>().map(|_| ()))),
        ("second order", text(parse(SECOND_ORDER).into_mesh::<2>().map(|_| ()))),
        ("quadrilaterals", plate(|file| file.blocks.push(quadrilateral()))),
        ("out of the plane", plate(|file| file.points[7][2] = 0.1)),
        ("one clockwise", plate(|file| swap_all(&mut triangles(file).nodes[30..33]))),
        ("flat cell", plate(|file| triangles(file).nodes[1] = triangles(file).nodes[0])),
        ("triangle twice", plate(|file| triangles(file).nodes.extend([5, 16, 22]))),
        (
            "no groups",
            plate(|file| {
                file.names.clear();
                file.blocks.iter_mut().for_each(|block| block.groups.clear());
            }),
        ),
        (
            "names, but Mesh.SaveAll of format 2.2 has lost the groups",
            space({
                let mut file = prism();
                file.blocks.iter_mut().for_each(|block| block.groups.clear());
                file
            }),
        ),
        ("named group without elements", plate(|file| file.names.push(name(12, "wall")))),
        ("two groups of one name", plate(|file| file.names[1].name = "top".into())),
        ("curve in two groups", plate(|file| file.blocks[1].groups.push(4))),
        ("line in two groups", plate(|file| file.blocks[1].nodes.extend([0, 6]))),
        ("line within the plate", plate(|file| file.blocks[1].nodes.extend([5, 16]))),
        (
            "line off the plate",
            plate(|file| {
                file.node_tags.push(500);
                file.points.push([2.0, 0.5, 0.0]);
                file.blocks[1].nodes.extend([1, 36]);
            }),
        ),
    ];
    let messages = table(cases.into_iter());
    insta::assert_snapshot!(messages);
}
