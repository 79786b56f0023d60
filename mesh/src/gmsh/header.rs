//! `$MeshFormat`: version, encoding and byte order.

use super::cursor::{Cursor, Encoding};
use super::error::ParseError;
use super::fault::{Fault, excerpt};

/// The formats that are read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Version {
    Two,
    Four,
}

/// Reads the header; from here on the cursor knows how numbers are written.
pub(super) fn read(cursor: &mut Cursor) -> Result<Version, ParseError> {
    if cursor.rest().trim_ascii().is_empty() {
        return Err(cursor.fail(Fault::Empty));
    }
    if cursor.line().trim_ascii() != b"$MeshFormat" {
        return Err(cursor.fail(Fault::NotGmsh { found: excerpt(cursor.line()) }));
    }
    cursor.open_section()?;
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

fn version(cursor: &mut Cursor) -> Result<Version, ParseError> {
    match cursor.word("the version")? {
        b"2.2" => Ok(Version::Two),
        b"4.1" => Ok(Version::Four),
        other => Err(cursor.fail(Fault::Version { found: excerpt(other) })),
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
