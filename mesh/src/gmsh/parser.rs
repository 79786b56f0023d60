//! The sections of a file, one after the other.

use std::path::Path;

use super::cursor::Cursor;
use super::document::{ElementBlock, GmshFile};
use super::entities::{self, Entities};
use super::error::{ParseError, ReadError};
use super::fault::Fault;
use super::header::{self, Version};
use super::names::{self, Label};
use super::numbering::{GroupSets, NodeList};
use super::{version2, version4};

impl GmshFile {
    /// Reads the contents of a file.
    ///
    /// # Errors
    /// [`ParseError`] names the line (text) or byte (binary), the section, what is wrong and a remedy.
    pub fn parse(bytes: &[u8]) -> Result<Self, ParseError> {
        parse(bytes)
    }

    /// Reads a file.
    ///
    /// # Errors
    /// [`ReadError`] when the file cannot be opened or is no complete mesh of format 2.0 to 2.2 or 4.1.
    pub fn read(path: &Path) -> Result<Self, ReadError> {
        let bytes = std::fs::read(path).map_err(|source| ReadError::File { path: path.into(), source })?;
        Self::parse(&bytes).map_err(|source| ReadError::Content { path: path.into(), source })
    }
}

fn parse(bytes: &[u8]) -> Result<GmshFile, ParseError> {
    let mut cursor = Cursor::new(bytes);
    let version = header::read(&mut cursor)?;
    let mut parser = Parser {
        cursor,
        version,
        sets: GroupSets::new(),
        names: None,
        entities: None,
        nodes: None,
        elements: None,
    };
    while let Some(section) = parser.cursor.open_section()? {
        parser.section(&section)?;
    }
    parser.finish()
}

/// The sections read so far.
struct Parser<'a> {
    cursor: Cursor<'a>,
    version: Version,
    sets: GroupSets,
    names: Option<Vec<Label>>,
    entities: Option<Entities>,
    nodes: Option<NodeList>,
    elements: Option<Vec<ElementBlock>>,
}

impl Parser<'_> {
    fn section(&mut self, name: &str) -> Result<(), ParseError> {
        match name {
            "MeshFormat" => return Err(self.cursor.fail(Fault::DuplicateSection)),
            "PhysicalNames" => {
                self.first(self.names.is_some())?;
                self.names = Some(names::read(&mut self.cursor, self.version)?);
            }
            "Entities" if self.version == Version::Four => {
                self.first(self.entities.is_some())?;
                self.before_elements()?;
                self.entities = Some(entities::read(&mut self.cursor, &mut self.sets)?);
            }
            "PartitionedEntities" => return Err(self.cursor.fail(Fault::Partitioned)),
            "ParametricNodes" => return Err(self.cursor.fail(Fault::ParametricNodes)),
            "Nodes" => {
                self.first(self.nodes.is_some())?;
                self.nodes = Some(match self.version {
                    Version::TwoZero | Version::Two => version2::nodes(&mut self.cursor)?,
                    Version::Four => version4::nodes(&mut self.cursor)?,
                });
            }
            "Elements" => {
                self.first(self.elements.is_some())?;
                self.elements = Some(self.elements()?);
            }
            // The format has sections of results, periodicity and comments, and lets anyone add more.
            _ => return self.cursor.skip_section(),
        }
        self.cursor.close_section()
    }

    fn elements(&mut self) -> Result<Vec<ElementBlock>, ParseError> {
        let Some(nodes) = &self.nodes else {
            return Err(self.cursor.fail(Fault::SectionOrder { first: "$Nodes", second: "$Elements" }));
        };
        let blocks = match self.version {
            Version::TwoZero | Version::Two => version2::elements(&mut self.cursor, nodes, &mut self.sets)?,
            Version::Four => version4::elements(&mut self.cursor, nodes, self.entities.as_ref())?,
        };
        Ok(blocks.finish(&self.sets))
    }

    fn first(&self, repeated: bool) -> Result<(), ParseError> {
        if repeated { Err(self.cursor.fail(Fault::DuplicateSection)) } else { Ok(()) }
    }

    fn before_elements(&self) -> Result<(), ParseError> {
        match self.elements {
            None => Ok(()),
            Some(_) => Err(self.cursor.fail(Fault::SectionOrder { first: "$Entities", second: "$Elements" })),
        }
    }

    fn finish(self) -> Result<GmshFile, ParseError> {
        let missing = |section| self.cursor.fail(Fault::MissingSection { section });
        let nodes = self.nodes.ok_or_else(|| missing("$Nodes"))?;
        let blocks = self.elements.ok_or_else(|| missing("$Elements"))?;
        let names = names::resolve(&self.cursor, self.names.unwrap_or_default(), &blocks)?;
        Ok(GmshFile { node_tags: nodes.tags, points: nodes.points, blocks, names })
    }
}
