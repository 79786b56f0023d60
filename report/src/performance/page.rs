//! `docs/performance.md`, from the data alone.

use std::collections::BTreeSet;

use super::Data;
use super::fit::exponent;
use crate::markdown::{prose_table, table};
use crate::task::TaskError;

/// One time.
#[derive(Debug, Clone, PartialEq)]
struct Time {
    part: String,
    dofs: usize,
    threads: usize,
    milliseconds: f64,
    ratio: Option<f64>,
}

/// What a page is made of.
struct Numbers {
    times: Vec<Time>,
}

const PARTS: [&str; 5] = ["assembly", "analysis", "refactor", "solve", "newton iteration"];

/// Triangles of the tank's mesh for each unknown: two nodes of three unknowns for every four triangles.
const TRIANGLES: f64 = 4.0 / 6.0;

pub(super) fn text(data: &Data) -> Result<String, TaskError> {
    let numbers = Numbers::read(data)?;
    let mut text = HEAD.to_owned();
    text += &format!("Machine: {}. One thread, where no other number is given.\n", data.machine.trim());
    text += "\n## A Newton iteration of the fluid\n\n";
    text += ITERATION;
    text += &numbers.parts();
    text += "\n## Targets\n\n";
    text += &numbers.targets();
    text += "\n## Whole steps, and memory\n\n";
    text += STEPS;
    text += &numbers.steps(data)?;
    text += "\n";
    text += &numbers.scenes();
    text += SCENES;
    text += "\n## Two threads\n\n";
    text += THREADS;
    text += &numbers.threads();
    text += LIMITS;
    text += &numbers.assembly();
    text += GMRES;
    Ok(text)
}

impl Numbers {
    fn read(data: &Data) -> Result<Self, TaskError> {
        let time = |row: crate::csv::Row| {
            Ok(Time {
                part: row.text("part")?.to_owned(),
                dofs: row.value("dofs")?,
                threads: row.value("threads")?,
                milliseconds: row.value("milliseconds")?,
                ratio: row.optional("ratio_to_faer")?,
            })
        };
        Ok(Self { times: data.times.rows().map(time).collect::<Result<_, TaskError>>()? })
    }

    /// By one thread.
    fn of<'a>(&'a self, part: &'a str) -> impl Iterator<Item = &'a Time> {
        self.times.iter().filter(move |time| time.part == part && time.threads == 1)
    }

    /// By one thread.
    fn find(&self, part: &str, dofs: usize) -> Option<&Time> {
        self.times.iter().find(|time| time.part == part && time.dofs == dofs && time.threads == 1)
    }

    /// The measured size that is next to a number of unknowns, if it lies within a quarter of it.
    fn near(&self, dofs: usize) -> Option<usize> {
        let sizes = self.of("newton iteration").map(|time| time.dofs);
        let nearest = sizes.min_by_key(|size| size.abs_diff(dofs))?;
        (4 * nearest.abs_diff(dofs) <= dofs).then_some(nearest)
    }

    fn parts(&self) -> String {
        let sizes: BTreeSet<usize> = self.of("newton iteration").map(|time| time.dofs).collect();
        let mut header = vec!["unknowns".to_owned()];
        header.extend(sizes.iter().map(ToString::to_string));
        header.push("exponent".to_owned());
        let rows: Vec<Vec<String>> = PARTS
            .iter()
            .map(|part| {
                let mut row = vec![(*part).to_owned()];
                row.extend(sizes.iter().map(|&dofs| self.find(part, dofs).map_or_else(String::new, cell)));
                let costs: Vec<(usize, f64)> =
                    self.of(part).map(|time| (time.dofs, time.milliseconds)).collect();
                row.push(power(&costs));
                row
            })
            .collect();
        table(&header, &rows)
    }

    fn targets(&self) -> String {
        let mut rows = Vec::new();
        for (dofs, most) in [(675, 0.35), (30_000, 45.0), (300_000, 800.0)] {
            let size = self.near(dofs);
            let time = size.and_then(|size| self.find("newton iteration", size));
            let milliseconds = time.map(|time| time.milliseconds);
            let what = format!("Newton iteration of {dofs} unknowns");
            rows.push(target(what, &format!("at most {most} ms"), milliseconds, "ms", |time| time <= most));
        }
        for (dofs, least) in [(675, 2.5), (30_000, 4.0)] {
            let what = format!("refactor and solve of {dofs} unknowns against faer's LU");
            let ratio = self.near(dofs).and_then(|size| self.ratio(size));
            rows.push(target(what, &format!("at least {least} times faster"), ratio, "times", |ratio| {
                ratio >= least
            }));
        }
        if let Some(assembly) = self.near(30_000).and_then(|size| self.find("assembly", size)) {
            let nanoseconds = 1e6 * assembly.milliseconds / (TRIANGLES * assembly.dofs as f64);
            let what = "assembly of a triangle".to_owned();
            rows.push(target(what, "at most 300 ns", Some(nanoseconds), "ns", |time| time <= 300.0));
        }
        prose_table(&["what", "target", "measured", "met"], &rows)
    }

