//! What a scene is, in words and numbers, before it runs.

mod balance;
mod inflow;
use partita_numerics::Field;

use std::collections::BTreeMap;
use std::fmt::Write;

use partita_fluid::FluidSolver;
use partita_iga::Side;
use partita_iga::seam::Seams;
use partita_mesh::{Mesh, Place, quality, simplex};
use partita_structure::{Space, StructureSolver};

use crate::build::{BuildError, FieldMarch};
use crate::interface::{chosen, coarsest};
use crate::memory;
use inflow::Inflow;
use partita_scene::schema::{
    Component, Condition, Coupling, Direction, Fluid, Part, Structure, Transfer, plain,
};
use partita_scene::{Content, Resolved, Role, words};

/// Looks ahead to what a run would stop at in a later step: an enclosed fluid that does not keep its volume.
///
/// # Errors
/// What the run would stop at, with its time.
pub fn look_ahead(resolved: &Resolved, run: &FieldMarch) -> Result<(), BuildError> {
    match run.first().field() {
        Some(fluid) => Ok(balance::check(fluid, &resolved.scene.time)?),
        None => Ok(()),
    }
}

/// Describes a scene and the run that was built from it: title, meshes with their boundary groups, splines, interface,
/// choices. The last line is `scene is sound`.
#[must_use]
pub fn describe(resolved: &Resolved, run: &FieldMarch) -> String {
    let scene = &resolved.scene;
    let (fluid, structure) = (run.first().field(), run.second().field());
    let mut page = Page { text: format!("{}\n", scene.title) };
    let (steps, step) = (scene.time.steps.get(), scene.time.step);
    page.line("time", format!("{steps} steps of {step} s, to t = {} s", short(steps as f64 * step.get())));
    if let (Some(scene), Some(fluid)) = (&scene.fluid, fluid) {
        page.fluid(scene, fluid);
        for inflow in inflow::all(&resolved.scene, fluid) {
            page.inflow(&inflow);
        }
        page.file(resolved.shapes.fluid_file.as_ref());
    }
    if let (Some(scene), Some(structure)) = (&scene.structure, structure) {
        page.structure(scene, structure);
        page.file(resolved.shapes.structure_file.as_ref());
    }
    if let (Some(coupling), Some(fluid), Some(structure)) = (&scene.coupling, fluid, structure) {
        let (nodes, points) = (fluid.interface_nodes().len(), structure.interface_points().len());
        let transfer = match chosen(coupling.transfer, coarsest(fluid, structure).as_ref()) {
            Transfer::Mortar => "mortar",
            _ => "interpolation",
        };
        page.line(
            "interface",
            format!("{nodes} fluid nodes on {points} control points that move, by {transfer}"),
        );
        page.coupling(coupling);
    }
    page.line("memory", format!("about {}", memory::words(memory_of(fluid, structure))));
    page.text.push_str("scene is sound\n");
    page.text
}

fn memory_of(fluid: Option<&FluidSolver<2>>, structure: Option<&StructureSolver<2>>) -> f64 {
    let of_fluid = fluid.map_or(0, Field::unknowns);
    let of_structure = structure.map_or(0, Field::unknowns);
    let degrees = structure.map_or([0; 2], |structure| degrees(structure.space()));
    memory::estimate(of_fluid, of_structure, degrees)
}

/// Lines `name  text`, the texts below one another.
struct Page {
    text: String,
}

impl Page {
    fn line(&mut self, name: &str, text: impl AsRef<str>) {
        writeln!(self.text, "  {name:<12}{}", text.as_ref()).expect("writing to a string does not fail");
    }

    fn fluid(&mut self, scene: &Fluid, fluid: &FluidSolver<2>) {
        let mesh = fluid.mesh();
        let unknowns = fluid.unknowns();
        let (cells, nodes) = (mesh.cells().len(), mesh.points().len());
        self.line("fluid", format!("{cells} triangles, {nodes} nodes, {unknowns} unknowns"));
        let quality = quality::summary(mesh.points(), mesh.cells());
        self.line("", format!("area {} m2, {}", short(quality.total_measure), extent(mesh.points())));
        self.line(
            "",
            format!(
                "shape quality {:.3} on average, {:.3} at worst, at {} (1 is equilateral)",
                quality.mean_quality,
                quality.worst_quality,
                Place::from(centroid(mesh, quality.worst_cell))
            ),
        );
        self.line("", format!("body force {} m/s2 (per mass)", words(&scene.body_force)));
        self.line("", format!("{}, tangent {}", words(&scene.time_scheme), words(&scene.tangent)));
        self.boundary(mesh, &scene.boundary);
    }

    fn boundary(&mut self, mesh: &Mesh<2>, conditions: &BTreeMap<String, Condition>) {
        let width = mesh.groups().iter().map(|group| group.name.len()).max().unwrap_or_default();
        for group in mesh.groups() {
            let condition = conditions.get(&group.name).map_or_else(|| "none".to_owned(), words);
            self.line("", format!("{:<width$}  {:>4} edges  {condition}", group.name, group.facets.len()));
        }
    }

    fn inflow(&mut self, inflow: &Inflow) {
        let Inflow { group, time, discrete, exact } = inflow;
        let (word, sign) = if *exact < 0.0 { ("outflow", -1.0) } else { ("inflow", 1.0) };
        let [of_mesh, of_formula] = [discrete, exact].map(|flow| six(sign * flow));
        let difference = 100.0 * (discrete / exact - 1.0);
        let difference = if difference.is_finite() && difference.abs() >= 0.05 {
            format!(" ({difference:+.1} %)")
        } else {
            String::new()
        };
        self.line(
            "",
            format!(
                "{word} through {group} at t = {} s: {of_mesh} m2/s on this mesh{difference}, {of_formula} m2/s by its formula",
                short(*time)
            ),
        );
    }

