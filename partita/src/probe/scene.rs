//! The probes that a scene can name.

use std::collections::BTreeMap;

use partita_fluid::FluidSolver;
use partita_numerics::Field;
use partita_structure::StructureSolver;

use super::Probe;
use super::exact;
use super::line::Samples;
use crate::couple::FieldMarch;
use crate::run::Run;
use partita_scene::models::{self, nearest_node};
use partita_scene::schema::{self, Parameter, Real};

/// The probes of a scene, in the order of their columns.
#[derive(Debug)]
pub struct Probes {
    places: Vec<Place>,
    columns: Vec<String>,
}

/// Where a probe looks.
#[derive(Debug)]
enum Place {
    Structure(StructurePlace),
    Fluid(FluidPlace),
}

#[derive(Debug)]
enum StructurePlace {
    Displacement([f64; 2]),
    Energy,
}

#[derive(Debug)]
enum FluidPlace {
    Force(Vec<String>),
    Node(usize),
    Line(Samples),
    Error(schema::Known),
    FlowRate(Vec<String>),
    Energy,
    VolumeDefect,
    MeshQuality,
    InterfaceWork,
}

impl Probes {
    /// The probes of `scene` on `run`, which was built from it.
    #[must_use]
    pub fn new(probes: &BTreeMap<String, schema::Probe>, run: &FieldMarch) -> Self {
        let places = probes.values().map(|probe| place(probe, run)).collect();
        Self { places, columns: columns(probes) }
    }

    /// Names of the columns.
    #[must_use]
    pub fn columns(&self) -> &[String] {
        &self.columns
    }

    /// The values now, one a column.
    ///
    /// # Panics
    /// When `run` is not the one that the probes were made for.
    #[must_use]
    pub fn values(&self, run: &FieldMarch) -> Vec<f64> {
        self.places.iter().flat_map(|place| place.values(run)).collect()
    }
}

/// Names of the columns of `probes`.
#[must_use]
pub fn columns(probes: &BTreeMap<String, schema::Probe>) -> Vec<String> {
    let of_probe = |(name, probe)| quantities(probe).iter().map(move |quantity| format!("{name}_{quantity}"));
    probes.iter().flat_map(of_probe).collect()
}

/// What the columns of a probe are called.
fn quantities(probe: &schema::Probe) -> &'static [&'static str] {
    use schema::Probe;
    match probe {
        Probe::StructureDisplacement(_) | Probe::StructurePoint(_) => &["displacement_x", "displacement_y"],
        Probe::StructureEnergy => &["kinetic_energy", "strain_energy"],
        Probe::FluidForce(_) => &["force_x", "force_y"],
        Probe::FluidValue(_) => &["velocity_x", "velocity_y", "pressure"],
        Probe::FluidExtremes(_) => {
            &["smallest_velocity_x", "largest_velocity_x", "smallest_velocity_y", "largest_velocity_y"]
        }
        Probe::FluidError(_) => &["velocity_error", "pressure_error"],
        Probe::FluidFlowRate(_) => &["flow_rate"],
        Probe::FluidEnergy => &["kinetic_energy"],
        Probe::VolumeDefect => &["volume_defect"],
        Probe::MeshQuality => &["smallest_ratio", "worst_shape"],
        Probe::InterfaceWork => &["work"],
    }
}

