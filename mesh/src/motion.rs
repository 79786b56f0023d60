//! Mesh motion: the nodes inside follow the boundary as an elastic or a harmonic body would.
//!
//! Find `d` with the prescribed values on part of the boundary and, for all test functions `q` that vanish
//! there,
//!
//! ```text
//! elastic    sum_e (J_0/J_e)^chi [ lambda (div q, div d)_e + 2 mu (eps(q), eps(d))_e ] = 0
//! harmonic   sum_e (J_0/J_e)^chi (grad q, grad d)_e = 0
//! ```
//!
//! with the cell's measure `J_e`, any constant `J_0` (the mean measure) and an exponent `chi` that makes
//! small cells stiffer (Johnson and Tezduyar, Comput. Methods Appl. Mech. Eng. 119, 1994). Young's modulus
//! cancels. Both matrices are symmetric positive definite.

mod check;
mod coupling;
mod error;
mod kernel;
mod prescribed;
mod settings;
mod system;

pub use check::MotionQuality;
pub use error::MotionError;
pub use prescribed::prescribed_dofs;
pub use settings::{MotionLaw, MotionMode, MotionSettings};

use crate::cell::Cells;
use crate::mesh::Mesh;
use crate::quality;
use crate::simplex;
use system::System;

/// Moves the nodes of a mesh with its boundary.
///
/// Displacements are vectors `node * D + c` in metres, counted from the **reference** mesh in both modes.
/// Nothing is allocated after construction.
///
/// ```
/// use partita_mesh::generate::{Diagonal, RectangleMesh, rectangle};
/// use partita_mesh::motion::{MeshMotion, MotionSettings, prescribed_dofs};
///
/// let mesh = rectangle(&RectangleMesh {
///     origin: [0.0, 0.0],
///     size: [1.0, 1.0],
///     divisions: [2, 2],
///     pattern: Diagonal::Right,
/// })?;
/// let prescribed = prescribed_dofs(&mesh, &[])?;
/// let mut motion = MeshMotion::new(&mesh, MotionSettings::default(), &prescribed)?;
///
/// // Stretch the boundary by a tenth in x; the node at the centre follows.
/// let mut displacement = vec![0.0; 18];
/// for (node, point) in mesh.points().iter().enumerate() {
///     if prescribed[2 * node] {
///         displacement[2 * node] = 0.1 * point[0];
///     }
/// }
/// let committed = vec![0.0; 18];
/// motion.begin_step(&committed)?;
/// motion.displace(&committed, &mut displacement)?;
/// assert!((displacement[8] - 0.05).abs() < 1e-14);
/// let quality = motion.check(&displacement)?;
/// assert!((quality.smallest_ratio - 1.1).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct MeshMotion<const D: usize> {
    points: Vec<[f64; D]>,
    cells: Cells,
    reference_measures: Vec<f64>,
    mode: MotionMode,
    system: System<D>,
    factorizations: usize,
    solves: usize,
}

impl<const D: usize> MeshMotion<D> {
    /// Prepares the motion of `mesh`, where `prescribed[node * D + c]` tells whether a component of the
    /// displacement is given; assembles and factors the matrix of the reference mesh.
    ///
    /// # Errors
    /// [`MotionError`] for settings out of range, for a mesh that nothing holds in some direction, or when
    /// the factorization fails.
    ///
    /// # Panics
    /// If `prescribed` does not have `D` entries a node.
    pub fn new(mesh: &Mesh<D>, settings: MotionSettings, prescribed: &[bool]) -> Result<Self, MotionError> {
        assert_eq!(prescribed.len(), D * mesh.points().len(), "`prescribed` has D entries a node");
        settings.check()?;
        check_supports::<D>(prescribed)?;
        let reference_measures = quality::measures(mesh.points(), mesh.cells());
        let mean_measure = reference_measures.iter().sum::<f64>() / reference_measures.len() as f64;
        let mut system = System::new(mesh.cells(), settings.law, mean_measure, prescribed)?;
        let at_rest = vec![0.0; prescribed.len()];
        system.factor_at(mesh.points(), mesh.cells(), &at_rest)?;
        Ok(Self {
            points: mesh.points().to_vec(),
            cells: mesh.cells().clone(),
            reference_measures,
            mode: settings.mode,
            system,
            factorizations: 0,
            solves: 0,
        })
    }

