//! Reference cells: shape functions, quadrature and edges of triangles and quadrilaterals of degree 1 and 2.
//!
//! Triangles lie between (0, 0), (1, 0) and (0, 1), quadrilaterals in [-1, 1]^2, lines in [-1, 1]. A shape function is one
//! at its own node and zero at the others. Source: T. J. R. Hughes, *The Finite Element Method* (2000), sections 3.2 to
//! 3.7; the order of the nodes is that of [`CellKind`].

use partita_numerics::gauss;

use crate::cell::CellKind;

/// Most nodes of a cell.
pub const MAX_NODES: usize = 9;

/// Shape functions of one cell at one point of the reference cell; entries from the number of its nodes on are zero.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shape {
    /// `N_a`
    pub values: [f64; MAX_NODES],
    /// `(dN_a/dxi, dN_a/deta)`
    pub derivatives: [[f64; 2]; MAX_NODES],
}

/// Places of the nodes of a quadrilateral: corners, edges, middle.
const QUADRILATERAL: [[f64; 2]; 9] = [
    [-1.0, -1.0],
    [1.0, -1.0],
    [1.0, 1.0],
    [-1.0, 1.0],
    [0.0, -1.0],
    [1.0, 0.0],
    [0.0, 1.0],
    [-1.0, 0.0],
    [0.0, 0.0],
];

/// Places of the nodes of a triangle: corners, edges.
const TRIANGLE: [[f64; 2]; 6] = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.5, 0.0], [0.5, 0.5], [0.0, 0.5]];

/// Whether a plane solid can consist of such cells.
#[must_use]
pub const fn is_plane_solid(kind: CellKind) -> bool {
    match kind {
        CellKind::Triangle3
        | CellKind::Triangle6
        | CellKind::Quadrilateral4
        | CellKind::Quadrilateral8
        | CellKind::Quadrilateral9 => true,
        CellKind::Line2 | CellKind::Line3 | CellKind::Tetrahedron4 => false,
    }
}

/// Places of the nodes of a plane cell.
///
/// # Panics
/// If the kind is none of a plane solid; so do the other functions of this module.
#[must_use]
pub fn nodes(kind: CellKind) -> &'static [[f64; 2]] {
    match kind {
        CellKind::Triangle3 | CellKind::Triangle6 => &TRIANGLE[..kind.node_count()],
        CellKind::Quadrilateral4 | CellKind::Quadrilateral8 | CellKind::Quadrilateral9 => {
            &QUADRILATERAL[..kind.node_count()]
        }
        CellKind::Line2 | CellKind::Line3 | CellKind::Tetrahedron4 => not_plane(kind),
    }
}

/// Number of corners of a plane cell.
#[must_use]
pub fn corner_count(kind: CellKind) -> usize {
    edges(kind).len()
}

/// What an edge of a plane cell is: a line of two or three nodes.
#[must_use]
pub fn edge_kind(kind: CellKind) -> CellKind {
    match edges(kind)[0].len() {
        2 => CellKind::Line2,
        _ => CellKind::Line3,
    }
}

/// Local nodes of each edge, both ends first, in the direction that has the cell on its left.
#[must_use]
pub fn edges(kind: CellKind) -> &'static [&'static [usize]] {
    match kind {
        CellKind::Triangle3 => &[&[0, 1], &[1, 2], &[2, 0]],
        CellKind::Triangle6 => &[&[0, 1, 3], &[1, 2, 4], &[2, 0, 5]],
        CellKind::Quadrilateral4 => &[&[0, 1], &[1, 2], &[2, 3], &[3, 0]],
        CellKind::Quadrilateral8 | CellKind::Quadrilateral9 => {
            &[&[0, 1, 4], &[1, 2, 5], &[2, 3, 6], &[3, 0, 7]]
        }
        CellKind::Line2 | CellKind::Line3 | CellKind::Tetrahedron4 => not_plane(kind),
    }
}

/// Points and weights that integrate mass and stiffness of an undistorted cell exactly.
#[must_use]
pub fn quadrature(kind: CellKind) -> Vec<([f64; 2], f64)> {
    let triangle = |degree| gauss::triangle(degree).iter().map(|&([_, x, y], w)| ([x, y], 0.5 * w)).collect();
    let square = |n| {
        let line = gauss::line(n);
        let row = |&(y, wy): &(f64, f64)| {
            let points = line.iter().map(move |&(x, wx)| ([2.0 * x - 1.0, 2.0 * y - 1.0], 4.0 * wx * wy));
            points.collect::<Vec<_>>()
        };
        line.iter().flat_map(row).collect()
    };
    match kind {
        CellKind::Triangle3 => triangle(2),
        CellKind::Triangle6 => triangle(4),
        CellKind::Quadrilateral4 => square(2),
        CellKind::Quadrilateral8 | CellKind::Quadrilateral9 => square(3),
        CellKind::Line2 | CellKind::Line3 | CellKind::Tetrahedron4 => not_plane(kind),
    }
}

