//! Studies: what is measured, and what is left in the folder.

use insta::assert_snapshot;
use partita_sweep::folder::{DIAGRAM, ROWS, RUNS, STUDY};
use partita_sweep::study::Report;
use partita_sweep::{Kind, SweepError};

use crate::support::{Case, SOUND, entries, execute, report, without_times};

/// The rows without the time.
fn errors(report: &Report) -> String {
    let line = |row: &partita_sweep::study::Row| {
        let numbers = row.outcome.as_ref().expect("it ran");
        format!("{}, {}: {:.2e}, {} unknowns\n", row.choice, row.refinement, numbers.error, numbers.unknowns)
    };
    report.rows.iter().map(line).collect()
}

#[test]
fn a_study_measures_every_refinement_of_every_choice() {
    let case = Case::new(SOUND);
    let (sweep, dir) = (case.load(), case.dir());
    execute(&sweep, &dir, 1).expect("it runs");
    let report = report(&sweep, &dir);
    assert_snapshot!(errors(&report), @r#"
    degree 2, 2 elements: 1.69e-1, 18 unknowns
    degree 2, 4 elements: 1.95e-2, 30 unknowns
    degree 2, 8 elements: 1.32e-3, 54 unknowns
    degree 3, 2 elements: 1.36e-2, 24 unknowns
    degree 3, 4 elements: 3.76e-4, 36 unknowns
    degree 3, 8 elements: 2.38e-5, 60 unknowns
    "#);
    assert!(!report.interrupted);
    assert_eq!(entries(&dir), [RUNS, ROWS, DIAGRAM, STUDY]);
    assert_eq!(case.read(STUDY), SOUND);
    let rows = case.read(ROWS);
    assert!(rows.starts_with("study,setting,error,cpu_seconds,"), "{rows}");
    assert!(rows.contains("\nbending,\"degree 3, 4 elements\","), "{rows}");
    assert_eq!(rows.lines().count(), 7);
    for row in &report.rows {
        assert!(row.outcome.as_ref().expect("it ran").cpu_seconds > Some(0.0), "{row:?}");
    }
    let picture = case.read(DIAGRAM);
    assert!(picture.contains("CPU time [s]") && picture.contains("degree 3"));
    assert!(picture.contains("relative error of the deflection of the tip"));
    let answer = report.answer();
    assert!(answer.contains("cheapest setting that reaches 1e-4: degree "), "{answer}");
}

/// A slender cantilever of Poisson ratio 0 under a uniform load that bends it little: q L^4 / (8 E I), q = 0.2 h,
/// I = h^3 / 12. What shear adds is of the order (h / L)^2.
#[test]
fn a_value_is_a_reference_too_and_its_uncertainty_is_in_the_unit_of_the_error() {
    let start = SOUND.find("[reference]").expect("a reference");
    let end = SOUND.find("[[choice]]").expect("a choice");
    let set = r#"set = [
    "structure.body_force=[0.0, -0.2]",
    "structure.geometry.rectangle.size=[1.0, 0.05]",
    "structure.newton.tolerance.relative=1e-8",
]"#;
    let head = SOUND[..start].replace("wanted = 1e-4", set);
    let reference = "[reference]\nvalue = -1.2e-4\nuncertainty = 6e-7\n\n";
    let case = Case::new(&format!("{head}{reference}{}", &SOUND[end..]));
    let sweep = case.load();
    execute(&sweep, &case.dir(), 2).expect("it runs");
    let report = report(&sweep, &case.dir());
    let error = report.rows.last().expect("six rows").outcome.as_ref().expect("it ran").error;
    assert!((report.uncertainty - 5e-3).abs() < 1e-12, "{}", report.uncertainty);
    assert!(error < 5e-3, "{error}");
}

