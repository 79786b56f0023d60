//! What can be wrong in a gmsh file, and what to do about it.

use super::element::ElementKind;

/// What is wrong with a file.
#[derive(Debug, Clone, PartialEq, thiserror::Error, miette::Diagnostic)]
pub enum Fault {
    /// Nothing but white space.
    #[error("the file is empty")]
    #[diagnostic(help("did gmsh fail, or is the disk full?"))]
    Empty,
    /// No `$MeshFormat` at the front.
    #[error("a gmsh file begins with `$MeshFormat`, this one with `{found}`")]
    #[diagnostic(help(
        "save it from gmsh as MSH 4.1 or 2.2; geometry (.geo) and other formats are not read"
    ))]
    NotGmsh {
        /// The first line.
        found: String,
    },
    /// Text of two or four bytes a character.
    #[error("the file is text in UTF-16, which is not read")]
    #[diagnostic(help(
        "save it as UTF-8 (or ASCII): `iconv -f UTF-16 -t UTF-8 old.msh > new.msh`, or choose the encoding in the editor"
    ))]
    Utf16,
    /// Lines that end with a carriage return alone.
    #[error("the lines end with carriage returns alone")]
    #[diagnostic(help("convert the line ends: `tr '\\r' '\\n' < old.msh > new.msh`"))]
    CarriageReturns,
    /// Another version.
    #[error("format version `{found}` is not read")]
    #[diagnostic(help("save as 4.1 or 2.2: `gmsh -0 old.msh -format msh41 -o new.msh`"))]
    Version {
        /// As written.
        found: String,
    },
    /// Neither text nor binary.
    #[error("file type `{found}` is neither 0 (text) nor 1 (binary)")]
    #[diagnostic(help("the header line is `4.1 0 8` for text"))]
    FileType {
        /// As written.
        found: String,
    },
    /// Numbers that are not doubles and 64-bit sizes.
    #[error("numbers of `{found}` bytes are not read, only of 8")]
    #[diagnostic(help("save the mesh with a 64-bit gmsh"))]
    DataSize {
        /// As written.
        found: String,
    },
    /// The number 1 is not there in either byte order.
    #[error("bytes {found:?} are not the number 1 in either byte order")]
    #[diagnostic(help("was a binary file changed by a text editor or a transfer in text mode?"))]
    ByteOrder {
        /// As found.
        found: [u8; 4],
    },
    /// The end of the file in the middle.
    #[error("the file ends where {wanted} was expected")]
    #[diagnostic(help("it was cut short, write or copy it again"))]
    Truncated {
        /// What did not come.
        wanted: String,
    },
    /// The end of a line in the middle of a record.
    #[error("the line ends where {wanted} was expected")]
    #[diagnostic(help("each record fills one line"))]
    LineEnds {
        /// What did not come.
        wanted: &'static str,
    },
    /// More on a line than its record has.
    #[error("`{found}` is left on the line after {record}")]
    #[diagnostic(help("each record fills one line"))]
    Surplus {
        /// The complete record.
        record: &'static str,
        /// What is left.
        found: String,
    },
    /// A word that is no number of the right kind.
    #[error("{wanted} was expected, not `{found}`")]
    #[diagnostic(help("only finite numbers, and whole ones for tags and counts, can stand here"))]
    NotANumber {
        /// What was expected.
        wanted: &'static str,
        /// As written.
        found: String,
    },
    /// A section mark where data should be.
    #[error("{wanted} was expected, but `{found}` ends the section")]
    #[diagnostic(help("a count of the section is too large, or lines are missing"))]
    SectionEndsEarly {
        /// What did not come.
        wanted: &'static str,
        /// The mark.
        found: String,
    },
    /// Data where the section should end.
    #[error("`{end}` was expected, not `{found}`")]
    #[diagnostic(help("a count of the section is too small, or the mark is missing or misspelt"))]
    SectionGoesOn {
        /// The mark that should be here.
        end: String,
        /// What is here.
        found: String,
    },
    /// A section to be leapt over that does not end.
    #[error("the section has no `{end}`")]
    #[diagnostic(help("the file was cut short, or the section's name is misspelt"))]
    SectionOpen {
        /// The mark that is missing.
        end: String,
    },
    /// Text between sections.
    #[error("a section (`$Name`) was expected, not `{found}`")]
    #[diagnostic(help("the section before holds more than it says"))]
    OutsideSections {
        /// The line.
        found: String,
    },
    /// A section twice.
    #[error("the section was there before")]
    #[diagnostic(help("two meshes in one file? merge them in gmsh"))]
    DuplicateSection,
    /// A section that is needed.
    #[error("the file has no section {section}")]
    #[diagnostic(help("mesh the geometry in gmsh before saving it"))]
    MissingSection {
        /// The section.
        section: &'static str,
    },
    /// Sections in an order in which they cannot be understood.
    #[error("{first} must come before {second}")]
    #[diagnostic(help("gmsh writes them so; save the file again"))]
    SectionOrder {
        /// What must come first.
        first: &'static str,
        /// What must follow.
        second: &'static str,
    },
    /// A partitioned mesh.
    #[error("partitioned meshes are not read")]
    #[diagnostic(help("remove the partition in gmsh (Mesh > Unpartition) and save again"))]
    Partitioned,
    /// Nodes with parameters in a section of their own, as 2.2 has them.
    #[error("nodes with parameters are not read from format 2.2")]
    #[diagnostic(help("set Mesh.SaveParametric = 0 and save again, or save as 4.1"))]
    ParametricNodes,
    /// A count that cannot be true.
    #[error("{count} {what} do not fit into the {left} bytes that are left")]
    #[diagnostic(help("the count is wrong, or the file was cut short"))]
    TooMany {
        /// What is counted.
        what: &'static str,
        /// How many are announced.
        count: u64,
        /// Bytes behind the count.
        left: usize,
    },
    /// A total that differs from the sum of its parts.
    #[error("{announced} {what} are announced, the blocks hold {found}")]
    #[diagnostic(help("save the file from gmsh again"))]
    Total {
        /// What is counted.
        what: &'static str,
        /// The total as written.
        announced: u64,
        /// The sum of the parts.
        found: u64,
    },
    /// A negative count or tag.
    #[error("{wanted} cannot be negative: {value}")]
    #[diagnostic(help("was the file written by a converter? save it with gmsh"))]
    Negative {
        /// What was expected.
        wanted: &'static str,
        /// As found.
        value: i64,
    },
    /// More or fewer dimensions than there are.
    #[error("a dimension is 0, 1, 2 or 3, not {value}")]
    #[diagnostic(help("the line does not begin with a dimension, or is damaged"))]
    Dimension {
        /// As found.
        value: i64,
    },
    /// Neither with nor without parameters.
    #[error("nodes have parameters (1) or not (0), {value} says neither")]
    #[diagnostic(help("the fields of a block are dimension, tag, parameters, count"))]
    Parametric {
        /// As found.
        value: i64,
    },
    /// An infinite coordinate or none at all.
    #[error("a coordinate is {value}")]
    #[diagnostic(help("remesh; a geometry with zero or infinite lengths makes such nodes"))]
    NotFinite {
        /// As found.
        value: f64,
    },
    /// The tag that gmsh never gives.
    #[error("a node has tag 0")]
    #[diagnostic(help("gmsh counts from 1; was the file written by a converter?"))]
    NodeZero,
    /// A tag given twice.
    #[error("node {tag} is given twice")]
    #[diagnostic(help("renumber and save again in gmsh (`RenumberMeshNodes`)"))]
    DuplicateNode {
        /// The tag.
        tag: u64,
    },
    /// An element on a node that does not exist.
    #[error("element {element} names node {node}, which is not in $Nodes")]
    #[diagnostic(help("save nodes and elements together, with the same gmsh options"))]
    MissingNode {
        /// The element's tag.
        element: u64,
        /// The node's tag.
        node: u64,
    },
    /// An element type that is not read.
    #[error("element type {code} ({name}) is not read")]
    #[diagnostic(help(
        "points, lines, triangles, quadrilaterals and tetrahedra of order 1 and 2 are; set Mesh.ElementOrder = 1"
    ))]
    ForeignElement {
        /// Its number.
        code: i64,
        /// What it is.
        name: &'static str,
    },
    /// An element in an entity of another dimension.
    #[error("a {kind} cannot lie in entity {tag} of dimension {dimension}")]
    #[diagnostic(help("the fields of a block are dimension, tag, type, count"))]
    ElementOfEntity {
        /// The elements of the block.
        kind: ElementKind,
        /// The entity's dimension.
        dimension: usize,
        /// The entity's tag.
        tag: i64,
    },
    /// Elements of an entity that does not exist.
    #[error("entity {tag} of dimension {dimension} is not in $Entities")]
    #[diagnostic(help("its physical groups are not known; save the file from gmsh again"))]
    MissingEntity {
        /// The entity's dimension.
        dimension: usize,
        /// The entity's tag.
        tag: i64,
    },
    /// An entity given twice.
    #[error("entity {tag} of dimension {dimension} is given twice")]
    #[diagnostic(help("its physical groups are not clear; save the file from gmsh again"))]
    DuplicateEntity {
        /// The entity's dimension.
        dimension: usize,
        /// The entity's tag.
        tag: i64,
    },
    /// A name without quotes, empty, or not UTF-8.
    #[error("`{found}` is not a name in double quotes")]
    #[diagnostic(help("names are not empty, are UTF-8 and hold no quotes: 1 5 \"inflow\""))]
    Name {
        /// As written.
        found: String,
    },
    /// A name that does not say whether it is that of a curve or of a surface.
    #[error("the name `{name}` has no dimension, so it is not clear what group {tag} consists of")]
    #[diagnostic(help(
        "write the dimension (1 for curves, 2 for surfaces) before the number, in place of any -1: `1 {tag} \"{name}\"`; only format 2.0, which is read, has names without"
    ))]
    NameWithoutDimension {
        /// The group's tag.
        tag: u64,
        /// The name.
        name: String,
    },
    /// Two names for one group.
    #[error("group {tag} of dimension {dimension} gets a second name, `{name}`")]
    #[diagnostic(help("give each physical group one name"))]
    DuplicateName {
        /// The group's dimension.
        dimension: usize,
        /// The group's tag.
        tag: u64,
        /// The second name.
        name: String,
    },
}

/// The beginning of some text of a file, safe to print.
pub(super) fn excerpt(text: &[u8]) -> String {
    const LONGEST: usize = 32;
    let start = &text[..text.len().min(LONGEST)];
    let shown = String::from_utf8_lossy(start);
    let shown = shown.trim_end();
    if shown.contains(char::is_control) {
        return "(bytes that are no text)".into();
    }
    let dots = if text.len() > LONGEST { "..." } else { "" };
    format!("{shown}{dots}")
}
