//! Files cut or damaged anywhere give an error or a document: no panic, no hang, no absurd allocation.

use allocation_counter::measure;
use partita_mesh::gmsh::GmshFile;
use partita_testing::{Noise, corpus};

use crate::gmsh::{ALL, big_endian_prism, big_endian_prism_2, parse};

/// Bytes that may be allocated while reading, beyond the file's size times a factor for tags, points and index.
const CONSTANT: u64 = 16 * 1024;
const PER_BYTE: u64 = 40;

/// Reads a file and makes every kind of mesh from it when it can be read.
fn digest(bytes: &[u8]) -> bool {
    let mut readable = false;
    let info = measure(|| {
        if let Ok(file) = GmshFile::parse(bytes) {
            readable = true;
            drop(file);
        }
    });
    let most = CONSTANT + PER_BYTE * bytes.len() as u64;
    assert!(info.bytes_max <= most, "{} bytes allocated for a file of {}", info.bytes_max, bytes.len());
    if let Ok(file) = GmshFile::parse(bytes) {
        let _ = file.clone().into_mesh::<2>();
        let _ = file.clone().into_mesh::<3>();
        for dimension in [2, 3] {
            let chosen = file.regions(dimension).into_iter().next();
            if let Ok(part) = file.clone().part(dimension, chosen.as_slice()) {
                let _ = part.clone().into_mesh::<2>();
                let _ = part.clone().into_mesh::<3>();
                let _ = part.into_solid_mesh();
            }
        }
        let _ = file.into_solid_mesh();
    }
    readable
}

#[test]
fn every_prefix_of_a_file_is_refused() {
    for file in ALL.into_iter().chain([&big_endian_prism()[..], &big_endian_prism_2()]) {
        let end = file.trim_ascii_end().len();
        for length in 0..end {
            assert!(!digest(&file[..length]), "a file cut to {length} of {end} bytes is read");
        }
        assert!(digest(&file[..end]), "only the last line break is not needed");
    }
}

#[test]
fn damaged_bytes_never_panic() {
    let mut noise = Noise::new(0x9e37_79b9_7f4a_7c15);
    for file in ALL.into_iter().chain([&big_endian_prism()[..], &big_endian_prism_2()]) {
        for round in 0..1000 {
            let mut damaged = file.to_vec();
            for _ in 0..=(round % 4) {
                let place = noise.below(damaged.len());
                damaged[place] = byte(&mut noise, round);
            }
            digest(&damaged);
        }
    }
}

#[test]
fn moved_and_doubled_pieces_never_panic() {
    let mut noise = Noise::new(0xd1b5_4a32_d192_ed03);
    for file in ALL {
        for _ in 0..300 {
            let [a, b, c] = [0; 3].map(|_| noise.below(file.len()));
            let piece = &file[a.min(b)..a.max(b)];
            digest(&[&file[..c], piece, &file[c..]].concat());
            digest(&[&file[..a.min(b)], &file[a.max(b)..]].concat());
        }
    }
}

#[test]
fn undamaged_files_pass_the_same_checks() {
    for file in ALL {
        assert!(digest(file));
        assert!(!parse(file).blocks.is_empty());
    }
}

#[test]
fn the_corpus_of_the_fuzz_target_never_panics() {
    let files = corpus::of("gmsh");
    assert!(files.len() > 100, "{} files", files.len());
    let readable = files.iter().filter(|file| digest(file)).count();
    assert!(readable > 10, "of {} files {readable} can be read", files.len());
}

/// Any byte, or in every other round a digit or a sign: text stays text and numbers change.
fn byte(noise: &mut Noise, round: usize) -> u8 {
    if round.is_multiple_of(2) { noise.below(256).to_le_bytes()[0] } else { noise.of(b"0123456789-.e$\n \"") }
}
