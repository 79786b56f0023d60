//! How a run is put together.

use std::path::Path;

use partita_coupling::{Accelerator, CouplingSettings, StepSizes, Transfer};
use partita_fluid::FluidSolver;
use partita_scene::schema::Transfer as TransferMethod;
use partita_scene::{Resolved, schema};
use partita_structure::StructureSolver;

use super::{Plan, Run, RunError, Time};
use crate::adapt::Side;
use crate::build;
use crate::couple::{self, FieldMarch};
use crate::probe::{self, Named, Probe};

/// Largest distance of a fluid node from the structure, as part of the interface's extent.
const TOLERANCE: f64 = 1e-6;

impl Run {
    /// A fluid and a structure that act on each other.
    ///
    /// Each is a solver of Partita or, in a `Box`, any other [`Participant`](partita_coupling::Participant). Between two
    /// solvers the operator `H`, `d_f = H d` and `F = H^T f`, is made as a scene makes it if nothing is said; anybody else's
    /// points have to agree with those of the other side, or [`couple_by`](Self::couple_by) is given the operator.
    ///
    /// # Errors
    /// If a side has no interface, or the two interfaces are not in the same place.
    pub fn couple(
        fluid: impl Into<Side<FluidSolver<2>>>,
        structure: impl Into<Side<StructureSolver<2>>>,
    ) -> Result<Self, RunError> {
        let (fluid, structure) = (fluid.into(), structure.into());
        let transfer = couple::transfer(&fluid, &structure, TransferMethod::Automatic, TOLERANCE)?;
        Self::coupled(fluid, structure, transfer)
    }

    /// The same with an operator of the caller's own, from the points of the structure to those of the fluid.
    ///
    /// # Errors
    /// If it does not fit the interfaces.
    pub fn couple_by(
        fluid: impl Into<Side<FluidSolver<2>>>,
        structure: impl Into<Side<StructureSolver<2>>>,
        transfer: impl Transfer + 'static,
    ) -> Result<Self, RunError> {
        Self::coupled(fluid.into(), structure.into(), Box::new(transfer))
    }

    fn coupled(
        fluid: Side<FluidSolver<2>>,
        structure: Side<StructureSolver<2>>,
        transfer: Box<dyn Transfer>,
    ) -> Result<Self, RunError> {
        let settings = CouplingSettings::default();
        let march = couple::two_way(fluid, structure, transfer, &settings)?;
        Ok(Self { settings: Some(settings), ..Self::from(march) })
    }

    /// A fluid that loads a structure and does not notice: one call of each per step. Its interface stands still
    /// (`BoundaryCondition::RigidInterface`).
    ///
    /// # Errors
    /// As [`couple`](Self::couple).
    pub fn one_way(
        fluid: impl Into<Side<FluidSolver<2>>>,
        structure: impl Into<Side<StructureSolver<2>>>,
    ) -> Result<Self, RunError> {
        let (fluid, structure) = (fluid.into(), structure.into());
        let transfer = couple::transfer(&fluid, &structure, TransferMethod::Automatic, TOLERANCE)?;
        Ok(couple::one_way(fluid, structure, transfer)?.into())
    }

    /// A fluid alone.
    ///
    /// # Errors
    /// If it wants to exchange data.
    pub fn fluid_alone(fluid: impl Into<Side<FluidSolver<2>>>) -> Result<Self, RunError> {
        Ok(couple::alone(fluid.into(), Side::Absent)?.into())
    }

    /// A structure alone.
    ///
    /// # Errors
    /// If it wants to exchange data.
    pub fn structure_alone(structure: impl Into<Side<StructureSolver<2>>>) -> Result<Self, RunError> {
        Ok(couple::alone(Side::Absent, structure.into())?.into())
    }

    /// The run of a scene, with its steps and probes; it writes nothing by itself.
    ///
    /// # Errors
    /// If the parts of the scene do not fit together.
    pub fn of(scene: &Resolved) -> Result<Self, RunError> {
        Ok(Self::of_march(build::march(scene)?, scene))
    }

