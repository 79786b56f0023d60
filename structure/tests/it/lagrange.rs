//! Structures on meshes of triangles and quadrilaterals: the same identities as on a patch.
use partita_numerics::Field;

use nalgebra::{DMatrix, SymmetricEigen};
use partita_iga::Side;
use partita_mesh::solid::reference;
use partita_mesh::{CellKind, SolidMesh};
use partita_numerics::newton::{self, Limit, Problem, Verdict};
use partita_structure::{
    Boundary, Material, Rayleigh, Space, StructureError, StructureModel, StructureSettings, StructureSolver,
};
use partita_testing::with_hint;

use crate::common::{
    KINDS, bare, beam, bent_square, dense_tangent, dynamic, largest, linear, neo_hookean, noise, on_mesh,
    quasi_static, svk,
};

/// Stretch, shear and rotation together, far beyond small strains.
const GRADIENT: [[f64; 2]; 2] = [[0.3, -0.4], [0.5, -0.1]];

fn materials() -> [Material; 3] {
    [linear(7.0, 0.3), svk(7.0, 0.3), neo_hookean(7.0, 0.3)]
}

fn affine(mesh: &SolidMesh<2>, gradient: [[f64; 2]; 2]) -> Vec<f64> {
    let displacement = |x: &[f64; 2]| gradient.map(|row| row[0] * x[0] + row[1] * x[1]);
    mesh.points().iter().flat_map(displacement).collect()
}

fn converge(solver: &mut StructureSolver<2>) {
    let settings = *solver.newton_settings();
    newton::solve(solver, &settings, Limit::ToConvergence, |_, _| Verdict::Continue).unwrap();
}

#[test]
fn uniform_strain_leaves_no_force_inside_a_bent_mesh() {
    for kind in KINDS {
        let mesh = bent_square(kind, 3);
        for material in materials() {
            let mut solver = on_mesh(mesh.clone(), bare(material), quasi_static());
            solver.begin_step(1.0, 1.0).expect("a step");
            solver.guess(&affine(&mesh, GRADIENT));
            solver.assemble(false).unwrap();
            let forces = solver.residual().as_chunks::<2>().0;
            let inside: Vec<f64> = (0..forces.len())
                .filter(|node| mesh.boundary_nodes().binary_search(node).is_err())
                .flat_map(|node| forces[node])
                .collect();
            assert!(!inside.is_empty());
            let ratio = largest(&inside) / largest(solver.residual());
            assert!(ratio < 1e-14, "{kind:?}, {:?}: {ratio:e}", material.law());
        }
    }
}

/// Consistent nodal forces `(N_a, P N)` of a uniform stress on boundary groups, on all dofs.
fn traction_of_uniform_stress(mesh: &SolidMesh<2>, groups: &[&str], stress: [[f64; 2]; 2]) -> Vec<f64> {
    let mut force = vec![0.0; mesh.points().len() * 2];
    for group in groups {
        let edges = &mesh.group(group).unwrap().edges;
        for edge in edges {
            for (unit, weight) in partita_numerics::gauss::line(4) {
                let shape = reference::line_shape(edges.kind, 2.0 * unit - 1.0);
                let mut tangent = [0.0; 2];
                for (&node, [_, slope]) in edge.iter().zip(shape) {
                    (0..2).for_each(|i| tangent[i] += 2.0 * slope * mesh.points()[node][i]);
                }
                // The solid lies to the left.
                let normal = [tangent[1], -tangent[0]];
                for (&node, [value, _]) in edge.iter().zip(shape) {
                    for i in 0..2 {
                        let traction = stress[i][0] * normal[0] + stress[i][1] * normal[1];
                        force[2 * node + i] += weight * value * traction;
                    }
                }
            }
        }
    }
    force
}

