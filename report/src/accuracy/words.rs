//! Costs as the page of accuracy and its summary write them.

use partita_charts::axis::rounded;
use partita_charts::work_precision::Fit;

use super::row::Row;

pub(super) fn cost(fit: &Fit) -> String {
    rounded(fit.digit_factor(), 3)
}

pub(super) fn seconds(row: &Row) -> String {
    row.cpu_seconds.map_or_else(|| "-".to_owned(), |seconds| rounded(seconds, 2))
}
