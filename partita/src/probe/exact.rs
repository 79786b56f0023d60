//! Distance of a flow from an exact solution.

use partita_mesh::{Cells, simplex};
use partita_numerics::gauss;

use partita_scene::schema::Known;

/// Degree of the quadrature: the square of a linear function times a curve, well below the errors that are measured.
const DEGREE: usize = gauss::TRIANGLE_DEGREE;

/// Root mean square errors of velocity \[m/s\] and pressure \[Pa\] at `time` \[s\]:
///
/// ```text
/// sqrt( integral |u_h - u|^2 / area ),   sqrt( integral (p_h - p)^2 / area )
/// ```
///
/// over triangles with nodes at `points`; the nodal values are `node * 3 + (u, v, p)`.
pub(super) fn errors(
    known: &Known,
    cells: &Cells,
    points: &[[f64; 2]],
    values: &[f64],
    time: f64,
) -> [f64; 2] {
    let (mut velocity, mut pressure, mut area) = (0.0, 0.0, 0.0);
    for nodes in cells {
        let vertices = simplex::vertices(points, nodes);
        let measure = simplex::measure(&vertices[..3]);
        area += measure;
        for (weights, share) in gauss::triangle(DEGREE) {
            let x = [0, 1].map(|c| (0..3).map(|a| weights[a] * vertices[a][c]).sum::<f64>());
            let field = |c: usize| (0..3).map(|a| weights[a] * values[3 * nodes[a] + c]).sum::<f64>();
            let [u, v] = known.velocity.value(&x, time);
            velocity += share * measure * ((field(0) - u).powi(2) + (field(1) - v).powi(2));
            pressure += share * measure * (field(2) - known.pressure.value(&x, time)).powi(2);
        }
    }
    [velocity, pressure].map(|sum: f64| (sum / area).sqrt())
}

#[cfg(test)]
mod tests {
    use partita_mesh::Mesh;
    use partita_mesh::generate::{Diagonal, RectangleMesh, rectangle};

    use super::*;
    use partita_scene::expression::Expression;
    use partita_scene::schema::{Formula, VectorFormula};

    fn formula(text: &str) -> Formula {
        Formula::Expression(Expression::parse(text).expect("a formula"))
    }

    fn mesh() -> Mesh<2> {
        let description = RectangleMesh {
            origin: [0.0; 2],
            size: [2.0, 1.0],
            divisions: [3, 2],
            pattern: Diagonal::Crossed,
        };
        rectangle(&description).expect("a rectangle")
    }

    fn distances(velocity: [&str; 2], pressure: &str, nodal: impl Fn(&[f64; 2]) -> [f64; 3]) -> [f64; 2] {
        let known = Known { velocity: VectorFormula(velocity.map(formula)), pressure: formula(pressure) };
        let mesh = mesh();
        let values: Vec<f64> = mesh.points().iter().flat_map(nodal).collect();
        errors(&known, mesh.cells(), mesh.points(), &values, 0.5)
    }

    #[test]
    fn a_linear_flow_has_no_distance_from_itself() {
        let found = distances(["x + t", "2*y"], "3*x - y", |[x, y]| [x + 0.5, 2.0 * y, 3.0 * x - y]);
        assert!(found.iter().all(|error| *error < 1e-14), "{found:?}");
    }

    #[test]
    fn distances_are_root_mean_squares_over_the_area() {
        // Off by (0.3, 0.4) in velocity; by x in pressure, whose mean square on [0, 2] is 4/3.
        let [velocity, pressure] = distances(["x", "y"], "0", |&[x, y]| [x + 0.3, y - 0.4, x]);
        assert!((velocity - 0.5).abs() < 1e-14, "{velocity}");
        assert!((pressure - (4.0_f64 / 3.0).sqrt()).abs() < 1e-14, "{pressure}");
    }
}
