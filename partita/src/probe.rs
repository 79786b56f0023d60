//! Values that are read off a run after each step.

mod exact;
mod line;
mod scene;

use partita_coupling::{SetupError, state};

pub(crate) use scene::named;
pub use scene::{Probes, columns};

use crate::run::Run;

/// Looks at a run at the end of each step and returns numbers.
///
/// A probe may remember what it saw: a largest value, an integral. Then [`save`](Self::save) and
/// [`restore`](Self::restore) keep that across a restart. A closure `FnMut(&Run) -> f64` is a probe of one value without
/// memory.
pub trait Probe: Send {
    /// What its columns are called, beside the probe's own name.
    fn columns(&self) -> Vec<String>;

    /// The values at the end of the step that was just accepted, one per column.
    ///
    /// It is called once per accepted step. The values of the run's other probes are not at hand meanwhile.
    fn values(&mut self, run: &Run) -> Vec<f64>;

    /// What the probe remembers, in bytes that nobody else reads. Nothing unless it says otherwise.
    fn save(&self) -> Vec<u8> {
        Vec::new()
    }

    /// Continues from the bytes of [`save`](Self::save), bit for bit.
    ///
    /// # Errors
    /// If the bytes belong to another probe.
    fn restore(&mut self, bytes: &[u8]) -> Result<(), SetupError> {
        state::expect_none("probe", bytes)
    }
}

/// The closure's value, in a column called `value`.
impl<F: FnMut(&Run) -> f64 + Send> Probe for F {
    fn columns(&self) -> Vec<String> {
        vec!["value".to_owned()]
    }

    fn values(&mut self, run: &Run) -> Vec<f64> {
        vec![self(run)]
    }
}

/// A probe of a run, with its name and what it saw last.
pub(crate) struct Named {
    pub(crate) name: String,
    pub(crate) probe: Box<dyn Probe>,
    /// Empty before the first step.
    pub(crate) latest: Vec<f64>,
}

impl Named {
    pub(crate) fn new(name: String, probe: Box<dyn Probe>) -> Self {
        Self { name, probe, latest: Vec::new() }
    }

    /// The names of its columns in a table of all probes.
    pub(crate) fn columns(&self) -> impl Iterator<Item = String> {
        self.probe.columns().into_iter().map(|quantity| format!("{}_{quantity}", self.name))
    }
}
