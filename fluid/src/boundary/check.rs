//! Whether model, mesh and settings make a problem that can be solved.

use partita_mesh::{Mesh, Place};

use crate::error::FluidError;
use crate::model::{BoundaryCondition, FluidModel};
use crate::settings::{FluidSettings, TimeScheme};

/// Checks properties, groups, and the level of pressure.
pub(crate) fn check<const D: usize>(
    mesh: &Mesh<D>,
    model: &FluidModel<D>,
    settings: &FluidSettings,
) -> Result<(), FluidError> {
    properties(model, settings)?;
    groups(mesh, model)?;
    slides(model, settings)?;
    pressure_level(mesh, model, settings)
}

fn properties<const D: usize>(model: &FluidModel<D>, settings: &FluidSettings) -> Result<(), FluidError> {
    let positive = |x: f64| x > 0.0 && x.is_finite();
    let steady = settings.time == TimeScheme::Steady;
    let FluidModel { density, viscosity, .. } = *model;
    let constant = settings.inverse_constant;
    let refuse = |name, value, unit, range| Err(FluidError::Property { name, value, unit, range });
    if !positive(density) {
        return refuse("density", density, "kg/m^3", "it is positive and finite");
    }
    if !(positive(viscosity) || (viscosity == 0.0 && !steady)) {
        let range = "it is positive and finite; zero only in unsteady flow";
        return refuse("viscosity", viscosity, "Pa s", range);
    }
    if !positive(constant) {
        return refuse("inverse constant", constant, "(C_I)", "it is positive and finite; 36 is common");
    }
    if !(settings.grad_div >= 0.0 && settings.grad_div.is_finite()) {
        let range = "it is finite and not negative; 1 is the formula of the literature";
        return refuse("grad-div factor", settings.grad_div, "", range);
    }
    Ok(())
}

fn groups<const D: usize>(mesh: &Mesh<D>, model: &FluidModel<D>) -> Result<(), FluidError> {
    for (index, (group, _)) in model.boundary.iter().enumerate() {
        if mesh.group(group).is_none() {
            let names: Vec<&str> = mesh.groups().iter().map(|group| group.name.as_str()).collect();
            return Err(FluidError::UnknownGroup { group: group.clone(), known: names.join(", ") });
        }
        if model.boundary[..index].iter().any(|(earlier, _)| earlier == group) {
            return Err(FluidError::TwoConditions { group: group.clone() });
        }
    }
    let has_condition = |name: &String| model.boundary.iter().any(|(group, _)| group == name);
    if let Some(group) = mesh.groups().iter().find(|group| !has_condition(&group.name)) {
        return Err(FluidError::NoCondition { group: group.name.clone() });
    }
    match mesh.ungrouped_boundary()[..] {
        [] => Ok(()),
        [first, ..] => Err(FluidError::UngroupedBoundary {
            count: mesh.ungrouped_boundary().len(),
            place: Place::from(first.centroid(mesh.points())),
        }),
    }
}

fn slides<const D: usize>(model: &FluidModel<D>, settings: &FluidSettings) -> Result<(), FluidError> {
    let moves = |name: &&String| model.boundary.iter().any(|(group, c)| group == *name && c.moves());
    match settings.mesh_slide.iter().find(moves) {
        Some(group) => Err(FluidError::SlidesAndMoves { group: group.clone() }),
        None => Ok(()),
    }
}

fn pressure_level<const D: usize>(
    mesh: &Mesh<D>,
    model: &FluidModel<D>,
    settings: &FluidSettings,
) -> Result<(), FluidError> {
    let first = |wanted: fn(&(String, _)) -> bool| {
        model.boundary.iter().find(|entry| wanted(entry)).map(|(group, _)| group.clone())
    };
    let natural = first(|(_, condition)| condition.is_natural());
    let elastic = first(|(_, condition)| matches!(condition, BoundaryCondition::Interface));
    let nodes = mesh.points().len();
    match (natural, elastic, settings.pressure_pin) {
        (None, Some(group), _) => Err(FluidError::ClosedAndMoving { group }),
        (None, None, None) => Err(FluidError::PressureLevel),
        (Some(group), _, Some(_)) => Err(FluidError::NeedlessPin { group }),
        (None, None, Some(pin)) if pin.node >= nodes => {
            Err(FluidError::PinOutOfRange { node: pin.node, nodes })
        }
        _ => Ok(()),
    }
}
