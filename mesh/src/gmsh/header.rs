//! `$MeshFormat`: version, encoding and byte order; and what may stand before it.

use super::cursor::{Cursor, Encoding};
use super::error::ParseError;
use super::fault::{Fault, excerpt};

/// The formats that are read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Version {
    /// As 2.2, but names have no dimension.
    TwoZero,
    /// 2.1 and 2.2, which differ in nothing that is read.
    Two,
    Four,
}

/// Sections that mean nothing before the header.
const OF_THE_MESH: [(&str, &str); 4] = [
    ("PhysicalNames", "$PhysicalNames"),
    ("Entities", "$Entities"),
    ("Nodes", "$Nodes"),
    ("Elements", "$Elements"),
];

/// Reads the header; from here on the cursor knows how numbers are written.
pub(super) fn read(cursor: &mut Cursor) -> Result<Version, ParseError> {
    check_text(cursor)?;
    find(cursor)?;
    let version = version(cursor)?;
    let binary = match cursor.word("the file type (0 or 1)")? {
        b"0" => false,
        b"1" => true,
        other => return Err(cursor.fail(Fault::FileType { found: excerpt(other) })),
    };
    match cursor.word("the size of numbers (8)")? {
        b"8" => {}
        other => return Err(cursor.fail(Fault::DataSize { found: excerpt(other) })),
    }
    if binary {
        // From here on a line break is one line break: bytes of data may look like more of them.
        cursor.encoding = Encoding::LittleEndian;
    }
    cursor.end_line("the format")?;
    if binary {
        cursor.encoding = byte_order(cursor)?;
    }
    cursor.close_section()?;
    Ok(version)
}

/// Text of another kind than gmsh's is named as what it is.
fn check_text(cursor: &Cursor) -> Result<(), ParseError> {
    let bytes = cursor.rest();
    let wide = [&b"\xff\xfe"[..], b"\xfe\xff", b"$\0", b"\0$", b"\0\0\xfe\xff"];
    if wide.iter().any(|start| bytes.starts_with(start)) {
        return Err(cursor.fail(Fault::Utf16));
    }
    let first = cursor.line().trim_ascii();
    if first.starts_with(b"$") && first.contains(&b'\r') {
        return Err(cursor.fail(Fault::CarriageReturns));
    }
    Ok(())
}

/// Opens `$MeshFormat`; comments and sections of other tools may stand before it.
fn find(cursor: &mut Cursor) -> Result<(), ParseError> {
    if cursor.rest().trim_ascii().is_empty() {
        return Err(cursor.fail(Fault::Empty));
    }
    cursor.skip(|byte| byte.is_ascii_whitespace());
    let first = cursor.line().trim_ascii();
    let other = cursor.fail(Fault::NotGmsh { found: excerpt(first) });
    // $NOD opens a file of format 1.
    if !first.starts_with(b"$") || first == b"$NOD" {
        return Err(other);
    }
    while let Some(section) = cursor.open_section()? {
        if section == "MeshFormat" {
            return Ok(());
        }
        if let Some((_, second)) = OF_THE_MESH.into_iter().find(|(name, _)| *name == section) {
            return Err(cursor.fail(Fault::SectionOrder { first: "$MeshFormat", second }));
        }
        cursor.skip_section()?;
    }
    Err(other)
}

/// A version is a number: 2.2 is 2.200000 as well.
fn version(cursor: &mut Cursor) -> Result<Version, ParseError> {
    let word = cursor.word("the version")?;
    let plain = word.iter().all(|byte| byte.is_ascii_digit() || *byte == b'.');
    let number = str::from_utf8(word).ok().filter(|_| plain).and_then(|word| word.parse::<f64>().ok());
    match number {
        Some(2.0) => Ok(Version::TwoZero),
        Some(2.1 | 2.2) => Ok(Version::Two),
        Some(4.1) => Ok(Version::Four),
        _ => Err(cursor.fail(Fault::Version { found: excerpt(word) })),
    }
}

/// The file says 1 in its own byte order.
fn byte_order(cursor: &mut Cursor) -> Result<Encoding, ParseError> {
    match cursor.array("the number 1 that tells the byte order")? {
        [1, 0, 0, 0] => Ok(Encoding::LittleEndian),
        [0, 0, 0, 1] => Ok(Encoding::BigEndian),
        found => Err(cursor.fail(Fault::ByteOrder { found })),
    }
}
