//! What a run remembers between two steps.

use partita_coupling::{MarchState, Saved};
use partita_scene::Resolved;
use serde::{Deserialize, Serialize};

use super::{Run, RunError};
use crate::couple::FieldMarch;

/// Everything a run remembers between two steps.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct RunState {
    /// The scene as far as it decides about the numbers of a step; empty without a scene.
    scene: String,
    pub(crate) march: MarchState,
    probes: Vec<ProbeState>,
}

/// What a probe remembers, and what it saw last.
#[derive(Debug, Clone, Serialize, Deserialize)]
struct ProbeState {
    probe: Saved,
    latest: Vec<f64>,
}

impl RunState {
    /// What the fields of a scene remember now.
    #[must_use]
    pub fn of(march: &FieldMarch, scene: &Resolved) -> Self {
        Self { scene: scene.decisive(), march: march.state(), probes: Vec::new() }
    }

    /// Puts the fields of a scene where this state was taken.
    ///
    /// # Errors
    /// If the state is that of another scene; then `march` may be of no use.
    pub fn restore(&self, march: &mut FieldMarch, scene: &Resolved) -> Result<(), RunError> {
        self.check_scene(&scene.decisive())?;
        self.restore_march(march)
    }

    fn check_scene(&self, now: &str) -> Result<(), RunError> {
        if let Some((then, now)) = self.scene.lines().zip(now.lines()).find(|(then, now)| then != now) {
            return Err(RunError::Misfit(format!("`{}` is now `{}`", then.trim(), now.trim())));
        }
        if self.scene.is_empty() != now.is_empty() {
            let what =
                if now.is_empty() { "it is that of a scene" } else { "it is of a run without a scene" };
            return Err(RunError::Foreign(what.to_owned()));
        }
        Ok(())
    }

    fn restore_march(&self, march: &mut FieldMarch) -> Result<(), RunError> {
        let misfit =
            |what| if self.scene.is_empty() { RunError::Foreign(what) } else { RunError::Misfit(what) };
        march.restore(&self.march).map_err(|error| misfit(error.to_string()))
    }
}

impl Run {
    /// Everything the run remembers now.
    #[must_use]
    pub fn state(&self) -> RunState {
        let probe = |named: &crate::probe::Named| ProbeState {
            probe: Saved::new(&named.name, named.probe.save()),
            latest: named.latest.clone(),
        };
        RunState {
            scene: self.scene.clone(),
            march: self.march.state(),
            probes: self.probes.iter().map(probe).collect(),
        }
    }

    /// Continues from a saved state, bit for bit.
    ///
    /// # Errors
    /// If the state is that of another run. This one is of no use then.
    pub fn restore(&mut self, state: &RunState) -> Result<(), RunError> {
        state.check_scene(&self.scene)?;
        state.restore_march(&mut self.march)?;
        for named in &mut self.probes {
            let foreign = |what: String| RunError::Foreign(format!("probe `{}`: {what}", named.name));
            let saved = state.probes.iter().find(|saved| saved.probe.owner == named.name);
            let saved = saved.ok_or_else(|| foreign("it was not there".to_owned()))?;
            named.probe.restore(&saved.probe.bytes).map_err(|error| foreign(error.to_string()))?;
            named.latest.clone_from(&saved.latest);
        }
        Ok(())
    }
}
