//! The text of a spline's file: there and back to the last bit, and no panic whatever it says.

use miette::Diagnostic;
use partita_iga::file::{self, Fault};
use partita_iga::{Knots, Spline, build};
use proptest::prelude::*;
use proptest::sample::Index;

use crate::support::splines;

pub(crate) const RING: &str = include_str!("../data/ring.toml");

#[test]
fn the_example_file_is_the_quarter_annulus() {
    let ring = build::quarter_annulus(1.0, 1.5).unwrap();
    assert_eq!(file::to_toml(&ring), RING);
    assert_eq!(file::from_toml(RING), Ok(ring));
    assert!(include_str!("../../README.md").contains(RING), "the README shows the example");
}

fn bits<const D: usize>(spline: &Spline<D>) -> Vec<u64> {
    let knots = spline.knots().iter().flat_map(|knots| knots.values().to_vec());
    let points = spline.control_points().iter().flatten().copied();
    knots.chain(points).chain(spline.weights().iter().copied()).map(f64::to_bits).collect()
}

fn returns<const D: usize>(spline: &Spline<D>) {
    let back = file::from_toml::<D>(&file::to_toml(spline)).unwrap();
    assert_eq!(&back, spline);
    assert_eq!(bits(&back), bits(spline));
}

proptest! {
    #[test]
    fn what_is_written_is_read_back_to_the_last_bit(
        curve in splines::<3>(1), surface in splines::<2>(2), volume in splines::<3>(3),
    ) {
        returns(&curve);
        returns(&surface);
        returns(&volume);
    }
}

#[test]
fn numbers_of_any_size_and_points_without_parameters_return() {
    let knots = Knots::new(1, vec![-0.0, 0.0, 5e-324, 1.0 / 3.0, 1e300, 1e300]).unwrap();
    let points = vec![[-0.0, f64::MAX], [f64::MIN_POSITIVE, 0.1], [1e-7, 1e16], [123_456_789.0, -1e22]];
    returns(&Spline::rational(vec![knots], points, vec![5e-324, 1.0, 1e300, 2.0]).unwrap());
    returns(&Spline::new(vec![], vec![[0.1, 0.2, 0.3]]).unwrap());
    returns(
        &Spline::rational(vec![Knots::uniform(1, 1).unwrap()], vec![[1.0], [2.0]], vec![2.0; 2]).unwrap(),
    );
}

#[test]
fn other_ways_to_write_the_same_file_are_read() {
    let ring = file::from_toml::<2>(RING).unwrap();
    let without_weights = RING.split("weights = ").next().unwrap();
    assert_eq!(file::from_toml::<2>(without_weights).unwrap().weights(), [1.0; 6]);
    let marked = format!("\u{feff}{RING}");
    for same in [RING.replace('\n', "\r\n"), marked, RING.replace("1.0", "1"), RING.replace(".5", ".500e0")] {
        assert_eq!(file::from_toml::<2>(&same).as_ref(), Ok(&ring), "{same}");
    }
}

#[test]
fn a_file_cut_short_anywhere_is_refused() {
    let (weights, complete) = (RING.find("weights =").unwrap(), RING.trim_end().len());
    for length in 0..complete {
        let cut = &RING[..length];
        // Without the weights it is another spline, but a whole one.
        let whole = (weights - 1..=weights).contains(&length);
        assert_eq!(file::from_toml::<2>(cut).is_ok(), whole, "{cut}");
    }
}

#[test]
fn long_words_are_not_repeated_in_full() {
    let text = format!("{RING}\"{}\\n\" = 1\n", "x".repeat(10_000));
    let message = file::from_toml::<2>(&text).unwrap_err().to_string();
    assert!(message.len() < 300, "{message}");
}

#[test]
fn deep_nesting_is_an_error() {
    let text = RING.replace("[1.5, 1.5]", &"[".repeat(100_000));
    assert!(matches!(file::from_toml::<2>(&text).unwrap_err().fault(), Fault::Toml { .. }));
}

/// Pieces that a careless hand might put anywhere.
const PIECES: [&str; 24] = [
    "[",
    "]",
    ",",
    "\n",
    "=",
    "\"",
    "'",
    "#",
    "nan",
    "inf",
    "-1",
    "1e999",
    "0x7f",
    "[]",
    "[[]]",
    "{}",
    "é",
    "\0",
    "99999999999999999999",
    "9223372036854775807",
    "1979-05-27",
    "knots = [",
    "weights",
    "true",
];

#[derive(Clone, Debug)]
enum Piece {
    Nothing,
    Known(&'static str),
    /// Some letters from elsewhere in the file.
    Copy(Index, usize),
}

fn changes() -> impl Strategy<Value = Vec<(Index, usize, Piece)>> {
    let piece = prop_oneof![
        Just(Piece::Nothing),
        prop::sample::select(&PIECES[..]).prop_map(Piece::Known),
        (any::<Index>(), 1_usize..40).prop_map(|(start, length)| Piece::Copy(start, length)),
    ];
    prop::collection::vec((any::<Index>(), 0_usize..6, piece), 1..5)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]
    #[test]
    fn damaged_files_are_read_or_refused_without_a_panic(changes in changes(), dimension in 1_usize..=3) {
        let mut text: Vec<char> = RING.chars().collect();
        for (start, removed, piece) in changes {
            let start = start.index(text.len());
            let new: Vec<char> = match piece {
                Piece::Nothing => vec![],
                Piece::Known(piece) => piece.chars().collect(),
                Piece::Copy(from, length) => {
                    text[from.index(text.len())..].iter().take(length).copied().collect()
                }
            };
            text.splice(start..(start + removed).min(text.len()), new);
        }
        let text: String = text.into_iter().collect();
        let error = match dimension {
            1 => file::from_toml::<1>(&text).err(),
            2 => file::from_toml::<2>(&text).err(),
            _ => file::from_toml::<3>(&text).err(),
        };
        if let Some(error) = error {
            prop_assert!(text.get(error.span()).is_some(), "{:?}", error.span());
            prop_assert!(error.line() <= 1 + text.matches('\n').count());
            prop_assert!(error.help().is_some());
        }
    }
}
