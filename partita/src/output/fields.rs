//! Fields over time for viewers: `fluid.pvd` and `structure.pvd`, their files in `fields/`.

use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use partita_mesh::vtu::{Array, PvdCollection, save_vtu};
use partita_mesh::{CellKind, Cells};

use super::OutputError;

/// Folder of the VTU files in a run's folder.
pub(super) const FOLDER: &str = "fields";

/// Which field's files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Series {
    /// `fluid.pvd`
    Fluid,
    /// `structure.pvd`
    Structure,
}

impl Series {
    pub(super) const ALL: [Self; 2] = [Self::Fluid, Self::Structure];

    fn name(self) -> &'static str {
        match self {
            Self::Fluid => "fluid",
            Self::Structure => "structure",
        }
    }

    pub(super) fn collection(self) -> String {
        format!("{}.pvd", self.name())
    }

    fn file(self, step: usize) -> String {
        format!("{FOLDER}/{}-{step:06}.vtu", self.name())
    }
}

/// What is drawn at one moment.
#[derive(Debug, Clone, Copy)]
pub struct Snapshot<'a, const D: usize> {
    /// Points \[m\].
    pub points: &'a [[f64; D]],
    /// Cells between them.
    pub cells: &'a Cells,
    /// Values at the points.
    pub point_data: &'a [Array<'a>],
    /// Values in the cells.
    pub cell_data: &'a [Array<'a>],
}

/// Both collections; each appears with its first file.
#[derive(Debug)]
pub(super) struct FieldFiles {
    dir: PathBuf,
    collections: [Option<PvdCollection>; 2],
}

impl FieldFiles {
    pub(super) fn create(dir: &Path) -> Result<Self, OutputError> {
        let folder = dir.join(FOLDER);
        fs::create_dir_all(&folder).map_err(|source| OutputError::Write { path: folder, source })?;
        Ok(Self { dir: dir.to_owned(), collections: [None, None] })
    }

    /// Drops what lies after `time` \[s\], files included.
    pub(super) fn resume(dir: &Path, time: f64) -> Result<Self, OutputError> {
        let mut files = Self::create(dir)?;
        for series in Series::ALL {
            let path = dir.join(series.collection());
            if path.exists() {
                let mut collection = PvdCollection::open(&path)?;
                for entry in collection.entries().iter().filter(|entry| entry.time > time) {
                    remove_if_there(&dir.join(&entry.file))?;
                }
                collection.truncate_after(time)?;
                files.collections[series as usize] = Some(collection);
            }
        }
        Ok(files)
    }

    /// The time \[s\] of the last files.
    pub(super) fn last_time(&self) -> Option<f64> {
        let last = |collection: &PvdCollection| collection.entries().last().map(|entry| entry.time);
        self.collections.iter().flatten().filter_map(last).reduce(f64::max)
    }

    pub(super) fn write<const D: usize>(
        &mut self,
        series: Series,
        step: usize,
        time: f64,
        snapshot: &Snapshot<'_, D>,
    ) -> Result<(), OutputError> {
        let file = series.file(step);
        let Snapshot { points, cells, point_data, cell_data } = *snapshot;
        save_vtu(&self.dir.join(&file), points, cells, point_data, cell_data)?;
        let collection = &mut self.collections[series as usize];
        if collection.is_none() {
            *collection = Some(PvdCollection::create(&self.dir.join(series.collection()))?);
        }
        collection.as_mut().expect("just created").push(time, &file)?;
        Ok(())
    }
}

pub(super) fn remove_if_there(path: &Path) -> Result<(), OutputError> {
    match fs::remove_file(path) {
        Err(source) if source.kind() != ErrorKind::NotFound => {
            Err(OutputError::Write { path: path.to_owned(), source })
        }
        _ => Ok(()),
    }
}

/// Quadrilaterals that draw a spline surface: each element cut evenly in both parameters.
///
/// The points form one grid, first parameter fastest; evaluate position and fields at [`parameters`](Self::parameters).
///
/// ```
/// use partita::output::fields::Tessellation;
///
/// let drawing = Tessellation::new([&[0.0, 0.5, 1.0], &[0.0, 1.0]], 2);
/// assert_eq!(drawing.parameters().len(), 5 * 3);
/// assert_eq!(drawing.parameters()[6], [0.25, 0.5]);
/// assert_eq!(drawing.cells().len(), 4 * 2);
/// assert_eq!(drawing.cells().cell(0), [0, 1, 6, 5]);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Tessellation {
    parameters: Vec<[f64; 2]>,
    cells: Cells,
}

impl Tessellation {
    /// Cuts the elements between the `breakpoints` (knots without repetition, rising) of each parameter into
    /// `subdivisions` parts.
    ///
    /// # Panics
    /// When a parameter has fewer than two breakpoints, or there are no subdivisions.
    #[must_use]
    pub fn new(breakpoints: [&[f64]; 2], subdivisions: usize) -> Self {
        let [first, second] = breakpoints.map(|breakpoints| cut(breakpoints, subdivisions));
        let parameters = second.iter().flat_map(|&eta| first.iter().map(move |&xi| [xi, eta])).collect();
        let row = first.len();
        let corner = |i: usize, j: usize| j * row + i;
        let quads = (1..second.len()).flat_map(|j| (1..row).map(move |i| (i, j)));
        let nodes = quads
            .flat_map(|(i, j)| [corner(i - 1, j - 1), corner(i, j - 1), corner(i, j), corner(i - 1, j)])
            .collect();
        Self { parameters, cells: Cells::new(CellKind::Quadrilateral4, nodes) }
    }

    /// Parameters of each point.
    #[must_use]
    pub fn parameters(&self) -> &[[f64; 2]] {
        &self.parameters
    }

    /// The quadrilaterals.
    #[must_use]
    pub fn cells(&self) -> &Cells {
        &self.cells
    }
}

/// The breakpoints and evenly spaced values between them. Breakpoints are kept to the last bit.
fn cut(breakpoints: &[f64], parts: usize) -> Vec<f64> {
    assert!(breakpoints.len() > 1, "a parameter has at least one element");
    assert!(parts > 0, "an element is drawn by at least one cell");
    let mut values = Vec::with_capacity((breakpoints.len() - 1) * parts + 1);
    for ends in breakpoints.windows(2) {
        values.extend((0..parts).map(|part| ends[0] + (ends[1] - ends[0]) * (part as f64 / parts as f64)));
    }
    values.extend(breakpoints.last());
    values
}

/// Removes the VTU files of a run, and their folder when nothing else is in it.
pub(super) fn remove_all(dir: &Path) -> Result<(), OutputError> {
    let folder = dir.join(FOLDER);
    let Ok(entries) = fs::read_dir(&folder) else { return Ok(()) };
    for entry in entries.flatten().filter(|entry| entry.file_name().to_str().is_some_and(is_ours)) {
        remove_if_there(&entry.path())?;
    }
    // A folder that holds something else stays.
    let _ = fs::remove_dir(&folder);
    Ok(())
}

/// Whether a file in [`FOLDER`] has the name of a field file, or of the temporary one it is written to.
pub(super) fn is_ours(name: &str) -> bool {
    let ours = Series::ALL.iter().any(|series| name.starts_with(series.name()));
    ours && name.contains(".vtu")
}
