//! The element kernel against finite differences of itself.

use partita_fluid::kernel::facet::Facet;
use partita_fluid::kernel::{Element, Fields, Flow, Terms, shape};
use partita_fluid::settings::Tangent;
use partita_fluid::stabilization::Stabilization;
use partita_numerics::gauss;
use proptest::prelude::*;

const TANGENTS: [Tangent; 3] = [Tangent::Full, Tangent::FrozenTau, Tangent::Picard];

/// Of the central differences, in m/s and Pa.
const DIFFERENCE_STEP: f64 = 1e-5;

/// What acts on the element: its interior, and one kind of boundary term on each of its facets in turn.
#[derive(Debug, Clone, Copy)]
enum Part {
    Interior,
    Traction,
    DoNothing,
    Backflow,
}

/// An element with everything random, and what a tangent may hold.
#[derive(Debug, Clone)]
struct Case<const D: usize, const N: usize> {
    fields: Fields<D, N>,
    mesh_velocity: [[f64; D]; N],
    flow: Flow,
    traction: [[f64; D]; D],
}

impl<const D: usize, const N: usize> Case<D, N> {
    /// `numbers` in [-1, 1]: at least 6 N D of them.
    fn new(numbers: &[f64], steady: bool, tangent: Tangent) -> Self {
        let mut rest = numbers.iter().copied();
        let mut nodal = |scale: f64| -> [[f64; D]; N] {
            std::array::from_fn(|_| std::array::from_fn(|_| scale * rest.next().expect("enough numbers")))
        };
        let mut points = nodal(0.15);
        for (a, point) in points.iter_mut().enumerate().skip(1) {
            point[a - 1] += 1.0;
        }
        let (velocity, mesh_velocity) = (nodal(2.0), nodal(1.0));
        let mut fields = Fields {
            points,
            velocity,
            pressure: nodal(5.0).map(|p| p[0]),
            convective: velocity,
            history: nodal(if steady { 0.0 } else { 20.0 }),
            body_force: nodal(9.81),
        };
        fields.convective = difference(&velocity, &mesh_velocity);
        let traction = nodal(3.0);
        let flow = Flow {
            density: 1.3,
            viscosity: 0.07,
            inverse_constant: 36.0,
            grad_div: 0.7,
            rate: if steady { 0.0 } else { 15.0 },
            four_over_dt_squared: if steady { 0.0 } else { 400.0 },
            tangent,
        };
        Self { fields, mesh_velocity, flow, traction: std::array::from_fn(|k| traction[k]) }
    }

    /// The residual at other velocities and pressures, holding what the tangent holds.
    fn residual(&self, velocity: [[f64; D]; N], pressure: [f64; N], part: Part) -> Vec<f64> {
        let mut fields = Fields { velocity, pressure, ..self.fields };
        if self.flow.tangent != Tangent::Picard {
            fields.convective = difference(&velocity, &self.mesh_velocity);
        }
        let element = match self.flow.tangent {
            Tangent::Full => Element::new(&fields, &self.flow),
            Tangent::FrozenTau | Tangent::Picard => {
                Element::with_stabilization(&fields, &self.flow, self.held())
            }
        };
        flatten(&self.terms(&element, part, None))
    }

    /// Whether no flux through a quadrature point of a facet comes within a difference step of zero, where the backflow
    /// term has its kink and a difference is no derivative.
    fn keeps_off_the_kink(&self) -> bool {
        let (gradients, measure) = shape(&self.fields.points);
        let far = (1.0 - 1.0 / ((D + 1) as f64).sqrt()) / D as f64;
        let flux = |opposite: usize, near: usize| -> f64 {
            let through = |a: usize| -> f64 {
                let weight = if a == near { 1.0 - (D - 1) as f64 * far } else { far };
                (0..D).map(|i| -weight * gradients[opposite][i] * self.fields.convective[a][i]).sum()
            };
            D as f64 * measure * (0..N).filter(|&a| a != opposite).map(through).sum::<f64>()
        };
        let reach = |opposite: usize| {
            let area = D as f64 * measure * gradients[opposite].iter().map(|g| g * g).sum::<f64>().sqrt();
            2.0 * DIFFERENCE_STEP * area
        };
        (0..N).all(|o| (0..N).filter(|&a| a != o).all(|near| flux(o, near).abs() > reach(o)))
    }

