//! What no single value shows: whether the parts of a scene fit together.

mod fields;
mod fluid;
mod formulas;
mod groups;
mod interface;
mod mesh;
mod solid;
mod structure;

use super::check::Check;
use super::finding::Finding;
use super::schema::Scene;
use super::shapes::Shapes;
use crate::spelling::nearest;
use crate::warning::Kind;

/// What does not fit, as far as the text of the scene shows it.
pub(super) fn validate(check: &mut Check<'_>, scene: &Scene) {
    fields::check(check, scene);
    warnings(check, scene);
    if let Some(fluid) = &scene.fluid {
        fluid::check(check, scene, fluid);
    }
    if let Some(structure) = &scene.structure {
        structure::check(check, structure, scene.fluid.is_some());
    }
}

/// Warnings are accepted by their names.
fn warnings(check: &mut Check<'_>, scene: &Scene) {
    let names = || Kind::ALL.into_iter().map(Kind::name);
    for name in scene.warnings.accept.keys().filter(|name| Kind::from_name(name).is_none()) {
        check.add(
            Finding::new(format!("there is no warning `{name}`"))
                .mark_if(check.key(&["warnings", "accept", name]), "unknown warning")
                .hint(match nearest(name, names()) {
                    Some(near) => format!("did you mean `{near}`?"),
                    None => format!("warnings: {}", names().collect::<Vec<_>>().join(", ")),
                }),
        );
    }
}

/// What does not fit the shapes, or does not fit between them.
pub(super) fn validate_shapes(check: &mut Check<'_>, scene: &Scene, shapes: &Shapes) {
    if let (Some(fluid), Some(mesh)) = (&scene.fluid, &shapes.fluid) {
        mesh::check(check, scene, fluid, mesh, shapes.fluid_file.as_ref());
    }
    if let (Some(structure), Some(space)) = (&scene.structure, &shapes.structure) {
        solid::check(check, scene, structure, space, shapes.structure_file.as_ref());
    }
    interface::check(check, scene, shapes);
    if check.is_sound() {
        formulas::check(check, scene, shapes);
    }
}
