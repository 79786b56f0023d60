//! Numbers that start at a cache line.

use std::ops::{Deref, DerefMut};

const CACHE_LINE: usize = 64;

/// A slice of fixed length whose first number lies at the start of a cache line, so that no vector straddles two.
pub(super) struct Aligned {
    storage: Vec<f64>,
    start: usize,
    len: usize,
}

impl Aligned {
    /// Zeros; nothing if memory does not suffice.
    pub(super) fn zeros(len: usize) -> Option<Self> {
        let slack = CACHE_LINE / size_of::<f64>();
        let mut storage = Vec::new();
        storage.try_reserve_exact(len + slack).ok()?;
        storage.resize(len + slack, 0.0);
        // An offset that cannot be found costs speed, nothing else.
        let start = storage.as_ptr().align_offset(CACHE_LINE).min(slack);
        Some(Self { storage, start, len })
    }
}

impl Deref for Aligned {
    type Target = [f64];

    fn deref(&self) -> &[f64] {
        &self.storage[self.start..self.start + self.len]
    }
}

impl DerefMut for Aligned {
    fn deref_mut(&mut self) -> &mut [f64] {
        &mut self.storage[self.start..self.start + self.len]
    }
}