    /// Starts a step from the committed displacement `[m]`: [`MotionMode::Incremental`] assembles and
    /// factors the matrix of the committed mesh, [`MotionMode::Reference`] has nothing to do.
    ///
    /// # Errors
    /// [`MotionError::Inverted`] if the committed mesh has an inverted cell, [`MotionError::Factorization`].
    ///
    /// # Panics
    /// If `committed` does not have `D` entries a node.
    pub fn begin_step(&mut self, committed: &[f64]) -> Result<(), MotionError> {
        self.assert_length(committed);
        match self.mode {
            MotionMode::Reference => Ok(()),
            MotionMode::Incremental => {
                self.factorizations += 1;
                self.system.factor_at(&self.points, &self.cells, committed)
            }
        }
    }

    /// Fills the free entries of `displacement` from its prescribed ones; both are total displacements `[m]`.
    ///
    /// `committed` is the displacement that [`begin_step`](Self::begin_step) got. In reference mode
    /// `d = -K_ff^-1 K_fp d_p` does not depend on it; in incremental mode
    /// `d = d_n - K_ff^-1 K_fp (d_p - d_{n,p})`.
    ///
    /// # Errors
    /// [`MotionError::NotFinite`] when a prescribed entry is infinite or not a number.
    ///
    /// # Panics
    /// If a vector does not have `D` entries a node.
    pub fn displace(&mut self, committed: &[f64], displacement: &mut [f64]) -> Result<(), MotionError> {
        self.assert_length(committed);
        self.assert_length(displacement);
        let origin = match self.mode {
            MotionMode::Reference => None,
            MotionMode::Incremental => Some(committed),
        };
        self.system.check_finite(&self.points, displacement)?;
        self.system.displace(origin, displacement);
        self.solves += 1;
        Ok(())
    }

    /// How often a matrix was factored since the motion was prepared; that of the reference mesh, which
    /// [`new`](Self::new) factors, is not among them.
    #[must_use]
    pub fn factorizations(&self) -> usize {
        self.factorizations
    }

    /// How often the displacement inside was solved for.
    #[must_use]
    pub fn solves(&self) -> usize {
        self.solves
    }

    /// Measures and shapes of the cells after a displacement `[m]`.
    ///
    /// # Errors
    /// [`MotionError::Inverted`] names the cell of the smallest measure if that is not positive.
    ///
    /// # Panics
    /// If `displacement` does not have `D` entries a node.
    pub fn check(&self, displacement: &[f64]) -> Result<MotionQuality, MotionError> {
        self.assert_length(displacement);
        check::check(&self.points, &self.cells, &self.reference_measures, displacement)
    }

    fn assert_length(&self, displacement: &[f64]) {
        assert_eq!(displacement.len(), D * self.points.len(), "a displacement has D entries a node");
    }
}

/// Every direction needs a prescribed entry somewhere, or the mesh floats.
fn check_supports<const D: usize>(prescribed: &[bool]) -> Result<(), MotionError> {
    match (0..D).find(|&c| !prescribed.iter().skip(c).step_by(D).any(|&is_prescribed| is_prescribed)) {
        Some(component) => Err(MotionError::Floating { component }),
        None => Ok(()),
    }
}

/// The vertices of a cell of the displaced mesh, `X + d`.
fn moved_vertices<const D: usize>(
    points: &[[f64; D]],
    nodes: &[usize],
    displacement: &[f64],
) -> [[f64; D]; simplex::MAX_VERTICES] {
    let mut vertices = simplex::vertices(points, nodes);
    for (vertex, &node) in vertices.iter_mut().zip(nodes) {
        for c in 0..D {
            vertex[c] += displacement[node * D + c];
        }
    }
    vertices
}