#[test]
fn a_clamped_mesh_under_the_tractions_of_a_uniform_stress_takes_its_uniform_strain() {
    // On the clamped side x = 0 the displacement vanishes.
    let gradient = [[0.3, 0.0], [-0.2, 0.0]];
    for kind in KINDS {
        for material in materials() {
            let mesh = bent_square(kind, 3);
            let stress = material.stress(&gradient).unwrap();
            let free = ["right", "bottom", "top"];
            let model = StructureModel { clamped: "left".into(), wetted: free.into(), ..bare(material) };
            let mut solver = on_mesh(mesh.clone(), model, quasi_static());
            let traction = traction_of_uniform_stress(&mesh, &free, stress);
            let traction = traction.as_chunks::<2>().0;
            let load: Vec<f64> = solver.interface_points().iter().flat_map(|&node| traction[node]).collect();
            solver.begin_step(1.0, 1.0).expect("a step");
            solver.impose(&load).expect("a step");
            converge(&mut solver);
            let exact = affine(&mesh, gradient);
            let error: Vec<f64> = solver.values().iter().zip(&exact).map(|(d, exact)| d - exact).collect();
            assert!(largest(&error) < 1e-11, "{kind:?}, {:?}: {:e}", material.law(), largest(&error));
            // The support stands in for the tractions that clamped nodes do not take.
            let all = traction_of_uniform_stress(&mesh, &["left", "right", "bottom", "top"], stress);
            let clamped = mesh.group_nodes("left").unwrap();
            let reaction = solver.reaction("left").unwrap();
            for i in 0..2 {
                let pulled: f64 = clamped.iter().map(|&node| all[2 * node + i]).sum();
                assert!((reaction[i] - pulled).abs() < 1e-10, "{kind:?}: {reaction:?} and {pulled}");
            }
        }
    }
}

#[test]
fn a_free_mesh_has_three_rigid_modes_and_no_others() {
    for kind in KINDS {
        let mut solver = on_mesh(bent_square(kind, 2), bare(svk(1.0, 0.3)), quasi_static());
        solver.begin_step(1.0, 1.0).expect("a step");
        solver.assemble(true).unwrap();
        let rows = dense_tangent(&solver);
        let stiffness = DMatrix::from_fn(rows.len(), rows.len(), |i, j| rows[i][j]);
        let mut values: Vec<f64> = SymmetricEigen::new(stiffness).eigenvalues.iter().copied().collect();
        values.sort_by(f64::total_cmp);
        assert!(values[..3].iter().all(|value| value.abs() < 1e-13), "{kind:?}: {:?}", &values[..4]);
        assert!(values[3] > 0.01, "{kind:?}: {:?}", &values[..4]);
    }
}

#[test]
fn a_turned_mesh_feels_no_force() {
    let (sin, cos) = 2.2_f64.sin_cos();
    for kind in KINDS {
        for material in [svk(1.0, 0.3), neo_hookean(1.0, 0.3)] {
            let mesh = bent_square(kind, 2);
            let mut solver = on_mesh(mesh.clone(), bare(material), quasi_static());
            solver.begin_step(1.0, 1.0).expect("a step");
            solver.guess(&affine(&mesh, [[cos - 1.0, -sin], [sin, cos - 1.0]]));
            solver.assemble(false).unwrap();
            assert!(largest(solver.residual()) < 1e-14, "{kind:?}");
        }
    }
}

#[test]
fn tangent_is_derivative_of_residual_and_symmetric_on_every_kind_of_cells() {
    let rayleigh = Some(Rayleigh { mass: 0.4, stiffness: 0.03 });
    for (kind, material) in KINDS.into_iter().flat_map(|kind| materials().map(|material| (kind, material))) {
        let model = StructureModel { density: 2.5, clamped: "left".into(), ..bare(material) };
        let settings = StructureSettings { rayleigh, ..dynamic(0.3) };
        let mut solver = on_mesh(bent_square(kind, 2), model, settings);
        solver.begin_step(0.2, 0.2).expect("a step");
        let at: Vec<f64> = noise(solver.values().len(), 1.0).iter().map(|x| 0.03 * x).collect();
        solver.guess(&at);
        solver.assemble(true).unwrap();
        let tangent = dense_tangent(&solver);
        let scale = tangent.iter().map(|row| largest(row)).fold(0.0, f64::max);
        let free = solver.parts()[0].dofs.clone();
        for (column, &dof) in free.iter().enumerate() {
            let mut residual = |step: f64| {
                let mut moved = at.clone();
                moved[dof] += step;
                solver.guess(&moved);
                solver.assemble(false).unwrap();
                solver.residual().to_vec()
            };
            let (ahead, behind) = (residual(1e-6), residual(-1e-6));
            for (row, &force) in free.iter().enumerate() {
                let slope = (ahead[force] - behind[force]) / 2e-6;
                let error = (tangent[row][column] - slope).abs() / scale;
                assert!(error < 1e-6, "{kind:?}, {:?} ({row}, {column}): {error:e}", material.law());
                assert_eq!(tangent[row][column].to_bits(), tangent[column][row].to_bits());
            }
        }
    }
}