/// Shape functions and their derivatives at the point `xi` of the reference cell.
#[must_use]
pub fn shape(kind: CellKind, xi: [f64; 2]) -> Shape {
    let mut shape = Shape { values: [0.0; MAX_NODES], derivatives: [[0.0; 2]; MAX_NODES] };
    match kind {
        CellKind::Triangle3 => linear_triangle(xi, &mut shape),
        CellKind::Triangle6 => quadratic_triangle(xi, &mut shape),
        CellKind::Quadrilateral4 => product(&QUADRILATERAL[..4], linear, xi, &mut shape),
        CellKind::Quadrilateral8 => serendipity(xi, &mut shape),
        CellKind::Quadrilateral9 => product(&QUADRILATERAL, quadratic, xi, &mut shape),
        CellKind::Line2 | CellKind::Line3 | CellKind::Tetrahedron4 => not_plane(kind),
    }
    shape
}

/// Values and derivatives of the two or three shape functions of a line at s in [-1, 1]; the middle node comes last.
///
/// # Panics
/// If the kind is no line.
#[must_use]
pub fn line_shape(kind: CellKind, s: f64) -> [[f64; 2]; 3] {
    match kind {
        CellKind::Line2 => [linear(-1.0, s), linear(1.0, s), [0.0; 2]],
        CellKind::Line3 => [quadratic(-1.0, s), quadratic(1.0, s), quadratic(0.0, s)],
        _ => panic!("{kind:?} is no line"),
    }
}

fn not_plane(kind: CellKind) -> ! {
    panic!("{kind:?} is no cell of a plane solid")
}

/// Value and slope at s of the linear function on [-1, 1] that is one at the end `node`.
fn linear(node: f64, s: f64) -> [f64; 2] {
    [0.5 * (1.0 + node * s), 0.5 * node]
}

/// Value and slope at s of the quadratic function on [-1, 1] that is one at `node`, -1, 0 or 1.
fn quadratic(node: f64, s: f64) -> [f64; 2] {
    if node == 0.0 { [1.0 - s * s, -2.0 * s] } else { [0.5 * s * (s + node), s + 0.5 * node] }
}

/// `N_a = phi_a(xi) phi_a(eta)`
fn product(nodes: &[[f64; 2]], phi: fn(f64, f64) -> [f64; 2], [x, y]: [f64; 2], shape: &mut Shape) {
    for (a, node) in nodes.iter().enumerate() {
        let ([u, du], [v, dv]) = (phi(node[0], x), phi(node[1], y));
        shape.values[a] = u * v;
        shape.derivatives[a] = [du * v, u * dv];
    }
}

/// Corners `(1 + xi_a xi)(1 + eta_a eta)(xi_a xi + eta_a eta - 1)/4`, edges `(1 - xi^2)(1 + eta_a eta)/2` and likewise.
fn serendipity([x, y]: [f64; 2], shape: &mut Shape) {
    for (a, &[p, q]) in QUADRILATERAL[..8].iter().enumerate() {
        let ([u, du], [v, dv]) = if a < 4 {
            (linear(p, x), linear(q, y))
        } else if p == 0.0 {
            (quadratic(0.0, x), linear(q, y))
        } else {
            (linear(p, x), quadratic(0.0, y))
        };
        // What a corner's bilinear function has left over at the neighbouring edge nodes.
        let (cut, slope) = if a < 4 { (p * x + q * y - 1.0, [p, q]) } else { (1.0, [0.0; 2]) };
        shape.values[a] = u * v * cut;
        shape.derivatives[a] = [du * v * cut + u * v * slope[0], u * dv * cut + u * v * slope[1]];
    }
}

const TRIANGLE_SLOPES: [[f64; 2]; 3] = [[-1.0, -1.0], [1.0, 0.0], [0.0, 1.0]];

/// `N_a = L_a`, the barycentric coordinates.
fn linear_triangle([x, y]: [f64; 2], shape: &mut Shape) {
    shape.values[..3].copy_from_slice(&[1.0 - x - y, x, y]);
    shape.derivatives[..3].copy_from_slice(&TRIANGLE_SLOPES);
}

