//! Element types of gmsh: those that are read, and the names of the others for messages.

use std::fmt;

/// The element types that are read. Nodes keep gmsh's order: corners first, then edges, then the centre.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ElementKind {
    /// A single node.
    Point1,
    /// A straight line.
    Line2,
    /// A line of second order.
    Line3,
    /// A straight triangle.
    Triangle3,
    /// A triangle of second order.
    Triangle6,
    /// A bilinear quadrilateral.
    Quadrilateral4,
    /// A quadrilateral of second order without centre.
    Quadrilateral8,
    /// A quadrilateral of second order.
    Quadrilateral9,
    /// A straight tetrahedron.
    Tetrahedron4,
    /// A tetrahedron of second order.
    Tetrahedron10,
}

impl ElementKind {
    /// All kinds, by dimension and number of nodes.
    pub const ALL: [Self; 10] = [
        Self::Point1,
        Self::Line2,
        Self::Line3,
        Self::Triangle3,
        Self::Triangle6,
        Self::Quadrilateral4,
        Self::Quadrilateral8,
        Self::Quadrilateral9,
        Self::Tetrahedron4,
        Self::Tetrahedron10,
    ];

    /// The kind with this number in gmsh files, if it is read.
    #[must_use]
    pub fn from_code(code: i32) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.code() == code)
    }

    /// The kind's number in gmsh files.
    #[must_use]
    pub const fn code(self) -> i32 {
        match self {
            Self::Point1 => 15,
            Self::Line2 => 1,
            Self::Line3 => 8,
            Self::Triangle3 => 2,
            Self::Triangle6 => 9,
            Self::Quadrilateral4 => 3,
            Self::Quadrilateral8 => 16,
            Self::Quadrilateral9 => 10,
            Self::Tetrahedron4 => 4,
            Self::Tetrahedron10 => 11,
        }
    }

    /// Dimension of the element itself.
    #[must_use]
    pub const fn dimension(self) -> usize {
        match self {
            Self::Point1 => 0,
            Self::Line2 | Self::Line3 => 1,
            Self::Triangle3
            | Self::Triangle6
            | Self::Quadrilateral4
            | Self::Quadrilateral8
            | Self::Quadrilateral9 => 2,
            Self::Tetrahedron4 | Self::Tetrahedron10 => 3,
        }
    }

    /// Number of nodes of one element.
    #[must_use]
    pub const fn node_count(self) -> usize {
        match self {
            Self::Point1 => 1,
            Self::Line2 => 2,
            Self::Line3 | Self::Triangle3 => 3,
            Self::Quadrilateral4 | Self::Tetrahedron4 => 4,
            Self::Triangle6 => 6,
            Self::Quadrilateral8 => 8,
            Self::Quadrilateral9 => 9,
            Self::Tetrahedron10 => 10,
        }
    }

    /// The straight simplex of a dimension: point, line, triangle or tetrahedron.
    ///
    /// # Panics
    /// In more than 3 dimensions.
    #[must_use]
    pub const fn simplex(dimension: usize) -> Self {
        match dimension {
            0 => Self::Point1,
            1 => Self::Line2,
            2 => Self::Triangle3,
            3 => Self::Tetrahedron4,
            _ => panic!("elements have at most 3 dimensions"),
        }
    }
}

impl fmt::Display for ElementKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let shape = match self {
            Self::Point1 => return f.write_str("point"),
            Self::Line2 | Self::Line3 => "line",
            Self::Triangle3 | Self::Triangle6 => "triangle",
            Self::Quadrilateral4 | Self::Quadrilateral8 | Self::Quadrilateral9 => "quadrilateral",
            Self::Tetrahedron4 | Self::Tetrahedron10 => "tetrahedron",
        };
        write!(f, "{}-node {shape}", self.node_count())
    }
}

/// What an element type is that is not read.
pub(super) fn foreign_name(code: i64) -> &'static str {
    match code {
        5 | 12 | 17 | 92 | 93 => "hexahedron",
        6 | 13 | 18 => "prism",
        7 | 14 | 19 => "pyramid",
        20..=25 => "triangle of third or higher order",
        26..=28 => "line of third or higher order",
        29..=31 => "tetrahedron of third or higher order",
        _ => "unknown to gmsh's manual",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_is_found_by_its_code() {
        for kind in ElementKind::ALL {
            assert_eq!(ElementKind::from_code(kind.code()), Some(kind));
        }
        assert_eq!(ElementKind::from_code(5), None);
    }
}
