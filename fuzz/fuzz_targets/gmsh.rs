//! Whatever bytes a gmsh file holds, reading it gives a document or an error with a hint; and whatever the document
//! holds, making a mesh of it gives a mesh or an error with a hint.

#![no_main]

use libfuzzer_sys::fuzz_target;
use partita_mesh::gmsh::{ElementBlock, GmshFile};

fuzz_target!(|bytes: &[u8]| {
    match GmshFile::parse(bytes) {
        Ok(file) => {
            check_document(&file);
            check_mesh::<2>(&file);
            check_mesh::<3>(&file);
        }
        Err(error) => check_message(&error.to_string()),
    }
});

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

fn check_mesh<const D: usize>(file: &GmshFile) {
    match file.clone().into_mesh::<D>() {
        Ok(mesh) => {
            assert!(mesh.cells().nodes.iter().all(|&node| node < mesh.points().len()));
            assert!(mesh.groups().iter().all(|group| !group.facets.is_empty()));
        }
        Err(error) => check_message(&error.to_string()),
    }
}

fn check_message(message: &str) {
    assert!(message.contains("\nhint: "), "no hint in: {message}");
}
