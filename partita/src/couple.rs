//! Two sides put together: interface blocks, transfer, choices.

use partita_coupling::port::total_len;
use partita_coupling::{Block, CouplingSettings, IdentityTransfer, March, Participant, Quantity, Transfer};
use partita_fluid::FluidSolver;
use partita_scene::models;
use partita_scene::schema::Transfer as TransferMethod;
use partita_structure::StructureSolver;

use crate::adapt::Side;
use crate::error::BuildError;
use crate::interface;

/// Two coupled sides and nothing else, stepped by hand: fluid first, structure second.
pub type FieldMarch = March<Side<FluidSolver<2>>, Side<StructureSolver<2>>>;

/// What moves: loads alone, or displacements, too.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Direction {
    OneWay,
    TwoWay,
}

/// Interface values per point.
const COMPONENTS: usize = 2;
/// Name of the interface in messages.
const INTERFACE: &str = "interface";

/// Loads go to the second side, displacements come back to the first.
pub(crate) fn two_way(
    mut first: Side<FluidSolver<2>>,
    mut second: Side<StructureSolver<2>>,
    transfer: Box<dyn Transfer>,
    settings: &CouplingSettings,
) -> Result<FieldMarch, BuildError> {
    connect(&mut first, &mut second, Direction::TwoWay);
    Ok(March::new(first, second, vec![transfer], settings, 0.0)?)
}

/// Loads go to the second side; the first does not notice.
pub(crate) fn one_way(
    mut first: Side<FluidSolver<2>>,
    mut second: Side<StructureSolver<2>>,
    transfer: Box<dyn Transfer>,
) -> Result<FieldMarch, BuildError> {
    connect(&mut first, &mut second, Direction::OneWay);
    Ok(March::new(first, second, vec![transfer], &models::one_call(), 0.0)?)
}

/// Sides that exchange nothing; commonly one of them is absent.
pub(crate) fn alone(
    first: Side<FluidSolver<2>>,
    second: Side<StructureSolver<2>>,
) -> Result<FieldMarch, BuildError> {
    Ok(March::new(first, second, Vec::new(), &models::one_call(), 0.0)?)
}

/// The operator between two sides: `H` of two solvers, by `method` and with nodes at most `tolerance` of the interface's
/// extent apart; otherwise the identity, for points that agree.
pub(crate) fn transfer(
    first: &Side<FluidSolver<2>>,
    second: &Side<StructureSolver<2>>,
    method: TransferMethod,
    tolerance: f64,
) -> Result<Box<dyn Transfer>, BuildError> {
    if let Some(fluid) = first.field()
        && fluid.interface_nodes().is_empty()
    {
        let remedy = "give a boundary group the condition `BoundaryCondition::Interface`";
        return Err(BuildError::NoInterface { field: "fluid", remedy });
    }
    if let Some(structure) = second.field()
        && structure.interface_points().is_empty()
    {
        return Err(BuildError::NoInterface { field: "structure", remedy: "name its `wetted` sides" });
    }
    if let (Some(fluid), Some(structure)) = (first.field(), second.field()) {
        return interface::transfer(fluid, structure, method, tolerance);
    }
    let points_of_fluid = first.field().map(|fluid| COMPONENTS * fluid.interface_nodes().len());
    let points_of_structure = second.field().map(|structure| COMPONENTS * structure.interface_points().len());
    let first_values = points_of_fluid.unwrap_or_else(|| total_len(first.output()));
    let second_values = points_of_structure.unwrap_or_else(|| total_len(second.input()));
    if first_values == second_values {
        return Ok(Box::new(IdentityTransfer::new(first_values)));
    }
    let [first, second] = [first.name().to_owned(), second.name().to_owned()];
    Err(BuildError::Unmatched { first, first_values, second, second_values })
}

/// Gives our solvers the blocks that say what they exchange, under the interface's name on the other side.
fn connect(first: &mut Side<FluidSolver<2>>, second: &mut Side<StructureSolver<2>>, direction: Direction) {
    let named = |blocks: &[Block]| blocks.first().map(|block| block.interface.clone());
    let name =
        named(first.output()).or_else(|| named(second.input())).unwrap_or_else(|| INTERFACE.to_owned());
    let block = |quantity, points| vec![Block::new(name.clone(), quantity, COMPONENTS, points)];
    let displacements = |points| match direction {
        Direction::TwoWay => block(Quantity::Displacement, points),
        Direction::OneWay => Vec::new(),
    };
    if let Side::Solver(adapter) = first {
        let points = adapter.field().interface_nodes().len();
        adapter.set_blocks(displacements(points), block(Quantity::Force, points));
    }
    if let Side::Solver(adapter) = second {
        let points = adapter.field().interface_points().len();
        adapter.set_blocks(block(Quantity::Force, points), displacements(points));
    }
}