#[test]
fn mass_is_density_times_area() {
    for kind in KINDS {
        let mesh = bent_square(kind, 3);
        let rule = reference::quadrature(kind);
        let area: f64 = (0..mesh.cells().len())
            .flat_map(|cell| rule.iter().map(move |&(xi, weight)| (cell, xi, weight)))
            .map(|(cell, xi, weight)| {
                let [[a, b], [c, d]] = mesh.map(cell, xi).jacobian;
                weight * (a * d - b * c)
            })
            .sum();
        let mut solver = on_mesh(mesh, StructureModel { density: 7.0, ..bare(svk(1.0, 0.3)) }, dynamic(0.5));
        let mut state = solver.state().clone();
        state.velocity.as_chunks_mut::<2>().0.fill([0.6, 0.8]);
        solver.restore(&state).unwrap();
        assert!((2.0 * solver.kinetic_energy() / (7.0 * area) - 1.0).abs() < 1e-13, "{kind:?}");
    }
}

/// Places on the wetted sides, between nodes and on them, the ends of the clamped side too.
fn places(mesh: &SolidMesh<2>) -> Vec<[f64; 2]> {
    let mut places = Vec::new();
    for group in ["top", "right"] {
        let edges = &mesh.group(group).unwrap().edges;
        for edge in edges {
            for s in [-1.0, -0.43, 0.2, 0.77] {
                let shape = reference::line_shape(edges.kind, s);
                let mut place = [0.0; 2];
                for (&node, [value, _]) in edge.iter().zip(shape) {
                    (0..2).for_each(|i| place[i] += value * mesh.points()[node][i]);
                }
                places.push(place);
            }
        }
    }
    places
}

#[test]
fn transfer_conserves_force_and_work_between_points_and_interface() {
    for kind in KINDS {
        let mesh = bent_square(kind, 3);
        let model = StructureModel {
            clamped: "bottom".into(),
            wetted: ["top", "right"].into(),
            ..bare(neo_hookean(7.0, 0.3))
        };
        let mut solver = on_mesh(mesh.clone(), model, quasi_static());
        let places = places(&mesh);
        let rows = solver.interface_rows(&places, 1e-13).unwrap();
        let force: Vec<f64> = noise(2 * places.len(), 3.0).iter().map(|f| 0.01 * f).collect();
        let force = force.as_chunks::<2>().0;
        let columns = solver.interface_points().to_vec();
        let (mut load, mut on_clamp) = (vec![[0.0; 2]; columns.len()], [0.0; 2]);
        for (row, f) in rows.iter().zip(force) {
            assert!((row.iter().map(|(_, weight)| weight).sum::<f64>() - 1.0).abs() < 1e-14);
            for (node, weight) in row {
                let taker = columns.binary_search(node).map_or(&mut on_clamp, |column| &mut load[column]);
                (0..2).for_each(|i| taker[i] += weight * f[i]);
            }
        }
        for i in 0..2 {
            let (given, taken): (f64, f64) =
                (force.iter().map(|f| f[i]).sum(), load.iter().map(|f| f[i]).sum::<f64>() + on_clamp[i]);
            assert!((given - taken).abs() < 1e-13, "{kind:?}: {given} and {taken}");
        }

        solver.begin_step(1.0, 1.0).expect("a step");
        solver.impose(load.as_flattened()).expect("a step");
        converge(&mut solver);
        let mut output = vec![0.0; 2 * columns.len()];
        solver.output(&mut output);
        let work_of_structure: f64 = output.iter().zip(load.as_flattened()).map(|(d, f)| d * f).sum();
        let nodes = solver.values().as_chunks::<2>().0;
        let mut work_of_points = 0.0;
        for ((row, f), place) in rows.iter().zip(force).zip(&places) {
            let mut displacement = [0.0; 2];
            for &(node, weight) in row {
                (0..2).for_each(|i| displacement[i] += weight * nodes[node][i]);
            }
            work_of_points += displacement[0] * f[0] + displacement[1] * f[1];
            // The rows are the shape functions of the structure on its boundary.
            let seen = solver.displacement_at(place);
            assert!((0..2).all(|i| (seen[i] - displacement[i]).abs() < 1e-9));
        }
        assert!((work_of_points - work_of_structure).abs() < 1e-13, "{kind:?}: {work_of_points}");
        assert!(work_of_structure.abs() > 1e-4);
    }
}

