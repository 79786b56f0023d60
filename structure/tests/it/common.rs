//! Patches, models and matrices that several tests need.
use partita_numerics::Field;

use partita_iga::{Knots, Side, Spline, build};
use partita_mesh::generate::{SolidRectangle, solid_rectangle};
use partita_mesh::{CellKind, SolidMesh};
use partita_numerics::newton::{self, Limit, Problem, Verdict};
use partita_structure::{
    BodyForce, Boundary, Law, Material, Plane, Space, StructureModel, StructureSettings, StructureSolver,
    TimeScheme,
};

pub(crate) const RADII: [f64; 3] = [0.0, 0.5, 1.0];

pub(crate) fn svk(young_modulus: f64, poisson_ratio: f64) -> Material {
    Material::new(Law::StVenantKirchhoff, young_modulus, poisson_ratio, Plane::Strain).unwrap()
}

pub(crate) fn linear(young_modulus: f64, poisson_ratio: f64) -> Material {
    Material::new(Law::LinearElastic, young_modulus, poisson_ratio, Plane::Strain).unwrap()
}

pub(crate) fn neo_hookean(young_modulus: f64, poisson_ratio: f64) -> Material {
    Material::new(Law::NeoHookean, young_modulus, poisson_ratio, Plane::Strain).unwrap()
}

/// A model of density 1 without loads, supports and interface.
pub(crate) fn bare<const D: usize>(material: Material) -> StructureModel<D> {
    StructureModel {
        density: 1.0,
        material: material.into(),
        body_force: BodyForce::NONE,
        clamped: Boundary::NONE,
        held: Vec::new(),
        wetted: Boundary::NONE,
    }
}

pub(crate) fn quasi_static() -> StructureSettings {
    StructureSettings { time: TimeScheme::QuasiStatic, ..Default::default() }
}

pub(crate) fn dynamic(spectral_radius: f64) -> StructureSettings {
    stepped_by(generalized_alpha(spectral_radius))
}

pub(crate) fn generalized_alpha(spectral_radius: f64) -> TimeScheme {
    TimeScheme::GeneralizedAlpha { spectral_radius }
}

pub(crate) fn stepped_by(time: TimeScheme) -> StructureSettings {
    StructureSettings { time, ..Default::default() }
}

pub(crate) fn solver<const D: usize>(
    patch: Spline<D>,
    model: StructureModel<D>,
    settings: StructureSettings,
) -> StructureSolver<D> {
    StructureSolver::new(patch.into(), model, settings).unwrap()
}

pub(crate) fn on_mesh(
    mesh: SolidMesh<2>,
    model: StructureModel<2>,
    settings: StructureSettings,
) -> StructureSolver<2> {
    StructureSolver::new(Space::Lagrange(mesh), model, settings).unwrap()
}

/// The cells that a plane solid can have.
pub(crate) const KINDS: [CellKind; 5] = [
    CellKind::Triangle3,
    CellKind::Triangle6,
    CellKind::Quadrilateral4,
    CellKind::Quadrilateral8,
    CellKind::Quadrilateral9,
];

/// The unit square in n x n squares of any kind of cells, every node moved by `shape`.
pub(crate) fn shaped_square(kind: CellKind, n: usize, shape: impl Fn(&[f64; 2]) -> [f64; 2]) -> SolidMesh<2> {
    let square = SolidRectangle { origin: [0.0; 2], size: [1.0; 2], divisions: [n, n] };
    let mesh = solid_rectangle(&square, kind).unwrap();
    mesh.with_points(mesh.points().iter().map(shape).collect()).unwrap()
}

/// The unit square with curved sides but the left one, which is straight; the edges inside are curved, too.
pub(crate) fn bent_square(kind: CellKind, n: usize) -> SolidMesh<2> {
    shaped_square(kind, n, |&[x, y]| {
        [x + 0.1 * (3.0 * y).sin() * x * (1.5 - x), y + 0.15 * x * x + 0.05 * (4.0 * x).sin() * y]
    })
}

