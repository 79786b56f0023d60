//! Secant columns: what the iterations have told about the interface.
//!
//! Within a step, `v_j = r^j - r^{j-1}` and `w_j = x_tilde^j - x_tilde^{j-1}`; no column spans two steps.
//!
//! A pair is a secant only where the difference of the outputs is the fields' response to the difference of the inputs. It is
//! none where a field gave the answer to an earlier input (see [`Answer`]): there `x_tilde` has hardly moved, and `r` holds
//! what `x` moved by, which the model has accounted for already. A step along it would only lead away again. So `x` *waits*
//! for one iteration, in which the other field settles; an answer to an input that did not change is no secant either. Where the
//! answer is missing twice running, the residual is as good as the field's bound lets it be, and `x` moves on. The
//! difference from there to the next answer is kept: without it, iterations whose bounds are looser than what the criterion
//! asks for creep. A difference that is round-off tells nothing.

use super::column::{Column, Columns};
use super::filter::Filter;
use super::qr::Qr;
use super::{Answer, DropReason, DroppedColumn};
use crate::vector::{add_scaled, norm, subtract};

/// One iterate: `x_tilde`, `r` and `J_prev r`.
#[derive(Debug, Clone)]
struct Iterate {
    x_tilde: Vec<f64>,
    r: Vec<f64>,
    jr: Vec<f64>,
}

/// Columns under construction, with the factorization of their `V`.
#[derive(Debug, Clone)]
pub(crate) struct Secants {
    filter: Filter,
    columns: Columns,
    qr: Qr,
    /// Whether `qr` belongs to `columns`.
    factored: bool,
    /// Whether an iteration of this step has been seen.
    begun: bool,
    /// Whether `x` is to stay as it is for the next iteration.
    waits: bool,
    /// The last iteration of this step.
    last: Option<Iterate>,
    /// `-c`, the least-squares solution of `min |V c + r|` with its sign turned.
    solution: Vec<f64>,
}

impl Secants {
    pub(crate) fn new(filter: Filter) -> Self {
        Self {
            filter,
            columns: Columns::new(),
            qr: Qr::default(),
            factored: true,
            begun: false,
            waits: false,
            last: None,
            solution: Vec::new(),
        }
    }

    /// The factored `columns`, without those that round-off makes dependent.
    pub(crate) fn from_columns(columns: Columns) -> Self {
        let mut secants = Self::new(Filter::None);
        let dropped = Filter::None.rebuild(&mut secants.qr, &columns.all);
        secants.columns = columns;
        secants.remove(&dropped);
        secants
    }

    /// Starts a step with `columns` of earlier ones. The factorization is built anew at the first iteration,
    /// so that a resumed run repeats every rounding.
    pub(crate) fn start_step(&mut self, columns: Columns) {
        self.factored = columns.all.is_empty();
        self.columns = columns;
        self.qr.clear();
        self.begun = false;
        self.waits = false;
        self.last = None;
    }

    pub(crate) fn columns(&self) -> &Columns {
        &self.columns
    }

    pub(crate) fn qr(&self) -> &Qr {
        &self.qr
    }

    pub(crate) fn len(&self) -> usize {
        self.columns.all.len()
    }

    /// Whether no iterate of this step has been seen yet.
    pub(crate) fn at_first_iteration(&self) -> bool {
        !self.begun
    }

    /// Whether the iteration just observed had no answer, so that `x` is to stay until it has one.
    pub(crate) fn waits(&self) -> bool {
        self.waits
    }

    /// `x` moves all the same: where nothing is known, there is nothing the residual could have been accounted for by.
    pub(crate) fn move_on(&mut self) {
        self.waits = false;
    }