    fn held(&self) -> Stabilization<D> {
        *Element::new(&self.fields, &self.flow).stabilization()
    }

    fn terms(&self, element: &Element<D, N>, part: Part, mut tangent: Option<&mut [f64]>) -> Terms<D, N> {
        if matches!(part, Part::Interior) {
            return element.residual();
        }
        let mut terms = Terms::ZERO;
        for opposite in 0..N {
            let mut facet = Facet { element, opposite, terms: &mut terms, tangent: tangent.as_deref_mut() };
            match part {
                Part::Interior => {}
                Part::Traction => facet.traction(&self.traction),
                Part::DoNothing => facet.do_nothing(),
                Part::Backflow => facet.backflow(),
            }
        }
        terms
    }

    fn tangent(&self, part: Part) -> Vec<f64> {
        let size = N * (D + 1);
        let mut matrix = vec![0.0; size * size];
        let element = Element::new(&self.fields, &self.flow);
        if matches!(part, Part::Interior) {
            element.tangent(&mut matrix);
        } else {
            self.terms(&element, part, Some(&mut matrix));
        }
        matrix
    }

    fn differenced(&self, part: Part) -> Vec<f64> {
        let size = N * (D + 1);
        let mut matrix = vec![0.0; size * size];
        let step = DIFFERENCE_STEP;
        for column in 0..size {
            let shifted = |by: f64| {
                let (mut velocity, mut pressure) = (self.fields.velocity, self.fields.pressure);
                match (column / (D + 1), column % (D + 1)) {
                    (a, i) if i < D => velocity[a][i] += by,
                    (a, _) => pressure[a] += by,
                }
                self.residual(velocity, pressure, part)
            };
            let (plus, minus) = (shifted(step), shifted(-step));
            for row in 0..size {
                matrix[row * size + column] = (plus[row] - minus[row]) / (2.0 * step);
            }
        }
        matrix
    }

    /// The largest difference of the two, each entry relative to the largest of its kind (momentum or
    /// continuity by velocity or pressure).
    fn defect(&self, part: Part) -> f64 {
        let (tangent, differenced) = (self.tangent(part), self.differenced(part));
        let size = N * (D + 1);
        let kind = |k: usize| {
            let pressure = |i: usize| usize::from(i % (D + 1) == D);
            2 * pressure(k / size) + pressure(k % size)
        };
        let mut largest = [f64::MIN_POSITIVE; 4];
        let mut defect = [0.0_f64; 4];
        for k in 0..size * size {
            largest[kind(k)] = largest[kind(k)].max(differenced[k].abs());
            defect[kind(k)] = defect[kind(k)].max((tangent[k] - differenced[k]).abs());
        }
        // A kind without entries (a facet has none by pressure) must be zero in both.
        (0..4).map(|i| if defect[i] == 0.0 { 0.0 } else { defect[i] / largest[i] }).fold(0.0, f64::max)
    }
}

fn difference<const D: usize, const N: usize>(u: &[[f64; D]; N], w: &[[f64; D]; N]) -> [[f64; D]; N] {
    std::array::from_fn(|a| std::array::from_fn(|i| u[a][i] - w[a][i]))
}

fn flatten<const D: usize, const N: usize>(terms: &Terms<D, N>) -> Vec<f64> {
    (0..N).flat_map(|a| terms.momentum_sum(a).into_iter().chain([terms.continuity_sum(a)])).collect()
}

fn check<const D: usize, const N: usize>(numbers: &[f64], steady: bool) {
    for tangent in TANGENTS {
        let case = Case::<D, N>::new(numbers, steady, tangent);
        for part in [Part::Interior, Part::Traction, Part::DoNothing, Part::Backflow] {
            if matches!(part, Part::Backflow) && !case.keeps_off_the_kink() {
                continue;
            }
            let defect = case.defect(part);
            assert!(defect < 1e-6, "{tangent:?}, {part:?}: {defect:.1e}");
        }
    }
}

