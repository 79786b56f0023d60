//! Files that are read back hold what was written, and are whole at any time.

use std::fs;

use partita_mesh::generate::Diagonal;
use partita_mesh::vtu::{Array, Encoding, PvdCollection, VtuError, VtuFile, save_vtu, write_vtu};
use partita_mesh::{CellKind, Cells, Mesh};
use partita_testing::with_hint;

use crate::boxes::{field, unit_cube, unit_square};

fn parsed(file: Vec<u8>) -> VtuFile {
    VtuFile::parse(&String::from_utf8(file).expect("XML is text")).expect("a grid")
}

/// Writes velocity and pressure at the points and a number in each cell; returns what a reader finds.
fn written<const D: usize>(mesh: &Mesh<D>, encoding: Encoding) -> (VtuFile, Vec<f64>, Vec<f64>) {
    let velocity = field(mesh, |x| x.map(|x| (0.1 + x).sqrt()));
    let number: Vec<f64> = (0..mesh.cells().len()).map(|cell| 1.0 / (1.0 + cell as f64)).collect();
    let mut file = Vec::new();
    let point_data = [Array { name: "velocity [m/s]", components: D, values: &velocity }];
    let cell_data = [Array { name: "a < b & \"c\"", components: 1, values: &number }];
    write_vtu(&mut file, mesh.points(), mesh.cells(), &point_data, &cell_data, encoding)
        .expect("memory takes it all");
    (parsed(file), velocity, number)
}

fn check<const D: usize>(mesh: &Mesh<D>, encoding: Encoding) {
    let (file, velocity, number) = written(mesh, encoding);
    let values = |name: &str| &file.arrays[name].values;
    let padded = |values: &[f64]| -> Vec<f64> {
        values.chunks(D).flat_map(|v| (0..3).map(|c| v.get(c).copied().unwrap_or(0.0))).collect()
    };
    let coordinates: Vec<f64> = mesh.points().iter().flatten().copied().collect();
    assert_eq!(*values("Points"), padded(&coordinates));
    assert_eq!(*values("velocity [m/s]"), padded(&velocity));
    assert_eq!(*values("a < b & \"c\""), number);
    let nodes: Vec<f64> = mesh.cells().nodes.iter().map(|&node| node as f64).collect();
    assert_eq!(*values("connectivity"), nodes);
    let offsets: Vec<f64> = (1..=mesh.cells().len()).map(|cell| (cell * (D + 1)) as f64).collect();
    assert_eq!(*values("offsets"), offsets);
    let vtk_id = if D == 2 { 5.0 } else { 10.0 };
    assert_eq!(*values("types"), vec![vtk_id; mesh.cells().len()]);

    assert_eq!(file.attributes["NumberOfPoints"], mesh.points().len().to_string());
    assert_eq!(file.attributes["NumberOfCells"], mesh.cells().len().to_string());
    assert_eq!(file.arrays["velocity [m/s]"].section, "PointData");
    assert_eq!(file.arrays["velocity [m/s]"].components, 3);
    assert_eq!(file.arrays["a < b & \"c\""].section, "CellData");
    assert_eq!(file.arrays["a < b & \"c\""].components, 1);
    assert_eq!(file.arrays["Points"].section, "Points");
    assert_eq!(file.arrays["types"].section, "Cells");
}

#[test]
fn grids_come_back_bit_for_bit() {
    for encoding in [Encoding::Compressed, Encoding::Ascii] {
        check(&unit_square(1, Diagonal::Crossed), encoding);
        // Large enough for several compressed blocks.
        check(&unit_square(60, Diagonal::Crossed), encoding);
        check(&unit_cube(3), encoding);
    }
}

