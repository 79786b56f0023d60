//! How much room a text takes.

/// Advance widths of the printable characters of ASCII, in thousandths of the size of the font: those of `DejaVu` Sans,
/// the widest of the fonts that viewers take for `sans-serif`.
const ADVANCES: [u16; 95] = [
    318, 401, 460, 838, 636, 950, 780, 275, 390, 390, 500, 838, 318, 361, 318, 337, 636, 636, 636, 636, 636,
    636, 636, 636, 636, 636, 337, 337, 838, 838, 838, 531, 1000, 684, 686, 698, 770, 632, 575, 775, 752, 295,
    295, 656, 557, 863, 748, 787, 603, 787, 695, 635, 611, 732, 684, 989, 685, 611, 685, 390, 337, 390, 838,
    500, 500, 613, 635, 550, 635, 615, 352, 635, 634, 278, 278, 579, 278, 974, 634, 612, 635, 635, 411, 521,
    392, 634, 592, 818, 592, 592, 525, 636, 337, 636, 838,
];
/// Of any other character.
const OTHER: u16 = 838;

/// Width of a line of text \[pixels\] in a font of this size; an estimate from above for most fonts.
#[must_use]
pub fn width(text: &str, size: f64) -> f64 {
    let advance = |letter: char| {
        let index = (letter as usize).checked_sub(' ' as usize);
        index.and_then(|index| ADVANCES.get(index)).copied().unwrap_or(OTHER)
    };
    text.chars().map(|letter| f64::from(advance(letter))).sum::<f64>() * size / 1000.0
}

/// A text on lines of at most this width, broken between words; a word that is wider has a line of its own.
#[must_use]
pub fn lines(text: &str, size: f64, most: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split(' ') {
        match lines.last_mut() {
            Some(line) if width(&format!("{line} {word}"), size) <= most => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_is_as_wide_as_its_letters() {
        assert!((width("Wii", 10.0) - (9.89 + 2.0 * 2.78)).abs() < 1e-12);
        assert!(width("", 10.0) == 0.0 && width("µ", 10.0) > 5.0);
        assert!((width("level", 20.0) - 2.0 * width("level", 10.0)).abs() < 1e-12);
    }

    #[test]
    fn long_texts_are_broken_between_words_and_none_is_lost() {
        let name = "constant 0.8, N^f = 2, N^s = 1, bounds of the fields";
        let broken = lines(name, 12.0, 200.0);
        assert!(broken.len() == 2 && broken.iter().all(|line| width(line, 12.0) <= 200.0), "{broken:?}");
        assert_eq!(broken.join(" "), name);
        assert_eq!(lines("BDF1", 12.0, 200.0), ["BDF1"]);
        let long = "x".repeat(50);
        assert_eq!(lines(&format!("a {long} b"), 12.0, 200.0), ["a", &long, "b"]);
    }
}
