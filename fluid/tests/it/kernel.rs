//! The element kernel against finite differences of itself.

use partita_fluid::kernel::facet::Facet;
use partita_fluid::kernel::{Element, Fields, Flow, Terms};
use partita_fluid::settings::Tangent;
use partita_fluid::stabilization::Stabilization;
use proptest::prelude::*;

const TANGENTS: [Tangent; 3] = [Tangent::Full, Tangent::FrozenTau, Tangent::Picard];

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
        let step = 1e-5;
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
            let defect = case.defect(part);
            assert!(defect < 1e-6, "{tangent:?}, {part:?}: {defect:.1e}");
        }
    }
}

/// Backflow has a kink where the flux through a quadrature point changes sign; random data meets it only by
/// chance, and then within one difference step.
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
