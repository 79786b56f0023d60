//! The time of a run and how it got there.

use serde::{Deserialize, Serialize};

/// Which step comes next, and when.
///
/// While the size of the steps stays the same, times are `start + n dt` and gather no round-off.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Clock {
    /// Accepted steps.
    pub steps: usize,
    /// Time reached \[s\].
    pub time: f64,
    /// Size of the last steps \[s\]; 0 before the first.
    pub dt: f64,
    /// Where the row of equal steps began \[s\].
    pub since: f64,
    /// Accepted steps of that row.
    pub row: usize,
}

impl Clock {
    /// A clock that starts at `time` \[s\].
    #[must_use]
    pub fn new(time: f64) -> Self {
        Self { steps: 0, time, dt: 0.0, since: time, row: 0 }
    }

    /// The clock after one more step of size `dt` \[s\].
    #[must_use]
    pub fn after(self, dt: f64) -> Self {
        let same = dt.to_bits() == self.dt.to_bits();
        let (since, row) = if same { (self.since, self.row + 1) } else { (self.time, 1) };
        Self { steps: self.steps + 1, time: since + row as f64 * dt, dt, since, row }
    }
}
