//! Numbers of the flow that lie far outside the range in which the method was tested.

use super::scales::FlowScales;
use super::{Found, Kind};
use partita_scene::schema::{Fluid, FluidTimeScheme};

/// The largest Reynolds number of the benchmarks is about 1000.
const REYNOLDS: f64 = 1e4;
/// Cells that the fastest fluid may cross in a step.
const COURANT: f64 = 50.0;
/// Largest Reynolds number of a cell.
const CELL_REYNOLDS: f64 = 500.0;

pub(super) fn check(found: &mut Found<'_>, fluid: &Fluid, scales: &FlowScales) {
    if !fluid.convection {
        return;
    }
    let kinematic = fluid.viscosity.get() / fluid.density.get();
    let FlowScales { velocity, length, cell, .. } = *scales;
    let reynolds = velocity * length / kinematic;
    if reynolds > REYNOLDS {
        found.warn(
            Kind::ReynoldsNumber,
            &["fluid", "viscosity"],
            format!(
                "the Reynolds number is {reynolds:.1e} ({velocity:.3} m/s over {length:.3} m), tested up to 1e3; \
                 there is no turbulence model"
            ),
            "check velocities and viscosity, or refine the mesh and compare",
        );
    }
    let of_cell = velocity * cell / kinematic;
    if of_cell > CELL_REYNOLDS {
        found.warn(
            Kind::CellReynoldsNumber,
            &["fluid", "mesh"],
            format!("the Reynolds number of a cell of {cell:.2e} m is {of_cell:.1e}: stabilization replaces viscosity"),
            "refine the mesh",
        );
    }
    let step = found.resolved.scene.time.step.get();
    let courant = velocity * step / cell;
    if courant > COURANT && fluid.time_scheme != FluidTimeScheme::Steady {
        found.warn(
            Kind::CourantNumber,
            &["time", "step"],
            format!("the fluid crosses {courant:.0} cells of {cell:.2e} m in one step (CFL number)"),
            "take a smaller step, or `fluid.time_scheme = \"steady\"` where only the steady state counts",
        );
    }
}
