//! Element matrices and vectors into global ones.

use crate::{Connectivity, DofMap, Pattern};

/// Marks an entry of a prescribed row or column.
const SKIPPED: u32 = u32::MAX;

/// For each entry of each element matrix, the slot of the global values it is added to.
///
/// Computed once for a pattern; assembling is then a loop without a search.
///
/// ```
/// use partita_numerics::{Connectivity, DofMap, Pattern, Scatter};
///
/// let dofs = DofMap::new(&[false, false, true]);
/// let bars = Connectivity::new(2, vec![0, 1, 1, 2]);
/// let pattern = Pattern::new(&dofs, &[&bars]);
/// let scatter = Scatter::new(&pattern, &dofs, &bars);
/// let mut values = vec![0.0; pattern.nonzeros()];
/// for bar in 0..bars.len() {
///     scatter.add_matrix(bar, &[1.0, -1.0, -1.0, 1.0], &mut values);
/// }
/// assert_eq!(values, [1.0, -1.0, -1.0, 2.0]);
/// ```
#[derive(Debug, Clone)]
pub struct Scatter {
    entries_per_element: usize,
    nonzeros: usize,
    slots: Vec<u32>,
}

impl Scatter {
    /// Finds the slots of all elements of `connectivity` in `pattern`.
    ///
    /// # Panics
    ///
    /// If `pattern` was not built from `dofs` and `connectivity` (among others), or has 2^32 - 1 entries or
    /// more.
    #[must_use]
    pub fn new(pattern: &Pattern, dofs: &DofMap, connectivity: &Connectivity) -> Self {
        assert_eq!(pattern.size(), dofs.free_count(), "pattern and dofs do not belong together");
        let n = connectivity.dofs_per_element();
        let mut slots = Vec::with_capacity(connectivity.len() * n * n);
        for element in connectivity.elements() {
            for &row in element {
                slots.extend(element.iter().map(|&col| slot(pattern, dofs, row, col)));
            }
        }
        Self { entries_per_element: n * n, nonzeros: pattern.nonzeros(), slots }
    }

    /// Adds the matrix of `element`, n x n over all its dofs and row by row, to the global `values`.
    ///
    /// Entries of prescribed rows and columns are skipped.
    ///
    /// # Panics
    ///
    /// If `local` does not have n * n entries, or `values` not one an entry of the pattern.
    pub fn add_matrix(&self, element: usize, local: &[f64], values: &mut [f64]) {
        self.add_entries(element, local.iter().copied(), values);
    }

    /// Like [`add_matrix`](Self::add_matrix), for a matrix that is not stored entry beside entry.
    ///
    /// # Panics
    ///
    /// As there.
    #[inline]
    pub fn add_entries(&self, element: usize, local: impl ExactSizeIterator<Item = f64>, values: &mut [f64]) {
        assert_eq!(local.len(), self.entries_per_element, "element matrix has the wrong length");
        assert_eq!(values.len(), self.nonzeros, "values have the wrong length");
        let start = element * self.entries_per_element;
        let slots = &self.slots[start..start + self.entries_per_element];
        for (&slot, entry) in slots.iter().zip(local) {
            if slot != SKIPPED {
                values[slot as usize] += entry;
            }
        }
    }
}

fn slot(pattern: &Pattern, dofs: &DofMap, row: usize, col: usize) -> u32 {
    let (Some(row), Some(col)) = (dofs.equation(row), dofs.equation(col)) else { return SKIPPED };
    let slot = pattern.slot(row, col).expect("the pattern was built without this connectivity");
    u32::try_from(slot)
        .ok()
        .filter(|&slot| slot != SKIPPED)
        .expect("the pattern has 2^32 - 1 entries or more")
}

/// Adds the vector of `element` to a vector over **all** dofs, prescribed ones included.
///
/// A residual assembled this way holds the reactions in its prescribed rows.
///
/// # Panics
///
/// If `local` does not have one entry a dof of the element, or `full` is too short.
pub fn add_vector(connectivity: &Connectivity, element: usize, local: &[f64], full: &mut [f64]) {
    let dofs = connectivity.element(element);
    assert_eq!(local.len(), dofs.len(), "element vector has the wrong length");
    for (&dof, entry) in dofs.iter().zip(local) {
        full[dof] += entry;
    }
}
