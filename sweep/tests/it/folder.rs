//! The folder of a sweep: killed half-way, shared, changed, with files of others in it.

use std::fs::{self, File};
use std::num::NonZeroUsize;
use std::sync::Barrier;
use std::sync::atomic::AtomicBool;
use std::thread;

use partita_sweep::folder::{CELLS, DIAGRAM, MAP as MAP_FILE, PICTURE, ROWS, RUNS};
use partita_sweep::{Order, State, Sweep, SweepError, Threads};

use crate::support::{Case, MAP, SOUND, entries, execute, execute_unless};

/// The table of a map that nobody has interrupted.
fn whole_table() -> String {
    let case = Case::new(MAP);
    execute(&case.load(), &case.dir(), 1).expect("it runs");
    case.load().collect(&case.dir()).expect("results");
    case.read(CELLS)
}

/// Marks the results that are there; those that are made again lose the mark.
fn mark(case: &Case, sweep: &Sweep) -> usize {
    let mut marked = 0;
    for run in sweep.runs() {
        let path = case.result_file(sweep, run.index);
        let Ok(text) = fs::read_to_string(&path) else { continue };
        let label = format!("\"run\":\"{}\"", run.label());
        assert!(text.contains(&label), "{text}");
        fs::write(path, text.replace(&label, "\"run\":\"kept\"")).expect("a marked result");
        marked += 1;
    }
    marked
}

fn is_marked(case: &Case, sweep: &Sweep, index: usize) -> bool {
    fs::read_to_string(case.result_file(sweep, index)).is_ok_and(|text| text.contains("\"run\":\"kept\""))
}

fn marked(case: &Case, sweep: &Sweep) -> Vec<usize> {
    (0..sweep.runs().len()).filter(|&index| is_marked(case, sweep, index)).collect()
}

#[test]
fn one_run_fails_by_design_and_the_others_do_not_mind() {
    let case = Case::new(MAP);
    let (sweep, dir) = (case.load(), case.dir());
    execute(&sweep, &dir, 2).expect("it runs");
    let collected = sweep.collect(&dir).expect("results");
    let troubles = collected.troubles();
    assert_eq!(collected.failed.iter().map(|run| run.index).collect::<Vec<_>>(), [6], "{troubles}");
    assert!(troubles.contains("run 6 (full Newton, 1000, 10000): step 1 (t = 1 s)"), "{troubles}");
    assert!(collected.unfinished.is_empty());
    assert_eq!(entries(&dir), [CELLS, PICTURE, MAP_FILE, RUNS]);
    let states = sweep.states(&dir).expect("its folder");
    assert_eq!(states.iter().filter(|state| **state == State::Finished).count(), 8);
    assert_eq!(states[6], State::Failed);
}

#[test]
fn the_order_in_which_runs_end_is_in_no_table() {
    let whole = whole_table();
    for jobs in [2, 5] {
        let case = Case::new(MAP);
        execute(&case.load(), &case.dir(), jobs).expect("it runs");
        case.load().collect(&case.dir()).expect("results");
        assert_eq!(case.read(CELLS), whole);
    }
}

#[test]
fn a_sweep_that_was_killed_goes_on_with_what_is_missing() {
    let case = Case::new(MAP);
    let (sweep, dir) = (case.load(), case.dir());
    execute(&sweep, &dir, 1).expect("it runs");
    case.forget(&sweep, 4..9);
    assert_eq!(mark(&case, &sweep), 4);
    let collected = sweep.collect(&dir).expect("some results");
    assert_eq!(collected.unfinished.len(), 5);
    assert!(collected.troubles().contains("run 4 (full Newton, 10, 100000): not finished\n"));
    assert!(!dir.join(PICTURE).exists(), "there is no picture of half a map");
    // What a kill in the middle of a write leaves, and a result that a file system shows in part.
    let half = case.result_file(&sweep, 1);
    let text = fs::read_to_string(&half).expect("a result");
    fs::write(&half, &text[..text.len() / 2]).expect("half a result");
    fs::write(dir.join(".cells.csv.1.part"), "half").expect("half a table");
    let work = case.result_file(&sweep, 5).with_extension("");
    fs::create_dir(&work).expect("a run in progress");
    fs::write(work.join("result.json"), "{\"fing").expect("half a result");
    fs::write(work.join("checkpoint.bin"), "no checkpoint").expect("half a checkpoint");
    fs::write(work.join("lock"), "").expect("a lock of a process that is dead");
    execute(&sweep, &dir, 2).expect("it goes on");
    assert_eq!(marked(&case, &sweep), [0, 2, 3]);
    sweep.collect(&dir).expect("results");
    assert_eq!(case.read(CELLS), whole_table());
    assert!(
        entries(&dir.join(RUNS)).iter().all(|name| name.strip_suffix(".json").is_some() || name == "lock")
    );
}

