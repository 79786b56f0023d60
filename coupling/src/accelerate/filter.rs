//! Which secant columns may stay.

use std::collections::VecDeque;

use serde::{Deserialize, Serialize};

use super::column::Column;
use super::qr::{Dependent, Qr};
use crate::setup::SetupError;

/// Drops columns of `V = Q R` that depend on newer ones, so that the least-squares problem stays well posed.
///
/// Columns stand newest first. The names and rules are those of preCICE (Haelterman et al. 2016; Davis,
/// Schulte, Uekermann 2022). Every filter, `none` included, drops what round-off makes dependent.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Filter {
    /// Keeps every independent column.
    None,
    /// Drops column j when `|R_jj| < limit |R|_F`. Cheap, but blind to scale: as the columns shrink, it turns
    /// against the newest.
    Qr1 {
        /// Bound of the ratio.
        limit: f64,
    },
    /// Factorizes anew, newest first, in every iteration, and drops column j when `|R_jj| < limit |v_j|`.
    Qr2 {
        /// Bound of the ratio.
        limit: f64,
    },
    /// The rule of `qr2`, but the factorization is updated and built anew only when a column fails.
    Qr3 {
        /// Bound of the ratio.
        limit: f64,
    },
}

impl Default for Filter {
    fn default() -> Self {
        Self::Qr3 { limit: 1e-2 }
    }
}

/// A column that has to go: its index and what is independent of it.
pub(crate) type Dropped = (usize, f64);

impl Filter {
    pub(crate) fn validate(self) -> Result<(), SetupError> {
        match self {
            Self::None => Ok(()),
            Self::Qr1 { limit } | Self::Qr2 { limit } | Self::Qr3 { limit } => {
                if (0.0..1.0).contains(&limit) {
                    return Ok(());
                }
                Err(SetupError::setting("filter limit", limit, "take a number from 0 up to, but not, 1"))
            }
        }
    }

    /// Takes the newest column, `columns[0]`, into the factorization of the others and filters; returns the
    /// columns to drop, which are no longer in the factorization, by ascending index.
    pub(crate) fn admit_newest(self, qr: &mut Qr, columns: &VecDeque<Column>) -> Vec<Dropped> {
        let update = match self {
            Self::Qr2 { .. } => false,
            Self::None | Self::Qr1 { .. } | Self::Qr3 { .. } => qr.push_front(&columns[0].v).is_ok(),
        };
        match self {
            Self::Qr1 { limit } if update => drop_small(qr, limit),
            Self::None if update => Vec::new(),
            Self::Qr3 { limit } if update && (0..qr.len()).all(|j| independent(qr, j) >= limit) => Vec::new(),
            _ => self.rebuild(qr, columns),
        }
    }

    /// Factorizes all columns, newest first, and filters; returns the columns to drop.
    pub(crate) fn rebuild(self, qr: &mut Qr, columns: &VecDeque<Column>) -> Vec<Dropped> {
        let limit = match self {
            Self::None | Self::Qr1 { .. } => 0.0,
            Self::Qr2 { limit } | Self::Qr3 { limit } => limit,
        };
        qr.clear();
        let mut dropped = Vec::new();
        for (index, column) in columns.iter().enumerate() {
            if let Err(Dependent(rest)) = qr.push_back(&column.v, limit) {
                dropped.push((index, rest));
            }
        }
        if let Self::Qr1 { limit } = self {
            let kept: Vec<usize> =
                (0..columns.len()).filter(|index| dropped.iter().all(|(gone, _)| gone != index)).collect();
            dropped.extend(drop_small(qr, limit).into_iter().map(|(index, rest)| (kept[index], rest)));
            dropped.sort_by_key(|&(index, _)| index);
        }
        dropped
    }
}

/// What of column `j` is independent of the newer ones, relative to its length.
fn independent(qr: &Qr, j: usize) -> f64 {
    qr.diagonal(j) / crate::vector::norm(qr.r(j))
}

