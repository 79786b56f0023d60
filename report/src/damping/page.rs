//! `docs/damping.md`: the rows as tables a person reads.

use super::case::{CASES, Case, FLAP};
use super::row::{Radius, Row};
use crate::markdown;

const HEAD: &str = "\
# Numerical damping of the structure

<!-- Generated from docs/data/damping.csv: `cargo xtask damping` -->

The generalized-alpha scheme of the structure has one parameter, its spectral radius at infinite frequency. At radius 1 it
keeps the energy of every vibration, including those that the mesh has but the time step does not resolve. In a coupled run
these never die out after a jolt, and the force between fluid and structure oscillates from step to step. At radius 0 they
are gone within a few steps, but slow vibrations lose amplitude, too. This study compares both effects; `cargo xtask damping
--mode compare` repeats all runs and compares them with [data/damping.csv](data/damping.csv).
";

const COLUMNS: &str = "
## Columns

* **second difference**: the mean of |f(n+1) - 2 f(n) + f(n-1)| over all steps, with the vector f(n) of the fluid's force on
  the structure at the end of step n, in N per metre of depth. A force that alternates by +a and -a has 4a; a smooth one has
  about its second time derivative times the squared step, which is what the last row shows.
* **of that at 1**: the same as part of the value at radius 1.
* **error of the displacement**, **error of the force**: the root mean square, over the ends of all coarse steps, of the
  distance from the reference, as part of the root mean square of the reference. Displacement is that of the tip.
* The last row is the **reference**, a run with much smaller steps and radius 0.5, sampled at the ends of the coarse steps. Its
  errors are the distance from the same run with radius 0.2: what the choice of its own radius may account for. Errors of
  different radii that are closer together than that cannot be told apart. (The force of FSI1 is such a case: its reference is
  known to 0.084 % only.)

The reference solves the same equations on the same mesh. Stabilization depends on the step size, so these runs leave out
grad-div and raise `inverse_constant`, which leaves little of that dependence; what is left is the same at every radius.
";

/// The page of these rows.
pub(super) fn text(rows: &[Row]) -> String {
    let mut text = format!("{HEAD}{COLUMNS}");
    for case in &CASES {
        let of: Vec<&Row> = rows.iter().filter(|row| row.case == case.name).collect();
        text.push_str(&format!("\n## {}\n\n{}\n\n", heading(case.name), setting(case)));
        text.push_str(&table(case, &of));
    }
    text.push_str(&reason(rows));
    text
}

fn heading(name: &str) -> String {
    let mut letters = name.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

/// How the case is run.
fn setting(case: &Case) -> String {
    let Case { scene, changes, step, steps, finer, .. } = case;
    let name = scene.trim_start_matches("scenes/");
    format!(
        "[{name}](../{scene}/README.md) with {}. {steps} steps of {step} s; the reference has {} steps of {} s.",
        changes,
        steps * finer,
        step / *finer as f64,
    )
}

fn table(case: &Case, rows: &[&Row]) -> String {
    let undamped =
        rows.iter().find(|row| row.radius == Radius::Given(1.0)).and_then(|row| row.second_difference);
    let header: &[&str] = if case.coupled {
        &[
            "spectral radius",
            "second difference, N/m",
            "of that at 1",
            "error of the displacement",
            "error of the force",
        ]
    } else {
        &["spectral radius", "error of the displacement"]
    };
    let line = |row: &&Row| {
        let mut line = vec![match row.radius {
            Radius::Given(value) => value.to_string(),
            Radius::Default => format!("**{}, the default**", row.value),
            Radius::Reference => "reference".to_owned(),
        }];
        if let Some(second_difference) = row.second_difference {
            let part = undamped.map_or(f64::NAN, |undamped| second_difference / undamped);
            line.extend([digits(second_difference), format!("{part:.3}")]);
        }
        let errors = std::iter::once(row.displacement_error).chain(row.force_error);
        line.extend(errors.map(|error| format!("{} %", digits(100.0 * error))));
        line
    };
    markdown::table(header, &rows.iter().map(line).collect::<Vec<_>>())
}

/// Three digits, without an exponent.
fn digits(value: f64) -> String {
    // The first number of places that leaves three digits: 0.00312, 2.26, 41.0, 128.
    let places = (0..9).find(|&places| value * 10_f64.powi(places) >= 99.95).unwrap_or(if value > 0.0 {
        9
    } else {
        0
    });
    format!("{value:.*}", usize::try_from(places).expect("not negative"))
}

/// Why the default is what it is, in the numbers of the rows.
fn reason(rows: &[Row]) -> String {
    let of = |case: &str, radius: Radius| rows.iter().find(|row| row.case == case && row.radius == radius);
    let structure = CASES.iter().find(|case| !case.coupled).map_or("", |case| case.name);
    let second = |radius| of(FLAP, radius).and_then(|row| row.second_difference).unwrap_or(f64::NAN);
    let force = |radius| percent(of(FLAP, radius).and_then(|row| row.force_error));
    let swing = |radius| percent(of(structure, radius).map(|row| row.displacement_error));
    let value = of(FLAP, Radius::Default).map_or(f64::NAN, |row| row.value);
    let (default, undamped) = (Radius::Default, Radius::Given(1.0));
    format!(
        "
## The default: {value}

* Its forces are as smooth as those of the reference, or nearly so. The flap with BDF2 keeps {:.1} % of the second difference at
  radius 1, {} N/m, of which the reference has {}; the error of its force falls from {} % to {} %.
* It costs next to no accuracy. The displacements of the coupled cases hardly depend on the radius. A structure alone that
  swings with {STEPS_A_PERIOD} steps per period is where damping shows: its error is {} % at {value} against {} % at 1, {} % at 0.2
  and {} % at 0.
* Radii of 0.8 and above leave a visible part of the oscillation. Radii below {value} smooth the force a little more, and a long
  swing loses amplitude.

Choose 1 where the energy of a structure alone must be kept, and less than {value} where a force still oscillates: the scenes of
FSI2 and FSI3 take 0, because larger radii leave a sawtooth in their lift. Scenes that reproduce published numbers state
their radius. `check` and `run` warn of a coupled scene with a radius above 0.9.
",
        100.0 * second(default) / second(undamped),
        digits(second(default)),
        digits(second(Radius::Reference)),
        force(undamped),
        force(default),
        swing(default),
        swing(undamped),
        swing(Radius::Given(0.2)),
        swing(Radius::Given(0.0)),
    )
}

fn percent(error: Option<f64>) -> String {
    error.map_or_else(|| "?".to_owned(), |error| digits(100.0 * error))
}

/// Of the flag of CSM3, which swings at 1.1 Hz.
const STEPS_A_PERIOD: usize = 46;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_three_digits() {
        let shown = [83.91, 0.061_234, 8.7, 0.000_246, 0.0, 123.4].map(digits);
        assert_eq!(shown, ["83.9", "0.0612", "8.70", "0.000246", "0", "123"]);
    }
}