    /// What the file of a mesh holds, and what became of it.
    fn file(&mut self, content: Option<&Content>) {
        let Some(content) = content else { return };
        let turned = if content.turned { ": all its cells ran clockwise and were turned round" } else { "" };
        self.line("", format!("read from {}{turned}", content.file));
        for (dimension, kind) in ["points", "curves", "surfaces", "volumes"].iter().enumerate().rev() {
            let groups: Vec<String> = content
                .groups
                .iter()
                .filter(|(group, _)| group.dimension == dimension)
                .map(|(group, role)| {
                    let role = match role {
                        Role::Used => "",
                        Role::Inside => ", inside",
                        Role::LeftOut => ", left out",
                        Role::Unused => ", not used",
                    };
                    format!("{} ({}{role})", group.name, group.elements)
                })
                .collect();
            if !groups.is_empty() {
                self.line("", format!("{kind} (and their elements): {}", groups.join(", ")));
            }
        }
    }

    fn structure(&mut self, scene: &Structure, structure: &StructureSolver<2>) {
        let unknowns = structure.unknowns();
        self.line("structure", format!("{}, {unknowns} unknowns", elements_of(structure.space())));
        self.line("", extent(structure.space().points()));
        self.line("", words(&scene.material));
        self.line("", format!("body force {} N/m3 (per volume)", words(&scene.body_force)));
        self.line("", words(&scene.time_scheme));
        self.line("", format!("clamped: {}; wetted: {}", names(&scene.clamped), names(&scene.wetted)));
        if !scene.held.is_empty() {
            self.line("", format!("held: {}", held(scene)));
        }
        if let Space::Patch(patch) = structure.space()
            && let Some(joined) = joined(patch.seams())
        {
            self.line("", joined);
        }
    }

    fn coupling(&mut self, coupling: &Coupling) {
        let Some(acceleration) = coupling.acceleration.filter(|_| coupling.direction == Direction::TwoWay)
        else {
            return self.line("coupling", "one way: the fluid's load on the structure, one call each a step");
        };
        self.line("coupling", words(&acceleration));
        self.line("", format!("predictor {}", words(&coupling.predictor)));
        self.line(
            "",
            format!("until {}, at most {} iterations", words(&coupling.convergence), coupling.max_iterations),
        );
        self.line("", format!("Newton iterations a call: {}", words(&coupling.newton)));
    }
}

fn centroid(mesh: &Mesh<2>, cell: usize) -> [f64; 2] {
    simplex::centroid(&simplex::vertices(mesh.points(), mesh.cells().cell(cell))[..3])
}

/// What a structure is made of.
fn elements_of(space: &Space<2>) -> String {
    match space {
        Space::Patch(patch) => {
            let [along, across] = [0, 1].map(|direction| patch.spline().knots()[direction].element_count());
            let [degree, other] = degrees(space);
            let points = patch.points().len();
            format!("{along} x {across} elements of degree {degree} x {other}, {points} control points")
        }
        Space::Lagrange(mesh) => {
            let cells = mesh.cells();
            format!("{} elements {:?}, {} nodes", cells.len(), cells.kind, mesh.points().len())
        }
    }
}

fn degrees(space: &Space<2>) -> [usize; 2] {
    match space {
        Space::Patch(patch) => [0, 1].map(|direction| patch.spline().knots()[direction].degree()),
        // About as many functions meet at a node as for a spline of degree one.
        Space::Lagrange(_) => [1; 2],
    }
}

fn names(sides: &[Part]) -> String {
    if sides.is_empty() {
        return "none".to_owned();
    }
    sides.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ")
}

fn held(scene: &Structure) -> String {
    let of_part = |(part, components): (&String, &Vec<Component>)| {
        format!("{part} in {}", components.iter().map(|c| c.name()).collect::<Vec<_>>().join(" and "))
    };
    scene.held.iter().map(of_part).collect::<Vec<_>>().join(", ")
}

/// Which sides of a patch are no sides of its boundary.
fn joined(seams: &Seams) -> Option<String> {
    let pairs = [(Side::LEFT, Side::RIGHT), (Side::BOTTOM, Side::TOP)];
    let (side, partner) = pairs.into_iter().find(|(side, _)| seams.partner(*side).is_some())?;
    Some(format!("closed: {side} and {partner} are joined"))
}

fn extent(points: &[[f64; 2]]) -> String {
    let range = |c: usize| {
        points.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], point| {
            [low.min(point[c]), high.max(point[c])]
        })
    };
    box_of(range(0), range(1))
}

fn box_of([left, right]: [f64; 2], [bottom, top]: [f64; 2]) -> String {
    let [left, right, bottom, top] = [left, right, bottom, top].map(short);
    format!("x from {left} to {right} m, y from {bottom} to {top} m")
}

/// Six digits of a measured number.
fn six(number: f64) -> String {
    plain(format!("{number:.5e}").parse().unwrap_or(number))
}

/// Nine digits: enough for a reader, without the noise of the last bits.
fn short(number: f64) -> String {
    plain(format!("{number:.8e}").parse().unwrap_or(number))
}
