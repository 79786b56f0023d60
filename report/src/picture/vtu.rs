//! Reads the VTU files that our own program writes: one piece, little-endian arrays, zlib blocks in base64.

use std::collections::BTreeMap;
use std::io::Read;
use std::path::Path;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::read::ZlibDecoder;

use crate::task::{self, TaskError};

/// Points, cells and fields of a file, in the plane.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Piece {
    pub(crate) points: Vec<[f64; 2]>,
    /// Corners of each cell.
    pub(crate) cells: Vec<Vec<usize>>,
    /// Values at the points and components of each field.
    fields: BTreeMap<String, (usize, Vec<f64>)>,
}

impl Piece {
    /// Reads a file.
    pub(crate) fn read(path: &Path) -> Result<Self, TaskError> {
        Self::parse(&task::read(path)?)
            .ok_or_else(|| TaskError::Failed(format!("{}: not a VTU file of ours", path.display())))
    }

    fn parse(text: &str) -> Option<Self> {
        let mut piece = Self::default();
        let (mut corners, mut ends) = (Vec::new(), Vec::new());
        for element in text.split("<DataArray ").skip(1) {
            let (tag, rest) = element.split_once('>')?;
            let content = rest.split_once("</DataArray>")?.0;
            let name = attribute(tag, "Name")?;
            let components =
                attribute(tag, "NumberOfComponents").map_or(Some(1), |count| count.parse().ok())?;
            let bytes = decode(content.trim())?;
            match (name, attribute(tag, "type")?) {
                ("connectivity", "Int64") => corners = indices(&bytes)?,
                ("offsets", "Int64") => ends = indices(&bytes)?,
                ("Points", "Float64") => {
                    piece.points = floats(&bytes).chunks_exact(components).map(|x| [x[0], x[1]]).collect();
                }
                (field, "Float64") => {
                    piece.fields.insert(field.to_owned(), (components, floats(&bytes)));
                }
                _ => {}
            }
        }
        let mut start = 0;
        for end in ends {
            piece.cells.push(corners.get(start..end)?.to_vec());
            start = end;
        }
        let inside = piece.cells.iter().flatten().all(|&corner| corner < piece.points.len());
        (inside && !piece.points.is_empty()).then_some(piece)
    }

    /// A field of one component.
    pub(crate) fn scalars(&self, name: &str) -> Result<&[f64], TaskError> {
        Ok(&self.field(name)?.1)
    }

    /// The length of a vector field at each point.
    pub(crate) fn lengths(&self, name: &str) -> Result<Vec<f64>, TaskError> {
        let (components, values) = self.field(name)?;
        Ok(values.chunks_exact(*components).map(|v| v.iter().map(|x| x * x).sum::<f64>().sqrt()).collect())
    }

    fn field(&self, name: &str) -> Result<&(usize, Vec<f64>), TaskError> {
        self.fields.get(name).ok_or_else(|| TaskError::Failed(format!("the fields hold no `{name}`")))
    }
}

fn attribute<'a>(tag: &'a str, name: &str) -> Option<&'a str> {
    tag.split_once(&format!("{name}=\""))?.1.split('"').next()
}

/// The header (number of blocks, their size, size of the last, compressed size of each; eight bytes a number) and the
/// blocks are two base64 texts, one behind the other.
fn decode(text: &str) -> Option<Vec<u8>> {
    let encoded = |bytes: usize| bytes.div_ceil(3) * 4;
    let blocks = *indices(&STANDARD.decode(text.get(..encoded(8))?).ok()?)?.first()?;
    let header_end = encoded(8 * (3 + blocks));
    let header = indices(&STANDARD.decode(text.get(..header_end)?).ok()?)?;
    let data = STANDARD.decode(text.get(header_end..)?).ok()?;
    let mut rest = data.as_slice();
    let mut bytes = Vec::new();
    for &size in header.get(3..3 + blocks)? {
        let (block, others) = rest.split_at_checked(size)?;
        ZlibDecoder::new(block).read_to_end(&mut bytes).ok()?;
        rest = others;
    }
    Some(bytes)
}

fn words(bytes: &[u8]) -> impl Iterator<Item = [u8; 8]> + '_ {
    bytes.as_chunks::<8>().0.iter().copied()
}

fn indices(bytes: &[u8]) -> Option<Vec<usize>> {
    words(bytes).map(|word| u64::from_le_bytes(word).try_into().ok()).collect()
}

fn floats(bytes: &[u8]) -> Vec<f64> {
    words(bytes).map(f64::from_le_bytes).collect()
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use flate2::Compression;
    use flate2::write::ZlibEncoder;
    use std::io::Write as _;

    fn array(kind: &str, name: &str, components: usize, bytes: &[u8]) -> String {
        let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
        encoder.write_all(bytes).expect("a Vec takes anything");
        let block = encoder.finish().expect("a Vec takes anything");
        let header: Vec<u8> = [1, bytes.len(), bytes.len(), block.len()]
            .iter()
            .flat_map(|&number| (number as u64).to_le_bytes())
            .collect();
        format!(
            "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"binary\">{}{}\
             </DataArray>\n",
            STANDARD.encode(header),
            STANDARD.encode(block)
        )
    }

    fn file(corners: [u64; 6]) -> String {
        let floats = |values: &[f64]| -> Vec<u8> { values.iter().flat_map(|x| x.to_le_bytes()).collect() };
        let integers = |values: &[u64]| -> Vec<u8> { values.iter().flat_map(|x| x.to_le_bytes()).collect() };
        [
            array("Float64", "Points", 3, &floats(&[0., 0., 0., 1., 0., 0., 1., 1., 0., 0., 1., 0.])),
            array("Int64", "connectivity", 1, &integers(&corners)),
            array("Int64", "offsets", 1, &integers(&[3, 6])),
            array("UInt8", "types", 1, &[5, 5]),
            array("Float64", "pressure [Pa]", 1, &floats(&[1., 2., 3., 4.])),
            array(
                "Float64",
                "velocity [m/s]",
                3,
                &floats(&[3., 4., 0., 0., 0., 0., 0., -1., 0., 0., 0., 2.]),
            ),
        ]
        .concat()
    }

    /// A unit square in two triangles.
    pub(crate) fn square() -> Piece {
        Piece::parse(&file([0, 1, 2, 0, 2, 3])).expect("a file like ours")
    }

    #[test]
    fn points_cells_and_fields_are_read() {
        let piece = square();
        assert_eq!(piece.points, [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
        assert_eq!(piece.cells, [[0, 1, 2], [0, 2, 3]]);
        assert_eq!(piece.scalars("pressure [Pa]").expect("it is there"), [1.0, 2.0, 3.0, 4.0]);
        assert_eq!(piece.lengths("velocity [m/s]").expect("it is there"), [5.0, 0.0, 1.0, 2.0]);
        assert!(piece.scalars("temperature").is_err());
    }

    #[test]
    fn a_damaged_file_is_refused() {
        assert!(Piece::parse(&file([0, 1, 2, 0, 2, 4])).is_none(), "a corner that is no point");
        assert!(Piece::parse(&file([0, 1, 2, 0, 2, 3]).replacen("</DataArray>", "=", 1)).is_none());
        assert!(Piece::parse("<VTKFile></VTKFile>").is_none());
    }
}
