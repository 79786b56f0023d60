//! Long runs that are cut off go on from their checkpoint, with the same bits.

use std::fs;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

use partita::checkpoint::{LATEST, PREVIOUS};
use partita_sweep::result::RunResult;
use partita_sweep::{CHECKPOINT_WORK, Order, State, Sweep, Threads};
use tempfile::TempDir;

/// A tank whose bottom moves: both fields, a quasi-Newton method with a history, thirty steps. A map and a study of it.
const MAP: &str = r#"title = "A tank"
scene = "SCENE"
steps = 30
set = ["fluid.mesh.rectangle.divisions=[4, 4]", "structure.geometry.rectangle.elements=[8, 1]"]

[[parameter]]
name = "density_ratio"
values = [1]
set = ["structure.density=$(1000/x)"]

[[parameter]]
name = "dt"
values = [1e-2]
set = ["time.step=$(x)"]

[[choice]]
name = "IQN-IMVLS"
set = ["coupling.acceleration=iqn_imvls"]
"#;

const STUDY: &str = r#"title = "A tank"
scene = "SCENE"
set = ["fluid.mesh.rectangle.divisions=[4, 4]", "structure.geometry.rectangle.elements=[8, 1]", "time.steps=30"]

[quantity]
name = "deflection"
column = "middle_displacement_y"
take = "history"

[reference]
set = []

[[choice]]
name = "BDF2"
set = ["fluid.time_scheme=bdf2"]
refinements = [{ name = "dt = 0.01 s", set = [] }]
"#;

fn sweep(text: &str) -> (TempDir, Sweep) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes/elastic-bottom");
    let file = folder.path().join("tank.toml");
    fs::write(&file, text.replace("SCENE", &scene.display().to_string())).expect("a sweep");
    let sweep = Sweep::load(&file).expect("sound");
    (folder, sweep)
}

fn make(sweep: &Sweep, dir: &Path, index: usize, stop: &AtomicBool, checkpoint_work: u64) {
    let mut threads = Threads { checkpoint_work, timed: false, ..Threads::new(NonZeroUsize::MIN, stop) };
    let order = Order { dir, force: false, only: Some((index, None)) };
    sweep.execute(order, &mut threads, &mut ()).expect("the folder takes it");
}

fn result(sweep: &Sweep, dir: &Path, index: usize) -> RunResult {
    let path = dir.join("runs").join(format!("{}.json", sweep.runs()[index].fingerprint));
    serde_json::from_str(&fs::read_to_string(path).expect("a result")).expect("whole")
}

/// A run with a checkpoint at every step, cut off somewhere in the middle; returns its working folder.
fn cut_off(sweep: &Sweep, dir: &Path, index: usize) -> PathBuf {
    let (stop, work) = (AtomicBool::new(false), dir.join("runs").join(&sweep.runs()[index].fingerprint));
    thread::scope(|scope| {
        scope.spawn(|| make(sweep, dir, index, &stop, 1));
        while !work.join(PREVIOUS).exists() {
            thread::sleep(Duration::from_millis(1));
        }
        stop.store(true, Ordering::Relaxed);
    });
    assert_eq!(sweep.states(dir).expect("its folder")[index], State::Interrupted);
    work
}

#[test]
fn a_run_that_was_cut_off_ends_with_the_same_bits() {
    for text in [MAP, STUDY] {
        let (folder, sweep) = sweep(text);
        let [whole, cut] = ["whole", "cut"].map(|name| folder.path().join(name));
        let index = sweep.runs().len() - 1;
        make(&sweep, &whole, index, &AtomicBool::new(false), CHECKPOINT_WORK);
        let expected = result(&sweep, &whole, index);
        assert_eq!((expected.failure.as_ref(), expected.counts.steps), (None, 30));
        let work = cut_off(&sweep, &cut, index);
        make(&sweep, &cut, index, &AtomicBool::new(false), CHECKPOINT_WORK);
        assert_eq!(result(&sweep, &cut, index), expected);
        assert!(!work.exists(), "what was needed to get there is removed");
    }
}

/// A kill leaves an older checkpoint, and may leave half of the next one.
#[test]
fn a_run_that_was_killed_goes_on_from_the_checkpoint_before() {
    let (folder, sweep) = sweep(MAP);
    let [whole, cut] = ["whole", "cut"].map(|name| folder.path().join(name));
    make(&sweep, &whole, 0, &AtomicBool::new(false), CHECKPOINT_WORK);
    let work = cut_off(&sweep, &cut, 0);
    let bytes = fs::read(work.join(LATEST)).expect("a checkpoint");
    fs::write(work.join(LATEST), &bytes[..bytes.len() / 2]).expect("half a checkpoint");
    make(&sweep, &cut, 0, &AtomicBool::new(false), CHECKPOINT_WORK);
    assert_eq!(result(&sweep, &cut, 0), result(&sweep, &whole, 0));
}

#[test]
fn checkpoints_that_are_of_no_use_are_as_good_as_none() {
    let (folder, sweep) = sweep(MAP);
    let [whole, cut] = ["whole", "cut"].map(|name| folder.path().join(name));
    make(&sweep, &whole, 0, &AtomicBool::new(false), CHECKPOINT_WORK);
    let work = cut_off(&sweep, &cut, 0);
    for name in [LATEST, PREVIOUS] {
        fs::write(work.join(name), "something else").expect("no checkpoint");
    }
    make(&sweep, &cut, 0, &AtomicBool::new(false), CHECKPOINT_WORK);
    assert_eq!(result(&sweep, &cut, 0), result(&sweep, &whole, 0));
}
