//! What a structure is made of, and how it is solved.

use partita_numerics::newton;

use crate::body_force::BodyForce;
use crate::boundary::Boundary;
use crate::error::StructureError;
use crate::material::{AnyMaterial, Plane};
use crate::step::TimeScheme;
use crate::support::Held;

/// Properties, loads and supports of a structure.
#[derive(Debug, Clone)]
pub struct StructureModel<const D: usize> {
    /// Mass per reference volume rho `[kg/m^3]`.
    pub density: f64,
    /// The elastic law.
    pub material: AnyMaterial<D>,
    /// Force per reference volume b `[N/m^3]`.
    pub body_force: BodyForce<D>,
    /// Parts of the boundary whose nodes do not move: sides of a patch, groups of a mesh.
    pub clamped: Boundary,
    /// Parts of the boundary whose nodes move in some directions only.
    pub held: Vec<Held<D>>,
    /// Parts of the boundary that form the interface.
    pub wetted: Boundary,
}

impl<const D: usize> StructureModel<D> {
    /// A structure under no load that nothing holds, of a density `[kg/m^3]` and a material.
    #[must_use]
    pub fn new(density: f64, material: impl Into<AnyMaterial<D>>) -> Self {
        Self {
            density,
            material: material.into(),
            body_force: BodyForce::Constant([0.0; D]),
            clamped: Boundary::NONE,
            held: Vec::new(),
            wetted: Boundary::NONE,
        }
    }

    pub(crate) fn check(&self) -> Result<(), StructureError> {
        if !(self.density > 0.0 && self.density.is_finite()) {
            return Err(StructureError::Density { value: self.density });
        }
        if let AnyMaterial::Isotropic(material) = &self.material
            && D == 3
            && material.plane() == Plane::Stress
        {
            return Err(StructureError::PlaneStressInSpace);
        }
        let law = self.material.law();
        if let Err(source) = law.response(&[[0.0; D]; D]) {
            return Err(StructureError::NoStressAtRest { material: law.name().to_owned(), source });
        }
        Ok(())
    }
}

/// How a structure is solved.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct StructureSettings {
    /// Time integration.
    pub time: TimeScheme,
    /// When the Newton loop ends.
    pub newton: newton::Settings,
    /// Damping `C = mass M + stiffness K_0`.
    pub rayleigh: Option<Rayleigh>,
    /// Shortens Newton increments that overshoot.
    pub line_search: Option<LineSearch>,
}

impl StructureSettings {
    pub(crate) fn check(&self) -> Result<(), StructureError> {
        if let Some(Rayleigh { mass, stiffness }) = self.rayleigh {
            let is_fine = |factor: f64| factor >= 0.0 && factor.is_finite();
            if !(is_fine(mass) && is_fine(stiffness)) {
                return Err(StructureError::Damping { mass, stiffness });
            }
        }
        if let Some(LineSearch { tolerance, max_evaluations }) = self.line_search
            && !(tolerance > 0.0 && tolerance < 1.0 && max_evaluations > 0)
        {
            return Err(StructureError::LineSearch { tolerance, max_evaluations });
        }
        Ok(())
    }
}

/// Rayleigh damping: `C = mass M + stiffness K_0` with the stiffness `K_0` of the reference configuration.
///
/// A mode of circular frequency omega gets the damping ratio (mass/omega + stiffness omega)/2.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rayleigh {
    /// Factor of the mass `[1/s]`.
    pub mass: f64,
    /// Factor of the stiffness `[s]`.
    pub stiffness: f64,
}

/// Line search on the work of the residual along the Newton increment (Matthies and Strang 1979).
///
/// With G(s) = delta . R(d + s delta): the full step stays if |G(1)| <= tolerance |G(0)|, or if it falls short
/// (G has kept its sign); otherwise the root of G in (0, 1) is sought by regula falsi until the tolerance is met.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LineSearch {
    /// How far |G| must fall.
    pub tolerance: f64,
    /// At most so many residuals an iteration.
    pub max_evaluations: usize,
}

impl Default for LineSearch {
    /// To 0.8 of the work at the start, with at most ten residuals.
    fn default() -> Self {
        Self { tolerance: 0.8, max_evaluations: 10 }
    }
}
