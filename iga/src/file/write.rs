//! A spline as text.

use std::fmt::Write;

use super::format::{FORMAT, VERSION};
use crate::spline::Spline;

pub(super) fn spline<const D: usize>(spline: &Spline<D>) -> String {
    let degrees: Vec<usize> = spline.knots().iter().map(crate::Knots::degree).collect();
    let mut text = String::from("# Control points and weights are listed along the first parameter first.\n");
    let mut head = |key: &str, value: &dyn std::fmt::Debug| {
        writeln!(text, "{key} = {value:?}").expect("a string takes whatever is written to it");
    };
    head("format", &FORMAT);
    head("version", &VERSION);
    head("dimension", &D);
    head("degrees", &degrees);
    list(&mut text, "knots", spline.knots().iter().map(|knots| bracketed(knots.values())));
    list(&mut text, "control_points", spline.control_points().iter().map(|point| bracketed(point)));
    if spline.weights().iter().any(|w| w.to_bits() != 1.0_f64.to_bits()) {
        // A line for each line of control points.
        let lines = spline.weights().chunks(spline.shape()[0]);
        list(&mut text, "weights", lines.map(joined));
    }
    text
}

fn list(text: &mut String, key: &str, lines: impl Iterator<Item = String>) {
    text.push_str(key);
    text.push_str(" = [\n");
    lines.for_each(|line| {
        text.push_str("    ");
        text.push_str(&line);
        text.push_str(",\n");
    });
    text.push_str("]\n");
}

fn bracketed(numbers: &[f64]) -> String {
    format!("[{}]", joined(numbers))
}

/// Rust's shortest form that reads back to the same bits; it is TOML as it stands.
fn joined(numbers: &[f64]) -> String {
    numbers.iter().map(|x| format!("{x:?}")).collect::<Vec<_>>().join(", ")
}
