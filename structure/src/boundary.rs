//! Parts of the boundary: how supports and the interface are named.

use partita_iga::Side;

/// Parts of the boundary of a structure, named as its space names them.
///
/// ```
/// use partita_iga::Side;
/// use partita_structure::Boundary;
///
/// let of_patch = Boundary::from([Side::LEFT, Side::TOP]);
/// let of_mesh = Boundary::from(["clamp", "skin"]);
/// assert!(matches!(of_mesh, Boundary::Groups(names) if names.len() == 2));
/// assert_eq!(of_patch, [Side::LEFT, Side::TOP].into_iter().collect());
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Boundary {
    /// Sides of a patch.
    Sides(Vec<Side>),
    /// Boundary groups of a mesh.
    Groups(Vec<String>),
}

impl Boundary {
    /// No part at all; fits every space.
    pub const NONE: Self = Self::Sides(Vec::new());

    /// Whether there is no part.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        match self {
            Self::Sides(sides) => sides.is_empty(),
            Self::Groups(groups) => groups.is_empty(),
        }
    }

    /// Number of parts.
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            Self::Sides(sides) => sides.len(),
            Self::Groups(groups) => groups.len(),
        }
    }

    /// The parts with these indices.
    ///
    /// # Panics
    /// When an index is not below [`len`](Self::len).
    #[must_use]
    pub fn only(&self, indices: &[usize]) -> Self {
        match self {
            Self::Sides(sides) => Self::Sides(indices.iter().map(|&k| sides[k]).collect()),
            Self::Groups(groups) => Self::Groups(indices.iter().map(|&k| groups[k].clone()).collect()),
        }
    }
}

impl Default for Boundary {
    fn default() -> Self {
        Self::NONE
    }
}

impl From<Side> for Boundary {
    fn from(side: Side) -> Self {
        Self::Sides(vec![side])
    }
}

impl From<Vec<Side>> for Boundary {
    fn from(sides: Vec<Side>) -> Self {
        Self::Sides(sides)
    }
}

impl<const N: usize> From<[Side; N]> for Boundary {
    fn from(sides: [Side; N]) -> Self {
        Self::Sides(sides.into())
    }
}

impl FromIterator<Side> for Boundary {
    fn from_iter<I: IntoIterator<Item = Side>>(sides: I) -> Self {
        Self::Sides(sides.into_iter().collect())
    }
}

impl From<&str> for Boundary {
    fn from(group: &str) -> Self {
        Self::Groups(vec![group.to_owned()])
    }
}

impl From<Vec<String>> for Boundary {
    fn from(groups: Vec<String>) -> Self {
        Self::Groups(groups)
    }
}

impl<const N: usize> From<[&str; N]> for Boundary {
    fn from(groups: [&str; N]) -> Self {
        Self::Groups(groups.map(str::to_owned).into())
    }
}

impl FromIterator<String> for Boundary {
    fn from_iter<I: IntoIterator<Item = String>>(groups: I) -> Self {
        Self::Groups(groups.into_iter().collect())
    }
}
