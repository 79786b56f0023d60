//! The output folder: what is in it, and that a resumed run writes the same bytes as one that was never stopped.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use partita::checkpoint::Stamp;
use partita::output::fields::{Series, Snapshot, Tessellation};
use partita::output::tables::{self, Rows, TableError};
use partita::output::{Clock, Ending, OutputError, RunWriter, Seconds, remove_run};
use partita_coupling::participant::{Change, Effort, NewtonLimit, PhaseTimes, WorkDetails};
use partita_coupling::record::{
    self, FieldRecord, FieldSeconds, IterationRecord, Record, StepHistory, StepRecord,
};
use partita_coupling::{Step, accelerate::Proposal};
use partita_mesh::vtu::Array;
use partita_testing::timeless;

const SCENE: &str = "title = \"two steps\"\n";
const DT: f64 = 0.01;

fn probes() -> Vec<String> {
    vec!["tip_x".to_owned(), "tip, y".to_owned()]
}

fn field(name: &str, limit: NewtonLimit, newton: usize, change: f64) -> FieldRecord {
    let effort = Effort {
        newton,
        assemblies: newton + 1,
        factorizations: newton,
        solves: newton + 4,
        entry_residual: 1.0 / 3.0,
        residual: 1e-11,
        changes: vec![Change::new("velocity", change), Change::new("pressure", change / 2.0)],
        details: WorkDetails { tangents: newton, mesh_solves: 1, ..WorkDetails::default() },
        ..Effort::default()
    };
    FieldRecord::new(name, limit, effort)
}

/// The records of a step of `count` iterations; `speed` scales all times.
fn history(step: usize, count: usize, speed: f64) -> StepHistory {
    let step = Step { index: step, time: DT * step as f64, dt: DT };
    let iteration = |iteration: usize| {
        let phases = PhaseTimes { assembly: 0.125, factorization: 0.0625, solve: 0.03125, mesh_motion: 0.25 };
        let phases = PhaseTimes { mesh_motion: phases.mesh_motion * speed, ..phases };
        IterationRecord {
            step: step.index,
            iteration,
            residual: 0.1 / iteration as f64,
            relative_residual: if iteration == 1 { f64::INFINITY } else { 1e-3 },
            work_defect: 1e-16,
            fields: [
                field("fluid", NewtonLimit::AtMost(2), 2, 1e-3),
                field("structure", NewtonLimit::ToConvergence, iteration % 2, 1e-6),
            ],
            acceleration: (iteration < count).then(|| Proposal::relaxation(0.1)),
            seconds: record::Seconds {
                fields: [
                    FieldSeconds { total: 1.0 * speed, phases },
                    FieldSeconds { total: 0.5 * speed, phases: PhaseTimes::default() },
                ],
                transfer: 0.125 * speed,
                acceleration: 0.0625 * speed,
            },
        }
    };
    StepHistory { step, iterations: (1..=count).map(iteration).collect() }
}

/// Writes the steps of a run; step n takes n iterations.
fn write_steps(writer: &mut RunWriter, steps: impl IntoIterator<Item = usize>, speed: f64) {
    let drawing = Tessellation::new([&[0.0, 1.0], &[0.0, 1.0]], 1);
    for step in steps {
        let history = history(step, step, speed);
        let record = StepRecord::new(&history, true, &[]);
        history.iterations.iter().for_each(|iteration| writer.iteration(iteration).expect("written"));
        writer.step(&record).expect("written");
        writer.probes(step, record.time, &[0.1 * step as f64, -0.0]).expect("written");
        let values = [step as f64; 8];
        let displacement = Array { name: "displacement [m]", components: 2, values: &values };
        let snapshot = Snapshot {
            points: drawing.parameters(),
            cells: drawing.cells(),
            point_data: &[displacement],
            cell_data: &[],
        };
        writer.fields(Series::Fluid, step, record.time, &snapshot).expect("written");
        if step % 2 == 0 {
            writer.fields(Series::Structure, step, record.time, &snapshot).expect("written");
        }
    }
}

fn create(dir: &Path) -> RunWriter {
    RunWriter::create(dir, SCENE, &probes(), Clock::start()).expect("an empty folder")
}

