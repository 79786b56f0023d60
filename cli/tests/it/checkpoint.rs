//! Checkpoints keep every bit and say what is wrong with a file that lost some.

use std::fs;
use std::path::Path;

use miette::Diagnostic;
use partita::checkpoint::{CheckpointError, LATEST, PREVIOUS, Stamp, load, load_file, save};
use partita::output::Spent;
use serde::{Deserialize, Serialize};

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct State {
    values: Vec<f64>,
    history: Vec<Vec<f64>>,
    order: Order,
    last_relaxation: Option<f64>,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
enum Order {
    One,
    Two { dt_previous: f64 },
}

fn stamp(step: usize) -> Stamp {
    let spent = Spent { wall_seconds: 1.5, cpu_seconds: Some(1.25), output_seconds: 0.25 };
    Stamp { step, time: 0.01 * step as f64, spent }
}

fn state() -> State {
    State {
        values: vec![0.1, -0.0, f64::MIN_POSITIVE / 4.0, f64::INFINITY],
        history: vec![vec![], vec![1.0 / 3.0]],
        order: Order::Two { dt_previous: 0.01 },
        last_relaxation: None,
    }
}

/// A folder with the checkpoints of steps 10 and 20.
fn folder() -> tempfile::TempDir {
    let dir = tempfile::tempdir().expect("a temporary folder");
    save(dir.path(), &stamp(10), &State { values: vec![], ..state() }).expect("first checkpoint");
    save(dir.path(), &stamp(20), &state()).expect("second checkpoint");
    dir
}

/// The bytes of a checkpoint.
fn bytes() -> Vec<u8> {
    fs::read(folder().path().join(LATEST)).expect("the checkpoint")
}

/// What a file with these bytes is read as.
fn read_back(bytes: &[u8]) -> Result<(Stamp, State), CheckpointError> {
    let dir = tempfile::tempdir().expect("a temporary folder");
    let path = dir.path().join("changed.bin");
    fs::write(&path, bytes).expect("the changed checkpoint");
    load_file(&path)
}

/// Reads a checkpoint back after `change` was made to its bytes.
fn load_changed(change: impl FnOnce(&mut Vec<u8>)) -> Result<(Stamp, State), CheckpointError> {
    let mut bytes = bytes();
    change(&mut bytes);
    read_back(&bytes)
}

#[test]
fn a_state_comes_back_as_it_was() {
    let dir = folder();
    let checkpoint = load::<State>(dir.path()).expect("a checkpoint");
    assert_eq!((checkpoint.stamp, checkpoint.state), (stamp(20), state()));
    assert!(checkpoint.latest_unusable.is_none());
}

#[test]
fn floats_come_back_bit_for_bit() {
    let bits = [
        (-0.0_f64).to_bits(),
        0x7ff8_0000_dead_beef, // a quiet NaN with a payload
        0x7ff0_0000_0000_0001, // a signalling one
        0xfff8_0000_0000_0000,
        1, // the smallest subnormal
        f64::NEG_INFINITY.to_bits(),
        (0.1_f64 + 0.2).to_bits(),
    ];
    let dir = tempfile::tempdir().expect("a temporary folder");
    save(dir.path(), &stamp(1), &bits.map(f64::from_bits).to_vec()).expect("a checkpoint");
    let values = load::<Vec<f64>>(dir.path()).expect("a checkpoint").state;
    assert_eq!(values.into_iter().map(f64::to_bits).collect::<Vec<_>>(), bits);
}

#[test]
fn the_checkpoint_before_is_kept_and_used_when_the_latest_is_not_whole() {
    let dir = folder();
    let (before, _) = load_file::<State>(&dir.path().join(PREVIOUS)).expect("the previous checkpoint");
    assert_eq!(before.step, 10);

    fs::write(dir.path().join(LATEST), b"PARTITA\n").expect("a cut checkpoint");
    let checkpoint = load::<State>(dir.path()).expect("the previous checkpoint");
    assert_eq!(checkpoint.stamp.step, 10);
    assert!(matches!(checkpoint.latest_unusable, Some(CheckpointError::WrongLength { found: 8, .. })));

    // Killed between the two renames.
    fs::remove_file(dir.path().join(LATEST)).expect("removed");
    assert_eq!(load::<State>(dir.path()).expect("the previous checkpoint").stamp.step, 10);
}

#[test]
fn a_folder_without_checkpoints_says_so() {
    let dir = tempfile::tempdir().expect("a temporary folder");
    let error = load::<State>(dir.path()).expect_err("nothing there");
    assert!(matches!(error, CheckpointError::Missing { .. }), "{error}");
}

#[test]
fn a_cut_file_is_found_at_every_length() {
    let bytes = bytes();
    for kept in 1..bytes.len() {
        let error = read_back(&bytes[..kept]).expect_err("a cut file");
        assert!(
            matches!(error, CheckpointError::WrongLength { found, .. } if found == kept as u64),
            "{kept}: {error}"
        );
    }
    assert!(matches!(read_back(&[]), Err(CheckpointError::WrongMagic { .. })));
    assert!(matches!(read_back(&[&bytes[..], &[0]].concat()), Err(CheckpointError::WrongLength { .. })));
}

#[test]
fn every_flipped_bit_is_found() {
    let mut bytes = bytes();
    for bit in 0..8 * bytes.len() {
        let (byte, mask) = (bit / 8, 1 << (bit % 8));
        bytes[byte] ^= mask;
        let result = read_back(&bytes);
        bytes[byte] ^= mask;
        assert!(result.is_err(), "bit {} of byte {byte}", bit % 8);
        if byte >= 24 {
            assert!(matches!(result, Err(CheckpointError::WrongChecksum { .. })), "byte {byte}");
        }
    }
}

#[test]
fn another_version_and_another_file_are_named() {
    let newer = load_changed(|bytes| bytes[8] += 1).expect_err("another version");
    assert!(matches!(newer, CheckpointError::WrongVersion { found: 4, .. }), "{newer}");
    let other =
        load_changed(|bytes| bytes[..8].copy_from_slice(b"\x89PNG\r\n\x1a\n")).expect_err("another file");
    assert!(matches!(other, CheckpointError::WrongMagic { .. }), "{other}");
}

#[test]
fn a_byte_moved_from_the_stamp_to_the_state_is_found() {
    let error = load_changed(|bytes| {
        bytes[12] -= 1;
        bytes[16] += 1;
    });
    assert!(matches!(error, Err(CheckpointError::WrongChecksum { .. })), "{error:?}");
}

#[test]
fn a_monstrous_length_is_refused_before_it_is_believed() {
    let error = load_changed(|bytes| bytes[16..24].fill(0xff)).expect_err("a wrong length");
    assert!(matches!(error, CheckpointError::WrongLength { expected: u64::MAX, .. }), "{error}");
}

#[test]
fn a_state_of_another_kind_is_an_error() {
    let dir = folder();
    let path = dir.path().join(LATEST);
    assert!(matches!(load_file::<Vec<String>>(&path), Err(CheckpointError::Decode { .. })));
    // A prefix of the state decodes; what is left over gives it away.
    assert!(matches!(load_file::<Vec<f64>>(&path), Err(CheckpointError::Decode { .. })));
}

#[test]
fn a_failed_save_leaves_the_checkpoints_usable() {
    let dir = folder();
    fs::create_dir(dir.path().join("checkpoint.tmp.bin")).expect("a folder in the way");
    let error = save(dir.path(), &stamp(30), &state()).expect_err("the temporary file cannot be created");
    assert!(matches!(error, CheckpointError::File { .. }), "{error}");
    assert_eq!(load::<State>(dir.path()).expect("a checkpoint").stamp.step, 20);
}

#[test]
fn errors_name_the_file_and_a_remedy() {
    let error = load_file::<State>(Path::new("nowhere/checkpoint.bin")).expect_err("no file");
    assert!(error.to_string().starts_with("nowhere/checkpoint.bin: "), "{error}");
    assert!(error.help().is_some(), "{error}");
}
