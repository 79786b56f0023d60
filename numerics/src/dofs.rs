//! Free and prescribed dofs.

/// Which dofs are free, and the number of the equation each free dof owns.
///
/// Prescribed dofs are eliminated: the matrix holds free equations only, numbered in the order of their
/// dofs. Full vectors have one entry a dof, free vectors one entry an equation.
///
/// ```
/// use partita_numerics::DofMap;
///
/// let dofs = DofMap::new(&[true, false, false]);
/// assert_eq!(dofs.free(), [1, 2]);
/// assert_eq!(dofs.equation(2), Some(1));
/// assert_eq!(dofs.equation(0), None);
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DofMap {
    free: Vec<usize>,
    equations: Vec<Option<usize>>,
}

impl DofMap {
    /// One flag a dof: is its value prescribed?
    #[must_use]
    pub fn new(prescribed: &[bool]) -> Self {
        let free: Vec<usize> = (0..prescribed.len()).filter(|&dof| !prescribed[dof]).collect();
        let mut equations = vec![None; prescribed.len()];
        for (equation, &dof) in free.iter().enumerate() {
            equations[dof] = Some(equation);
        }
        Self { free, equations }
    }

    /// The number of dofs, free and prescribed.
    #[must_use]
    pub fn total(&self) -> usize {
        self.equations.len()
    }

    /// The number of free dofs, which is the number of equations.
    #[must_use]
    pub fn free_count(&self) -> usize {
        self.free.len()
    }

    /// Whether `dof` is free.
    #[must_use]
    pub fn is_free(&self, dof: usize) -> bool {
        self.equations[dof].is_some()
    }

    /// The equation of `dof`, or `None` where its value is prescribed.
    #[must_use]
    pub fn equation(&self, dof: usize) -> Option<usize> {
        self.equations[dof]
    }

    /// The free dofs in ascending order: `free()[equation]` is the dof of `equation`.
    #[must_use]
    pub fn free(&self) -> &[usize] {
        &self.free
    }

    /// Copies the free entries of `full` into `free`.
    ///
    /// # Panics
    ///
    /// If a length does not fit: `full` has [`total`](Self::total) entries, `free` has
    /// [`free_count`](Self::free_count).
    pub fn gather(&self, full: &[f64], free: &mut [f64]) {
        self.assert_lengths(full.len(), free.len());
        for (entry, &dof) in free.iter_mut().zip(&self.free) {
            *entry = full[dof];
        }
    }

    /// full += a * free on the free dofs; prescribed entries are left alone.
    ///
    /// # Panics
    ///
    /// If a length does not fit, as in [`gather`](Self::gather).
    pub fn add_scaled(&self, a: f64, free: &[f64], full: &mut [f64]) {
        self.assert_lengths(full.len(), free.len());
        for (entry, &dof) in free.iter().zip(&self.free) {
            full[dof] += a * entry;
        }
    }

    fn assert_lengths(&self, full: usize, free: usize) {
        assert_eq!(full, self.total(), "full vector has the wrong length");
        assert_eq!(free, self.free_count(), "free vector has the wrong length");
    }
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "these values are exact")]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn equations_and_free_dofs_are_inverse(prescribed in prop::collection::vec(any::<bool>(), 0..40)) {
            let dofs = DofMap::new(&prescribed);
            prop_assert_eq!(dofs.total(), prescribed.len());
            prop_assert_eq!(dofs.free_count(), prescribed.iter().filter(|p| !**p).count());
            prop_assert!(dofs.free().is_sorted());
            for (dof, &is_prescribed) in prescribed.iter().enumerate() {
                prop_assert_eq!(dofs.is_free(dof), !is_prescribed);
                prop_assert_eq!(dofs.equation(dof).map(|e| dofs.free()[e]), (!is_prescribed).then_some(dof));
            }
        }

        #[test]
        fn adding_what_was_gathered_doubles_the_free_entries(
            entries in prop::collection::vec((any::<bool>(), -1e3..1e3), 0..40)
        ) {
            let (prescribed, full): (Vec<bool>, Vec<f64>) = entries.into_iter().unzip();
            let dofs = DofMap::new(&prescribed);
            let mut free = vec![0.0; dofs.free_count()];
            dofs.gather(&full, &mut free);
            let mut sum = full.clone();
            dofs.add_scaled(0.5, &free, &mut sum);
            for dof in 0..full.len() {
                let factor = if prescribed[dof] { 1.0 } else { 1.5 };
                prop_assert_eq!(sum[dof], full[dof] + (factor - 1.0) * full[dof]);
            }
        }
    }

    #[test]
    #[should_panic(expected = "full vector has the wrong length")]
    fn wrong_length_is_a_panic() {
        DofMap::new(&[false, false]).gather(&[0.0], &mut [0.0, 0.0]);
    }
}
