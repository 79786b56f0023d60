//! Reads VTU files: all arrays of a file by name, as they stand there.

use std::collections::BTreeMap;
use std::error::Error;
use std::fs;
use std::io::Read;
use std::path::Path;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::read::ZlibDecoder;
use quick_xml::events::{BytesStart, Event};
use quick_xml::{Reader, XmlVersion};

use super::VtuError;

/// A VTU file of one piece whose numbers are little-endian, as [`write_vtu`](super::write_vtu) writes them.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct VtuFile {
    /// Arrays by name.
    pub arrays: BTreeMap<String, VtuArray>,
    /// Attributes of the elements `VTKFile` and `Piece`.
    pub attributes: BTreeMap<String, String>,
}

/// One array of a file.
#[derive(Debug, Clone, PartialEq)]
pub struct VtuArray {
    /// The element it stands in, such as `PointData`.
    pub section: String,
    /// Components a point or cell.
    pub components: usize,
    /// `ascii` or `binary`.
    pub format: String,
    /// All values. Integers of these files are indices, which an `f64` holds exactly.
    pub values: Vec<f64>,
}

/// Why a text is no VTU file that can be read here.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct NotVtu(String);

impl VtuFile {
    /// Reads the file `path`.
    ///
    /// # Errors
    /// [`VtuError::Read`], or [`VtuError::NotAGrid`] with what is wrong.
    pub fn load(path: &Path) -> Result<Self, VtuError> {
        let text =
            fs::read_to_string(path).map_err(|source| VtuError::Read { path: path.to_owned(), source })?;
        Self::parse(&text)
            .map_err(|reason| VtuError::NotAGrid { path: path.to_owned(), reason: reason.to_string() })
    }

    /// Reads the text of a file.
    ///
    /// # Errors
    /// [`NotVtu`] with what is wrong.
    pub fn parse(text: &str) -> Result<Self, NotVtu> {
        let mut reader = Reader::from_str(text);
        let (mut file, mut section, mut open) = (Self::default(), String::new(), None);
        loop {
            match reader.read_event().map_err(|error| because(&error))? {
                Event::Start(tag) => match tag.name().as_ref() {
                    "DataArray" => open = Some((attributes(&tag)?, String::new())),
                    "VTKFile" | "Piece" => file.attributes.extend(attributes(&tag)?),
                    name => section = name.into(),
                },
                Event::Text(text) => {
                    if let Some((_, content)) = &mut open {
                        content.push_str(&text.xml10_content());
                    }
                }
                Event::End(tag) if tag.name().as_ref() == "DataArray" => {
                    let (attributes, content) =
                        open.take().ok_or_else(|| fault("an array ends that did not start"))?;
                    let array = array(&section, &attributes, content.trim())?;
                    file.arrays.insert(required(&attributes, "Name")?.to_owned(), array);
                }
                Event::Eof if file.arrays.is_empty() => return Err(fault("it holds no arrays")),
                Event::Eof => return Ok(file),
                _ => {}
            }
        }
    }
}

fn fault(reason: impl Into<String>) -> NotVtu {
    NotVtu(reason.into())
}

fn because(error: &dyn Error) -> NotVtu {
    NotVtu(error.to_string())
}

fn attributes(tag: &BytesStart<'_>) -> Result<BTreeMap<String, String>, NotVtu> {
    let mut pairs = BTreeMap::new();
    for attribute in tag.attributes() {
        let attribute = attribute.map_err(|error| because(&error))?;
        let value = attribute.normalized_value(XmlVersion::Explicit1_0).map_err(|error| because(&error))?;
        pairs.insert(attribute.key.as_ref().to_string(), value.into_owned());
    }
    Ok(pairs)
}

fn required<'a>(attributes: &'a BTreeMap<String, String>, name: &str) -> Result<&'a str, NotVtu> {
    attributes.get(name).map(String::as_str).ok_or_else(|| fault(format!("an array has no `{name}`")))
}

fn array(section: &str, attributes: &BTreeMap<String, String>, content: &str) -> Result<VtuArray, NotVtu> {
    let format = required(attributes, "format")?.to_owned();
    let values = match format.as_str() {
        "ascii" => {
            content.split_whitespace().map(|word| word.parse().map_err(|error| because(&error))).collect()
        }
        "binary" => decode(content, required(attributes, "type")?),
        other => Err(fault(format!("unknown format {other}"))),
    }?;
    let components = attributes
        .get("NumberOfComponents")
        .map_or(Ok(1), |count| count.parse().map_err(|error| because(&error)))?;
    if components == 0 || values.len() % components != 0 {
        return Err(fault(format!("{} values in groups of {components}", values.len())));
    }
    Ok(VtuArray { section: section.into(), components, format, values })
}

/// VTK's compressed layout: number of blocks, their size, size of a smaller last one or 0, compressed size of each, eight
/// bytes a number; then the blocks. Both are base64 texts of their own. See "VTK XML formats", section on compressed data.
fn decode(text: &str, kind: &str) -> Result<Vec<f64>, NotVtu> {
    let base64 = |text: Option<&str>| {
        STANDARD.decode(text.ok_or_else(|| fault("an array is cut off"))?).map_err(|error| because(&error))
    };
    let encoded = |bytes: usize| bytes.div_ceil(3) * 4;
    let first = base64(text.get(..encoded(8)))?;
    let blocks = sizes(first.get(..8).ok_or_else(|| fault("an array is cut off"))?)?[0];
    let header_length = blocks.checked_add(3).and_then(|words| words.checked_mul(8)).map(encoded);
    let header_length = header_length.ok_or_else(|| fault("an array is cut off"))?;
    let header = sizes(&base64(text.get(..header_length))?)?;
    let data = base64(text.get(header_length..))?;
    let (mut bytes, mut rest) = (Vec::new(), data.as_slice());
    for (block, &size) in header[3..3 + blocks].iter().enumerate() {
        let (compressed, others) =
            rest.split_at_checked(size).ok_or_else(|| fault(format!("block {block} is cut off")))?;
        let before = bytes.len();
        ZlibDecoder::new(compressed).read_to_end(&mut bytes).map_err(|error| because(&error))?;
        let is_partial = block + 1 == blocks && header[2] > 0;
        let expected = if is_partial { header[2] } else { header[1] };
        if bytes.len() - before != expected {
            return Err(fault(format!("block {block} has {} bytes, not {expected}", bytes.len() - before)));
        }
        rest = others;
    }
    if !rest.is_empty() {
        return Err(fault(format!("{} bytes after the last block", rest.len())));
    }
    match kind {
        "Float64" => words(&bytes).map(|word| word.map(f64::from_le_bytes)).collect(),
        "Int64" => Ok(sizes(&bytes)?.into_iter().map(|value| value as f64).collect()),
        "UInt8" => Ok(bytes.into_iter().map(f64::from).collect()),
        other => Err(fault(format!("unknown type {other}"))),
    }
}

/// Eight bytes each.
fn words(bytes: &[u8]) -> impl Iterator<Item = Result<[u8; 8], NotVtu>> + '_ {
    bytes.chunks(8).map(|word| word.try_into().map_err(|_| fault("a number is cut off")))
}

/// Numbers that count or index.
fn sizes(bytes: &[u8]) -> Result<Vec<usize>, NotVtu> {
    words(bytes)
        .map(|word| usize::try_from(u64::from_le_bytes(word?)).map_err(|error| because(&error)))
        .collect()
}