#[test]
fn an_interrupted_study_keeps_what_it_has_measured() {
    let case = Case::new(SOUND);
    let (sweep, dir) = (case.load(), case.dir());
    execute(&sweep, &dir, 1).expect("it runs");
    // The reference and two settings are left.
    case.forget(&sweep, 3..7);
    let report = report(&sweep, &dir);
    assert!(report.interrupted);
    assert_eq!(report.rows.len(), 2);
    assert_eq!(case.read(ROWS).lines().count(), 3);
    assert_eq!(entries(&dir), [RUNS, ROWS, DIAGRAM, STUDY]);
    assert!(report.answer().contains("so far"), "{}", report.answer());
}

#[test]
fn a_setting_that_fails_is_a_row_that_says_so() {
    let case = Case::new(&SOUND.replace(
        "set = [\"structure.geometry.rectangle.degree=[3, 2]\"]",
        "set = [\"structure.newton.max_iterations=1\"]",
    ));
    let (sweep, dir) = (case.load(), case.dir());
    execute(&sweep, &dir, 2).expect("it runs");
    let report = report(&sweep, &dir);
    let failures: Vec<bool> = report.rows.iter().map(|row| row.outcome.is_err()).collect();
    assert_eq!(failures, [false, false, false, true, true, true]);
    let rows = case.read(ROWS);
    let failed = rows.lines().last().expect("a row");
    assert!(failed.starts_with("bending,\"degree 3, 8 elements\",,,degree 3,8 elements,,"), "{failed}");
    assert!(failed.contains("step 1 (t = 1 s)"), "{failed}");
    let collected = sweep.collect(&dir).expect("results");
    let troubles = collected.troubles();
    assert_eq!((collected.failed.len(), collected.unfinished.len()), (3, 0), "{troubles}");
    assert!(troubles.starts_with("run 4 (degree 3, 2 elements): step 1 (t = 1 s)"), "{troubles}");
}

#[test]
fn a_reference_that_fails_stops_the_study_and_leaves_nothing_behind() {
    let broken = "[reference]\nset = [\"structure.newton.max_iterations=1\", ";
    let case = Case::new(&SOUND.replace("[reference]\nset = [", broken));
    let sweep = case.load();
    let error = execute(&sweep, &case.dir(), 1).expect_err("there is nothing to measure against");
    assert!(matches!(error, SweepError::Reference { .. }), "{error}");
    assert!(error.to_string().starts_with("the reference run: step 1"), "{error}");
    assert!(!case.dir().exists());
}

/// Where several runs share the machine no time is that of one run: the column stays empty, and work stands for it.
#[test]
fn times_are_measured_only_where_nothing_else_runs() {
    let case = Case::new(SOUND);
    let (sweep, dir) = (case.load(), case.dir());
    execute(&sweep, &dir, 2).expect("it runs");
    let found = report(&sweep, &dir);
    assert!(found.rows.iter().all(|row| row.outcome.as_ref().expect("it ran").cpu_seconds.is_none()));
    assert!(case.read(ROWS).contains("\nbending,\"degree 2, 2 elements\",0.16"), "{}", case.read(ROWS));
    assert!(case.read(DIAGRAM).contains("unknowns times Newton iterations"));
    assert!(
        found.table().to_plain().contains("unknowns solved for") && found.answer().contains("times the work")
    );
    let timed = Case::new(SOUND);
    execute(&timed.load(), &timed.dir(), 1).expect("it runs");
    report(&timed.load(), &timed.dir());
    assert_eq!(without_times(&case.read(ROWS)), without_times(&timed.read(ROWS)));
    assert_ne!(case.read(ROWS), timed.read(ROWS));
}

/// Errors are made of what the runs have kept.
#[test]
fn another_quantity_or_wanted_error_runs_nothing_again() {
    let case = Case::new(SOUND);
    execute(&case.load(), &case.dir(), 2).expect("it runs");
    let absolute = SOUND.replace("take = \"last\"", "take = \"min\"\nerror = \"absolute\"");
    case.rewrite(&absolute.replace("wanted = 1e-4", "wanted = 1e-9"));
    let mut sweep = case.load();
    if let Kind::Study(study) = &mut sweep.kind {
        study.ask_for(None);
    }
    let found = report(&sweep, &case.dir());
    assert!(!found.interrupted && found.answer().contains("no setting reaches 1e-9"), "{}", found.answer());
}
