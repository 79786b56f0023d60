//! Who looks on while a run or a map is made: a progress bar, a log, nobody.

use partita_coupling::{IterationRecord, RetryRecord};

/// Is told what happens; nothing it does changes a number. All methods do nothing unless one says otherwise.
pub trait Watcher {
    /// `total` steps or cells will be done, `done` of them are already.
    fn begins(&mut self, total: usize, done: usize) {
        let _ = (total, done);
    }

    /// A coupling iteration of the step being solved.
    fn iteration(&mut self, record: &IterationRecord) {
        let _ = record;
    }

    /// A step failed and is repeated with half its size.
    fn retried(&mut self, record: &RetryRecord) {
        let _ = record;
    }

    /// So many steps or cells are done.
    fn reaches(&mut self, done: usize) {
        let _ = done;
    }

    /// A run of a sweep has ended, and came to this.
    fn finishes(&mut self, line: &str) {
        let _ = line;
    }

    /// Something a person should read.
    fn note(&mut self, line: &str) {
        let _ = line;
    }

    /// Nothing more will happen.
    fn ends(&mut self) {}
}

/// Nobody.
impl Watcher for () {}
