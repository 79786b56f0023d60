//! How a structure moves in time, and whether its material can carry its load.

use partita_structure::StructureSolver;

use super::scales::{FlowScales, extents, largest, most};
use super::{Found, Kind};
use partita_scene::formulas::times;
use partita_scene::schema::{Elastic, Material, Structure, StructureTimeScheme};

/// Largest spectral radius, and smallest gamma of Newmark's method, that damp the interface force.
const RADIUS: f64 = 0.9;
const GAMMA: f64 = 0.55;
/// Steps that a first period should have.
const STEPS_A_PERIOD: f64 = 10.0;
/// Pressure that a solid bears without large strains, as part of Young's modulus.
const STRAIN: f64 = 0.1;
/// Densities above this one `[kg/m3]` belong to metals, ceramics and glass, in which sound is faster than `SOUND` `[m/s]`.
const DENSE: f64 = 2000.0;
const SOUND: f64 = 100.0;

/// The time scheme of a structure that is coupled in both directions.
pub(super) fn damping(found: &mut Found<'_>, structure: &Structure) {
    let path = ["structure", "time_scheme"];
    let (what, remedy) = match structure.time_scheme {
        StructureTimeScheme::GeneralizedAlpha { spectral_radius } if spectral_radius.get() > RADIUS => (
            format!("spectral radius {spectral_radius} hardly damps the highest frequencies"),
            "leave `spectral_radius` at its default",
        ),
        StructureTimeScheme::Newmark { gamma, .. } if gamma.get() < GAMMA => (
            format!("Newmark's method with gamma = {gamma} does not damp the highest frequencies"),
            "take `generalized_alpha`, or gamma 0.6",
        ),
        _ => return,
    };
    let what = format!("{what}: the force at the interface will oscillate from step to step");
    found.warn(Kind::UndampedStructure, &path, what, remedy);
}

/// Whether the step resolves the first vibration.
pub(super) fn step(found: &mut Found<'_>, period: Option<f64>) {
    let step = found.resolved.scene.time.step.get();
    if let Some(period) = period.filter(|period| step > period / STEPS_A_PERIOD) {
        found.warn(
            Kind::LongStep,
            &["time", "step"],
            format!(
                "a step of {step} s is long against the structure's first period of {period:.3e} s without fluid"
            ),
            format!(
                "take {:.1e} s, or `structure.time_scheme = \"quasi_static\"` where only the steady state counts",
                period / 20.0
            ),
        );
    }
}

/// The pressure `[Pa]` that the fluid and its own weight put on a structure.
pub(super) fn pressure(
    found: &Found<'_>,
    structure: &Structure,
    solver: &StructureSolver<2>,
    flow: Option<&FlowScales>,
) -> f64 {
    let [width, height] = extents(solver.space().points());
    let weight = times(&found.resolved.scene.time).into_iter().map(|time| {
        let [x, y] = largest(&structure.body_force, &[[0.0; 2]], time);
        x * width + y * height
    });
    most(weight) + flow.map_or(0.0, |flow| flow.pressure)
}

/// Whether the modulus may be in another unit.
pub(super) fn modulus(found: &mut Found<'_>, structure: &Structure, pressure: f64) {
    let (law, elastic) = match structure.material {
        Material::SaintVenantKirchhoff(elastic) => ("saint_venant_kirchhoff", elastic),
        Material::NeoHookean(elastic) => ("neo_hookean", elastic),
        Material::LinearElastic(elastic) => ("linear_elastic", elastic),
    };
    let Elastic { young_modulus, .. } = elastic;
    let (modulus, density) = (young_modulus.get(), structure.density.get());
    let sound = (modulus / density).sqrt();
    let what = if pressure > STRAIN * modulus {
        format!("a load of about {pressure:.1e} Pa acts on a material of {young_modulus} Pa")
    } else if density > DENSE && sound < SOUND {
        format!(
            "sound would travel at {sound:.1} m/s in a material of {density} kg/m3 and {young_modulus} Pa"
        )
    } else {
        return;
    };
    found.warn(
        Kind::SoftStructure,
        &["structure", "material", law, "young_modulus"],
        what,
        "give Young's modulus in Pa: 1 MPa is 1e6, 1 GPa is 1e9",
    );
}
