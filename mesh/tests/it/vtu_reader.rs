//! A reader of VTU files for the tests, independent of the writer: all arrays of a file by name.

use std::collections::BTreeMap;
use std::io::Read;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::read::ZlibDecoder;
use quick_xml::events::{BytesStart, Event};
use quick_xml::{Reader, XmlVersion};

/// One array as it stands in the file.
#[derive(Debug, PartialEq)]
pub(crate) struct Array {
    pub(crate) section: String,
    pub(crate) components: usize,
    pub(crate) format: String,
    /// All types fit into `f64` without loss here.
    pub(crate) values: Vec<f64>,
}

/// Arrays by name, and the attributes of `VTKFile` and `Piece`.
#[derive(Debug, Default)]
pub(crate) struct File {
    pub(crate) arrays: BTreeMap<String, Array>,
    pub(crate) attributes: BTreeMap<String, String>,
}

pub(crate) fn read(text: &str) -> File {
    let mut reader = Reader::from_str(text);
    let (mut file, mut section, mut open) = (File::default(), String::new(), None);
    loop {
        match reader.read_event().expect("well-formed XML") {
            Event::Start(tag) => match tag.name().as_ref() {
                "DataArray" => open = Some((attributes(&tag), String::new())),
                "VTKFile" | "Piece" => file.attributes.extend(attributes(&tag)),
                name => section = name.into(),
            },
            Event::Text(text) => {
                if let Some((_, content)) = &mut open {
                    content.push_str(&text.xml10_content());
                }
            }
            Event::End(tag) if tag.name().as_ref() == "DataArray" => {
                let (attributes, content) = open.take().expect("an array was opened");
                let array = array(&section, &attributes, &content);
                file.arrays.insert(attributes["Name"].clone(), array);
            }
            Event::Eof => return file,
            _ => {}
        }
    }
}

fn attributes(tag: &BytesStart<'_>) -> BTreeMap<String, String> {
    let pair = |attribute: quick_xml::events::attributes::Attribute<'_>| {
        let value = attribute.normalized_value(XmlVersion::Explicit1_0).expect("an escaped value");
        (attribute.key.as_ref().to_string(), value.into_owned())
    };
    tag.attributes().map(|attribute| pair(attribute.expect("a whole attribute"))).collect()
}

fn array(section: &str, attributes: &BTreeMap<String, String>, content: &str) -> Array {
    let format = attributes["format"].clone();
    let values = match format.as_str() {
        "ascii" => content.split_whitespace().map(|word| word.parse().expect("a number")).collect(),
        "binary" => decode(content.trim(), &attributes["type"]),
        other => panic!("unknown format {other}"),
    };
    let components = attributes.get("NumberOfComponents").map_or(1, |count| count.parse().expect("a count"));
    Array { section: section.into(), components, format, values }
}

/// VTK's compressed layout: see "VTK XML formats", section on compressed data.
fn decode(text: &str, kind: &str) -> Vec<f64> {
    let base64_length = |bytes: usize| bytes.div_ceil(3) * 4;
    let count = u64s(&STANDARD.decode(&text[..base64_length(8)]).expect("base64")[..8])[0];
    let header_length = base64_length(8 * (3 + usize::try_from(count).expect("a count")));
    let header = u64s(&STANDARD.decode(&text[..header_length]).expect("base64"));
    let data = STANDARD.decode(&text[header_length..]).expect("base64");
    let (mut bytes, mut start) = (Vec::new(), 0);
    for (block, &size) in header[3..].iter().enumerate() {
        let end = start + usize::try_from(size).expect("a size");
        let before = bytes.len();
        ZlibDecoder::new(&data[start..end]).read_to_end(&mut bytes).expect("zlib");
        let is_partial = block + 4 == header.len() && header[2] > 0;
        let expected = if is_partial { header[2] } else { header[1] };
        assert_eq!((bytes.len() - before) as u64, expected, "size of block {block}");
        start = end;
    }
    assert_eq!(start, data.len(), "bytes after the last block");
    match kind {
        "Float64" => bytes.chunks_exact(8).map(|b| f64::from_le_bytes(b.try_into().expect("8"))).collect(),
        "Int64" => u64s(&bytes).into_iter().map(|value| value as f64).collect(),
        "UInt8" => bytes.into_iter().map(f64::from).collect(),
        other => panic!("unknown type {other}"),
    }
}

fn u64s(bytes: &[u8]) -> Vec<u64> {
    bytes.chunks_exact(8).map(|b| u64::from_le_bytes(b.try_into().expect("8 bytes"))).collect()
}
