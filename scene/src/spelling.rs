//! The known name that a misspelled one was probably meant to be.

/// The candidate nearest to `name`, if it is near enough to be worth a hint.
///
/// Distance is Damerau-Levenshtein's (one insertion, removal, change or swap of neighbours counts one); a third of
/// the letters may differ. Ties go to the first candidate.
pub fn nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let name = name.to_lowercase().replace('-', "_");
    candidates
        .into_iter()
        .map(|candidate| (strsim::damerau_levenshtein(&name, candidate), candidate))
        .filter(|&(distance, candidate)| distance <= (name.len().max(candidate.len()) / 3).max(1))
        .min_by_key(|&(distance, _)| distance)
        .map(|(_, candidate)| candidate)
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn finds_slips_and_leaves_strangers_alone() {
        let keys = ["density", "viscosity", "body_force", "mesh"];
        assert_eq!(nearest("densty", keys), Some("density"));
        assert_eq!(nearest("Body-Force", keys), Some("body_force"));
        assert_eq!(nearest("msh", keys), Some("mesh"));
        assert_eq!(nearest("colour", keys), None);
    }
}