/// 4096 numbers of 8 bytes fill one block of 32 KiB exactly.
#[test]
fn whole_blocks_come_back() {
    for count in [4095, 4096, 4097, 8192] {
        let points: Vec<[f64; 1]> = (0..count).map(|i| [f64::from(i)]).collect();
        let cells = Cells::new(CellKind::Line2, (1..points.len()).flat_map(|i| [i - 1, i]).collect());
        let square: Vec<f64> = points.iter().map(|x| x[0] * x[0]).collect();
        let mut file = Vec::new();
        let data = [Array { name: "square", components: 1, values: &square }];
        write_vtu(&mut file, &points, &cells, &data, &[], Encoding::Compressed).expect("memory");
        let file = parsed(file);
        assert_eq!(file.arrays["square"].values, square);
        assert_eq!(file.arrays["square"].format, "binary");
    }
}

#[test]
fn no_cells_and_no_fields_are_a_file_too() {
    let mut file = Vec::new();
    let cells = Cells::new(CellKind::Quadrilateral4, vec![]);
    write_vtu::<2>(&mut file, &[], &cells, &[], &[], Encoding::Compressed).expect("memory");
    let file = parsed(file);
    assert!(file.arrays["Points"].values.is_empty());
}

#[test]
fn text_form_is_readable() {
    let points = [[0.0, 0.0], [1.0, 0.0], [1.0, 0.1], [0.0, 0.1]];
    let cells = Cells::new(CellKind::Quadrilateral4, vec![0, 1, 2, 3]);
    let displacement = [0.0, 0.0, 0.5, -1e-9, 0.0, 0.0, 0.0, 0.0];
    let data = [Array { name: "displacement [m]", components: 2, values: &displacement }];
    let mut file = Vec::new();
    write_vtu(&mut file, &points, &cells, &data, &[], Encoding::Ascii).expect("memory");
    insta::assert_snapshot!(String::from_utf8(file).expect("text"), @r#"
    <?xml version="1.0"?>
    <VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">
      <UnstructuredGrid>
        <Piece NumberOfPoints="4" NumberOfCells="1">
          <Points>
            <DataArray type="Float64" Name="Points" NumberOfComponents="3" format="ascii">
    0.0 0.0 0.0
    1.0 0.0 0.0
    1.0 0.1 0.0
    0.0 0.1 0.0
    </DataArray>
          </Points>
          <Cells>
            <DataArray type="Int64" Name="connectivity" format="ascii">
    0
    1
    2
    3
    </DataArray>
            <DataArray type="Int64" Name="offsets" format="ascii">
    4
    </DataArray>
            <DataArray type="UInt8" Name="types" format="ascii">
    9
    </DataArray>
          </Cells>
          <PointData>
            <DataArray type="Float64" Name="displacement [m]" NumberOfComponents="3" format="ascii">
    0.0 0.0 0.0
    0.5 -1e-9 0.0
    0.0 0.0 0.0
    0.0 0.0 0.0
    </DataArray>
          </PointData>
          <CellData>
          </CellData>
        </Piece>
      </UnstructuredGrid>
    </VTKFile>
    "#);
}

#[test]
#[should_panic(expected = "field `pressure` has 1 components a point")]
fn field_of_a_wrong_length_is_refused() {
    let mesh = unit_square(1, Diagonal::Right);
    let data = [Array { name: "pressure", components: 1, values: &[1.0, 2.0] }];
    let _ = write_vtu(Vec::new(), mesh.points(), mesh.cells(), &data, &[], Encoding::Ascii);
}

#[test]
fn saved_file_replaces_the_old_one_and_leaves_no_part() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("fluid-0001.vtu");
    fs::write(&path, "what was there").expect("writable");
    fs::write(folder.path().join("fluid-0001.vtu.part"), "what a killed run left").expect("writable");
    let mesh = unit_square(2, Diagonal::Right);
    save_vtu(&path, mesh.points(), mesh.cells(), &[], &[]).expect("writable");
    let file = VtuFile::load(&path).expect("a grid");
    assert_eq!(file.arrays["Points"].values.len(), 27);
    let left: Vec<_> = fs::read_dir(folder.path()).expect("a folder").collect();
    assert_eq!(left.len(), 1);
}

