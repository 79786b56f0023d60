//! Values that a scene wants to see at every step.

use std::collections::BTreeMap;

use crate::build::{Run, nearest_node};
use crate::scene::schema::{self, Parameter, Real};

/// The probes of a scene, in the order of their columns.
#[derive(Debug)]
pub(crate) struct Probes {
    places: Vec<Place>,
    columns: Vec<String>,
}

#[derive(Debug)]
enum Place {
    Structure([f64; 2]),
    Force(String),
    Node(usize),
}

impl Probes {
    /// The probes of `scene` on `run`, which was built from it.
    #[must_use]
    pub(crate) fn new(probes: &BTreeMap<String, schema::Probe>, run: &Run) -> Self {
        let mut columns = Vec::new();
        let places = probes.iter().map(|(name, probe)| {
            let (place, quantities) = place(probe, run);
            columns.extend(quantities.iter().map(|quantity| format!("{name}_{quantity}")));
            place
        });
        Self { places: places.collect(), columns }
    }

    /// Names of the columns.
    #[must_use]
    pub(crate) fn columns(&self) -> &[String] {
        &self.columns
    }

    /// The values now, one a column.
    #[must_use]
    pub(crate) fn values(&self, run: &Run) -> Vec<f64> {
        self.places.iter().flat_map(|place| place.values(run)).collect()
    }
}

/// Where a probe looks, and what its columns are called.
///
/// A value of the fluid is that of the mesh node nearest to the point.
fn place(probe: &schema::Probe, run: &Run) -> (Place, &'static [&'static str]) {
    match probe {
        schema::Probe::StructureDisplacement(xi) => {
            (Place::Structure(xi.map(Parameter::get)), &["displacement_x", "displacement_y"])
        }
        schema::Probe::FluidForce(group) => (Place::Force(group.clone()), &["force_x", "force_y"]),
        schema::Probe::FluidValue(point) => {
            let mesh = run.first().field().map(|fluid| nearest_node(fluid.mesh(), point.map(Real::get)));
            (Place::Node(mesh.unwrap_or_default()), &["velocity_x", "velocity_y", "pressure"])
        }
    }
}

impl Place {
    fn values(&self, run: &Run) -> Vec<f64> {
        let (fluid, structure) = (run.first().field(), run.second().field());
        match self {
            Self::Structure(xi) => structure.map(|structure| structure.displacement_at(xi).to_vec()),
            Self::Force(group) => fluid.and_then(|fluid| fluid.force_on(group)).map(|force| force.to_vec()),
            Self::Node(node) => fluid.map(|fluid| fluid.values()[3 * node..3 * node + 3].to_vec()),
        }
        .expect("the scene's probes were checked against its fields and groups")
    }
}
