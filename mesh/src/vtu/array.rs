//! One `DataArray` element: numbers as text or as compressed bytes.

use std::fmt::{Debug, Write as _};
use std::io::{self, Write};

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::Compression;
use flate2::write::ZlibEncoder;
use quick_xml::Writer;
use quick_xml::events::BytesText;

use super::Encoding;

/// Bytes that are compressed together.
const BLOCK: usize = 1 << 15;

pub(super) enum Values {
    Float64(Vec<f64>),
    Int64(Vec<i64>),
    UInt8(Vec<u8>),
}

pub(super) struct DataArray<'a> {
    name: &'a str,
    components: usize,
    values: Values,
}

impl<'a> DataArray<'a> {
    pub(super) fn new(name: &'a str, components: usize, values: Values) -> Self {
        Self { name, components, values }
    }

    pub(super) fn write<W: Write>(&self, xml: &mut Writer<W>, encoding: Encoding) -> io::Result<()> {
        let (format, content) = match encoding {
            Encoding::Compressed => ("binary", compressed(&self.values.bytes())?),
            Encoding::Ascii => ("ascii", self.values.text(self.components)),
        };
        let components = self.components.to_string();
        let mut element = xml
            .create_element("DataArray")
            .with_attributes([("type", self.values.type_name()), ("Name", self.name)]);
        if self.components > 1 {
            element = element.with_attribute(("NumberOfComponents", components.as_str()));
        }
        element.with_attribute(("format", format)).write_text_content(BytesText::from_escaped(content))?;
        Ok(())
    }
}

impl Values {
    fn type_name(&self) -> &'static str {
        match self {
            Self::Float64(_) => "Float64",
            Self::Int64(_) => "Int64",
            Self::UInt8(_) => "UInt8",
        }
    }

    fn bytes(&self) -> Vec<u8> {
        match self {
            Self::Float64(values) => values.iter().flat_map(|value| value.to_le_bytes()).collect(),
            Self::Int64(values) => values.iter().flat_map(|value| value.to_le_bytes()).collect(),
            Self::UInt8(values) => values.clone(),
        }
    }

    fn text(&self, components: usize) -> String {
        match self {
            Self::Float64(values) => lines(values, components),
            Self::Int64(values) => lines(values, components),
            Self::UInt8(values) => lines(values, components),
        }
    }
}

/// One line a tuple; Rust prints the shortest decimal number that reads back as the same bits.
fn lines<T: Debug>(values: &[T], components: usize) -> String {
    let mut text = String::from("\n");
    for tuple in values.chunks(components) {
        for (c, value) in tuple.iter().enumerate() {
            let separator = if c == 0 { "" } else { " " };
            write!(text, "{separator}{value:?}").expect("writing to a string does not fail");
        }
        text.push('\n');
    }
    text
}

/// VTK's layout of compressed data: base64 of `[blocks, block size, size of a partial last block or 0,
/// compressed size of each block]` as `u64`, then base64 of all compressed blocks.
fn compressed(bytes: &[u8]) -> io::Result<String> {
    let blocks = bytes.len().div_ceil(BLOCK);
    let mut header = vec![blocks as u64, BLOCK as u64, (bytes.len() % BLOCK) as u64];
    let mut data = Vec::new();
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::fast());
    for block in bytes.chunks(BLOCK) {
        encoder.write_all(block)?;
        let compressed = encoder.reset(Vec::new())?;
        header.push(compressed.len() as u64);
        data.extend_from_slice(&compressed);
    }
    let header: Vec<u8> = header.iter().flat_map(|entry| entry.to_le_bytes()).collect();
    let mut text = STANDARD.encode(header);
    STANDARD.encode_string(data, &mut text);
    Ok(text)
}