/// Corners `L_a (2 L_a - 1)`, edges `4 L_a L_b`.
fn quadratic_triangle([x, y]: [f64; 2], shape: &mut Shape) {
    let l = [1.0 - x - y, x, y];
    for a in 0..3 {
        let b = (a + 1) % 3;
        shape.values[a] = l[a] * (2.0 * l[a] - 1.0);
        shape.values[3 + a] = 4.0 * l[a] * l[b];
        for i in 0..2 {
            let (slope_a, slope_b) = (TRIANGLE_SLOPES[a][i], TRIANGLE_SLOPES[b][i]);
            shape.derivatives[a][i] = (4.0 * l[a] - 1.0) * slope_a;
            shape.derivatives[3 + a][i] = 4.0 * (l[a] * slope_b + slope_a * l[b]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    pub(super) const KINDS: [CellKind; 5] = [
        CellKind::Triangle3,
        CellKind::Triangle6,
        CellKind::Quadrilateral4,
        CellKind::Quadrilateral8,
        CellKind::Quadrilateral9,
    ];

    #[test]
    fn each_function_is_one_at_its_node_and_zero_at_the_others() {
        for kind in KINDS {
            for (b, &node) in nodes(kind).iter().enumerate() {
                let shape = shape(kind, node);
                for a in 0..MAX_NODES {
                    assert_relative_eq!(shape.values[a], if a == b { 1.0 } else { 0.0 }, epsilon = 1e-15);
                }
            }
        }
    }

    #[test]
    fn derivatives_are_those_of_the_values_and_the_sum_is_one() {
        let (xi, step) = ([0.27, 0.31], 1e-6);
        for kind in KINDS {
            let at = shape(kind, xi);
            assert_relative_eq!(at.values.iter().sum::<f64>(), 1.0, epsilon = 1e-15);
            for i in 0..2 {
                let moved = |step: f64| {
                    let mut moved = xi;
                    moved[i] += step;
                    shape(kind, moved).values
                };
                let (ahead, behind) = (moved(step), moved(-step));
                for a in 0..MAX_NODES {
                    let slope = (ahead[a] - behind[a]) / (2.0 * step);
                    assert_relative_eq!(at.derivatives[a][i], slope, epsilon = 1e-9);
                }
            }
        }
    }

    #[test]
    fn each_kind_holds_the_polynomials_of_its_degree() {
        let xi = [0.13, 0.44];
        for kind in KINDS {
            let degree = if kind.node_count() < 6 { 1 } else { 2 };
            for (p, q) in (0..=degree).flat_map(|p| (0..=degree - p).map(move |q| (p, q))) {
                let monomial = |[x, y]: [f64; 2]| x.powi(p) * y.powi(q);
                let shape = shape(kind, xi);
                let sum: f64 =
                    nodes(kind).iter().zip(shape.values).map(|(&node, value)| value * monomial(node)).sum();
                assert_relative_eq!(sum, monomial(xi), epsilon = 1e-15);
            }
        }
    }

    #[test]
    fn quadrature_is_exact_for_the_product_of_any_two_shape_functions() {
        // Against a rule of many points on the square, and on the triangle by x = u, y = v (1 - u).
        let many = gauss::line(8);
        for kind in KINDS {
            let is_triangle = corner_count(kind) == 3;
            let mut fine = Vec::new();
            for &(u, wu) in &many {
                for &(v, wv) in &many {
                    fine.push(if is_triangle {
                        ([u, v * (1.0 - u)], wu * wv * (1.0 - u))
                    } else {
                        ([2.0 * u - 1.0, 2.0 * v - 1.0], 4.0 * wu * wv)
                    });
                }
            }
            for a in 0..kind.node_count() {
                for b in 0..=a {
                    let integral = |rule: &[([f64; 2], f64)]| -> f64 {
                        rule.iter()
                            .map(|&(xi, w)| w * shape(kind, xi).values[a] * shape(kind, xi).values[b])
                            .sum()
                    };
                    assert_relative_eq!(integral(&quadrature(kind)), integral(&fine), epsilon = 1e-14);
                }
            }
        }
    }

    #[test]
    fn on_an_edge_only_its_nodes_count_and_they_make_the_functions_of_a_line() {
        for kind in KINDS {
            for edge in edges(kind) {
                let [start, end] = [edge[0], edge[1]].map(|a| nodes(kind)[a]);
                let s = 0.3;
                let xi = [0, 1].map(|i| 0.5 * (1.0 - s) * start[i] + 0.5 * (1.0 + s) * end[i]);
                let (whole, line) = (shape(kind, xi), line_shape(edge_kind(kind), s));
                for a in 0..kind.node_count() {
                    let expected = edge.iter().position(|&on_edge| on_edge == a).map_or(0.0, |k| line[k][0]);
                    assert_relative_eq!(whole.values[a], expected, epsilon = 1e-15);
                }
            }
        }
    }

    #[test]
    #[should_panic(expected = "Tetrahedron4 is no cell of a plane solid")]
    fn a_tetrahedron_has_no_place_in_the_plane() {
        let _ = shape(CellKind::Tetrahedron4, [0.0; 2]);
    }
}
