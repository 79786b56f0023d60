//! Files of gmsh as other tools, editors and older versions write them.

use miette::Diagnostic;
use partita_mesh::gmsh::{Fault, GmshFile};

use crate::gmsh::{PLATE_2_BINARY, PLATE_2_TEXT, PLATE_4_BINARY, PLATE_4_TEXT, parse};
use crate::gmsh_kinds::fixture;

/// The file with every occurrence of a piece replaced.
fn with(file: &[u8], old: impl AsRef<[u8]>, new: impl AsRef<[u8]>) -> Vec<u8> {
    let (old, new) = (old.as_ref(), new.as_ref());
    let (mut result, mut rest, mut found) = (Vec::new(), file, false);
    while let Some(at) = rest.windows(old.len()).position(|window| window == old) {
        result.extend_from_slice(&rest[..at]);
        result.extend_from_slice(new);
        rest = &rest[at + old.len()..];
        found = true;
    }
    assert!(found, "{} is in the file", String::from_utf8_lossy(old));
    [&result, rest].concat()
}

fn fault(file: &[u8]) -> Fault {
    GmshFile::parse(file).expect_err("a broken file").fault
}

#[test]
fn a_version_is_a_number_however_it_is_spelled() {
    for spelling in ["2.2", "2.20", "2.200000", "2.2000000000000000", "02.2", "2.1", "2.10"] {
        let header = |kind: char| format!("{spelling} {kind} 8");
        assert_eq!(parse(&with(PLATE_2_TEXT, "2.2 0 8", header('0'))), parse(PLATE_2_TEXT), "{spelling}");
        assert_eq!(parse(&with(PLATE_2_BINARY, "2.2 1 8", header('1'))), parse(PLATE_2_TEXT), "{spelling}");
    }
    for spelling in ["4.1", "4.10", "4.1000", "4.100000"] {
        let header = |kind: char| format!("{spelling} {kind} 8");
        assert_eq!(parse(&with(PLATE_4_TEXT, "4.1 0 8", header('0'))), parse(PLATE_4_TEXT), "{spelling}");
        assert_eq!(parse(&with(PLATE_4_BINARY, "4.1 1 8", header('1'))), parse(PLATE_4_TEXT), "{spelling}");
    }
    for other in [
        "1.0", "2.3", "2.02", "3", "4.0", "4", "4.11", "5", "-2.2", "2,2", "2.2.0", "22e-1", "nan", "inf",
        ".",
    ] {
        let file = with(PLATE_2_TEXT, "2.2 0 8", format!("{other} 0 8"));
        assert_eq!(fault(&file), Fault::Version { found: other.into() });
    }
}

#[test]
fn comments_and_sections_of_others_may_come_first() {
    let comment = "$Comments\nmade by hand: $Nodes\n$EndComments\n";
    let other = "\n\n$MyTool\n1 2 3\n\n$EndMyTool\n\n";
    for preface in
        [comment.to_owned(), format!("{other}{comment}"), "\r\n \n".to_owned(), format!("\t{comment}")]
    {
        for file in [PLATE_2_TEXT, PLATE_2_BINARY, PLATE_4_TEXT, PLATE_4_BINARY] {
            assert_eq!(parse(&[preface.as_bytes(), file].concat()), parse(file), "{preface:?}");
        }
    }
    let early = "$Nodes\n0\n$EndNodes\n$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
    assert_eq!(fault(early.as_bytes()), Fault::SectionOrder { first: "$MeshFormat", second: "$Nodes" });
    assert_eq!(fault(comment.as_bytes()), Fault::NotGmsh { found: "$Comments".into() });
    assert!(matches!(fault(b"$Comments\nno end\n"), Fault::SectionOpen { .. }));
    assert_eq!(fault(b"$NOD\n1\n1 0 0 0\n$ENDNOD\n"), Fault::NotGmsh { found: "$NOD".into() });
}

#[test]
fn a_byte_order_mark_is_passed_over_and_wide_text_is_named() {
    for file in [PLATE_2_TEXT, PLATE_2_BINARY, PLATE_4_TEXT, PLATE_4_BINARY] {
        assert_eq!(parse(&[b"\xef\xbb\xbf", file].concat()), parse(file));
    }
    assert_eq!(fault(b"\xef\xbb\xbf"), Fault::Empty);
    let text = String::from_utf8(PLATE_2_TEXT.to_vec()).expect("text");
    let wide = |bytes: fn(u16) -> [u8; 2], mark: &str| -> Vec<u8> {
        format!("{mark}{text}").encode_utf16().flat_map(bytes).collect()
    };
    for mark in ["\u{feff}", ""] {
        assert_eq!(fault(&wide(u16::to_le_bytes, mark)), Fault::Utf16);
        assert_eq!(fault(&wide(u16::to_be_bytes, mark)), Fault::Utf16);
    }
    assert_eq!(fault(text.replace('\n', "\r").as_bytes()), Fault::CarriageReturns);
}

#[test]
fn lines_may_be_blank_indented_and_end_as_elsewhere() {
    for file in [PLATE_2_TEXT, PLATE_4_TEXT] {
        let text = String::from_utf8(file.to_vec()).expect("text");
        for change in ["\r\n", "\n\n", " \n", "\n \t", "\r\n\r\n"] {
            assert_eq!(parse(text.replace('\n', change).as_bytes()), parse(file), "{change:?}");
        }
        assert_eq!(parse(text.replace(' ', " \t ").as_bytes()), parse(file));
    }
}

