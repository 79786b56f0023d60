//! Faults in the text of a spline's file: each is named with its line, and a remedy.

use std::fmt::Write;

use partita_iga::file::{self, Fault, FileError};
use partita_iga::{KnotError, SplineError};
use partita_testing::with_hint;

use crate::file::RING;

/// The example with one piece exchanged.
fn broken(name: &str, from: &str, to: &str) -> (String, FileError) {
    assert!(RING.contains(from), "{name}: the example has no {from:?}");
    let text = RING.replacen(from, to, 1);
    let error = file::from_toml::<2>(&text).expect_err(name);
    (text, error)
}

/// What is said of each (name, piece, piece instead), after the name and the text at fault.
fn messages(faults: &[(&str, &str, &str)]) -> String {
    let mut messages = String::new();
    for (name, from, to) in faults {
        let (text, error) = broken(name, from, to);
        let message = with_hint(&error);
        let lines: Vec<&str> = message.lines().collect();
        assert!(lines.len() == 2 && lines[1].starts_with("hint: "), "{name}: {message}");
        assert!(lines[0].starts_with(&format!("line {}, ", error.line())), "{name}: {message}");
        let place = text.get(error.span()).unwrap_or_else(|| panic!("{name}: {:?}", error.span()));
        let place = place.lines().next().unwrap_or("<the end>");
        writeln!(messages, "{name} | {place}\n{message}").unwrap();
    }
    messages
}

const WHAT_STANDS_ROUND_THE_NUMBERS: [(&str, &str, &str); 16] = [
    ("not TOML", "version = 1", "version : 1"),
    ("a bracket too few", "control_points = [\n", "control_points = \n"),
    ("a key twice", "version = 1", "version = 1\nversion = 1"),
    ("another format", "partita-spline", "gismo-xml"),
    ("format a number", "\"partita-spline\"", "7"),
    ("no format", "format = \"partita-spline\"\n", ""),
    ("a later version", "version = 1", "version = 2\nperiodic = true"),
    ("version a text", "version = 1", "version = \"1\""),
    ("no version", "version = 1\n", ""),
    ("a slip in a key", "weights =", "weigths ="),
    ("a strange key", "version = 1", "version = 1\ncolour = \"red\""),
    ("a table", "version = 1", "version = 1\nmaterial.density = 1.0"),
    ("three dimensions", "dimension = 2", "dimension = 3"),
    ("negative dimension", "dimension = 2", "dimension = -2"),
    ("dimension out of range", "dimension = 2", "dimension = 99999999999999999999999"),
    ("no dimension", "dimension = 2\n", ""),
];

