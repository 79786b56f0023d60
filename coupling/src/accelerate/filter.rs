//! Which secant columns may stay.

use std::collections::VecDeque;

use serde::{Deserialize, Serialize};

use super::history::Column;
use super::qr::{Dependent, Qr};
use crate::error::SetupError;

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
