//! Which dofs each element touches.

/// A fixed number of dofs for each element of one kind, stored flat.
///
/// The order of an element's dofs is the order of the rows and columns of its local matrix.
///
/// ```
/// use partita_numerics::Connectivity;
///
/// let bars = Connectivity::new(2, vec![0, 1, 1, 2]);
/// assert_eq!(bars.len(), 2);
/// assert_eq!(bars.element(1), [1, 2]);
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Connectivity {
    dofs_per_element: usize,
    dofs: Vec<usize>,
}

impl Connectivity {
    /// Takes the dofs of all elements, one element after the other.
    ///
    /// # Panics
    ///
    /// If `dofs_per_element` is zero or does not divide the length of `dofs`.
    #[must_use]
    pub fn new(dofs_per_element: usize, dofs: Vec<usize>) -> Self {
        assert!(dofs_per_element > 0, "an element has at least one dof");
        assert!(
            dofs.len().is_multiple_of(dofs_per_element),
            "{} dofs are not a multiple of {dofs_per_element} dofs an element",
            dofs.len()
        );
        Self { dofs_per_element, dofs }
    }

    /// Expands the nodes of elements by `components` dofs a node: dof = node * components + component.
    ///
    /// ```
    /// use partita_numerics::Connectivity;
    ///
    /// let triangle = Connectivity::from_nodes(3, &[4, 0, 1], 2);
    /// assert_eq!(triangle.element(0), [8, 9, 0, 1, 2, 3]);
    /// ```
    ///
    /// # Panics
    ///
    /// If `nodes_per_element` or `components` is zero, or the former does not divide the length of `nodes`.
    #[must_use]
    pub fn from_nodes(nodes_per_element: usize, nodes: &[usize], components: usize) -> Self {
        let dofs = nodes.iter().flat_map(|node| (0..components).map(move |c| node * components + c));
        Self::new(nodes_per_element * components, dofs.collect())
    }

    /// The dofs of element `e`.
    #[must_use]
    pub fn element(&self, e: usize) -> &[usize] {
        &self.dofs[e * self.dofs_per_element..(e + 1) * self.dofs_per_element]
    }

    /// The number of elements.
    #[must_use]
    pub fn len(&self) -> usize {
        self.dofs.len() / self.dofs_per_element
    }

    /// Whether there is no element.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.dofs.is_empty()
    }

    /// The number of dofs of each element.
    #[must_use]
    pub fn dofs_per_element(&self) -> usize {
        self.dofs_per_element
    }

    /// The elements in order, each as its dofs.
    pub fn elements(&self) -> std::slice::ChunksExact<'_, usize> {
        self.dofs.chunks_exact(self.dofs_per_element)
    }

    /// Copies the entries of `full` that element `e` touches into `local`.
    ///
    /// # Panics
    ///
    /// If `local` does not hold [`dofs_per_element`](Self::dofs_per_element) entries, or `full` is too short.
    pub fn gather(&self, e: usize, full: &[f64], local: &mut [f64]) {
        let dofs = self.element(e);
        assert_eq!(local.len(), dofs.len(), "local vector has the wrong length");
        for (entry, &dof) in local.iter_mut().zip(dofs) {
            *entry = full[dof];
        }
    }
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "these values are exact")]
mod tests {
    use super::*;

    #[test]
    fn elements_come_in_order() {
        let connectivity = Connectivity::new(3, vec![0, 1, 2, 2, 1, 3]);
        assert_eq!(connectivity.len(), 2);
        assert!(!connectivity.is_empty());
        let elements: Vec<_> = connectivity.elements().collect();
        assert_eq!(elements, [connectivity.element(0), connectivity.element(1)]);
    }

    #[test]
    fn gather_takes_the_entries_of_the_element() {
        let connectivity = Connectivity::from_nodes(2, &[0, 2], 2);
        let mut local = [0.0; 4];
        connectivity.gather(0, &[0.0, 1.0, 2.0, 3.0, 4.0, 5.0], &mut local);
        assert_eq!(local, [0.0, 1.0, 4.0, 5.0]);
    }

    #[test]
    #[should_panic(expected = "not a multiple")]
    fn incomplete_elements_are_refused() {
        let _ = Connectivity::new(3, vec![0, 1, 2, 3]);
    }
}