#[test]
fn what_stands_round_the_numbers_is_checked() {
    insta::assert_snapshot!(messages(&WHAT_STANDS_ROUND_THE_NUMBERS), @r##"
    not TOML | <the end>
    line 3, not TOML: key with no value, expected `=`
    hint: a spline file consists of `key = value`, values are numbers or [lists]
    a bracket too few | <the end>
    line 11, not TOML: unclosed table, expected `]`
    hint: a spline file consists of `key = value`, values are numbers or [lists]
    a key twice | version
    line 4, not TOML: duplicate key
    hint: a spline file consists of `key = value`, values are numbers or [lists]
    another format | "gismo-xml"
    line 2, `format` is "gismo-xml"
    hint: the format of a spline file is "partita-spline"
    format a number | 7
    line 2, format: the number 7 stands where a text in quotes should
    hint: give a text in quotes
    no format | <the end>
    line 22, the file ends without `format`
    hint: add `format = "partita-spline"`
    a later version | 2
    line 3, `version` is 2
    hint: this program reads version 1
    version a text | "1"
    line 3, version: the text "1" stands where a whole number, 0 or more should
    hint: give a whole number, 0 or more
    no version | <the end>
    line 22, the file ends without `version`
    hint: add `version = 1`
    a slip in a key | weigths
    line 18, `weigths` is not a key of a spline file
    hint: did you mean `weights`?
    a strange key | colour
    line 4, `colour` is not a key of a spline file
    hint: keys are format, version, dimension, degrees, knots, control_points, weights
    a table | material
    line 4, `material` is not a key of a spline file
    hint: keys are format, version, dimension, degrees, knots, control_points, weights
    three dimensions | 3
    line 4, a spline in 3 dimensions, where one in 2 is needed
    hint: take a file with `dimension = 2` and 2 coordinates a control point
    negative dimension | -2
    line 4, dimension: the number -2 stands where a whole number, 0 or more should
    hint: give a whole number, 0 or more
    dimension out of range | 99999999999999999999999
    line 4, dimension: the number 99999999999999999999999 stands where a whole number, 0 or more should
    hint: give a whole number, 0 or more
    no dimension | <the end>
    line 22, the file ends without `dimension`
    hint: add `dimension = 2`
    "##);
}

const DEGREES_AND_KNOTS: [(&str, &str, &str); 16] = [
    ("no degrees", "degrees = [1, 2]\n", ""),
    ("one degree", "degrees = [1, 2]", "degrees = 2"),
    ("fractional degree", "degrees = [1, 2]", "degrees = [1, 2.5]"),
    ("degree zero", "degrees = [1, 2]", "degrees = [0, 2]"),
    ("absurd degree", "degrees = [1, 2]", "degrees = [1, 9223372036854775807]"),
    ("degree too high", "degrees = [1, 2]", "degrees = [1, 3]"),
    ("too many degrees", "degrees = [1, 2]", "degrees = [1, 2, 1, 1]"),
    ("a degree too few", "degrees = [1, 2]", "degrees = [1]"),
    ("no knots", "knots = [\n    [0.0, 0.0, 1.0, 1.0],\n    [0.0, 0.0, 0.0, 1.0, 1.0, 1.0],\n]\n", ""),
    ("knots not a list of lists", "[0.0, 0.0, 1.0, 1.0]", "0.0, 1.0"),
    ("a knot a text", "[0.0, 0.0, 1.0, 1.0]", "[0.0, \"0.0\", 1.0, 1.0]"),
    ("falling knots", "[0.0, 0.0, 1.0, 1.0]", "[0.0, 0.0, 0.7, 0.3, 1.0, 1.0]"),
    ("a knot not a number", "[0.0, 0.0, 1.0, 1.0]", "[0.0, 0.0, nan, 1.0, 1.0]"),
    ("start not clamped", "[0.0, 0.0, 1.0, 1.0]", "[0.0, 0.5, 1.0, 1.0]"),
    ("end not clamped", "[0.0, 0.0, 1.0, 1.0]", "[0.0, 0.0, 1.0, 1.0, 1.0]"),
    ("a torn knot", "[0.0, 0.0, 1.0, 1.0]", "[0.0, 0.0, 0.5, 0.5, 1.0, 1.0]"),
];

#[test]
fn degrees_and_knots_are_checked() {
    insta::assert_snapshot!(messages(&DEGREES_AND_KNOTS), @r##"
    no degrees | <the end>
    line 22, the file ends without `degrees`
    hint: add `degrees = [2, 2], one for each parameter`
    one degree | 2
    line 5, degrees: the number 2 stands where a list of degrees like [2, 2] should
    hint: give a list of degrees like [2, 2]
    fractional degree | 2.5
    line 5, degrees[1]: the number 2.5 stands where a whole number, 0 or more should
    hint: give a whole number, 0 or more
    degree zero | 0
    line 5, degrees[0]: a spline of degree 0 falls apart at its knots
    hint: take a degree of at least 1
    absurd degree | [0.0, 0.0, 0.0, 1.0, 1.0, 1.0]
    line 8, knots[1]: 6 knots are too few for degree 9223372036854775807
    hint: degree 9223372036854775807 needs at least 18446744073709551615 knots, half of them at either end
    degree too high | [0.0, 0.0, 0.0, 1.0, 1.0, 1.0]
    line 8, knots[1]: 6 knots are too few for degree 3
    hint: degree 3 needs at least 8 knots, half of them at either end
    too many degrees | [1, 2, 1, 1]
    line 5, degrees: 4 parameters are too many
    hint: a spline has up to 3
    a degree too few | [
    line 6, knots: 2 knot vectors for 1 degrees
    hint: give one list of knots for each degree
    no knots | <the end>
    line 19, the file ends without `knots`
    hint: add `knots = [[...], [...]], one list for each parameter`
    knots not a list of lists | [
    line 6, knots: 3 knot vectors for 2 degrees
    hint: give one list of knots for each degree
    a knot a text | "0.0"
    line 7, knots[0][1]: the text "0.0" stands where a decimal number should
    hint: give a decimal number
    falling knots | 0.3
    line 7, knots[0]: knot 3 is 0.3, smaller than 0.7 before it
    hint: list the knots in ascending order
    a knot not a number | nan
    line 7, knots[0]: knot 2 is NaN
    hint: knots are finite numbers
    start not clamped | [0.0, 0.5, 1.0, 1.0]
    line 7, knots[0]: the knot at the start stands 1 times
    hint: repeat it 2 times (degree + 1), so that the spline begins and ends in a control point
    end not clamped | [0.0, 0.0, 1.0, 1.0, 1.0]
    line 7, knots[0]: the knot at the end stands 3 times
    hint: repeat it 2 times (degree + 1), so that the spline begins and ends in a control point
    a torn knot | [0.0, 0.0, 0.5, 0.5, 1.0, 1.0]
    line 7, knots[0]: the inner knot 0.5 stands 2 times in a vector of degree 1, which tears the spline
    hint: an inner knot may stand at most 1 times
    "##);
}

const CONTROL_POINTS_AND_WEIGHTS: [(&str, &str, &str); 10] = [
    ("no control points", "control_points =", "outline ="),
    ("a control point too few", "    [1.0, 1.0],\n", ""),
    ("a coordinate too many", "[1.5, 1.5]", "[1.5, 1.5, 0.0]"),
    ("a point without brackets", "[1.5, 1.5]", "1.5"),
    ("an infinite coordinate", "[1.5, 1.5]", "[1.5, 1e999]"),
    ("a coordinate a truth", "[1.5, 1.5]", "[1.5, true]"),
    ("weights too few", "    1.0, 1.0,\n", ""),
    ("weight zero", "    1.0, 1.0,\n", "    1.0, 0.0,\n"),
    ("weight negative", "    1.0, 1.0,\n", "    1.0,\n    -1.0,\n"),
    ("weight not a number", "    1.0, 1.0,\n", "    nan, 1.0,\n"),
];

#[test]
fn control_points_and_weights_are_checked() {
    insta::assert_snapshot!(messages(&CONTROL_POINTS_AND_WEIGHTS), @r##"
    no control points | outline
    line 10, `outline` is not a key of a spline file
    hint: keys are format, version, dimension, degrees, knots, control_points, weights
    a control point too few | [
    line 10, control_points: 5 control points do not fit [2, 3] basis functions
    hint: give 6 control points
    a coordinate too many | [1.5, 1.5, 0.0]
    line 14, control_points[3]: 3 coordinates
    hint: with `dimension = 2` a point has 2
    a point without brackets | 1.5
    line 14, control_points[3]: the number 1.5 stands where a list of coordinates should
    hint: give a list of coordinates
    an infinite coordinate | [1.5, 1e999]
    line 14, control_points: control point 3 has a coordinate that is not finite
    hint: coordinates are finite numbers
    a coordinate a truth | true
    line 14, control_points[3][1]: `true` stands where a decimal number should
    hint: give a decimal number
    weights too few | [
    line 18, weights: 4 weights do not fit 6 control points
    hint: give one weight for each control point
    weight zero | 0.0
    line 19, weights: the weight of control point 1 is 0
    hint: weights are positive, finite numbers
    weight negative | -1.0
    line 20, weights: the weight of control point 1 is -1
    hint: weights are positive, finite numbers
    weight not a number | nan
    line 19, weights: the weight of control point 0 is NaN
    hint: weights are positive, finite numbers
    "##);
}

#[test]
fn a_caller_can_ask_for_the_fault_and_its_place() {
    let (text, error) = broken("", "[0.0, 0.0, 1.0, 1.0]", "[0.0, 0.0, 0.7, 0.3, 1.0, 1.0]");
    let knot = KnotError::Decreasing { index: 3, previous: 0.7, value: 0.3 };
    assert_eq!(error.fault(), &Fault::Knots { parameter: 0, error: knot });
    assert_eq!((error.line(), &text[error.span()]), (7, "0.3"));
    let (text, error) = broken("", "[1.5, 1.5]", "[1.5, inf]");
    let control_point = SplineError::NotFinite { index: 3 };
    assert_eq!(error.fault(), &Fault::Spline { key: "control_points", error: control_point });
    assert_eq!(&text[error.span()], "[1.5, inf]");
}