    /// What was measured with two threads, beside the same with one.
    fn threads(&self) -> String {
        let rows: Vec<Vec<String>> = self
            .times
            .iter()
            .filter(|time| time.threads == 2)
            .filter_map(|two| {
                let one = self.find(&two.part, two.dofs)?;
                let ratio = format!("{:.2}", one.milliseconds / two.milliseconds);
                let [one, two_threads] = [one, two].map(|time| digits(time.milliseconds));
                Some(vec![two.part.clone(), two.dofs.to_string(), one, two_threads, ratio])
            })
            .collect();
        if rows.is_empty() {
            return NO_THREADS.to_owned();
        }
        table(&["what", "unknowns", "one thread [ms]", "two threads [ms]", "times as fast"], &rows)
    }

    /// What a second thread could save of the assembly.
    fn assembly(&self) -> String {
        let largest = self.of("newton iteration").max_by_key(|time| time.dofs);
        let pair = largest.and_then(|whole| Some((self.find("assembly", whole.dofs)?, whole)));
        pair.map_or_else(String::new, |(assembly, whole)| {
            let percent = 100.0 * assembly.milliseconds / whole.milliseconds;
            format!(
                "* Assembly stays with one thread. It takes {} % of an iteration of {} unknowns by one thread; two would have to\n  \
                 keep the order of every sum, and could save half of that at most.\n",
                digits(percent),
                whole.dofs
            )
        })
    }

    /// Refactor and solve together.
    fn ratio(&self, dofs: usize) -> Option<f64> {
        let parts = [self.find("refactor", dofs)?, self.find("solve", dofs)?];
        let ours: f64 = parts.iter().map(|time| time.milliseconds).sum();
        let faer: f64 =
            parts.iter().map(|time| Some(time.ratio? * time.milliseconds)).sum::<Option<f64>>()?;
        Some(faer / ours)
    }

    fn steps(&self, data: &Data) -> Result<String, TaskError> {
        let mut rows = Vec::new();
        let mut costs = [Vec::new(), Vec::new(), Vec::new()];
        for row in data.memory.rows() {
            let dofs: usize = row.value("dofs")?;
            let time = self.find("fluid step", dofs).map(|time| time.milliseconds);
            let amounts = [time, row.optional("factor_megabytes")?, row.optional("peak_megabytes")?];
            let mut cells = vec![dofs.to_string()];
            for (amount, costs) in amounts.iter().zip(&mut costs) {
                cells.push(amount.map_or_else(String::new, digits));
                costs.extend(amount.map(|amount| (dofs, amount)));
            }
            rows.push(cells);
        }
        let mut last = vec!["exponent".to_owned()];
        last.extend(costs.iter().map(|costs| power(costs)));
        rows.push(last);
        Ok(table(&["unknowns", "step [ms]", "factor [MB]", "peak of the process [MB]"], &rows))
    }

    fn scenes(&self) -> String {
        let rows: Vec<Vec<String>> = self
            .times
            .iter()
            .filter_map(|time| {
                let scene = time.part.strip_prefix("step of ")?;
                let link = format!("[{scene}](../scenes/{scene}/README.md)");
                Some(vec![link, time.dofs.to_string(), digits(time.milliseconds)])
            })
            .collect();
        table(&["scene of the paper", "unknowns of both fields", "coupled step [ms]"], &rows)
    }
}

fn target(
    what: String,
    aim: &str,
    found: Option<f64>,
    unit: &str,
    is_met: impl Fn(f64) -> bool,
) -> Vec<String> {
    let measured =
        found.map_or_else(|| "not measured".to_owned(), |found| format!("{} {unit}", digits(found)));
    let verdict = found.map_or("", |found| if is_met(found) { "yes" } else { "no" });
    vec![what, aim.to_owned(), measured, verdict.to_owned()]
}

fn cell(time: &Time) -> String {
    let ratio = time.ratio.map_or_else(String::new, |ratio| format!(" ({ratio:.1}x)"));
    format!("{}{ratio}", digits(time.milliseconds))
}

fn power(costs: &[(usize, f64)]) -> String {
    exponent(costs).map_or_else(String::new, |exponent| format!("{exponent:.2}"))
}

/// Three significant digits.
fn digits(number: f64) -> String {
    format!("{number:.2e}").parse::<f64>().map_or_else(|_| number.to_string(), |rounded| rounded.to_string())
}

const HEAD: &str = "\
# Performance

<!-- Written by `cargo xtask performance` from docs/data/performance.csv, docs/data/memory.csv and
docs/data/performance-machine.txt. Do not edit. -->

How long a Newton iteration and a step take, how both grow with the size, and what they need of memory.
`cargo xtask performance` repeats all of it on an idle machine (`--largest 100000` leaves out what is larger).

";

