//! The scene's structure in the words of the structure crate.

use partita_iga::{Side, project};
use partita_structure::{
    BodyForce, Boundary, Held, Law, LineSearch, Material, MaterialError, Plane, Rayleigh, Space,
    StructureModel, StructureSettings, TimeScheme,
};

use super::newton;
use crate::schema;

/// What the structure is made of, and how it is held, in `space`.
///
/// # Errors
/// When the constants of its material are out of their range.
pub fn model(structure: &schema::Structure, space: &Space<2>) -> Result<StructureModel<2>, MaterialError> {
    let (clamped, held) = supports(space, structure);
    Ok(StructureModel {
        density: structure.density.get(),
        material: material(&structure.material)?.into(),
        body_force: body_force(&structure.body_force),
        clamped,
        held,
        wetted: boundary(space, &structure.wetted),
    })
}

/// How the structure is solved.
#[must_use]
pub fn settings(structure: &schema::Structure) -> StructureSettings {
    StructureSettings {
        time: match structure.time_scheme {
            schema::StructureTimeScheme::GeneralizedAlpha { spectral_radius } => {
                TimeScheme::GeneralizedAlpha { spectral_radius: spectral_radius.get() }
            }
            schema::StructureTimeScheme::Newmark { beta, gamma } => {
                TimeScheme::Newmark { beta: beta.get(), gamma: gamma.get() }
            }
            schema::StructureTimeScheme::QuasiStatic => TimeScheme::QuasiStatic,
        },
        newton: newton(&structure.newton),
        rayleigh: structure
            .rayleigh_damping
            .map(|damping| Rayleigh { mass: damping.mass.get(), stiffness: damping.stiffness.get() }),
        line_search: structure.line_search.map(|search| LineSearch {
            tolerance: search.tolerance.get(),
            max_evaluations: search.max_evaluations.get(),
        }),
    }
}

pub(super) fn material(material: &schema::Material) -> Result<Material, MaterialError> {
    let (law, elastic) = match material {
        schema::Material::SaintVenantKirchhoff(elastic) => (Law::StVenantKirchhoff, elastic),
        schema::Material::NeoHookean(elastic) => (Law::NeoHookean, elastic),
        schema::Material::LinearElastic(elastic) => (Law::LinearElastic, elastic),
    };
    let plane = match elastic.plane {
        schema::Plane::Strain => Plane::Strain,
        schema::Plane::Stress => Plane::Stress,
    };
    Material::new(law, elastic.young_modulus.get(), elastic.poisson_ratio.get(), plane)
}

/// A body force is uniform in space; the scene has made sure that no expression asks for the place.
fn body_force(formula: &schema::VectorFormula) -> BodyForce<2> {
    if let Some(force) = formula.constant() {
        return BodyForce::Constant(force);
    }
    let field = formula.function();
    BodyForce::in_time(move |time| field(&[0.0; 2], time))
}

/// Parts of the boundary of a space by the names a scene has for them.
#[must_use]
pub fn boundary(space: &Space<2>, parts: &[schema::Part]) -> Boundary {
    named(space, parts.iter().map(schema::Part::name))
}

fn named<'a>(space: &Space<2>, names: impl Iterator<Item = &'a str>) -> Boundary {
    match space {
        Space::Patch(_) => names.filter_map(side).collect(),
        Space::Lagrange(_) => names.map(str::to_owned).collect(),
    }
}

/// What a scene clamps, and what it holds in some directions.
#[must_use]
pub fn supports(space: &Space<2>, structure: &schema::Structure) -> (Boundary, Vec<Held<2>>) {
    let held = |(part, held): (&String, &Vec<schema::Component>)| {
        let mut components = [false; 2];
        for component in held {
            components[component.index()] = true;
        }
        Held { parts: named(space, std::iter::once(part.as_str())), components }
    };
    (boundary(space, &structure.clamped), structure.held.iter().map(held).collect())
}

/// A point off a patch by less than this part of its size is taken to be on it.
const ON_PATCH: f64 = 1e-6;

/// Where an undeformed point \[m\] lies in a space, as its fields are evaluated there: parameters of a patch, the point
/// itself in a mesh. `None` outside of it.
#[must_use]
pub fn place_in(space: &Space<2>, point: [f64; 2]) -> Option<[f64; 2]> {
    match space {
        Space::Patch(patch) => {
            let spline = patch.spline();
            let nearest = project::closest_point(spline, &point);
            let [low, high] = spline.bounding_box();
            let size = (high[0] - low[0]).hypot(high[1] - low[1]);
            (nearest.distance <= ON_PATCH * size).then(|| [nearest.xi[0], nearest.xi[1]])
        }
        Space::Lagrange(mesh) => mesh.locate(&point).map(|_| point),
    }
}

/// A side of a patch by its name; a scene that names another one has been refused.
#[must_use]
pub fn side(name: &str) -> Option<Side> {
    [Side::LEFT, Side::RIGHT, Side::BOTTOM, Side::TOP].into_iter().find(|side| side.to_string() == name)
}
