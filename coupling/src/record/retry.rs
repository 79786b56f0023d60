//! The record of a step that is tried again.

use serde::{Deserialize, Serialize};

/// A step that failed and is tried again with half its size.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RetryRecord {
    /// Number of the step, counted from 1.
    pub step: usize,
    /// The time at the end of what failed \[s\].
    pub time: f64,
    /// The size that failed \[s\].
    pub dt: f64,
    /// The size that is tried next \[s\].
    pub next_dt: f64,
    /// The coupling iteration that failed, counted from 1; 0 while the step was being opened.
    pub iteration: usize,
    /// Why.
    pub cause: String,
}
