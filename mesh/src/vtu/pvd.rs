//! A collection of VTU files over time, rewritten as a whole whenever it changes.

use std::borrow::Cow;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use quick_xml::Reader;
use quick_xml::XmlVersion;
use quick_xml::events::{BytesStart, Event};

use super::{VtuError, atomic, document};

/// One file of a collection.
#[derive(Debug, Clone, PartialEq)]
pub struct PvdEntry {
    /// Its time `[s]`.
    pub time: f64,
    /// Its path, relative to the collection.
    pub file: String,
}

/// A `.pvd` file and what it lists; the file on disk is valid after every call.
///
/// ```
/// use partita_mesh::vtu::PvdCollection;
///
/// let folder = tempfile::tempdir()?;
/// let path = folder.path().join("fluid.pvd");
/// let mut collection = PvdCollection::create(&path)?;
/// collection.push(0.01, "fluid-0001.vtu")?;
/// collection.push(0.02, "fluid-0002.vtu")?;
///
/// // A run that resumes at t = 0.01 s drops what it will write again.
/// let mut resumed = PvdCollection::open(&path)?;
/// resumed.truncate_after(0.01)?;
/// assert_eq!(resumed.entries().len(), 1);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct PvdCollection {
    path: PathBuf,
    entries: Vec<PvdEntry>,
}

impl PvdCollection {
    /// An empty collection, written to `path` in place of what is there.
    ///
    /// # Errors
    /// [`VtuError::Write`].
    pub fn create(path: &Path) -> Result<Self, VtuError> {
        let collection = Self { path: path.to_path_buf(), entries: Vec::new() };
        collection.write()?;
        Ok(collection)
    }

    /// The collection that an earlier run wrote to `path`.
    ///
    /// # Errors
    /// [`VtuError::Read`], or [`VtuError::NotACollection`] when the file is something else.
    pub fn open(path: &Path) -> Result<Self, VtuError> {
        let text =
            fs::read_to_string(path).map_err(|source| VtuError::Read { path: path.to_path_buf(), source })?;
        let entries =
            parse(&text).map_err(|reason| VtuError::NotACollection { path: path.to_path_buf(), reason })?;
        Ok(Self { path: path.to_path_buf(), entries })
    }

    /// What it lists, in the order of writing.
    #[must_use]
    pub fn entries(&self) -> &[PvdEntry] {
        &self.entries
    }

    /// Adds a file, given relative to the collection, at `time` `[s]`.
    ///
    /// # Errors
    /// [`VtuError::Write`].
    pub fn push(&mut self, time: f64, file: &str) -> Result<(), VtuError> {
        self.entries.push(PvdEntry { time, file: file.into() });
        self.write()
    }

    /// Drops every entry later than `time` `[s]`.
    ///
    /// # Errors
    /// [`VtuError::Write`].
    pub fn truncate_after(&mut self, time: f64) -> Result<(), VtuError> {
        self.entries.retain(|entry| entry.time <= time);
        self.write()
    }

    fn write(&self) -> Result<(), VtuError> {
        atomic::write(&self.path, |file| write_collection(file, &self.entries))
    }
}

fn write_collection(output: impl Write, entries: &[PvdEntry]) -> io::Result<()> {
    let mut xml = document(output)?;
    let root = xml.create_element("VTKFile").with_attributes([
        ("type", "Collection"),
        ("version", "0.1"),
        ("byte_order", "LittleEndian"),
    ]);
    root.write_inner_content(|xml| {
        xml.create_element("Collection").write_inner_content(|xml| {
            for PvdEntry { time, file } in entries {
                xml.create_element("DataSet")
                    .with_attributes([("timestep", time.to_string().as_str()), ("file", file)])
                    .write_empty()?;
            }
            Ok(())
        })?;
        Ok(())
    })?;
    xml.get_mut().write_all(b"\n")
}

/// Entries of a collection, or what is wrong with it.
fn parse(text: &str) -> Result<Vec<PvdEntry>, String> {
    let mut reader = Reader::from_str(text);
    let mut entries = Vec::new();
    let (mut is_collection, mut is_whole) = (false, false);
    loop {
        match reader.read_event().map_err(|error| error.to_string())? {
            Event::Start(tag) if tag.name().as_ref() == "Collection" => is_collection = true,
            Event::End(tag) if tag.name().as_ref() == "VTKFile" => is_whole = true,
            Event::Empty(tag) if tag.name().as_ref() == "DataSet" => entries.push(entry(&tag)?),
            Event::Eof => break,
            _ => {}
        }
    }
    match (is_collection, is_whole) {
        (true, true) => Ok(entries),
        (false, _) => Err("it has no element `Collection`".into()),
        (true, false) => Err("it ends early".into()),
    }
}

fn entry(tag: &BytesStart<'_>) -> Result<PvdEntry, String> {
    let time = attribute(tag, "timestep")?;
    let time = time.parse().map_err(|_| format!("`{time}` is no time"))?;
    Ok(PvdEntry { time, file: attribute(tag, "file")?.into_owned() })
}

fn attribute<'a>(tag: &'a BytesStart<'_>, name: &str) -> Result<Cow<'a, str>, String> {
    let attribute = tag.try_get_attribute(name).map_err(|error| error.to_string())?;
    let attribute = attribute.ok_or_else(|| format!("a data set has no attribute `{name}`"))?;
    attribute.normalized_value(XmlVersion::Explicit1_0).map_err(|error| error.to_string())
}