    /// Adds the differences to the last iterate of this step and filters. `jr = J_prev r`, or empty.
    pub(crate) fn observe(&mut self, x: &[f64], r: &[f64], jr: &[f64], answer: Answer) -> Vec<DroppedColumn> {
        let first = !std::mem::replace(&mut self.begun, true);
        let waited = self.waits;
        self.waits = !(answer.answered || first || waited);
        let mut dropped = self.factor();
        let mut x_tilde = x.to_vec();
        add_scaled(1.0, r, &mut x_tilde);
        let before = self.last.replace(Iterate { x_tilde, r: r.to_vec(), jr: jr.to_vec() });
        if !answer.answered {
            dropped.push(DroppedColumn { steps_ago: 0, column: 0, reason: DropReason::NoAnswer });
        } else if let Some(before) = before.filter(|_| !waited) {
            dropped.extend(self.add(&before));
        }
        dropped
    }

    /// Factors the columns of earlier steps at the first iteration of this one.
    fn factor(&mut self) -> Vec<DroppedColumn> {
        if std::mem::replace(&mut self.factored, true) {
            return Vec::new();
        }
        let dropped = self.filter.rebuild(&mut self.qr, &self.columns.all);
        self.remove(&dropped)
    }

    fn add(&mut self, before: &Iterate) -> Vec<DroppedColumn> {
        let now = self.last.as_ref().expect("the iterate was just stored");
        let column = Column {
            v: difference(&now.r, &before.r),
            w: difference(&now.x_tilde, &before.x_tilde),
            jv: difference(&now.jr, &before.jr),
        };
        let round_off = f64::EPSILON * norm(&now.x_tilde);
        if norm(&column.v) <= round_off || norm(&column.w) <= round_off {
            return vec![DroppedColumn { steps_ago: 0, column: 0, reason: DropReason::NoChange }];
        }
        self.columns.push(column);
        let dropped = self.filter.admit_newest(&mut self.qr, &self.columns.all);
        self.remove(&dropped)
    }

    fn remove(&mut self, dropped: &[(usize, f64)]) -> Vec<DroppedColumn> {
        let record = |&(index, independent): &(usize, f64)| {
            let (steps_ago, column) = self.columns.place(index);
            DroppedColumn { steps_ago, column, reason: DropReason::Dependent { independent } }
        };
        let records = dropped.iter().map(record).collect();
        for &(index, _) in dropped.iter().rev() {
            self.columns.remove(index);
        }
        records
    }

    /// The quasi-Newton update `x <- x_tilde - b + (W - J_prev V) c` with `c = argmin |V c + r|`;
    /// `b = J_prev r`, or empty like the columns' `jv`.
    pub(crate) fn update(&mut self, x: &mut [f64], r: &[f64], b: &[f64]) {
        self.qr.solve(r, &mut self.solution);
        add_scaled(1.0, r, x);
        if !b.is_empty() {
            add_scaled(-1.0, b, x);
        }
        for (c, column) in self.solution.iter().zip(&self.columns.all) {
            add_scaled(-c, &column.w, x);
            if !column.jv.is_empty() {
                add_scaled(*c, &column.jv, x);
            }
        }
    }
}