/// Solves a quasi-static structure under its body force as far as the arithmetic goes.
///
/// The last bit of the displacement of a slender body changes its residual by more than any tight bound (K times the
/// rounding of d, see `newton_loop`), so that a fixed number of iterations takes the place of a bound.
pub(crate) fn settle<const D: usize>(solver: &mut StructureSolver<D>) {
    solver.begin_step(1.0, 1.0).expect("a step");
    let settings = *solver.newton_settings();
    let report = newton::solve(solver, &settings, Limit::AtMost(12), |_, _| Verdict::Continue).unwrap();
    assert!(report.exit.relative < 1e-6, "{report:?}");
}

/// Weights of a distorted patch.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Weights {
    Equal,
    Unequal,
}

impl Weights {
    fn at(self, phase: f64) -> f64 {
        match self {
            Self::Equal => 1.0,
            Self::Unequal => 1.0 + 0.4 * phase.sin(),
        }
    }
}

/// The unit square as a patch of degree 2 and 3 with 3 x 2 elements of different sizes, its inner control points
/// moved; its sides are straight.
pub(crate) fn distorted_square(weights: Weights) -> Spline<2> {
    let knots = vec![
        Knots::new(2, vec![0.0, 0.0, 0.0, 0.3, 0.55, 1.0, 1.0, 1.0]).unwrap(),
        Knots::new(3, vec![0.0, 0.0, 0.0, 0.0, 0.6, 1.0, 1.0, 1.0, 1.0]).unwrap(),
    ];
    let (columns, rows) = (knots[0].greville(), knots[1].greville());
    let (mut points, mut at_points) = (vec![], vec![]);
    for &y in &rows {
        for &x in &columns {
            let bump = x * (1.0 - x) * y * (1.0 - y);
            points.push([x + 1.5 * bump * (5.0 * y).sin(), y + 1.2 * bump * (4.0 * x).cos()]);
            at_points.push(weights.at(7.0 * x + 3.0 * y));
        }
    }
    Spline::rational(knots, points, at_points).unwrap()
}

/// The unit cube of degree (2, 1, 2), distorted and weighted likewise.
pub(crate) fn distorted_cube(weights: Weights) -> Spline<3> {
    let knots = [(2, 2), (1, 2), (2, 1)].map(|(degree, elements)| Knots::uniform(degree, elements).unwrap());
    let greville = [0, 1, 2].map(|i| knots[i].greville());
    let (mut points, mut at_points) = (vec![], vec![]);
    for &z in &greville[2] {
        for &y in &greville[1] {
            for &x in &greville[0] {
                let bump = x * (1.0 - x) * y * (1.0 - y) * z * (1.0 - z);
                points.push([x + 2.0 * bump * (5.0 * y).sin(), y - 2.0 * bump, z + 3.0 * bump * x]);
                at_points.push(weights.at(7.0 * x + 3.0 * y - 2.0 * z));
            }
        }
    }
    Spline::rational(knots.to_vec(), points, at_points).unwrap()
}

/// A beam along x from the origin, its axis at mid-height.
pub(crate) fn beam(length: f64, height: f64, degree: usize, elements: usize) -> Spline<2> {
    build::rectangle([0.0, -0.5 * height], [length, height], [degree, degree], [elements, 1]).unwrap()
}

/// A field evaluated at the control points, as a vector over all dofs.
pub(crate) fn at_control_points<const D: usize>(
    patch: &Spline<D>,
    field: impl Fn(&[f64; D]) -> [f64; D],
) -> Vec<f64> {
    patch.control_points().iter().flat_map(field).collect()
}

/// Smooth numbers between -1 and 1 that look random.
pub(crate) fn noise(count: usize, seed: f64) -> Vec<f64> {
    (0..count).map(|i| (12.9898 * (i as f64 + 1.0) + 78.233 * seed).sin()).collect()
}

/// The tangent of the last assembly as a dense matrix over the free dofs, row by row.
pub(crate) fn dense_tangent<const D: usize>(solver: &StructureSolver<D>) -> Vec<Vec<f64>> {
    let (pattern, values) = solver.tangent();
    let mut dense = vec![vec![0.0; pattern.size()]; pattern.size()];
    for column in 0..pattern.size() {
        for slot in pattern.col_ptr()[column]..pattern.col_ptr()[column + 1] {
            dense[pattern.row_idx()[slot]][column] = values[slot];
        }
    }
    dense
}