fn numbers() -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec(-1.0..1.0, 6 * 4 * 3 + 12)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn tangent_is_derivative_of_residual_in_2d(numbers in numbers(), steady in any::<bool>()) {
        check::<2, 3>(&numbers, steady);
    }

    #[test]
    fn tangent_is_derivative_of_residual_in_3d(numbers in numbers(), steady in any::<bool>()) {
        check::<3, 4>(&numbers, steady);
    }
}

/// At rest without a time step tau has only its viscous part; its slope is zero, and nothing divides by zero.
#[test]
fn steady_rest_gives_finite_residual_and_tangent() {
    for tangent in TANGENTS {
        let mut case = Case::<2, 3>::new(&[0.3; 84], true, tangent);
        case.fields.velocity = [[0.0; 2]; 3];
        case.fields.convective = [[0.0; 2]; 3];
        case.mesh_velocity = [[0.0; 2]; 3];
        assert!(case.tangent(Part::Interior).iter().all(|x| x.is_finite()));
        assert!(case.defect(Part::Interior) < 1e-6);
    }
}

#[test]
fn residual_and_tangent_do_not_know_the_numbering() {
    let numbers: Vec<f64> = (0..84).map(|k| f64::sin(f64::from(k * k))).collect();
    let case = Case::<2, 3>::new(&numbers, false, Tangent::Full);
    let turn = |nodal: [[f64; 2]; 3]| [nodal[2], nodal[0], nodal[1]];
    let [a, b, c] = case.fields.pressure;
    let mut turned = case.clone();
    turned.mesh_velocity = turn(case.mesh_velocity);
    turned.fields = Fields {
        points: turn(case.fields.points),
        velocity: turn(case.fields.velocity),
        pressure: [c, a, b],
        convective: turn(case.fields.convective),
        history: turn(case.fields.history),
        body_force: turn(case.fields.body_force),
    };
    let (matrix, turned_matrix) = (case.tangent(Part::Interior), turned.tangent(Part::Interior));
    let old = |dof: usize| (dof + 6) % 9;
    let largest = matrix.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    for (k, entry) in turned_matrix.iter().enumerate() {
        let same = matrix[old(k / 9) * 9 + old(k % 9)];
        assert!((entry - same).abs() < 1e-13 * largest, "entry {k}: {entry} and {same}");
    }
    let residual = case.residual(case.fields.velocity, case.fields.pressure, Part::Interior);
    let turned = turned.residual(turned.fields.velocity, turned.fields.pressure, Part::Interior);
    for dof in 0..9 {
        assert!((turned[dof] - residual[old(dof)]).abs() < 1e-12, "row {dof}");
    }
}

/// The weak form as it stands in the book, by quadrature of degree four: nothing of the kernel but tau.
fn weak_form<const D: usize, const N: usize>(case: &Case<D, N>, points: &[([f64; N], f64)]) -> Vec<f64> {
    let Case { fields, flow, .. } = case;
    let (gradients, measure) = shape(&fields.points);
    let tau = case.held();
    let slope =
        |value: &dyn Fn(usize) -> f64, j: usize| (0..N).map(|a| value(a) * gradients[a][j]).sum::<f64>();
    let velocity_slope = |i: usize, j: usize| slope(&|a| fields.velocity[a][i], j);
    let divergence: f64 = (0..D).map(|i| velocity_slope(i, i)).sum();
    let mut residual = vec![0.0; N * (D + 1)];
    for (barycentric, weight) in points {
        let at = |nodal: &[[f64; D]; N], i: usize| (0..N).map(|a| barycentric[a] * nodal[a][i]).sum::<f64>();
        let pressure: f64 = (0..N).map(|a| barycentric[a] * fields.pressure[a]).sum();
        let inertia: [f64; D] = std::array::from_fn(|i| {
            let rate = flow.rate * at(&fields.velocity, i) + at(&fields.history, i);
            let convection: f64 = (0..D).map(|j| at(&fields.convective, j) * velocity_slope(i, j)).sum();
            flow.density * (rate + convection - at(&fields.body_force, i))
        });
        let strong: [f64; D] = std::array::from_fn(|i| inertia[i] + slope(&|a| fields.pressure[a], i));
        for a in 0..N {
            let along: f64 = (0..D).map(|j| at(&fields.convective, j) * gradients[a][j]).sum();
            for i in 0..D {
                let viscous: f64 = (0..D)
                    .map(|j| flow.viscosity * (velocity_slope(i, j) + velocity_slope(j, i)) * gradients[a][j])
                    .sum();
                let galerkin = barycentric[a] * inertia[i] + viscous - pressure * gradients[a][i];
                let stabilization =
                    tau.momentum * along * strong[i] + tau.continuity * gradients[a][i] * divergence;
                residual[a * (D + 1) + i] += weight * measure * (galerkin + stabilization);
            }
            let smoothing: f64 = (0..D).map(|i| gradients[a][i] * strong[i]).sum();
            residual[a * (D + 1) + D] +=
                weight * measure * (barycentric[a] * divergence + tau.momentum / flow.density * smoothing);
        }
    }
    residual
}

