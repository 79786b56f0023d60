//! The known word that a misspelled one was probably meant to be.

/// The known word with the fewest letters to insert, remove or change (Levenshtein's distance), if that is at most a
/// third of them. Ties go to the first.
pub(crate) fn nearest(word: &str, known: &[&'static str]) -> Option<&'static str> {
    let letters: Vec<char> = word.to_lowercase().replace('-', "_").chars().collect();
    let candidates = known.iter().map(|candidate| {
        let candidate_letters: Vec<char> = candidate.chars().collect();
        let longest = letters.len().max(candidate_letters.len());
        (distance(&letters, &candidate_letters), longest, *candidate)
    });
    candidates
        .filter(|(distance, longest, _)| *distance <= (longest / 3).max(1))
        .min_by_key(|(distance, _, _)| *distance)
        .map(|(_, _, candidate)| candidate)
}

/// Row by row of the table of distances between the starts of both words.
fn distance(a: &[char], b: &[char]) -> usize {
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.iter().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, y) in b.iter().enumerate() {
            let changed = diagonal + usize::from(x != y);
            diagonal = row[j + 1];
            row[j + 1] = changed.min(row[j] + 1).min(row[j + 1] + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distance_counts_letters_inserted_removed_and_changed() {
        let between = |a: &str, b: &str| {
            let [a, b] = [a, b].map(|word| word.chars().collect::<Vec<_>>());
            (distance(&a, &b), distance(&b, &a))
        };
        assert_eq!(between("kitten", "sitting"), (3, 3));
        assert_eq!(between("", "knots"), (5, 5));
        assert_eq!(between("weights", "weights"), (0, 0));
    }

    #[test]
    fn slips_find_their_word_and_strangers_none() {
        let known = ["knots", "control_points", "weights"];
        assert_eq!(nearest("knot", &known), Some("knots"));
        assert_eq!(nearest("Control-Points", &known), Some("control_points"));
        assert_eq!(nearest("wieghts", &known), Some("weights"));
        assert_eq!(nearest("colour", &known), None);
    }
}