/// Every file below `dir` but the summary, with the times of records and tables taken out.
fn without_times(dir: &Path) -> BTreeMap<String, String> {
    let mut files = BTreeMap::new();
    for folder in [dir.to_owned(), dir.join("fields")] {
        for entry in fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path()) {
            let name = entry.strip_prefix(dir).expect("inside").to_string_lossy().replace('\\', "/");
            if entry.is_file() && name != "summary.json" {
                files.insert(name, timeless::file(&entry));
            }
        }
    }
    files
}

#[test]
fn the_folder_holds_every_record_once() {
    let dir = tempfile::tempdir().expect("a temporary folder");
    let mut writer = create(dir.path());
    write_steps(&mut writer, 1..=3, 1.0);
    writer.finish(Ending::Completed).expect("written");

    let text = fs::read_to_string(dir.path().join("run.jsonl")).expect("records");
    let records: Vec<Record> =
        text.lines().map(|line| serde_json::from_str(line).expect("a record")).collect();
    let expected: Vec<Record> = (1..=3)
        .flat_map(|step| {
            let history = history(step, step, 1.0);
            let last = Record::Step(StepRecord::new(&history, true, &[]));
            history.iterations.into_iter().map(Record::Iteration).chain([last])
        })
        .collect();
    assert_eq!(records, expected);
    assert_eq!(fs::read_to_string(dir.path().join("scene.toml")).expect("scene"), SCENE);
    assert_eq!(
        fs::read_to_string(dir.path().join("probes.csv")).expect("probes"),
        "step,time,tip_x,\"tip, y\"\n1,0.01,0.1,-0.0\n2,0.02,0.2,-0.0\n3,0.03,0.30000000000000004,-0.0\n"
    );
    let listed = fs::read_to_string(dir.path().join("structure.pvd")).expect("collection");
    assert!(listed.contains("fields/structure-000002.vtu"), "{listed}");
    assert!(dir.path().join("fields/structure-000002.vtu").is_file());
}

/// What a run has done is in one place: no file but the records tells of single iterations.
#[test]
fn nothing_is_recorded_twice() {
    let dir = tempfile::tempdir().expect("a temporary folder");
    let size = |name: &str| fs::metadata(dir.path().join(name)).expect("a file").len();
    let mut writer = create(dir.path());
    write_steps(&mut writer, [6, 6, 6, 6].into_iter().enumerate().map(|(k, count)| 10 * k + count), 1.0);
    drop(writer);
    let names: Vec<String> =
        without_times(dir.path()).into_keys().filter(|name| !name.contains('/')).collect();
    assert_eq!(names, ["fluid.pvd", "probes.csv", "run.jsonl", "scene.toml", "steps.csv", "structure.pvd"]);
    assert!(20 * size("steps.csv") < size("run.jsonl"), "{} and {}", size("steps.csv"), size("run.jsonl"));
}

#[test]
fn the_table_of_an_earlier_version_goes_with_the_run() {
    let dir = tempfile::tempdir().expect("a temporary folder");
    let mut writer = create(dir.path());
    write_steps(&mut writer, 1..=2, 1.0);
    let stamp = writer.stamp(2, DT * 2.0).expect("synchronized");
    drop(writer);
    let earlier = dir.path().join("iterations.csv");
    fs::write(&earlier, "step,iteration\n").expect("written");
    drop(RunWriter::resume(dir.path(), &stamp, &probes(), Clock::start()).expect("a run"));
    assert!(!earlier.exists(), "it would not grow with the run");
    fs::write(&earlier, "step,iteration\n").expect("written");
    remove_run(dir.path()).expect("a run's folder");
    assert!(!earlier.exists());
}