#[test]
fn who_is_told_to_stop_says_so_and_begins_no_further_run() {
    let case = Case::new(MAP);
    let executed = execute_unless(&case.load(), &case.dir(), 2, &AtomicBool::new(true)).expect("it stops");
    assert!(executed.interrupted);
    assert_eq!(case.load().collect(&case.dir()).expect("no results").unfinished.len(), 9);
}

/// A file system that lags shows a result late, or not in its listing: the run is made again, with the same result.
#[test]
fn a_result_that_is_not_seen_is_not_there_yet() {
    let case = Case::new(MAP);
    let (sweep, dir) = (case.load(), case.dir());
    execute(&sweep, &dir, 1).expect("it runs");
    let path = case.result_file(&sweep, 3);
    let (away, seen) = (path.with_extension("away"), fs::read(&path).expect("a result"));
    fs::rename(&path, &away).expect("it is not seen");
    assert_eq!(sweep.states(&dir).expect("its folder")[3], State::Missing);
    assert_eq!(sweep.collect(&dir).expect("the others").unfinished.len(), 1);
    fs::remove_file(away).expect("a file");
    execute(&sweep, &dir, 1).expect("it runs");
    assert_eq!(fs::read(&path).expect("a result"), seen);
}

#[test]
fn two_at_once_share_the_runs_of_one_folder() {
    let case = Case::new(MAP);
    let (sweep, dir, start) = (case.load(), case.dir(), Barrier::new(2));
    let work = || {
        start.wait();
        execute(&sweep, &dir, 2).expect("the folder is shared")
    };
    thread::scope(|scope| {
        let [one, other] = [scope.spawn(work), scope.spawn(work)];
        for thread in [one, other] {
            assert!(!thread.join().expect("no panic").interrupted);
        }
    });
    assert!(sweep.collect(&dir).expect("results").unfinished.is_empty());
    assert_eq!(case.read(CELLS), whole_table());
}

/// A lock that is held says that somebody makes the run; nobody else does then.
#[test]
fn a_run_that_another_process_has_taken_on_is_left_to_it() {
    let case = Case::new(MAP);
    let (sweep, dir) = (case.load(), case.dir());
    let work = case.result_file(&sweep, 2).with_extension("");
    fs::create_dir_all(&work).expect("a run in progress");
    let lock = File::create(work.join("lock")).expect("a lock");
    lock.lock().expect("it is ours");
    let executed = execute(&sweep, &dir, 2).expect("the others are made");
    assert_eq!((executed.elsewhere, executed.interrupted), (1, false));
    let collected = sweep.collect(&dir).expect("results");
    assert!(collected.troubles().contains("run 2 (full Newton, 1, 1000000): not finished: it is running\n"));
    drop(lock);
    execute(&sweep, &dir, 1).expect("it is free");
    sweep.collect(&dir).expect("results");
    assert_eq!(case.read(CELLS), whole_table());
}

#[test]
fn who_measures_times_or_replaces_results_works_alone() {
    let case = Case::new(SOUND);
    let (sweep, dir) = (case.load(), case.dir());
    execute(&sweep, &dir, 2).expect("it runs");
    case.forget(&sweep, [3]);
    let lock = File::open(dir.join(RUNS).join("lock")).expect("the lock of the folder");
    lock.lock_shared().expect("somebody works here");
    let in_use = |outcome| matches!(outcome, Err(SweepError::InUse { .. }));
    assert!(in_use(execute(&sweep, &dir, 1)), "times would be those of two");
    let (stop, before) = (AtomicBool::new(false), entries(&dir.join(RUNS)));
    let order = Order { dir: &dir, force: true, only: None };
    let two = NonZeroUsize::new(2).expect("two");
    assert!(in_use(sweep.execute(order, &mut Threads::new(two, &stop), &mut ())));
    assert_eq!(entries(&dir.join(RUNS)), before);
    execute(&sweep, &dir, 2).expect("the folder is shared");
}