#[test]
fn attributes_behind_a_name_are_passed_over() {
    for attribute in [" periodic", "\tperiodic 3", " \"periodic\"", " # a comment", "   "] {
        let file = with(PLATE_2_TEXT, "\"inflow\"", format!("\"inflow\"{attribute}"));
        assert_eq!(parse(&file), parse(PLATE_2_TEXT), "{attribute}");
    }
    for name in ["\"5\" pipe\"", "\"in\"flow", "\"in\" flow\"", "\"\" inflow", "inflow \"inflow\"", "\""] {
        let file = with(PLATE_2_TEXT, "\"inflow\"", name);
        assert_eq!(fault(&file), Fault::Name { found: name.into() });
    }
}

/// In text a number has as many digits as it likes; binary 2.2 has 32 bits for all tags, binary 4.1 has 64 for those of
/// nodes and elements.
#[test]
fn tags_beyond_32_bits_are_read() {
    let small = parse(&fixture("gaps", "2.2-ascii"));
    let mut file = fixture("gaps", "2.2-ascii");
    for (old, new) in [
        ("\n2 0.5 0.5 0\n", "\n5000000000 0.5 0.5 0\n"),
        ("\n2 2 2 5 7 4 2 1\n", "\n9000000000 2 2 5 8000000000 4 5000000000 1\n"),
        ("\n3 2 2 5 7 4 3 2\n", "\n9000000001 2 2 5 8000000000 4 3 5000000000\n"),
    ] {
        file = with(&file, old, new);
    }
    let read = parse(&file);
    assert_eq!(read.node_tags, [1, 5_000_000_000, 3, 4]);
    assert_eq!((&read.points, &read.blocks, &read.names), (&small.points, &small.blocks, &small.names));

    let physical = with(&with(&file, "4000 3", "7000000000 3"), "1 4000 \"", "1 7000000000 \"");
    let mesh = parse(&physical).into_mesh::<2>().expect("two triangles");
    assert_eq!(mesh, small.into_mesh::<2>().expect("two triangles"));

    let text = with(&fixture("gaps", "4.1-ascii"), "2000000000", "5000000000");
    let text = with(&with(&text, "\n7 0 0 0", "\n6000000000 0 0 0"), "\n2 7 ", "\n2 6000000000 ");
    assert_eq!(parse(&text).node_tags, [70, 5, 5_000_000_000, 3]);
    let binary = with(
        &fixture("gaps", "4.1-binary"),
        2_000_000_000_u64.to_le_bytes(),
        5_000_000_000_u64.to_le_bytes(),
    );
    assert_eq!(parse(&binary), parse(&text));
}

/// The plate as format 2.0 has it: names without a dimension.
fn version_2_0() -> Vec<u8> {
    let mut file = with(PLATE_2_TEXT, "2.2 0 8", "2.0 0 8");
    for (old, new) in [
        ("1 1 \"", "1 \""),
        ("1 2 \"", "2 \""),
        ("1 3 \"", "3 \""),
        ("1 4 \"", "4 \""),
        ("1 10 \"", "10 \""),
        ("2 11 \"", "11 \""),
    ] {
        file = with(&file, old, new);
    }
    file
}

#[test]
fn names_of_format_2_0_go_to_the_groups_of_their_numbers() {
    assert_eq!(parse(&version_2_0()), parse(PLATE_2_TEXT));
    assert_eq!(parse(&with(&version_2_0(), "2.0 0 8", "2 0 8")), parse(PLATE_2_TEXT));
    // A curve and a surface of one number both have its name; a number without elements names nothing.
    let shared = with(&with(&version_2_0(), "11 \"fluid\"", "99 \"fluid\""), " 2 11 ", " 2 10 ");
    let file = parse(&shared);
    assert_eq!((&*file.group_name(1, 10), &*file.group_name(2, 10)), ("hole", "hole"));
    assert!(file.names.iter().all(|group| group.name != "fluid"));
    // Some tools write the dimension all the same.
    assert_eq!(parse(&with(PLATE_2_TEXT, "2.2 0 8", "2.0 0 8")), parse(PLATE_2_TEXT));
    let twice = with(&version_2_0(), "4 \"inflow\"", "3 \"inflow\"");
    assert!(matches!(fault(&twice), Fault::DuplicateName { tag: 3, .. }));
    let twice = with(&version_2_0(), "4 \"inflow\"", "1 3 \"inflow\"");
    assert!(matches!(fault(&twice), Fault::DuplicateName { dimension: 1, tag: 3, .. }));
}

#[test]
fn names_without_a_dimension_elsewhere_say_so() {
    let missing = Fault::NameWithoutDimension { tag: 4, name: "inflow".into() };
    for file in [PLATE_2_TEXT, PLATE_2_BINARY, PLATE_4_TEXT, PLATE_4_BINARY] {
        for line in ["-1 4 \"inflow\"", "4 \"inflow\""] {
            assert_eq!(fault(&with(file, "1 4 \"inflow\"", line)), missing, "{line}");
        }
    }
    assert_eq!(fault(&with(&version_2_0(), "4 \"inflow\"", "-1 4 \"inflow\"")), missing);
    assert!(missing.help().expect("a remedy").to_string().contains("`1 4 \"inflow\"`"));
}
