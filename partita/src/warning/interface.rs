//! A fluid too coarse for the structure it meets.

use partita_fluid::FluidSolver;
use partita_mesh::Place;
use partita_structure::StructureSolver;

use super::{Found, Kind};
use crate::interface::{Coarsest, chosen, coarsest};
use partita_scene::schema::{Coupling, Transfer};

/// Length of a facet over that of the element beside it, above which a scene that asks for interpolation is warned: elements
/// in between get no load of their own.
const BY_INTERPOLATION: f64 = 1.5;
/// The same for the mortar method: the mean load and motion are right at any ratio, but the structure can bend at places
/// between two nodes of the fluid that cannot follow.
const BY_MORTAR: f64 = 3.0;

pub(super) fn check(
    found: &mut Found<'_>,
    coupling: &Coupling,
    fluid: &FluidSolver<2>,
    structure: &StructureSolver<2>,
) {
    let Some(coarsest) = coarsest(fluid, structure) else { return };
    let limit = if coupling.transfer == Transfer::Interpolation { BY_INTERPOLATION } else { BY_MORTAR };
    if !coarsest.exceeds(limit) {
        return;
    }
    let finer = "refine the fluid's interface, or take fewer elements along the structure";
    let (loses, remedy) = match (chosen(coupling.transfer, Some(&coarsest)), coupling.transfer) {
        (Transfer::Mortar, _) => {
            ("neither loads nor motions that vary within an edge pass", finer.to_owned())
        }
        (_, Transfer::Interpolation) => (
            "`interpolation` loads the structure at single points",
            format!("{finer}, or `coupling.transfer = \"mortar\"`"),
        ),
        _ => ("loads go to the structure at single points", finer.to_owned()),
    };
    let Coarsest { facet, element, place } = coarsest;
    let what = format!(
        "the fluid's edge at {} is {facet:.3e} m long, {:.1} elements of the structure ({element:.3e} m): {loses}",
        Place::from(place),
        coarsest.ratio(),
    );
    found.warn(Kind::CoarseInterface, &["coupling", "transfer"], what, &remedy);
}