#[test]
fn only_runs_that_changed_are_made_again() {
    let case = Case::new(MAP);
    execute(&case.load(), &case.dir(), 1).expect("it runs");
    case.load().collect(&case.dir()).expect("results");
    mark(&case, &case.load());
    case.rewrite(&MAP.replace("values = [1, 10, 1000]", "values = [1, 50, 1000]"));
    let sweep = case.load();
    assert_eq!(sweep.states(&case.dir()).expect("its folder")[3..6], [State::Missing; 3]);
    execute(&sweep, &case.dir(), 1).expect("it runs");
    assert!(!case.dir().join(CELLS).exists(), "the table of the earlier file is gone");
    assert_eq!(marked(&case, &sweep), [0, 1, 2, 6, 7, 8]);
    sweep.collect(&case.dir()).expect("results");
    assert!(case.read(CELLS).contains("full Newton,50,") && case.read(MAP_FILE).contains("[1, 50, 1000]"));
}

#[test]
fn the_folder_of_another_sweep_is_not_taken() {
    let case = Case::new(MAP);
    execute(&case.load(), &case.dir(), 1).expect("it runs");
    let other = case.path().join("other.toml");
    fs::write(&other, MAP).expect("a map of another name");
    let other = Sweep::load(&other).expect("sound");
    let error = execute(&other, &case.dir(), 1).expect_err("it is another's");
    assert!(error.to_string().contains("the map `bending`, not of the map `other`"), "{error}");
    case.rewrite(SOUND);
    let error = execute(&case.load(), &case.dir(), 1).expect_err("it is a map's");
    assert!(error.to_string().contains("the map `bending`, not of the study `bending`"), "{error}");
}

fn force(case: &Case) -> Result<(), SweepError> {
    let stop = AtomicBool::new(false);
    let mut threads = Threads::new(NonZeroUsize::MIN, &stop);
    let order = Order { dir: &case.dir(), force: true, only: None };
    case.load().execute(order, &mut threads, &mut ()).map(drop)
}

#[test]
fn force_replaces_what_a_sweep_has_left_and_removes_no_other_file() {
    let case = Case::new(MAP);
    execute(&case.load(), &case.dir(), 1).expect("it runs");
    let sweep = case.load();
    sweep.collect(&case.dir()).expect("results");
    mark(&case, &sweep);
    for place in ["thesis.txt", "runs/thesis.txt"] {
        let thesis = case.dir().join(place);
        fs::write(&thesis, "mine").expect("a file");
        let before = (entries(&case.dir()), entries(&case.dir().join(RUNS)));
        let error = force(&case).expect_err("it is in the way");
        assert!(matches!(&error, SweepError::Foreign { path } if path.ends_with(place)), "{error}");
        assert_eq!((entries(&case.dir()), entries(&case.dir().join(RUNS))), before);
        // Without it nothing is removed, so that nothing is in the way.
        execute(&sweep, &case.dir(), 1).expect("there is nothing to do");
        fs::remove_file(&thesis).expect("a file");
    }
    assert_eq!(marked(&case, &sweep).len(), 9);
    // What earlier versions have left is a sweep's, too.
    fs::write(case.dir().join("cells.jsonl"), "{}\n").expect("an earlier journal");
    force(&case).expect("it is replaced");
    assert_eq!(marked(&case, &sweep), [0; 0]);
    assert_eq!(entries(&case.dir()), [MAP_FILE, RUNS]);
    // A study takes the place of a map.
    case.rewrite(SOUND);
    force(&case).expect("it is replaced");
    case.load().collect(&case.dir()).expect("results");
    assert_eq!(entries(&case.dir()), [RUNS, ROWS, DIAGRAM, "study.toml"]);
}

#[test]
fn a_folder_with_something_else_in_it_is_no_place_for_a_sweep() {
    let case = Case::new(MAP);
    fs::create_dir(case.dir()).expect("a folder");
    fs::write(case.dir().join("thesis.txt"), "mine").expect("a file");
    let error = execute(&case.load(), &case.dir(), 1).expect_err("it is not empty");
    assert!(matches!(error, SweepError::Occupied { .. }), "{error}");
    assert_eq!(entries(&case.dir()), ["thesis.txt"]);
    let nowhere = case.load().collect(&case.path().join("nowhere")).expect_err("nothing is there");
    assert!(matches!(nowhere, SweepError::Nothing { .. }), "{nowhere}");
}