    /// The same with fields that were built from the scene before.
    pub(crate) fn of_march(march: FieldMarch, resolved: &Resolved) -> Self {
        let schema::Scene { time, output, .. } = &resolved.scene;
        let probes = probe::named(&output.probes, &march).into_iter();
        let time = Time { steps: time.steps.get(), dt: time.step.get(), sizes: time.sizes() };
        let plan = Plan {
            dir: None,
            fields_every: output.fields_every,
            checkpoint_every: output.checkpoint_every,
            subdivisions: output.spline_subdivisions.get(),
        };
        Self {
            time: Some(time),
            probes: probes.map(|(name, probe)| Named::new(name, probe)).collect(),
            plan,
            scene: resolved.decisive(),
            ..Self::from(march)
        }
    }

    /// Makes this many steps of `dt` \[s\] each.
    ///
    /// # Panics
    /// If `dt` is not positive.
    #[must_use]
    pub fn with_steps(self, steps: usize, dt: f64) -> Self {
        Self { time: Some(Time { steps, dt, sizes: StepSizes::new(dt, 0) }), ..self }
    }

    /// Repeats a step that fails in halves, up to this many times in succession; comes after
    /// [`with_steps`](Self::with_steps).
    ///
    /// # Panics
    /// If there are more halvings than [`StepSizes::MOST`].
    #[must_use]
    pub fn with_halvings(self, halvings: u32) -> Self {
        let time = self.time.map(|time| Time { sizes: StepSizes::new(time.dt, halvings), ..time });
        Self { time, ..self }
    }

    /// Couples with these settings in place of the defaults.
    ///
    /// # Errors
    /// If a setting is out of its range.
    ///
    /// # Panics
    /// If the run has started.
    pub fn with_coupling(mut self, settings: CouplingSettings) -> Result<Self, RunError> {
        self.march.set_choices(settings.build(self.march.interface().x.len())?);
        self.settings = Some(settings);
        Ok(self)
    }

    /// Couples with an accelerator of the caller's own; records and checkpoints name it. Comes after
    /// [`with_coupling`](Self::with_coupling).
    ///
    /// # Panics
    /// If the run has started.
    #[must_use]
    pub fn with_accelerator(mut self, accelerator: impl Accelerator + 'static) -> Self {
        self.march.set_accelerator(Box::new(accelerator));
        self
    }

    /// Makes the operator between two solvers by this method.
    ///
    /// # Errors
    /// If the two interfaces are not in the same place, or a side is no solver of Partita and its points do not agree.
    pub fn with_transfer(mut self, method: TransferMethod) -> Result<Self, RunError> {
        let transfer = couple::transfer(self.march.first(), self.march.second(), method, TOLERANCE)?;
        self.march.set_transfers(vec![transfer])?;
        Ok(self)
    }

    /// Reads off these values after each step; they go into the columns `<name>_<quantity>` of `probes.csv`. A probe of the
    /// same name is replaced.
    ///
    /// ```
    /// # fn with_tip(run: partita::Run) -> partita::Run {
    /// run.with_probe("tip", |run: &partita::Run| {
    ///     run.structure().map_or(0.0, |structure| structure.displacement_at(&[1.0, 0.5])[1])
    /// })
    /// # }
    /// ```
    #[must_use]
    pub fn with_probe(mut self, name: &str, probe: impl Probe + 'static) -> Self {
        self.probes.retain(|named| named.name != name);
        self.probes.push(Named::new(name.to_owned(), Box::new(probe)));
        self
    }

    /// Writes records, tables and probes into this folder, which must be new or empty when the first step begins.
    #[must_use]
    pub fn with_output(mut self, dir: impl AsRef<Path>) -> Self {
        self.plan.dir = Some(dir.as_ref().to_owned());
        self
    }

    /// Writes the fields into the folder at the start and after every so many steps; 0 (the default) writes none.
    #[must_use]
    pub fn with_fields_every(mut self, steps: usize) -> Self {
        self.plan.fields_every = steps;
        self
    }

    /// Writes a checkpoint into the folder after every so many steps; 0 (the default) writes none.
    #[must_use]
    pub fn with_checkpoint_every(mut self, steps: usize) -> Self {
        self.plan.checkpoint_every = steps;
        self
    }
}

impl From<FieldMarch> for Run {
    /// A run of fields that were coupled by hand; nothing but their step is said.
    fn from(march: FieldMarch) -> Self {
        let plan = Plan { dir: None, fields_every: 0, checkpoint_every: 0, subdivisions: 2 };
        let scene = String::new();
        Self { march, settings: None, time: None, probes: Vec::new(), plan, folder: None, scene }
    }
}
