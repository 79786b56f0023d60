//! Maps: one scene over two parameters and some choices, each cell a run of a few dozen steps, its outcome as data.
//!
//! ```toml
//! title = "Tank: added mass against step size"
//! scene = "../scenes/elastic-bottom"      # beside the map
//! steps = 30
//! set = ["fluid.tangent=full"]            # for all cells, as with --set
//!
//! [[parameter]]                           # the rows
//! name = "density_ratio"                  # a column of the table
//! label = "rho_f / rho_s"
//! values = [0.01, 1, 100]                 # numbers, or words
//! set = ["structure.density=$(1000/x)"]   # a formula of the value stands in $(...)
//!
//! [[parameter]]                           # the columns
//! name = "dt"
//! values = [1e-2, 1e-3]
//! set = ["time.step=$(x)"]
//!
//! [[choice]]
//! name = "IQN-IMVLS"
//! set = ["coupling.acceleration=iqn_imvls"]
//! ```
//!
//! Two more keys hold a cell in check: `newton_budget`, the Newton iterations it may take (20 000), and
//! `largest_energy_growth`, above which it is not called converged (100). Both count work, not time, so that the table is
//! the same on every machine and for any number of jobs. A cell ends at its first step that fails; the table then says
//! where, why, and what to change.

mod cell;
pub mod measure;
mod picture;
mod read;
mod row;
mod store;
mod template;

use std::path::Path;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc;
use std::thread;

pub use read::{Axis, Cell, Map};
pub use row::{Outcome, Row, to_csv};
use store::Store;
pub use store::{JOURNAL, MAP, PICTURE, StoreError, TABLE};

use partita::watch::Watcher;

/// How a map is carried out; nothing here changes its numbers.
#[derive(Debug, Clone, Copy)]
pub struct Options<'a> {
    /// Cells run at a time.
    pub jobs: usize,
    /// Forget the cells that are finished.
    pub fresh: bool,
    /// Set from outside to give up the cells in progress.
    pub stop: &'a AtomicBool,
}

/// What a map came to.
#[derive(Debug)]
pub enum Ending {
    /// All cells are finished: their rows, in the map's order.
    Finished(Vec<Row>),
    /// It was interrupted with so many cells finished.
    Interrupted(usize),
}

/// Stack of a thread that runs cells, like that of a program's first one.
const STACK: usize = 8 << 20;

/// Runs the cells of `map` that the folder `dir` does not hold yet, and writes table and picture.
///
/// # Errors
/// When the folder holds something else or cannot be written. Finished cells are kept.
///
/// # Panics
/// When the system gives no thread.
pub fn run(
    map: &Map,
    dir: &Path,
    options: Options<'_>,
    watcher: &mut dyn Watcher,
) -> Result<Ending, StoreError> {
    let mut store = Store::open(dir, map, checksum(map), options.fresh)?;
    let open: Vec<usize> = (0..map.cells.len()).filter(|cell| !store.rows.contains_key(cell)).collect();
    watcher.begins(map.cells.len(), store.rows.len());
    let next = AtomicUsize::new(0);
    let (sender, receiver) = mpsc::channel();
    let kept = thread::scope(|scope| {
        for _ in 0..options.jobs.min(open.len()) {
            let (sender, next, open) = (sender.clone(), &next, &open);
            let work = move || {
                while let Some(&cell) = open.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let Some(row) = cell::run(map, &map.cells[cell], options.stop) else { break };
                    if sender.send((cell, row)).is_err() {
                        break;
                    }
                }
            };
            thread::Builder::new()
                .stack_size(STACK)
                .spawn_scoped(scope, work)
                .expect("the system gives a thread");
        }
        drop(sender);
        receiver.into_iter().try_for_each(|(cell, row)| {
            store.keep(cell, row)?;
            watcher.reaches(store.rows.len());
            Ok(())
        })
    });
    watcher.ends();
    kept?;
    if store.rows.len() < map.cells.len() {
        return Ok(Ending::Interrupted(store.rows.len()));
    }
    let rows: Vec<Row> = store.rows.values().cloned().collect();
    store.put(TABLE, &to_csv(map, &rows))?;
    store.put(PICTURE, &picture::draw(map, &rows))?;
    Ok(Ending::Finished(rows))
}

/// Of the map and of every scene it makes, files included: cells of another one are not taken up.
fn checksum(map: &Map) -> u32 {
    let mut hasher = crc32fast::Hasher::new();
    hasher.update(env!("CARGO_PKG_VERSION").as_bytes());
    hasher.update(map.text.as_bytes());
    for cell in &map.cells {
        let Ok(resolved) = partita_scene::load(&cell.scene, &cell.overrides) else { continue };
        hasher.update(resolved.to_toml().as_bytes());
        for input in &resolved.shapes.inputs {
            hasher.update(&input.bytes);
        }
    }
    hasher.finalize()
}

/// One line a choice: how many cells converged, and what they cost.
#[must_use]
pub fn summary(map: &Map, rows: &[Row]) -> String {
    let line = |(choice, name): (usize, &String)| {
        let cells: Vec<&Row> = map
            .cells
            .iter()
            .zip(rows)
            .filter(|(cell, _)| cell.choice == choice)
            .map(|(_, row)| row)
            .collect();
        let converged = || cells.iter().filter(|row| row.outcome == Outcome::Converged);
        let most = converged().filter_map(|row| row.max_iterations()).max().unwrap_or(0);
        let others = Outcome::ALL.into_iter().filter(|outcome| *outcome != Outcome::Converged);
        let others = others.filter_map(|outcome| {
            let count = cells.iter().filter(|row| row.outcome == outcome).count();
            (count > 0).then(|| format!(", {count} {}", outcome.word()))
        });
        format!(
            "{name}: {} of {} cells converged, at most {most} iterations a step{}\n",
            converged().count(),
            cells.len(),
            others.collect::<String>()
        )
    };
    map.choices.iter().enumerate().map(line).collect()
}