#[test]
fn a_table_of_half_a_line_or_of_none_is_not_guessed() {
    let dir = tempfile::tempdir().expect("a temporary folder");
    let mut writer = create(dir.path());
    write_steps(&mut writer, 1..=2, 1.0);
    drop(writer);
    let path = dir.path().join("run.jsonl");
    let text = fs::read_to_string(&path).expect("records");
    let table = || {
        let mut out = Vec::new();
        tables::write(dir.path(), Rows::Iterations, &mut out).map(|()| String::from_utf8(out).expect("text"))
    };
    fs::write(&path, text.clone() + "{\"iteration\":{\"st").expect("half a line");
    assert_eq!(
        table().expect("a table").lines().count(),
        1 + 1 + 2,
        "a killed run has whole lines before the last"
    );
    fs::write(&path, "{\"step\":7}\n".to_owned() + &text).expect("no record");
    let error = table().expect_err("line 1 is no record");
    assert!(matches!(error, TableError::Records(OutputError::Corrupt { line: 1, .. })), "{error}");
}

#[test]
#[expect(clippy::too_many_lines, reason = "two long snapshots")]
fn tables_say_what_the_records_say() {
    let dir = tempfile::tempdir().expect("a temporary folder");
    let mut writer = create(dir.path());
    write_steps(&mut writer, 2..=2, 1.0);
    drop(writer);
    let table = |text: &str| {
        let rows: Vec<Vec<String>> =
            text.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect();
        assert!(rows.iter().all(|row| row.len() == rows[0].len()), "{text}");
        // One line a column: easier to read than to count commas.
        let shown = |cell: &str| if cell.is_empty() { "-".to_owned() } else { cell.to_owned() };
        let column = |c: usize| rows.iter().map(|row| shown(&row[c])).collect::<Vec<_>>().join("  ");
        (0..rows[0].len()).map(column).collect::<Vec<_>>().join("\n")
    };
    let made = |rows| {
        let mut text = Vec::new();
        tables::write(dir.path(), rows, &mut text).expect("a table");
        String::from_utf8(text).expect("text")
    };
    let kept = fs::read_to_string(dir.path().join("steps.csv")).expect("a table");
    let (iterations, steps) = (made(Rows::Iterations), made(Rows::Steps));
    for (kept, made) in kept.lines().zip(steps.lines()) {
        assert!(made.starts_with(kept), "the kept table is the beginning of the whole one");
    }
    insta::assert_snapshot!(table(&iterations), @r"
    step  2  2
    iteration  1  2
    residual  0.1  0.05
    relative_residual  inf  0.001
    work_defect  1e-16  1e-16
    fluid_limit  2  2
    fluid_newton  2  2
    fluid_assemblies  3  3
    fluid_factorizations  2  2
    fluid_solves  6  6
    fluid_entry_residual  0.3333333333333333  0.3333333333333333
    fluid_exit_residual  1e-11  1e-11
    fluid_change  0.001  0.001
    structure_limit  inf  inf
    structure_newton  1  0
    structure_assemblies  2  1
    structure_factorizations  1  0
    structure_solves  5  4
    structure_entry_residual  0.3333333333333333  0.3333333333333333
    structure_exit_residual  1e-11  1e-11
    structure_change  1e-6  1e-6
    relaxation  0.1  -
    secant_columns  0  -
    dropped_columns  0  -
    fluid_seconds  1.0  1.0
    fluid_assembly_seconds  0.125  0.125
    fluid_factorization_seconds  0.0625  0.0625
    fluid_solve_seconds  0.03125  0.03125
    fluid_mesh_motion_seconds  0.25  0.25
    structure_seconds  0.5  0.5
    structure_assembly_seconds  0.0  0.0
    structure_factorization_seconds  0.0  0.0
    structure_solve_seconds  0.0  0.0
    structure_mesh_motion_seconds  0.0  0.0
    transfer_seconds  0.125  0.125
    acceleration_seconds  0.0625  0.0625
    fluid_tangents  2  2
    fluid_fallbacks  0  0
    fluid_mesh_factorizations  0  0
    fluid_mesh_solves  1  1
    structure_tangents  1  0
    structure_fallbacks  0  0
    structure_mesh_factorizations  0  0
    structure_mesh_solves  1  1
    ");
    insta::assert_snapshot!(table(&kept), @r"
    step  2
    time  0.02
    dt  0.01
    converged  true
    coupling_iterations  2
    residual  0.05
    largest_change  0.001
    fluid_calls  2
    fluid_newton  4
    fluid_assemblies  6
    fluid_factorizations  4
    fluid_solves  12
    structure_calls  2
    structure_newton  1
    structure_assemblies  3
    structure_factorizations  1
    structure_solves  9
    ");
    let rest = table(&steps).lines().skip(17).collect::<Vec<_>>().join("\n");
    insta::assert_snapshot!(rest, @r"
    dropped_columns  0
    fluid_seconds  2.0
    fluid_assembly_seconds  0.25
    fluid_factorization_seconds  0.125
    fluid_solve_seconds  0.0625
    fluid_mesh_motion_seconds  0.5
    structure_seconds  1.0
    structure_assembly_seconds  0.0
    structure_factorization_seconds  0.0
    structure_solve_seconds  0.0
    structure_mesh_motion_seconds  0.0
    transfer_seconds  0.25
    acceleration_seconds  0.125
    fluid_tangents  4
    fluid_fallbacks  0
    fluid_mesh_factorizations  0
    fluid_mesh_solves  2
    structure_tangents  1
    structure_fallbacks  0
    structure_mesh_factorizations  0
    structure_mesh_solves  2
    ");
}

#[test]
fn a_killed_run_keeps_its_history() {
    let dir = tempfile::tempdir().expect("a temporary folder");
    let mut writer = create(dir.path());
    write_steps(&mut writer, 1..=2, 1.0);
    // Killed here: no destructor runs.
    std::mem::forget(writer);
    let text = fs::read_to_string(dir.path().join("run.jsonl")).expect("records");
    assert_eq!(text.lines().count(), 1 + 1 + 2 + 1);
    assert!(text.ends_with('\n'));
}

#[test]
fn a_resumed_run_writes_the_same_bytes_but_for_times() {
    let whole = tempfile::tempdir().expect("a temporary folder");
    let mut writer = create(whole.path());
    write_steps(&mut writer, 1..=6, 1.0);
    let expected = writer.finish(Ending::Completed).expect("written");

    let parts = tempfile::tempdir().expect("a temporary folder");
    let mut writer = create(parts.path());
    write_steps(&mut writer, 1..=3, 2.0);
    let stamp = writer.stamp(3, DT * 3.0).expect("synchronized");
    // The run goes on behind the checkpoint, into another history, and is killed while it writes a line.
    write_steps(&mut writer, [4, 4, 5, 8], 2.0);
    drop(writer);
    for name in ["run.jsonl", "steps.csv", "probes.csv"] {
        let path = parts.path().join(name);
        let text = fs::read_to_string(&path).expect("text");
        fs::write(&path, text + "{\"iteration\":{\"st").expect("half a line");
    }
    fs::write(parts.path().join("summary.json"), "{}").expect("an old summary");

    let mut writer = RunWriter::resume(parts.path(), &stamp, &probes(), Clock::start()).expect("a run");
    assert!(!parts.path().join("summary.json").exists(), "the summary of an earlier session is gone");
    write_steps(&mut writer, 4..=6, 3.0);
    let summary = writer.finish(Ending::Completed).expect("written");

    let (left, right) = (without_times(whole.path()), without_times(parts.path()));
    assert_eq!(left.keys().collect::<Vec<_>>(), right.keys().collect::<Vec<_>>());
    for (name, text) in &left {
        assert_eq!(text, &right[name], "{name}");
    }
    let counts = |s: &partita::output::Summary| {
        (s.converged, s.steps, s.coupling_iterations, s.newton_fluid, s.newton_structure)
    };
    assert_eq!(counts(&summary), counts(&expected));
    assert_eq!(counts(&summary), (true, 6, 21, 42, 12));
}

#[test]
fn half_a_line_right_behind_the_checkpoint_is_dropped() {
    let (whole, killed) = (tempfile::tempdir().expect("a folder"), tempfile::tempdir().expect("a folder"));
    let mut stamps = [&whole, &killed].map(|dir| {
        let mut writer = create(dir.path());
        write_steps(&mut writer, 1..=2, 1.0);
        writer.stamp(2, DT * 2.0).expect("synchronized")
    });
    for (name, half) in [("run.jsonl", "{\"iteration\":{\"st"), ("steps.csv", "3"), ("probes.csv", "2")] {
        let path = killed.path().join(name);
        let text = fs::read_to_string(&path).expect("text");
        fs::write(&path, text + half).expect("half a line");
    }
    stamps[1].spent.wall_seconds += 1000.0;
    let mut writer = RunWriter::resume(killed.path(), &stamps[1], &probes(), Clock::start()).expect("a run");
    assert_eq!(without_times(whole.path()), without_times(killed.path()));

    write_steps(&mut writer, 3..=3, 1.0);
    let summary = writer.finish(Ending::Completed).expect("written");
    assert_eq!(summary.steps, 3);
    assert!(summary.wall_seconds > 1000.0, "earlier sessions count");
}

#[test]
fn a_run_killed_while_it_wrote_the_step_of_the_checkpoint_is_cut_not_guessed() {
    let dir = tempfile::tempdir().expect("a temporary folder");
    let mut writer = create(dir.path());
    write_steps(&mut writer, 1..=2, 1.0);
    let stamp = Stamp { step: 3, ..writer.stamp(2, DT * 2.0).expect("synchronized") };
    drop(writer);
    let error =
        RunWriter::resume(dir.path(), &stamp, &probes(), Clock::start()).expect_err("step 3 is missing");
    assert!(matches!(&error, OutputError::Cut { step: 3, path } if path.ends_with("run.jsonl")), "{error}");
}

#[test]
fn a_lost_row_is_found_in_the_table() {
    let name = "steps.csv";
    let dir = tempfile::tempdir().expect("a temporary folder");
    let mut writer = create(dir.path());
    write_steps(&mut writer, 1..=2, 1.0);
    let stamp = writer.stamp(2, DT * 2.0).expect("synchronized");
    drop(writer);
    let path = dir.path().join(name);
    let text = fs::read_to_string(&path).expect("text");
    let lines: Vec<&str> = text.lines().collect();
    fs::write(&path, lines[..lines.len() - 1].join("\n") + "\n").expect("cut");
    let error =
        RunWriter::resume(dir.path(), &stamp, &probes(), Clock::start()).expect_err("a row is missing");
    assert!(matches!(&error, OutputError::Cut { path, .. } if path.ends_with(name)), "{error}");
}

#[test]
fn changed_lines_are_named() {
    for (name, line, text) in [
        ("run.jsonl", 2, "{\"step\":7}"),
        ("steps.csv", 1, "step,time"),
        ("steps.csv", 3, "x,1"),
        ("probes.csv", 1, "step,time,tip_x"),
    ] {
        let dir = tempfile::tempdir().expect("a temporary folder");
        let mut writer = create(dir.path());
        write_steps(&mut writer, 1..=2, 1.0);
        let stamp = writer.stamp(2, DT * 2.0).expect("synchronized");
        drop(writer);
        let path = dir.path().join(name);
        let before = fs::read_to_string(&path).expect("text");
        let lines = before.lines().enumerate().map(|(index, old)| if index + 1 == line { text } else { old });
        fs::write(&path, lines.collect::<Vec<_>>().join("\n") + "\n").expect("changed");
        let error =
            RunWriter::resume(dir.path(), &stamp, &probes(), Clock::start()).expect_err("a changed line");
        assert!(
            matches!(error, OutputError::Corrupt { line: found, .. } if found == line),
            "{name}: {error}"
        );
    }
}

#[test]
fn no_second_is_counted_twice() {
    let dir = tempfile::tempdir().expect("a temporary folder");
    let mut writer = create(dir.path());
    write_steps(&mut writer, 1..=2, 1.0);
    let summary = writer.finish(Ending::Completed).expect("written");
    let Seconds { fluid, structure, mesh_motion, transfer, acceleration, output } = summary.seconds;
    // Three iterations: 1 s in the fluid, a quarter of it mesh motion.
    let (found, expected) =
        ([fluid, structure, mesh_motion, transfer, acceleration], [2.25, 1.5, 0.75, 0.375, 0.1875]);
    assert_eq!(found.map(f64::to_bits), expected.map(f64::to_bits), "{found:?}");
    assert!(output > 0.0 && output < summary.wall_seconds);
    let json: serde_json::Value =
        serde_json::from_str(&fs::read_to_string(dir.path().join("summary.json")).expect("summary"))
            .expect("JSON");
    assert_eq!(
        (&json["converged"], &json["steps"], &json["newton_fluid"]),
        (&true.into(), &2.into(), &6.into())
    );
    // One, then two iterations: two Newton iterations in every call of the fluid, one in every other of the structure.
    assert_eq!(
        json["fluid"],
        serde_json::json!({
            "calls": 3, "newton": 6, "assemblies": 9, "factorizations": 6, "solves": 18,
            "tangents": 6, "fallbacks": 0, "mesh_factorizations": 0, "mesh_solves": 3
        })
    );
    assert_eq!((&json["structure"]["calls"], &json["structure"]["assemblies"]), (&3.into(), &5.into()));
    assert_eq!(json["seconds"].as_object().expect("a map").len(), 6);
    if cfg!(target_os = "linux") {
        assert!(json["max_resident_bytes"].as_u64().expect("Linux tells") > 1 << 20);
        assert!(json["cpu_seconds"].as_f64().expect("Linux tells") > 0.0);
    }
}

#[test]
fn a_new_run_leaves_a_used_folder_alone() {
    let dir = tempfile::tempdir().expect("a temporary folder");
    fs::write(dir.path().join("thesis.tex"), "x").expect("a file");
    let error =
        RunWriter::create(dir.path(), SCENE, &probes(), Clock::start()).expect_err("the folder is not empty");
    assert!(matches!(error, OutputError::Occupied { .. }), "{error}");
    assert_eq!(fs::read_dir(dir.path()).expect("a folder").count(), 1);
}

#[test]
fn a_run_is_removed_unless_something_else_lies_beside_it() {
    let dir = tempfile::tempdir().expect("a temporary folder");
    let mut writer = create(dir.path());
    write_steps(&mut writer, 1..=2, 1.0);
    writer.finish(Ending::Completed).expect("written");
    drop(writer);
    let names = || -> Vec<_> {
        let mut names: Vec<_> = fs::read_dir(dir.path())
            .expect("a folder")
            .map(|entry| entry.expect("an entry").file_name())
            .collect();
        names.sort();
        names
    };
    for foreign in ["notes.md", "fields/view.pvsm"] {
        fs::write(dir.path().join(foreign), "x").expect("a file");
        let before = names();
        let error = remove_run(dir.path()).expect_err("not a run's");
        assert!(matches!(&error, OutputError::Foreign { path } if path.ends_with(foreign)), "{error}");
        assert_eq!(names(), before);
        fs::remove_file(dir.path().join(foreign)).expect("moved away");
    }
    remove_run(dir.path()).expect("removed");
    assert!(names().is_empty());
}

#[test]
fn the_folder_of_a_scene_is_not_taken_for_one_of_a_run() {
    let dir = tempfile::tempdir().expect("a temporary folder");
    fs::write(dir.path().join("scene.toml"), SCENE).expect("a scene");
    remove_run(dir.path()).expect("nothing to remove");
    assert!(dir.path().join("scene.toml").is_file());
}

#[test]
fn the_closing_table_counts_per_step() {
    let dir = tempfile::tempdir().expect("a temporary folder");
    let mut writer = create(dir.path());
    write_steps(&mut writer, 1..=2, 1.0);
    let summary = writer.finish(Ending::Completed).expect("written");
    let seconds = Seconds { output: 0.125, ..summary.seconds };
    let summary = partita::output::Summary { wall_seconds: 6.5, seconds, ..summary };
    insta::assert_snapshot!(summary.table().to_plain(), @r"
                                  total  per step  seconds
    ----------------------------  -----  --------  -------
    steps                             2              6.500
    coupling iterations               3     1.500   0.5625
    Newton iterations, fluid          6     3.000    2.250
    Newton iterations, structure      2     1.000    1.500
    mesh motion                                     0.7500
    output                                          0.1250
    ");
}
