//! Whether a fixed relaxation survives the added mass.

use partita_fluid::FluidSolver;
use partita_structure::{Mode, StructureSolver};

use super::{Found, Kind};
use crate::interface;
use partita_scene::schema::{Acceleration, Coupling, Direction, Fluid, FluidTimeScheme};

/// `(c_0 / c_0 of BDF1)^2`, what the time scheme makes of a displacement over dt^2: the interface's acceleration.
fn acceleration(scheme: FluidTimeScheme) -> f64 {
    match scheme {
        FluidTimeScheme::Bdf1 => 1.0,
        FluidTimeScheme::Bdf2 => 2.25,
        FluidTimeScheme::Steady => 0.0,
    }
}

/// The ratio mu of the fluid's inertia to the structure's resistance in its first mode, over one step of size `dt` `[s]`:
///
/// ```text
/// mu = (1 - alpha_f) c^2/dt^2 m_a / ((1 - alpha_m)/(beta dt^2) m + (1 - alpha_f) k)
/// ```
///
/// with the added mass `m_a` of an inviscid fluid. The iteration `x <- x + omega (x_tilde - x)` multiplies an error in
/// that mode by `1 - omega (1 + mu)`. `None` where the fluid cannot be asked.
pub(super) fn ratio(
    found: &Found<'_>,
    (fluid, structure): (&FluidSolver<2>, &StructureSolver<2>),
    scheme: FluidTimeScheme,
    coupling: &Coupling,
    mode: &Mode,
) -> Option<f64> {
    let transfer =
        interface::transfer(fluid, structure, coupling.transfer, coupling.projection_tolerance.get()).ok()?;
    let points = structure.interface_points();
    let shape: Vec<f64> = points.iter().flat_map(|point| [0, 1].map(|c| mode.shape[2 * point + c])).collect();
    let mut motion = vec![0.0; 2 * fluid.interface_nodes().len()];
    transfer.apply(&shape, &mut motion);
    let dt = found.resolved.scene.time.step.get();
    let (resistance, weight) = structure.resistance(mode, dt);
    let mass = fluid.added_mass(&motion).ok()?;
    Some(weight * acceleration(scheme) / (dt * dt) * mass / resistance)
}

/// The relaxation of the scene against the largest that converges.
pub(super) fn check(found: &mut Found<'_>, coupling: &Coupling, ratio: f64) {
    let Some(Acceleration::Constant { relaxation }) = coupling.acceleration else { return };
    let largest = 2.0 / (1.0 + ratio);
    if coupling.direction == Direction::TwoWay && relaxation.get() > largest {
        found.warn(
            Kind::AddedMass,
            &["coupling", "acceleration", "constant", "relaxation"],
            format!(
                "relaxation {relaxation} will not survive an added-mass ratio of about {ratio:.2}: the iteration of the \
                 first mode diverges above {largest:.2e}"
            ),
            "take `acceleration = \"iqn_imvls\"`, or a smaller relaxation",
        );
    }
}

/// The scheme of a fluid whose inertia counts.
pub(super) fn scheme(fluid: &Fluid) -> Option<FluidTimeScheme> {
    Some(fluid.time_scheme).filter(|scheme| *scheme != FluidTimeScheme::Steady)
}
