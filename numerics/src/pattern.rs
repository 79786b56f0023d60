//! The sparsity pattern of the free equations.

use crate::{Connectivity, DofMap};

/// Square, structurally symmetric pattern in compressed column form, rows sorted within each column.
///
/// Holds every pair of free dofs that share an element, and always the diagonal (a dof without an element
/// then shows up as a singular matrix rather than as a missing column). A matrix is a slice of values
/// beside its pattern: entry `k` belongs to row `row_idx()[k]`, and column `j` owns the entries
/// `col_ptr()[j]..col_ptr()[j + 1]`.
///
/// ```
/// use partita_numerics::{Connectivity, DofMap, Pattern};
///
/// let bars = Connectivity::new(2, vec![0, 1, 1, 2]);
/// let pattern = Pattern::new(&DofMap::new(&[true, false, false]), &[&bars]);
/// assert_eq!((pattern.size(), pattern.nonzeros()), (2, 4));
/// assert_eq!(pattern.slot(1, 0), Some(1));
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Pattern {
    col_ptr: Vec<usize>,
    row_idx: Vec<usize>,
}

impl Pattern {
    /// Collects the pattern of elements of one or more kinds over the free dofs.
    ///
    /// # Panics
    ///
    /// If an element names a dof that `dofs` does not have.
    #[must_use]
    pub fn new(dofs: &DofMap, connectivities: &[&Connectivity]) -> Self {
        let touching: Vec<Touching> = connectivities.iter().map(|c| Touching::new(dofs, c)).collect();
        let mut col_ptr = vec![0];
        let mut row_idx = Vec::new();
        // `seen[row] == column` marks the rows that the column already has.
        let mut seen = vec![usize::MAX; dofs.free_count()];
        for column in 0..dofs.free_count() {
            let start = row_idx.len();
            seen[column] = column;
            row_idx.push(column);
            for (elements, connectivity) in touching.iter().zip(connectivities) {
                let neighbours = elements.of(column).iter().flat_map(|&e| connectivity.element(e));
                for row in neighbours.filter_map(|&dof| dofs.equation(dof)) {
                    if seen[row] != column {
                        seen[row] = column;
                        row_idx.push(row);
                    }
                }
            }
            row_idx[start..].sort_unstable();
            col_ptr.push(row_idx.len());
        }
        Self { col_ptr, row_idx }
    }

    /// The number of rows, which is the number of columns.
    #[must_use]
    pub fn size(&self) -> usize {
        self.col_ptr.len() - 1
    }

    /// The number of stored entries, zeros included.
    #[must_use]
    pub fn nonzeros(&self) -> usize {
        self.row_idx.len()
    }

    /// Where each column starts in [`row_idx`](Self::row_idx); one entry more than columns.
    #[must_use]
    pub fn col_ptr(&self) -> &[usize] {
        &self.col_ptr
    }

    /// The row of each stored entry.
    #[must_use]
    pub fn row_idx(&self) -> &[usize] {
        &self.row_idx
    }

    /// Where the value of (`row`, `col`) is stored, or `None` where the pattern has no such entry.
    #[must_use]
    pub fn slot(&self, row: usize, col: usize) -> Option<usize> {
        let start = self.col_ptr[col];
        let rows = &self.row_idx[start..self.col_ptr[col + 1]];
        rows.binary_search(&row).ok().map(|k| start + k)
    }

    /// y = A x for the matrix with these `values`.
    ///
    /// # Panics
    ///
    /// If `values` does not have [`nonzeros`](Self::nonzeros) entries, or `x` or `y` not
    /// [`size`](Self::size).
    pub fn multiply(&self, values: &[f64], x: &[f64], y: &mut [f64]) {
        assert_eq!(values.len(), self.nonzeros(), "values have the wrong length");
        assert_eq!(x.len(), self.size(), "x has the wrong length");
        assert_eq!(y.len(), self.size(), "y has the wrong length");
        y.fill(0.0);
        for (column, x_column) in x.iter().enumerate() {
            let entries = self.col_ptr[column]..self.col_ptr[column + 1];
            for (&row, value) in self.row_idx[entries.clone()].iter().zip(&values[entries]) {
                y[row] += value * x_column;
            }
        }
    }
}

/// The elements of one connectivity that touch each equation, in compressed form.
struct Touching {
    start: Vec<usize>,
    elements: Vec<usize>,
}

impl Touching {
    fn new(dofs: &DofMap, connectivity: &Connectivity) -> Self {
        let mut start = vec![0; dofs.free_count() + 1];
        let equations = |element| {
            let dofs_of_element: &[usize] = element;
            dofs_of_element.iter().filter_map(|&dof| dofs.equation(dof))
        };
        for equation in connectivity.elements().flat_map(equations) {
            start[equation + 1] += 1;
        }
        for equation in 0..dofs.free_count() {
            start[equation + 1] += start[equation];
        }
        let mut next = start.clone();
        let mut elements = vec![0; start[dofs.free_count()]];
        for (e, element) in connectivity.elements().enumerate() {
            for equation in equations(element) {
                elements[next[equation]] = e;
                next[equation] += 1;
            }
        }
        Self { start, elements }
    }

    fn of(&self, equation: usize) -> &[usize] {
        &self.elements[self.start[equation]..self.start[equation + 1]]
    }
}
