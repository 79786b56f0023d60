//! What a scene leaves out has the value that the libraries give it.
//!
//! Each comparison goes through the whole settings of a library, so that a key added on either side is compared as well.

use partita_coupling::accelerate::{Acceleration, QuasiNewton};
use partita_coupling::{AtLimit, CouplingSettings, Predictor};
use partita_fluid::settings::FluidSettings;
use partita_iga::build::Alignment;
use partita_mesh::generate::{Diagonal, RectangleMesh, rectangle};
use partita_mesh::motion::MotionLaw;
use partita_structure::{LineSearch, Plane, StructureSettings, TimeScheme};
use serde::de::DeserializeOwned;
use serde_json::{Value, json};

use super::{coupling, fluid, structure};
use crate::schema;

/// A part of a scene with nothing but `given`.
fn part<T: DeserializeOwned>(given: &Value) -> T {
    serde_json::from_value(given.clone()).unwrap_or_else(|error| panic!("{given}: {error}"))
}

fn structure_with(key: &str, value: &Value) -> schema::Structure {
    let mut given = json!({
        "density": 1.0,
        "geometry": { "rectangle": { "size": [1.0, 1.0], "elements": [1, 1] } },
        "material": { "linear_elastic": { "young_modulus": 1.0, "poisson_ratio": 0.3 } },
    });
    given[key] = value.clone();
    part(&given)
}

#[test]
fn a_fluid_that_says_nothing_is_solved_as_the_library_would() {
    let size =
        RectangleMesh { origin: [0.0; 2], size: [1.0; 2], divisions: [1; 2], pattern: Diagonal::default() };
    let mesh = rectangle(&size).expect("a unit square");
    let given = json!({
        "density": 1.0,
        "viscosity": 1.0,
        "mesh": { "rectangle": { "size": [1.0, 1.0], "divisions": [1, 1] } },
        "boundary": {},
    });
    let scene: schema::Fluid = part(&given);
    assert_eq!(fluid::settings(&scene, &mesh, FluidSettings::default().threads), FluidSettings::default());
    let schema::FluidMesh::Rectangle(mesh) = &scene.mesh else { panic!("a rectangle was given") };
    assert_eq!(Diagonal::from(mesh.diagonals), Diagonal::default());
}

#[test]
fn a_structure_that_says_nothing_is_solved_as_the_library_would() {
    let scene = structure_with("clamped", &json!([]));
    assert_eq!(structure::settings(&scene), StructureSettings::default());
    let material = structure::material(&scene.material).expect("sound constants");
    assert_eq!(material.plane(), Plane::default());
}

#[test]
fn a_time_scheme_without_parameters_has_those_of_the_library() {
    for (given, expected) in [
        (json!({ "generalized_alpha": {} }), TimeScheme::default()),
        (json!({ "newmark": {} }), TimeScheme::AVERAGE_ACCELERATION),
    ] {
        let scene = structure_with("time_scheme", &given);
        assert_eq!(structure::settings(&scene).time, expected, "{given}");
    }
    let radius = TimeScheme::DEFAULT_SPECTRAL_RADIUS;
    assert_eq!(TimeScheme::default(), TimeScheme::GeneralizedAlpha { spectral_radius: radius });
}

#[test]
fn a_line_search_without_bounds_has_those_of_the_library() {
    let scene = structure_with("line_search", &json!({}));
    assert_eq!(structure::settings(&scene).line_search, Some(LineSearch::default()));
}

#[test]
fn a_law_of_mesh_motion_without_parameters_has_those_of_the_library() {
    let harmonic = MotionLaw::Harmonic { stiffening: MotionLaw::DEFAULT_STIFFENING };
    for (given, expected) in
        [(json!({ "elastic": {} }), MotionLaw::default()), (json!({ "harmonic": {} }), harmonic)]
    {
        let scene: schema::MeshMotion = part(&json!({ "law": given }));
        assert_eq!(fluid::motion(&scene).law, expected, "{given}");
    }
}

#[test]
fn accelerations_without_options_have_those_of_the_library() {
    let library = QuasiNewton::default();
    for (given, expected) in [
        (json!({ "iqn_ils": {} }), Acceleration::IqnIls(library)),
        (json!({ "iqn_mvj": {} }), Acceleration::IqnMvj(library)),
        (json!({ "iqn_imvls": {} }), Acceleration::IqnImvls(library)),
        (json!({ "aitken": {} }), Acceleration::Aitken { omega_0: library.omega_0 }),
    ] {
        assert_eq!(coupling::acceleration(&part(&given)), expected, "{given}");
    }
}

#[test]
fn a_coupling_that_says_nothing_is_solved_as_the_library_would() {
    let settings = coupling::settings(&part(&json!({ "acceleration": { "aitken": {} } })));
    assert_eq!(settings.at_limit, AtLimit::default());
    assert_eq!(settings.predictor, Predictor::default());
}

#[test]
fn a_strip_lies_about_its_curve_as_in_the_library() {
    assert_eq!(Alignment::from(schema::Alignment::default()), Alignment::default());
}

/// An acceleration is the one thing that a coupled scene has to name.
#[test]
fn a_coupling_that_says_nothing_else_is_that_of_the_library() {
    let scene: schema::Coupling = part(&json!({ "acceleration": { "iqn_imvls": {} } }));
    assert_eq!(coupling::settings(&scene), CouplingSettings::default());
}