#[test]
fn rows_of_a_patch_are_those_of_its_own_transfer() {
    let patch = beam(1.0, 0.2, 2, 4);
    let model = StructureModel { wetted: [Side::TOP, Side::RIGHT].into(), ..bare(svk(1.0, 0.3)) };
    let solver = StructureSolver::new(patch.clone().into(), model, quasi_static()).unwrap();
    let places = [[0.3, 0.1], [1.0, 0.05], [1.0, 0.1]];
    let rows = solver.interface_rows(&places, 1e-9).unwrap();
    let expected = partita_iga::transfer::rows(&patch, &[Side::TOP, Side::RIGHT], &places, 1e-9).unwrap();
    for (row, expected) in rows.iter().zip(&expected) {
        assert_eq!(row, &expected.weights);
    }
    let error = solver.interface_rows(&[[0.3, 0.2]], 1e-9).unwrap_err();
    assert!(matches!(error, StructureError::OffPatch(_)), "{error}");
}

#[test]
fn values_at_points_are_interpolated_and_those_at_nodes_are_the_nodes_own() {
    for kind in KINDS {
        let mesh = bent_square(kind, 2);
        let mut solver = on_mesh(mesh.clone(), bare(svk(1.0, 0.3)), quasi_static());
        solver.begin_step(1.0, 1.0).expect("a step");
        solver.guess(&affine(&mesh, GRADIENT));
        for (point, value) in mesh.points().iter().zip(solver.values().as_chunks::<2>().0) {
            assert_eq!(solver.displacement_at(point), *value);
        }
        let [x, y] = [0.61, 0.4];
        let found = solver.displacement_at(&[x, y]);
        let expected = GRADIENT.map(|row| row[0] * x + row[1] * y);
        assert!((0..2).all(|i| (found[i] - expected[i]).abs() < 1e-13), "{kind:?}: {found:?}");
        let velocity = solver.velocity_at(&[x, y]);
        assert!((0..2).all(|i| (velocity[i] - expected[i]).abs() < 1e-13), "over a step of 1 s from rest");
        assert_eq!(solver.space().evaluate(&[2.0, 2.0], mesh.points()), None);
    }
}

#[test]
#[should_panic(expected = "lies outside the mesh")]
fn a_point_outside_has_no_displacement() {
    let solver = on_mesh(bent_square(CellKind::Triangle3, 1), bare(svk(1.0, 0.3)), quasi_static());
    let _ = solver.displacement_at(&[2.0, 0.0]);
}

#[test]
fn parts_that_the_space_does_not_have_are_refused_by_name() {
    let refusal = |space: Space<2>, clamped: Boundary| {
        let model = StructureModel { clamped, ..bare(svk(1.0, 0.3)) };
        with_hint(&StructureSolver::new(space, model, quasi_static()).err().expect("a refusal"))
    };
    let mesh = || Space::Lagrange(bent_square(CellKind::Quadrilateral4, 2));
    let patch = || Space::from(beam(1.0, 0.1, 2, 2));
    insta::assert_snapshot!(refusal(mesh(), "wall".into()), @r"
    the mesh has no boundary group `wall`
    hint: it has `left`, `right`, `bottom`, `top`
    ");
    insta::assert_snapshot!(refusal(mesh(), Side::LEFT.into()), @r"
    a mesh has no side `left`
    hint: it has boundary groups: `left`, `right`, `bottom`, `top`
    ");
    insta::assert_snapshot!(refusal(patch(), "left".into()), @r"
    a patch has no boundary group `left`
    hint: it has sides: left, right, bottom and top
    ");
    let one_cell = Space::Lagrange(bent_square(CellKind::Quadrilateral4, 1));
    assert!(refusal(one_cell, ["left", "right"].into()).contains("every node is held"));

    let mut model = bare(svk(1.0, 0.3));
    model.wetted = "top".into();
    let solver = on_mesh(bent_square(CellKind::Quadrilateral4, 2), model, quasi_static());
    let error = solver.interface_rows(&[[0.5, 0.5]], 1e-6).unwrap_err();
    assert!(matches!(error, StructureError::OffMesh(_)), "{error}");
    let dry = on_mesh(bent_square(CellKind::Quadrilateral4, 2), bare(svk(1.0, 0.3)), quasi_static());
    assert!(dry.interface_rows(&[[0.5, 0.5]], 1e-6).is_err());
}
