//! Saving and restoring a run.

use partita_coupling::models::tube::Tube;
use partita_coupling::{CouplingSettings, MarchState, Predictor, Record, StepRecord, state};

use crate::support::{TubeMarch, all_accelerations, imvls, settings, tube};

const DT: f64 = 1e-3;

fn save(run: &TubeMarch) -> Vec<u8> {
    state::encode(&run.state())
}

fn load(run: &mut TubeMarch, bytes: &[u8]) {
    run.restore(&state::decode("run", bytes).unwrap()).unwrap();
}

fn steps(run: &mut TubeMarch, count: usize) -> Vec<StepRecord> {
    (0..count).map(|_| run.step(DT, &mut ()).unwrap().without_seconds()).collect()
}

#[test]
fn resumed_run_continues_bit_for_bit() {
    for (name, acceleration) in all_accelerations() {
        let settings = CouplingSettings { predictor: Predictor::Cubic, ..settings(acceleration) };
        let mut original = tube(&Tube::default(), &settings);
        steps(&mut original, 5);
        let checkpoint = save(&original);
        let mut resumed = tube(&Tube::default(), &settings);
        load(&mut resumed, &checkpoint);

        assert_eq!(steps(&mut original, 4), steps(&mut resumed, 4), "{name}");
        assert_eq!(save(&original), save(&resumed), "{name}");
        assert_eq!(original.interface(), resumed.interface(), "{name}");
    }
}

#[test]
fn run_resumed_without_its_quasi_newton_history_pays_for_it() {
    let mut original = tube(&Tube::default(), &settings(imvls()));
    steps(&mut original, 5);
    let checkpoint = save(&original);
    let mut forgetful = tube(&Tube::default(), &settings(imvls()));
    load(&mut forgetful, &checkpoint);
    let mut state = forgetful.state();
    let nothing = tube(&Tube::default(), &settings(imvls())).state().accelerator;
    assert!(state.accelerator.bytes.len() > nothing.bytes.len(), "the checkpoint must hold the history");
    state.accelerator = nothing;
    forgetful.restore(&state).unwrap();
    assert!(steps(&mut forgetful, 1)[0].iterations > steps(&mut original, 1)[0].iterations);
}

#[test]
fn foreign_states_are_refused() {
    let all = all_accelerations();
    let states: Vec<MarchState> = all
        .iter()
        .map(|(_, acceleration)| {
            let mut run = tube(&Tube::default(), &settings(*acceleration));
            steps(&mut run, 1);
            run.state()
        })
        .collect();
    for (i, (name, acceleration)) in all.iter().enumerate() {
        for (j, state) in states.iter().enumerate() {
            let result = tube(&Tube::default(), &settings(*acceleration)).restore(state);
            assert_eq!(result.is_ok(), i == j, "{name} takes the state of {}", all[j].0);
        }
        let smaller = Tube { cells: 20, ..Tube::default() };
        assert!(tube(&smaller, &settings(*acceleration)).restore(&states[i]).is_err(), "{name}");
    }
}

#[test]
fn records_survive_json_lines_bit_for_bit() {
    let mut records: Vec<Record> = Vec::new();
    let mut run = tube(&Tube::default(), &settings(imvls()));
    for _ in 0..2 {
        run.step(DT, &mut records).unwrap();
    }
    let lines: Vec<String> = records.iter().map(|record| serde_json::to_string(record).unwrap()).collect();
    let back: Vec<Record> = lines.iter().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert_eq!(back, records);
    assert!(lines.iter().all(|line| !line.contains('\n')));
}