fn assert_is_weak_form<const D: usize, const N: usize>(numbers: &[f64], points: &[([f64; N], f64)]) {
    let case = Case::<D, N>::new(numbers, false, Tangent::Full);
    let found = case.residual(case.fields.velocity, case.fields.pressure, Part::Interior);
    let expected = weak_form(&case, points);
    let size = expected.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
    for (row, (found, expected)) in found.iter().zip(&expected).enumerate() {
        assert!((found - expected).abs() < 1e-13 * size, "row {row}: {found} and {expected}");
    }
}

#[test]
fn residual_is_the_weak_form_by_quadrature() {
    let numbers: Vec<f64> = (0..84).map(|k| f64::sin(f64::from(5 * k * k))).collect();
    assert_is_weak_form::<2, 3>(&numbers, gauss::triangle(4));
    assert_is_weak_form::<3, 4>(&numbers, gauss::tetrahedron(4));
}

/// On one element, the sum over the test functions of the momentum rows is the integral of the strong form
/// without stresses: the stabilization terms, like the stresses, drop out.
#[test]
fn momentum_rows_of_an_element_sum_to_its_inertia() {
    let numbers: Vec<f64> = (0..84).map(|k| f64::cos(f64::from(3 * k * k))).collect();
    let case = Case::<3, 4>::new(&numbers, false, Tangent::Full);
    let element = Element::new(&case.fields, &case.flow);
    let terms = element.residual();
    for i in 0..3 {
        let rows: f64 = (0..4).map(|a| terms.momentum_sum(a)[i]).sum();
        let inertia: f64 = (0..4).flat_map(|a| terms.momentum[a][i][..3].to_vec()).sum();
        assert!((rows - inertia).abs() < 1e-12);
    }
}

/// Uniform flow in through a facet: one half of rho (-c.n) u times its area, shared by its nodes alike.
#[test]
fn backflow_takes_out_the_energy_that_enters() {
    let mut case = Case::<2, 3>::new(&[0.1; 84], false, Tangent::Full);
    case.fields.velocity = [[2.0, 0.5]; 3];
    case.fields.convective = [[2.0, 0.5]; 3];
    let element = Element::new(&case.fields, &case.flow);
    let [from, to] = [case.fields.points[2], case.fields.points[0]];
    let outflux = 2.0 * (to[1] - from[1]) - 0.5 * (to[0] - from[0]);
    assert!(outflux < 0.0, "the flow enters through the facet opposite to node 1");
    let mut terms = Terms::ZERO;
    Facet { element: &element, opposite: 1, terms: &mut terms, tangent: None }.backflow();
    for (a, share) in [(0, 0.5), (1, 0.0), (2, 0.5)] {
        let row = terms.momentum_sum(a);
        for i in 0..2 {
            let expected = -0.5 * 1.3 * outflux * [2.0, 0.5][i] * share;
            assert!((row[i] - expected).abs() < 1e-14, "{row:?}");
        }
    }
    // Nothing where it leaves.
    let mut terms = Terms::ZERO;
    Facet { element: &element, opposite: 0, terms: &mut terms, tangent: None }.backflow();
    assert_eq!(terms, Terms::ZERO);
}