const ITERATION: &str = "\
Milliseconds, medians of many repetitions, on the tank with a moving bottom. *Refactor* includes the trial by which a factor
proves itself; *analysis* is done once for a mesh. In brackets: how many times as long faer's LU takes in the same process, in
turns with ours (supernodal path forced, its ordering COLAMD; up to 100 000 unknowns). The exponent k of time = c n^k is fitted
to the sizes above 4000 unknowns.

";

const STEPS: &str = "\
The first time step of the fluid with a moving bottom: mesh motion, and Newton iterations to convergence. The factor is that of
the tangent, its numbers alone; the peak is that of a process that does nothing else, set-up included.

";

const SCENES: &str = "
Mean over the first steps of a run, set-up and output left out.
";

const THREADS: &str = "\
`partita run --threads 2` factors and solves the fluid's linear systems with two threads (in the library, the setting `threads`
of the fluid). No bit of any result depends on it: which thread eliminates which subtrees of the elimination tree is decided once
for a mesh, and every sum keeps the order of one thread. It is meant for more than 10 000 unknowns; up to there one thread does
it in any case. Assembly and mesh motion stay with one.

";

const NO_THREADS: &str = "\
Not measured yet on this machine: `cargo xtask performance` does so.
";

const LIMITS: &str = "
## What is left out

* The fronts at the top of the elimination tree wait until both threads are done with their subtrees, and are then eliminated
  by one. They could be cut into blocks of columns; that would be worth a tenth of a factorization at most, and hang on products
  that give the same bits however they are cut.
* More than two threads are possible and were not measured. Runs of a parameter study fill the cores without any.
";

const GMRES: &str = "\
* GMRES with a block ILU(0) is not built. In trials before the choice the direct solver won in two dimensions up to 300 000
  unknowns; in three, where its factors grow as n^(4/3), GMRES was six times faster at 32 000.
";

#[cfg(test)]
mod tests {
    use super::*;

    fn data() -> Data {
        let mut data = Data::new("A machine\n".to_owned());
        for row in [
            "assembly,601,1,0.08,",
            "refactor,601,1,0.1,5.000",
            "solve,601,1,0.01,2.000",
            "newton iteration,601,1,0.2,3.000",
            "assembly,29401,1,4,",
            "refactor,29401,1,20,4.000",
            "solve,29401,1,2,3.000",
            "newton iteration,29401,1,26,4.000",
            "newton iteration,99588,1,130,",
            "newton iteration,29401,2,20,",
            "newton iteration,99588,2,65,",
            "refactor,99588,2,60,",
            "fluid step,9984,1,50,",
            "fluid step,99588,1,500,",
            "step of elastic-bottom,1023,1,2.5,",
        ] {
            data.times.push(row.split(',').map(str::to_owned).collect());
        }
        for row in ["9984,10.0,60.0", "99588,200.0,"] {
            data.memory.push(row.split(',').map(str::to_owned).collect());
        }
        data
    }

    #[test]
    fn a_page_shows_times_ratios_and_growth() {
        let page = text(&data()).expect("a page");
        for line in [
            "| unknowns | 601 | 29401 | 99588 | exponent |",
            "| refactor | 0.1 (5.0x) | 20 (4.0x) |  |  |",
            "| newton iteration | 0.2 (3.0x) | 26 (4.0x) | 130 | 1.32 |",
            "| 9984 | 50 | 10 | 60 |",
            "| 99588 | 500 | 200 |  |",
            "| exponent | 1.00 | 1.30 |  |",
            "| [elastic-bottom](../scenes/elastic-bottom/README.md) | 1023 | 2.5 |",
        ] {
            assert!(page.contains(&format!("{line}\n")), "{line}\n{page}");
        }
    }

    #[test]
    fn two_threads_stand_beside_one_where_both_were_measured() {
        let mut data = data();
        let page = text(&data).expect("a page");
        assert!(page.contains("| newton iteration | 29401 | 26 | 20 | 1.30 |\n"), "{page}");
        assert!(page.contains("| newton iteration | 99588 | 130 | 65 | 2.00 |\n"), "{page}");
        assert!(!page.contains("| refactor | 99588 |") && !page.contains(NO_THREADS), "{page}");
        data.times = Data::new(String::new()).times;
        data.times.push("assembly,601,1,0.08,".split(',').map(str::to_owned).collect());
        assert!(text(&data).expect("a page").contains(NO_THREADS));
    }

    #[test]
    fn targets_are_judged_and_what_was_not_measured_is_not() {
        let page = text(&data()).expect("a page");
        for line in [
            "| Newton iteration of 675 unknowns | at most 0.35 ms | 0.2 ms | yes |",
            "| Newton iteration of 300000 unknowns | at most 800 ms | not measured |  |",
            "| refactor and solve of 30000 unknowns against faer's LU | at least 4 times faster | 3.91 times | no |",
            "| assembly of a triangle | at most 300 ns | 204 ns | yes |",
        ] {
            assert!(page.contains(&format!("{line}\n")), "{line}\n{page}");
        }
    }
}
