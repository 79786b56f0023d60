//! Whatever bytes a gmsh file holds, reading it gives a document or an error with a hint; and whatever the document
//! holds, making a mesh of it gives a mesh or an error with a hint. Neither needs much more memory than the file is large.

#![no_main]

use libfuzzer_sys::fuzz_target;
use miette::Diagnostic;
use partita_mesh::gmsh::{ElementBlock, GmshFile};
use partita_mesh::quality::measures;
use partita_mesh::solid::reference::quadrature;

/// Bytes that may be in use at once beside the file: some, and so many for each of its own.
const CONSTANT: usize = 64 * 1024;
const TO_READ: usize = 64;
const TO_CONVERT: usize = 256;

fuzz_target!(|bytes: &[u8]| {
    match within(CONSTANT + TO_READ * bytes.len(), || GmshFile::parse(bytes)) {
        Ok(file) => {
            check_document(&file);
            let limit = CONSTANT + TO_CONVERT * bytes.len();
            check_mesh::<2>(file.clone(), limit);
            check_mesh::<3>(file.clone(), limit);
            check_part(&file, limit);
            check_solid_mesh(file, limit);
        }
        Err(error) => check_message(&error),
    }
});

/// Runs an action that may not have more than `limit` bytes allocated at any time.
fn within<T>(limit: usize, action: impl FnOnce() -> T) -> T {
    let mut outcome = None;
    let used = allocation_counter::measure(|| outcome = Some(action())).bytes_max;
    assert!(used <= limit as u64, "{used} bytes in use, at most {limit} are reasonable");
    outcome.expect("the action has run")
}

/// What [`GmshFile`] promises of its parts.
fn check_document(file: &GmshFile) {
    assert_eq!(file.node_tags.len(), file.points.len());
    assert!(file.points.as_flattened().iter().all(|x| x.is_finite()));
    for block in &file.blocks {
        assert!(!block.is_empty());
        assert_eq!(block.nodes.len(), block.len() * block.kind.node_count());
        assert!(block.nodes.iter().all(|&node| node < file.points.len()));
        assert!(block.groups.is_sorted_by(|a, b| a < b));
    }
    let order = |block: &ElementBlock| (block.kind, block.groups.clone());
    assert!(file.blocks.is_sorted_by(|a, b| order(a) < order(b)), "two blocks share kind and groups");
}

fn check_mesh<const D: usize>(file: GmshFile, limit: usize) {
    match within(limit, || file.into_mesh::<D>()) {
        Ok(mesh) => {
            assert!(mesh.cells().nodes.iter().all(|&node| node < mesh.points().len()));
            assert!(measures(mesh.points(), mesh.cells()).iter().all(|&x| x > 0.0 && x.is_finite()));
            assert!(mesh.groups().iter().all(|group| !group.facets.is_empty()));
        }
        Err(error) => check_message(&error),
    }
}

/// The cells of the first physical surface, if there is one.
fn check_part(file: &GmshFile, limit: usize) {
    let chosen = file.regions(2).into_iter().next();
    match within(limit, || file.clone().part(2, chosen.as_slice())) {
        Ok(part) => {
            check_mesh::<2>(part.clone(), limit);
            check_solid_mesh(part, limit);
        }
        Err(error) => check_message(&error),
    }
}

fn check_solid_mesh(file: GmshFile, limit: usize) {
    match within(limit, || file.into_solid_mesh()) {
        Ok(mesh) => {
            for (cell, (xi, _)) in (0..mesh.cells().len())
                .flat_map(|cell| quadrature(mesh.cells().kind).into_iter().map(move |q| (cell, q)))
            {
                let [[a, b], [c, d]] = mesh.map(cell, xi).jacobian;
                assert!(a * d - b * c > 0.0, "cell {cell} is folded");
            }
            assert!(mesh.groups().iter().all(|group| !group.edges.is_empty()));
        }
        Err(error) => check_message(&error),
    }
}

fn check_message(error: &dyn Diagnostic) {
    assert!(error.help().is_some(), "no hint with: {error}");
}