/// Stiffness K and mass M in the reference configuration, read off the tangents of two schemes.
pub(crate) fn stiffness_and_mass<const D: usize>(
    patch: &Spline<D>,
    model: &StructureModel<D>,
) -> (Vec<Vec<f64>>, Vec<Vec<f64>>) {
    let tangent = |settings| {
        let mut solver = solver(patch.clone(), model.clone(), settings);
        solver.begin_step(1.0, 1.0).expect("a step");
        solver.assemble(true).unwrap();
        dense_tangent(&solver)
    };
    let stiffness = tangent(quasi_static());
    // Radius 1 and dt = 1: alpha_m = alpha_f = 1/2, beta = 1/4, so that the tangent is 2 M + K/2.
    let mut mass = tangent(dynamic(1.0));
    for (row, k) in mass.iter_mut().zip(&stiffness) {
        row.iter_mut().zip(k).for_each(|(m, k)| *m = 0.5 * (*m - 0.5 * k));
    }
    (stiffness, mass)
}

/// Consistent control-point forces `(R_a, P N)` of one uniform first Piola-Kirchhoff stress on sides of a plane patch,
/// summed over the sides, on all dofs; integrated with many Gauss points on each side.
pub(crate) fn traction_of_uniform_stress(
    patch: &Spline<2>,
    sides: &[Side],
    stress: [[f64; 2]; 2],
) -> Vec<f64> {
    use partita_iga::{BasisValues, Derivatives, End};
    let mut force = vec![0.0; patch.control_points().len() * 2];
    for &side in sides {
        let (curve, nodes) = patch.side(side);
        let mut basis = BasisValues::new(&curve);
        // The tangent turned by a right angle points outwards on `right` and `bottom`.
        let outwards = if (side.parameter == 0) == (side.end == End::End) { 1.0 } else { -1.0 };
        for element in curve.elements() {
            for (unit, weight) in partita_numerics::gauss::line(12) {
                let xi = element.at([unit]);
                curve.basis_on(element.index(), &xi, Derivatives::First, &mut basis);
                let [[tx, ty], ..] = basis.first_of(curve.control_points());
                let normal = [outwards * ty, -outwards * tx];
                for (&a, value) in basis.active().iter().zip(basis.values()) {
                    for i in 0..2 {
                        let traction = stress[i][0] * normal[0] + stress[i][1] * normal[1];
                        force[2 * nodes[a] + i] += weight * element.measure() * value * traction;
                    }
                }
            }
        }
    }
    force
}

pub(crate) fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |largest, value| largest.max(value.abs()))
}

/// Circular frequencies [rad/s], ascending, and mass-normalized modes over the free dofs of the linear vibrations about
/// the reference configuration.
pub(crate) fn modes<const D: usize>(
    patch: &Spline<D>,
    model: &StructureModel<D>,
) -> (Vec<f64>, Vec<Vec<f64>>) {
    use nalgebra::{DMatrix, SymmetricEigen};
    let (k, m) = stiffness_and_mass(patch, model);
    let dense = |rows: &[Vec<f64>]| DMatrix::from_fn(rows.len(), rows.len(), |i, j| rows[i][j]);
    // M = L L^T turns K phi = omega^2 M phi into L^-1 K L^-T psi = omega^2 psi, phi = L^-T psi.
    let l = dense(&m).cholesky().expect("a mass is positive definite").l();
    let half = l.solve_lower_triangular(&dense(&k)).unwrap();
    let standard = l.solve_lower_triangular(&half.transpose()).unwrap();
    let eigen = SymmetricEigen::new(0.5 * (&standard + standard.transpose()));
    let shapes = l.transpose().solve_upper_triangular(&eigen.eigenvectors).unwrap();
    let mut order: Vec<usize> = (0..k.len()).collect();
    order.sort_by(|&a, &b| eigen.eigenvalues[a].total_cmp(&eigen.eigenvalues[b]));
    let frequencies = order.iter().map(|&i| eigen.eigenvalues[i].sqrt()).collect();
    (frequencies, order.iter().map(|&i| shapes.column(i).iter().copied().collect()).collect())
}
