//! What a spline's file consists of.

/// The value of the key `format`.
pub const FORMAT: &str = "partita-spline";
/// The version of the format that is written, and the only one that is read.
pub const VERSION: usize = 1;

/// Keys of a file.
pub(super) const KEYS: [&str; 7] =
    ["format", "version", "dimension", "degrees", "knots", "control_points", "weights"];
/// What could stand at each of them.
pub(super) const EXAMPLES: [&str; 7] = [
    "\"partita-spline\"",
    "1",
    "2",
    "[2, 2], one for each parameter",
    "[[...], [...]], one list for each parameter",
    "[[x, y], ...], along the first parameter first",
    "[...], one for each control point",
];
