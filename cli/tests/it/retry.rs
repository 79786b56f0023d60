//! Steps that fail and are repeated in halves, as a user meets them.

use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::program::{folder_with, partita};

/// A cantilever under a pulse of its weight; Newton's method gets few iterations, too few for a whole step at the pulse.
pub(crate) const BEAM: &str = r#"
title = "Beam under a pulse"

[time]
step = 0.02
steps = 12

[structure]
density = 1000.0
body_force = ["0", "-1e5 * exp(-((t - 0.12) / 0.02)^2)"]
clamped = ["left"]

[structure.geometry.rectangle]
size = [1.0, 0.05]
elements = [8, 1]
degree = [2, 2]

[structure.material.saint_venant_kirchhoff]
young_modulus = 5e7
poisson_ratio = 0.3

[structure.newton]
max_iterations = 5

[output]
fields_every = 4
checkpoint_every = 3

[output.probes]
tip = { structure_displacement = [1.0, 0.5] }
"#;

/// The lines of `run.jsonl` without times.
fn records(out: &Path) -> Vec<Value> {
    let text = fs::read_to_string(out.join("run.jsonl")).expect("records");
    let mut lines: Vec<Value> =
        text.lines().map(|line| serde_json::from_str(line).expect("whole lines of JSON")).collect();
    for line in &mut lines {
        for record in line.as_object_mut().expect("a record").values_mut() {
            record.as_object_mut().expect("its fields").remove("seconds");
        }
    }
    lines
}

/// The sizes of the accepted steps, in parts of the scene's.
fn sizes(records: &[Value]) -> Vec<f64> {
    records.iter().filter_map(|line| line["step"]["dt"].as_f64()).map(|dt| dt / 0.02).collect()
}

#[test]
fn without_retry_the_run_ends_at_the_step_that_fails() {
    let (_folder, path) = folder_with(BEAM);
    let outcome = partita(&path, &["run", "case.toml", "--out", "out", "--quiet"]);
    assert_eq!(outcome.code, 3, "{}", outcome.stderr);
    let records = records(&path.join("out"));
    assert!(records.iter().all(|line| line.get("retry").is_none()));
}

#[test]
fn a_failed_step_is_repeated_in_halves_and_the_record_says_so() {
    let (_folder, path) = folder_with(BEAM);
    let outcome = partita(&path, &["run", "case.toml", "--out", "out", "--set", "time.retry.halvings=4"]);
    assert_eq!(outcome.code, 0, "{}", outcome.stderr);
    let out = path.join("out");
    let records = records(&out);
    let retries: Vec<&Value> = records.iter().filter_map(|line| line.get("retry")).collect();
    assert!(!retries.is_empty());
    let first = retries[0];
    assert_eq!(first["next_dt"].as_f64(), first["dt"].as_f64().map(|dt| 0.5 * dt));
    assert!(first["cause"].as_str().is_some_and(|cause| cause.contains("structure")), "{first}");
    assert!(outcome.stderr.contains("failed, goes on with 0.01 s"), "{}", outcome.stderr);
    let sizes = sizes(&records);
    println!("{sizes:?}");
    assert!(sizes.windows(2).all(|pair| pair[1] <= 2.0 * pair[0]), "{sizes:?}");
    assert!((sizes.iter().sum::<f64>() - 12.0).abs() < 1e-9, "{sizes:?}");
    assert!(sizes.len() > 12 && sizes[0] > 0.99 && sizes[sizes.len() - 1] > 0.99, "{sizes:?}");
    let summary: Value =
        serde_json::from_str(&fs::read_to_string(out.join("summary.json")).expect("a summary"))
            .expect("JSON");
    assert_eq!(summary["retries"].as_u64(), Some(retries.len() as u64));
    assert_eq!(summary["steps"].as_u64(), Some(sizes.len() as u64));
    let probes = fs::read_to_string(out.join("probes.csv")).expect("probes");
    assert_eq!(probes.lines().count(), 1 + sizes.len());
}

#[test]
fn a_run_with_retries_is_resumed_bit_for_bit() {
    let (_folder, path) = folder_with(BEAM);
    let with = ["--set", "time.retry.halvings=4", "--quiet"];
    let whole = partita(&path, &[&["run", "case.toml", "--out", "whole"][..], &with].concat());
    assert_eq!(whole.code, 0, "{}", whole.stderr);
    let mut retried_before = false;
    for steps in ["4", "6", "7", "8"] {
        let out = format!("out{steps}");
        let cut = [&["run", "case.toml", "--out", &out, "--steps", steps][..], &with].concat();
        let first = partita(&path, &cut);
        assert_eq!(first.code, 0, "{}", first.stderr);
        retried_before |= records(&path.join(&out)).iter().any(|line| line.get("retry").is_some());
        let rest = partita(&path, &["resume", &out, "--quiet"]);
        assert_eq!(rest.code, 0, "{}", rest.stderr);
        assert_eq!(records(&path.join(&out)), records(&path.join("whole")), "{steps}");
        let probes = |out: &str| fs::read_to_string(path.join(out).join("probes.csv")).expect("probes");
        assert_eq!(probes(&out), probes("whole"), "{steps}");
    }
    assert!(retried_before, "one of the cuts comes after a retry");
}

#[test]
fn halvings_out_of_range_are_refused() {
    let (_folder, path) = folder_with(BEAM);
    for halvings in ["0", "17", "-1"] {
        let outcome =
            partita(&path, &["check", "case.toml", "--set", &format!("time.retry.halvings={halvings}")]);
        assert_eq!(outcome.code, 2, "{}", outcome.stderr);
        assert!(outcome.stderr.contains("from 1 to 16"), "{}", outcome.stderr);
    }
}
