//! Watching a run.

use crate::record::{IterationRecord, Record, RetryRecord, StepRecord};

/// Is told of every iteration and of every finished step, as soon as it is over.
pub trait Observer {
    /// A coupling iteration is over.
    fn iteration(&mut self, record: &IterationRecord);

    /// A step is accepted.
    fn step_finished(&mut self, record: &StepRecord);

    /// A step has failed and is repeated with half its size.
    fn step_retried(&mut self, _record: &RetryRecord) {}
}

/// Watches nothing.
impl Observer for () {
    fn iteration(&mut self, _: &IterationRecord) {}
    fn step_finished(&mut self, _: &StepRecord) {}
}

/// Keeps everything.
impl Observer for Vec<Record> {
    fn iteration(&mut self, record: &IterationRecord) {
        self.push(Record::Iteration(record.clone()));
    }
    fn step_finished(&mut self, record: &StepRecord) {
        self.push(Record::Step(record.clone()));
    }
    fn step_retried(&mut self, record: &RetryRecord) {
        self.push(Record::Retry(record.clone()));
    }
}