#[test]
fn folder_that_does_not_exist_is_named() {
    let mesh = unit_square(1, Diagonal::Right);
    let error = save_vtu("/nowhere/fluid.vtu".as_ref(), mesh.points(), mesh.cells(), &[], &[])
        .expect_err("no such folder");
    insta::assert_snapshot!(with_hint(&error), @r"
    cannot write `/nowhere/fluid.vtu`: No such file or directory (os error 2)
    hint: check that the folder exists, may be written to, and is not full
    ");
}

#[test]
fn collection_is_whole_after_every_step() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("fluid.pvd");
    let mut collection = PvdCollection::create(&path).expect("writable");
    assert!(PvdCollection::open(&path).expect("a collection").entries().is_empty());
    for step in 1..=30 {
        collection.push(f64::from(step) * 0.1, &format!("fluid & co-{step:04}.vtu")).expect("writable");
        let found = PvdCollection::open(&path).expect("a collection");
        assert_eq!(found.entries(), collection.entries());
    }
}

#[test]
fn resumed_collection_drops_later_times_and_keeps_its_own() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("fluid.pvd");
    let mut collection = PvdCollection::create(&path).expect("writable");
    let times: Vec<f64> = (1..=5).map(|step| f64::from(step) * 0.1).collect();
    for &time in &times {
        collection.push(time, "fluid.vtu").expect("writable");
    }
    let mut resumed = PvdCollection::open(&path).expect("a collection");
    // 3 * 0.1 is 0.30000000000000004: the time must come back exactly for its entry to stay.
    resumed.truncate_after(times[2]).expect("writable");
    let found = PvdCollection::open(&path).expect("a collection");
    let kept: Vec<f64> = found.entries().iter().map(|entry| entry.time).collect();
    assert_eq!(kept, times[..3]);
}

#[test]
fn broken_collections_are_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("fluid.pvd");
    let reason = |text: &str| {
        fs::write(&path, text).expect("writable");
        match PvdCollection::open(&path).expect_err("no collection") {
            VtuError::NotACollection { reason, .. } => reason,
            other => panic!("{other}"),
        }
    };
    assert_eq!(reason("<VTKFile><Collection>"), "it ends early");
    assert_eq!(reason("<VTKFile></VTKFile>"), "it has no element `Collection`");
    assert_eq!(
        reason(r#"<VTKFile><Collection><DataSet file="a"/></Collection></VTKFile>"#),
        "a data set has no attribute `timestep`"
    );
    assert_eq!(
        reason(r#"<VTKFile><Collection><DataSet timestep="soon" file="a"/></Collection></VTKFile>"#),
        "`soon` is no time"
    );
    assert!(matches!(PvdCollection::open("/nowhere/a.pvd".as_ref()), Err(VtuError::Read { .. })));
}

/// What is damaged is refused with its fault, and never read in part.
#[test]
fn a_damaged_grid_is_refused() {
    let mesh = unit_square(1, Diagonal::Crossed);
    let mut file = Vec::new();
    write_vtu(&mut file, mesh.points(), mesh.cells(), &[], &[], Encoding::Compressed).expect("memory");
    let sound = String::from_utf8(file).expect("XML is text");
    VtuFile::parse(&sound).expect("a grid");
    let refused = |from: &str, to: &str| {
        let damaged = sound.replacen(from, to, 1);
        assert_ne!(damaged, sound, "{from} is in the file");
        VtuFile::parse(&damaged).expect_err(to).to_string()
    };
    assert_eq!(refused("\"binary\"", "\"appended\""), "unknown format appended");
    assert_eq!(refused("Float64", "Float32"), "unknown type Float32");
    assert_eq!(refused("NumberOfComponents=\"3\"", "NumberOfComponents=\"7\""), "15 values in groups of 7");
    refused("</DataArray>", "AAAA</DataArray>");
    refused("</DataArray>", "");
    assert_eq!(VtuFile::parse("<VTKFile/>").expect_err("nothing").to_string(), "it holds no arrays");
}