/// The rule of QR1: sweeps until every diagonal entry is at least `limit |R|_F`.
fn drop_small(qr: &mut Qr, limit: f64) -> Vec<Dropped> {
    let mut alive: Vec<usize> = (0..qr.len()).collect();
    let mut dropped = Vec::new();
    while qr.len() > 1 {
        let all: f64 = (0..qr.len()).map(|j| crate::vector::dot(qr.r(j), qr.r(j))).sum();
        let Some(j) = (0..qr.len()).find(|&j| qr.diagonal(j) < limit * all.sqrt()) else { break };
        dropped.push((alive.remove(j), qr.diagonal(j) / all.sqrt()));
        qr.remove(j);
    }
    dropped.sort_by_key(|&(index, _)| index);
    dropped
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Columns that are newest first: an old copy of the newest, slightly disturbed, among independent ones.
    fn columns() -> VecDeque<Column> {
        let v = |entries: [f64; 5]| Column { v: entries.to_vec(), w: vec![0.0; 5], jv: vec![] };
        VecDeque::from([
            v([1.0, 2.0, 0.0, 0.0, 0.5]),
            v([0.0, 1.0, 3.0, 0.0, 0.0]),
            v([2.0, 4.0, 0.0, 1e-3, 1.0]),
            v([0.0, 0.0, 0.0, 5.0, 1.0]),
        ])
    }

    /// Lets the columns come one after the other, as in a run; returns what is dropped with the last one.
    fn admit(filter: Filter, columns: &VecDeque<Column>) -> (Vec<Dropped>, Qr) {
        let mut qr = Qr::default();
        let mut known = VecDeque::new();
        let mut dropped = Vec::new();
        for column in columns.iter().rev() {
            known.push_front(column.clone());
            dropped = filter.admit_newest(&mut qr, &known);
            for &(index, _) in dropped.iter().rev() {
                known.remove(index);
            }
            assert_eq!(qr.len(), known.len());
        }
        (dropped, qr)
    }

    #[test]
    fn dependent_old_column_is_dropped_with_what_was_left_of_it() {
        for filter in [Filter::Qr2 { limit: 1e-2 }, Filter::Qr3 { limit: 1e-2 }] {
            let (dropped, qr) = admit(filter, &columns());
            assert_eq!(qr.len(), 3);
            let [(2, independent)] = dropped[..] else { panic!("{filter:?} drops {dropped:?}") };
            let expected = 1e-3 / 21.0_f64.sqrt();
            assert!((independent - expected).abs() < 1e-3 * expected, "{independent:e} {expected:e}");
        }
    }

    #[test]
    fn loose_limits_keep_what_is_independent_at_all() {
        for filter in [Filter::None, Filter::Qr2 { limit: 1e-6 }, Filter::Qr3 { limit: 1e-6 }] {
            assert_eq!(admit(filter, &columns()).1.len(), 4, "{filter:?}");
        }
    }

    #[test]
    fn every_filter_drops_a_repeated_column() {
        let mut columns = columns();
        columns[3].v = columns[0].v.iter().map(|v| -3.0 * v).collect();
        for filter in
            [Filter::None, Filter::Qr1 { limit: 0.0 }, Filter::Qr2 { limit: 0.0 }, Filter::Qr3 { limit: 0.0 }]
        {
            let (dropped, qr) = admit(filter, &columns);
            assert_eq!(qr.len(), 3, "{filter:?}");
            assert_eq!(dropped[0].0, 3, "{filter:?}: the older of the two goes");
        }
    }

    #[test]
    fn newest_column_replaces_the_oldest_of_a_full_basis() {
        let unit = |i: usize| {
            let mut v = vec![0.1; 3];
            v[i % 3] = 1.0 + i as f64;
            Column { v, w: vec![0.0; 3], jv: vec![] }
        };
        let columns: VecDeque<Column> = (0..4).map(unit).collect();
        for filter in [Filter::None, Filter::default(), Filter::Qr2 { limit: 1e-2 }] {
            let (dropped, qr) = admit(filter, &columns);
            assert_eq!((qr.len(), dropped[0].0), (3, 3), "{filter:?}");
        }
    }

    #[test]
    fn first_filter_is_blind_to_scale() {
        let mut columns = columns();
        for value in &mut columns[0].v {
            *value *= 1e-4;
        }
        columns.remove(2);
        assert_eq!(admit(Filter::Qr1 { limit: 1e-2 }, &columns).0[0].0, 0, "QR1 drops the small newest");
        assert!(admit(Filter::Qr3 { limit: 1e-2 }, &columns).0.is_empty(), "QR3 keeps it");
    }

    #[test]
    fn rebuilding_drops_what_updating_drops() {
        let columns = columns();
        for filter in [Filter::Qr1 { limit: 1e-2 }, Filter::default(), Filter::None] {
            let (updated, _) = admit(filter, &columns);
            let rebuilt = filter.rebuild(&mut Qr::default(), &columns);
            let index = |dropped: &[Dropped]| dropped.iter().map(|&(index, _)| index).collect::<Vec<_>>();
            assert_eq!(index(&updated), index(&rebuilt), "{filter:?}");
        }
    }

    #[test]
    fn limits_outside_zero_to_one_are_refused() {
        assert!(Filter::Qr3 { limit: 1.0 }.validate().is_err());
        assert!(Filter::Qr1 { limit: -0.1 }.validate().is_err());
        assert!(Filter::default().validate().is_ok());
    }
}
