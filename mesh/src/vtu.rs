//! VTK files for viewers: unstructured grids (`.vtu`) and collections of them over time (`.pvd`).
//!
//! Files are written beside their place and renamed into it, so that a killed run leaves only whole files.

mod array;
mod atomic;
mod pvd;
mod read;

pub use pvd::{PvdCollection, PvdEntry};
pub use read::{NotVtu, VtuArray, VtuFile};

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use quick_xml::Writer;
use quick_xml::events::{BytesDecl, Event};

use crate::cell::Cells;
use array::{DataArray, Values};

/// How the numbers of a VTU file are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Encoding {
    /// Compressed by zlib, in base64: small and exact.
    #[default]
    Compressed,
    /// Decimal numbers: readable, exact, large.
    Ascii,
}

/// One field of point or cell data; `values[i * components + c]` is component `c` at point or cell `i`.
///
/// Fields of two components are taken for plane vectors and get a zero third one, which viewers need for
/// arrows and displaced shapes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Array<'a> {
    /// The name that viewers show; put the unit there.
    pub name: &'a str,
    /// Components a point or cell.
    pub components: usize,
    /// All values.
    pub values: &'a [f64],
}

/// Why an output file could not be written or read.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum VtuError {
    /// The file system takes no file there.
    #[error("cannot write `{}`: {source}", path.display())]
    #[diagnostic(help("check that the folder exists, may be written to, and is not full"))]
    Write {
        /// The file.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// The file system gives no file from there.
    #[error("cannot read `{}`: {source}", path.display())]
    #[diagnostic(help("was it moved, or written by another run?"))]
    Read {
        /// The file.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// A file that is no unstructured grid.
    #[error("`{}` cannot be read as VTU: {reason}", path.display())]
    #[diagnostic(help("it must have one piece with ASCII or zlib-compressed base64 arrays"))]
    NotAGrid {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// A collection that is not one.
    #[error("`{}` is no collection of VTK files: {reason}", path.display())]
    #[diagnostic(help("move the file away; the next run writes a new one"))]
    NotACollection {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
}

/// Writes an unstructured grid as VTU to `output`; points and two-component fields are padded to 3D.
///
/// ```
/// use partita_mesh::vtu::{Encoding, Array, write_vtu};
/// use partita_mesh::{CellKind, Cells};
///
/// let points = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
/// let cells = Cells::new(CellKind::Triangle3, vec![0, 1, 2]);
/// let pressure = Array { name: "pressure [Pa]", components: 1, values: &[1.0, 2.0, 3.0] };
/// let mut file = Vec::new();
/// write_vtu(&mut file, &points, &cells, &[pressure], &[], Encoding::Ascii)?;
/// assert!(String::from_utf8(file).unwrap().contains("<UnstructuredGrid>"));
/// # Ok::<(), std::io::Error>(())
/// ```
///
/// # Errors
/// What `output` reports.
///
/// # Panics
/// If a field does not have `components` values a point or cell, if `D > 3`, or if a cell names a point that
/// does not exist.
pub fn write_vtu<const D: usize>(
    output: impl Write,
    points: &[[f64; D]],
    cells: &Cells,
    point_data: &[Array<'_>],
    cell_data: &[Array<'_>],
    encoding: Encoding,
) -> io::Result<()> {
    check(points.len(), cells, point_data, cell_data);
    let mut xml = document(output)?;
    let mut root = xml.create_element("VTKFile").with_attributes([
        ("type", "UnstructuredGrid"),
        ("version", "1.0"),
        ("byte_order", "LittleEndian"),
        ("header_type", "UInt64"),
    ]);
    if encoding == Encoding::Compressed {
        root = root.with_attribute(("compressor", "vtkZLibDataCompressor"));
    }
    root.write_inner_content(|xml| {
        xml.create_element("UnstructuredGrid").write_inner_content(|xml| {
            let (point_count, cell_count) = (points.len().to_string(), cells.len().to_string());
            let piece = xml.create_element("Piece").with_attributes([
                ("NumberOfPoints", point_count.as_str()),
                ("NumberOfCells", cell_count.as_str()),
            ]);
            piece.write_inner_content(|xml| {
                let points = [DataArray::new("Points", 3, Values::Float64(padded_points(points)))];
                write_section(xml, "Points", &points, encoding)?;
                write_section(xml, "Cells", &cell_arrays(cells), encoding)?;
                write_section(xml, "PointData", &field_arrays(point_data), encoding)?;
                write_section(xml, "CellData", &field_arrays(cell_data), encoding)
            })?;
            Ok(())
        })?;
        Ok(())
    })?;
    xml.get_mut().write_all(b"\n")
}

/// Writes an unstructured grid to the file `path`, compressed; the file appears when it is whole.
///
/// # Errors
/// [`VtuError::Write`] names the file.
///
/// # Panics
/// As [`write_vtu`].
pub fn save_vtu<const D: usize>(
    path: &Path,
    points: &[[f64; D]],
    cells: &Cells,
    point_data: &[Array<'_>],
    cell_data: &[Array<'_>],
) -> Result<(), VtuError> {
    atomic::write(path, |file| write_vtu(file, points, cells, point_data, cell_data, Encoding::Compressed))
}

fn document<W: Write>(output: W) -> io::Result<Writer<W>> {
    let mut xml = Writer::new_with_indent(output, b' ', 2);
    xml.write_event(Event::Decl(BytesDecl::new("1.0", None, None)))?;
    Ok(xml)
}

fn check(points: usize, cells: &Cells, point_data: &[Array<'_>], cell_data: &[Array<'_>]) {
    assert!(cells.nodes.iter().all(|&node| node < points), "a cell names a point that does not exist");
    let counts = [(point_data, points, "point"), (cell_data, cells.len(), "cell")];
    for (fields, count, place) in counts {
        for field in fields {
            assert_eq!(
                field.values.len(),
                field.components * count,
                "field `{}` has {} components a {place}",
                field.name,
                field.components
            );
        }
    }
}

fn write_section<W: Write>(
    xml: &mut Writer<W>,
    section: &str,
    arrays: &[DataArray<'_>],
    encoding: Encoding,
) -> io::Result<()> {
    xml.create_element(section)
        .write_inner_content(|xml| arrays.iter().try_for_each(|array| array.write(xml, encoding)))?;
    Ok(())
}

fn padded_points<const D: usize>(points: &[[f64; D]]) -> Vec<f64> {
    assert!(D <= 3, "VTK knows three dimensions");
    points.iter().flat_map(|point| (0..3).map(|c| point.get(c).copied().unwrap_or(0.0))).collect()
}

fn cell_arrays(cells: &Cells) -> [DataArray<'static>; 3] {
    let count = cells.kind.node_count();
    let connectivity = cells.nodes.iter().map(|&node| index(node)).collect();
    let offsets = (1..=cells.len()).map(|cell| index(cell * count)).collect();
    [
        DataArray::new("connectivity", 1, Values::Int64(connectivity)),
        DataArray::new("offsets", 1, Values::Int64(offsets)),
        DataArray::new("types", 1, Values::UInt8(vec![cells.kind.vtk_id(); cells.len()])),
    ]
}

fn field_arrays<'a>(fields: &[Array<'a>]) -> Vec<DataArray<'a>> {
    let array = |field: &Array<'a>| match field.components {
        2 => {
            let padded = field.values.chunks_exact(2).flat_map(|v| [v[0], v[1], 0.0]).collect();
            DataArray::new(field.name, 3, Values::Float64(padded))
        }
        components => DataArray::new(field.name, components, Values::Float64(field.values.to_vec())),
    };
    fields.iter().map(array).collect()
}

/// An index as VTK itself writes it; some readers turn unsigned ones into floating-point numbers.
fn index(value: usize) -> i64 {
    i64::try_from(value).expect("no mesh has 2^63 nodes")
}
