//! Differences of iterations, by the steps they were made in.

use std::collections::VecDeque;

use serde::{Deserialize, Serialize};

/// One pair of differences, as plain data.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Column {
    /// Difference of the residuals.
    pub v: Vec<f64>,
    /// Difference of the outputs `x_tilde`.
    pub w: Vec<f64>,
    /// `J_prev v`, where the method has a Jacobian from earlier steps; else empty.
    pub jv: Vec<f64>,
}

/// The columns of some steps, newest first, as plain data.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Columns {
    /// The columns, newest first.
    pub all: VecDeque<Column>,
    /// How many of them each step made, newest step first.
    pub per_step: VecDeque<usize>,
}

impl Columns {
    /// No columns in one step, the current one.
    pub(crate) fn new() -> Self {
        Self { all: VecDeque::new(), per_step: VecDeque::from([0]) }
    }

    /// Whether the counts add up and all vectors have `size` entries.
    pub(crate) fn fit(&self, size: usize) -> bool {
        !self.per_step.is_empty()
            && self.per_step.iter().sum::<usize>() == self.all.len()
            && self.all.iter().all(|column| column.v.len() == size && column.w.len() == size)
    }

    /// Ends the current step and forgets steps older than the last `history` ones. A step without columns
    /// leaves no trace.
    pub(crate) fn end_step(&mut self, history: Option<usize>) {
        if self.per_step[0] > 0 {
            self.per_step.push_front(0);
        }
        while history.is_some_and(|steps| self.per_step.len() > steps + 1) {
            let oldest = self.per_step.pop_back().expect("there is at least the current step");
            self.all.truncate(self.all.len() - oldest);
        }
    }

    pub(crate) fn push(&mut self, column: Column) {
        self.all.push_front(column);
        self.per_step[0] += 1;
    }

    /// The step and the place in it of the column at `index`.
    pub(crate) fn place(&self, index: usize) -> (usize, usize) {
        let mut column = index;
        for (steps_ago, &count) in self.per_step.iter().enumerate() {
            if column < count {
                return (steps_ago, column);
            }
            column -= count;
        }
        unreachable!("column {index} of {}", self.all.len())
    }

    pub(crate) fn remove(&mut self, index: usize) {
        let (steps_ago, _) = self.place(index);
        self.all.remove(index);
        self.per_step[steps_ago] -= 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn old_steps_are_forgotten_and_empty_ones_do_not_count() {
        let column = || Column { v: vec![1.0], w: vec![1.0], jv: vec![] };
        let mut columns = Columns::new();
        for made in [2, 0, 1, 3] {
            for _ in 0..made {
                columns.push(column());
            }
            columns.end_step(Some(2));
        }
        assert_eq!(columns.per_step, [0, 3, 1]);
        assert_eq!(columns.all.len(), 4);
        columns.end_step(Some(0));
        assert_eq!((columns.per_step.len(), columns.all.len()), (1, 0));
    }
}
