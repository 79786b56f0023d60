//! How mesh motion fails.

use partita_numerics::FactorError;

use crate::Place;

/// Why the mesh cannot follow its boundary.
#[derive(Debug, Clone, PartialEq, thiserror::Error, miette::Diagnostic)]
pub enum MotionError {
    /// A cell is flat or turned inside out after the motion.
    #[error("mesh motion: cell {cell} at {centroid} is inverted, measure {measure:.3e} m^{}", centroid.0.len())]
    #[diagnostic(help("smaller time steps, incremental mesh motion, or another stiffening"))]
    Inverted {
        /// The cell of the smallest measure.
        cell: usize,
        /// Its centroid in the displaced mesh.
        centroid: Place,
        /// Its signed measure `[m^D]`.
        measure: f64,
    },
    /// A prescribed displacement that is infinite or not a number.
    #[error("mesh motion: the prescribed displacement of node {node} at {place} is not finite")]
    #[diagnostic(help("the solver that moves this boundary has diverged"))]
    NotFinite {
        /// The node.
        node: usize,
        /// Where it is in the reference mesh.
        place: Place,
    },
    /// No displacement is prescribed in one direction.
    #[error("mesh motion: no node is held in direction {}", ["x", "y", "z"][*component])]
    #[diagnostic(help("not every boundary can slide in the same direction"))]
    Floating {
        /// The direction, 0 for x.
        component: usize,
    },
    /// The matrix of the motion could not be factored.
    #[error("mesh motion: {source}")]
    #[diagnostic(transparent)]
    Factorization {
        /// Why.
        #[from]
        source: FactorError,
    },
    /// Poisson's ratio of the mesh is outside its range.
    #[error("mesh motion: Poisson's ratio {value} of the mesh is not in (-1, 0.5)")]
    #[diagnostic(help("0.3 is common"))]
    PoissonRatio {
        /// As given.
        value: f64,
    },
    /// The stiffening exponent is negative or not finite.
    #[error("mesh motion: stiffening {value} is not a finite number >= 0")]
    #[diagnostic(help("1 to 2 is common"))]
    Stiffening {
        /// As given.
        value: f64,
    },
    /// A group that shall slide does not exist.
    #[error("mesh motion: there is no boundary group `{name}` to slide along")]
    #[diagnostic(help("the groups are {known}"))]
    UnknownGroup {
        /// As given.
        name: String,
        /// The names there are.
        known: String,
    },
    /// A group that shall slide is not normal to an axis.
    #[error(
        "mesh motion: nodes cannot slide along group `{name}`, its facet at {place} is not normal to an axis"
    )]
    #[diagnostic(help("only straight boundaries along x, y or z can slide"))]
    SlideNotAligned {
        /// The group.
        name: String,
        /// The centroid of its first oblique facet.
        place: Place,
    },
}