fn difference(a: &[f64], b: &[f64]) -> Vec<f64> {
    let mut result = vec![0.0; a.len()];
    subtract(a, b, &mut result);
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A step of iterates `x` in two unknowns with `x_tilde = (3 - x_0, 5 - 2 x_1)`.
    fn observe_all(secants: &mut Secants, iterates: &[[f64; 2]]) -> Vec<DroppedColumn> {
        let mut dropped = Vec::new();
        for x in iterates {
            let r = [3.0 - 2.0 * x[0], 5.0 - 3.0 * x[1]];
            dropped.extend(secants.observe(x, &r, &[], Answer::default()));
        }
        dropped
    }

    #[test]
    fn columns_are_differences_of_neighbouring_iterates_newest_first() {
        let mut secants = Secants::new(Filter::None);
        assert!(observe_all(&mut secants, &[[0.0, 0.0], [1.0, 0.0], [1.0, 2.0]]).is_empty());
        let all = &secants.columns().all;
        assert_eq!((&all[0].v, &all[0].w), (&vec![0.0, -6.0], &vec![0.0, -4.0]));
        assert_eq!((&all[1].v, &all[1].w), (&vec![-2.0, 0.0], &vec![-1.0, 0.0]));
    }

    #[test]
    fn no_column_spans_two_steps() {
        let mut secants = Secants::new(Filter::None);
        observe_all(&mut secants, &[[0.0, 0.0], [1.0, 0.0]]);
        let mut columns = secants.columns().clone();
        columns.end_step(Some(2));
        secants.start_step(columns);
        observe_all(&mut secants, &[[5.0, 5.0]]);
        assert_eq!(secants.columns().per_step, [0, 1]);
    }

    #[test]
    fn frozen_iterates_are_dropped_and_recorded() {
        let mut secants = Secants::new(Filter::None);
        let dropped = observe_all(&mut secants, &[[0.0, 0.0], [0.0, 0.0], [1.0, 1.0]]);
        let frozen = DroppedColumn { steps_ago: 0, column: 0, reason: DropReason::NoChange };
        assert_eq!(dropped, [frozen]);
        assert_eq!(secants.len(), 1);
    }

    const UNANSWERED: Answer = Answer { answered: false };

    #[test]
    fn an_iterate_without_an_answer_makes_no_column_and_x_waits_for_one() {
        let mut secants = Secants::new(Filter::None);
        observe_all(&mut secants, &[[0.0, 0.0]]);
        // The input moved, the output did not: it belongs to the one before.
        let dropped = secants.observe(&[1.0, 1.0], &[2.0, 4.0], &[], UNANSWERED);
        assert_eq!(dropped, [DroppedColumn { steps_ago: 0, column: 0, reason: DropReason::NoAnswer }]);
        assert!(secants.waits());
        // The same input, answered now: no difference of inputs, no column.
        assert!(observe_all(&mut secants, &[[1.0, 1.0]]).is_empty());
        assert_eq!((secants.len(), secants.waits()), (0, false));
        observe_all(&mut secants, &[[1.0, 2.0]]);
        let column = &secants.columns().all[0];
        assert_eq!((&column.v, &column.w), (&vec![0.0, -3.0], &vec![0.0, -2.0]));
    }

    #[test]
    fn x_waits_once_and_never_in_the_first_iteration() {
        let mut secants = Secants::new(Filter::None);
        let waits = [(); 5].map(|()| {
            secants.observe(&[0.0], &[1.0], &[], UNANSWERED);
            secants.waits()
        });
        assert_eq!(waits, [false, true, false, true, false]);
        assert!(!secants.at_first_iteration());
    }

    #[test]
    fn differences_of_round_off_are_no_columns() {
        let no_change = [DroppedColumn { steps_ago: 0, column: 0, reason: DropReason::NoChange }];
        for (step, expected) in [(1e-3, 1), (1e-14, 1), (1e-17, 0)] {
            let mut secants = Secants::new(Filter::None);
            secants.observe(&[1.0], &[1.0], &[], Answer::default());
            let dropped = secants.observe(&[1.0 + 20.0 * step], &[1.0 - 10.0 * step], &[], Answer::default());
            assert_eq!(secants.len(), expected, "{step}");
            assert_eq!(dropped == no_change, expected == 0);
        }
    }

    #[test]
    fn dropped_columns_are_named_by_step_and_place() {
        let mut secants = Secants::new(Filter::default());
        observe_all(&mut secants, &[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]);
        let mut columns = secants.columns().clone();
        columns.end_step(None);
        secants.start_step(columns);
        // Two unknowns, so a third column displaces the oldest: one step ago, the second from the newest.
        let dropped = observe_all(&mut secants, &[[0.0, 0.0], [1.0, 1.5]]);
        assert_eq!(dropped.len(), 1);
        assert_eq!((dropped[0].steps_ago, dropped[0].column), (1, 1));
        assert_eq!(secants.columns().per_step, [1, 1]);
    }
}
