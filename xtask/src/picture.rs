//! Pictures of the deformed state.

use crate::reproduce::case::Case;

/// Where a picture stands, seen from the pages.
pub(crate) fn path(case: Case) -> String {
    format!("figures/{}-snapshot.svg", case.scene())
}