/// Where a probe looks. A value of the fluid is that of the mesh node nearest to the point.
fn place(probe: &schema::Probe, run: &FieldMarch) -> Place {
    use schema::Probe;
    let mesh = || run.first().field().map(FluidSolver::mesh).expect("the scene was checked for its fluid");
    Place::Fluid(match probe {
        Probe::StructureDisplacement(xi) => {
            return Place::Structure(StructurePlace::Displacement(xi.map(Parameter::get)));
        }
        Probe::StructurePoint(point) => {
            let space = run.second().field().map(StructureSolver::space);
            let place = space.and_then(|space| models::place_in(space, point.map(Real::get)));
            let place = place.expect("the scene's probes were checked against its structure");
            return Place::Structure(StructurePlace::Displacement(place));
        }
        Probe::StructureEnergy => return Place::Structure(StructurePlace::Energy),
        Probe::FluidForce(groups) => FluidPlace::Force(groups.names().to_vec()),
        Probe::FluidValue(point) => FluidPlace::Node(nearest_node(mesh(), point.map(Real::get))),
        Probe::FluidExtremes(line) => {
            FluidPlace::Line(Samples::new(mesh(), line.from.map(Real::get), line.to.map(Real::get)))
        }
        Probe::FluidError(known) => FluidPlace::Error(known.clone()),
        Probe::FluidFlowRate(groups) => FluidPlace::FlowRate(groups.names().to_vec()),
        Probe::FluidEnergy => FluidPlace::Energy,
        Probe::VolumeDefect => FluidPlace::VolumeDefect,
        Probe::MeshQuality => FluidPlace::MeshQuality,
        Probe::InterfaceWork => FluidPlace::InterfaceWork,
    })
}

impl Place {
    fn values(&self, run: &FieldMarch) -> Vec<f64> {
        const CHECKED: &str = "the scene's probes were checked against its fields";
        match self {
            Self::Structure(place) => place.values(run.second().field().expect(CHECKED)),
            Self::Fluid(place) => place.values(run.first().field().expect(CHECKED), run.clock().time),
        }
    }
}

/// A probe of a scene as one of a run.
struct SceneProbe {
    place: Place,
    quantities: &'static [&'static str],
}

impl Probe for SceneProbe {
    fn columns(&self) -> Vec<String> {
        self.quantities.iter().map(|quantity| (*quantity).to_owned()).collect()
    }

    fn values(&mut self, run: &Run) -> Vec<f64> {
        self.place.values(run.march())
    }
}

/// The probes of a scene by their names, on `run`, which was built from it.
pub(crate) fn named(
    probes: &BTreeMap<String, schema::Probe>,
    run: &FieldMarch,
) -> Vec<(String, Box<dyn Probe>)> {
    let make = |(name, probe): (&String, &schema::Probe)| {
        let probe = SceneProbe { place: place(probe, run), quantities: quantities(probe) };
        (name.clone(), Box::new(probe) as Box<dyn Probe>)
    };
    probes.iter().map(make).collect()
}

impl StructurePlace {
    fn values(&self, structure: &StructureSolver<2>) -> Vec<f64> {
        match self {
            Self::Displacement(xi) => structure.displacement_at(xi).to_vec(),
            Self::Energy => vec![structure.kinetic_energy(), structure.strain_energy()],
        }
    }
}

impl FluidPlace {
    /// The values of `fluid`, whose state is that at `time` \[s\].
    fn values(&self, fluid: &FluidSolver<2>, time: f64) -> Vec<f64> {
        const CHECKED: &str = "the scene's probes were checked against the groups of the mesh";
        match self {
            Self::Force(groups) => fluid.force_on_all(groups).expect(CHECKED).to_vec(),
            Self::Node(node) => fluid.values()[3 * node..3 * node + 3].to_vec(),
            Self::Line(samples) => samples.extremes(fluid.values()).as_flattened().to_vec(),
            Self::Error(known) => {
                exact::errors(known, fluid.mesh().cells(), fluid.points(), fluid.values(), time).to_vec()
            }
            Self::FlowRate(groups) => {
                vec![groups.iter().map(|group| fluid.flow_rate(group).expect(CHECKED)).sum()]
            }
            Self::Energy => vec![fluid.kinetic_energy()],
            Self::VolumeDefect => vec![fluid.volume_defect()],
            Self::MeshQuality => fluid.mesh_quality().map_or_else(
                || vec![1.0; 2],
                |quality| vec![quality.smallest_ratio, quality.smallest_quality],
            ),
            Self::InterfaceWork => vec![fluid.interface_work()],
        }
    }
}
