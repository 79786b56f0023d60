//! Geometry of one simplex with `D + 1` vertices in `D` dimensions.
//!
//! With the edge vectors `e_i = x_i - x_0` as columns of `A`, the signed measure is `det A / D!` and the
//! gradients of the linear shape functions are `grad N_i = A^-T` column `i` for `i > 0`,
//! `grad N_0 = -sum_i grad N_i`.

use partita_numerics::small;

/// Most vertices a simplex has here: those of a tetrahedron.
pub const MAX_VERTICES: usize = 4;

/// The vertices of a cell, gathered from the points of a mesh; entries from `D + 1` on are zero.
///
/// # Panics
/// If `nodes` does not hold `D + 1` nodes.
#[must_use]
pub fn vertices<const D: usize>(points: &[[f64; D]], nodes: &[usize]) -> [[f64; D]; MAX_VERTICES] {
    assert_eq!(nodes.len(), D + 1, "a simplex in {D} dimensions has {} nodes", D + 1);
    let mut vertices = [[0.0; D]; MAX_VERTICES];
    for (vertex, &node) in vertices.iter_mut().zip(nodes) {
        *vertex = points[node];
    }
    vertices
}

/// Signed length, area or volume `det A / D!`; positive for counter-clockwise triangles.
///
/// Only the first `D + 1` entries of `vertices` are read.
///
/// ```
/// use partita_mesh::simplex::measure;
/// assert_eq!(measure(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]), 0.5);
/// ```
#[must_use]
pub fn measure<const D: usize>(vertices: &[[f64; D]]) -> f64 {
    small::determinant(&edges(vertices)) / factorial(D)
}

/// Gradients `[1/m]` of the `D + 1` linear shape functions and the signed measure `det A / D!`, or `None`
/// where the measure is zero or not finite.
#[must_use]
pub fn gradients<const D: usize>(vertices: &[[f64; D]]) -> Option<([[f64; D]; MAX_VERTICES], f64)> {
    let (inverse, determinant) = small::inverse(&edges(vertices))?;
    let mut gradients = [[0.0; D]; MAX_VERTICES];
    for a in 0..D {
        for i in 0..D {
            gradients[a + 1][i] = inverse[i][a];
            gradients[0][i] -= inverse[i][a];
        }
    }
    Some((gradients, determinant / factorial(D)))
}

/// Mean of the vertices.
#[must_use]
pub fn centroid<const D: usize>(vertices: &[[f64; D]]) -> [f64; D] {
    let mut centroid = [0.0; D];
    for vertex in vertices {
        for i in 0..D {
            centroid[i] += vertex[i] / vertices.len() as f64;
        }
    }
    centroid
}

/// Sum of the squared lengths of all `D (D + 1) / 2` edges `[m^2]`.
#[must_use]
pub fn squared_edges<const D: usize>(vertices: &[[f64; D]]) -> f64 {
    let mut sum = 0.0;
    for b in 1..=D {
        for a in 0..b {
            sum += difference(&vertices[b], &vertices[a]).iter().map(|x| x * x).sum::<f64>();
        }
    }
    sum
}

pub(crate) fn difference<const D: usize>(a: &[f64; D], b: &[f64; D]) -> [f64; D] {
    std::array::from_fn(|i| a[i] - b[i])
}

/// Row `i` holds the edge `x_{i+1} - x_0`: the transpose of `A`.
fn edges<const D: usize>(vertices: &[[f64; D]]) -> [[f64; D]; D] {
    std::array::from_fn(|a| difference(&vertices[a + 1], &vertices[0]))
}

const fn factorial(dimension: usize) -> f64 {
    match dimension {
        1 => 1.0,
        2 => 2.0,
        _ => 6.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    const TETRAHEDRON: [[f64; 3]; 4] = [[0.1, 0.2, 0.0], [1.3, 0.1, 0.2], [0.2, 0.9, -0.1], [0.3, 0.4, 1.1]];

    #[test]
    fn measure_of_the_unit_simplex_is_one_over_factorial() {
        assert_relative_eq!(measure(&[[0.0], [1.0]]), 1.0);
        assert_relative_eq!(measure(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]), 0.5);
        let unit = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        assert_relative_eq!(measure(&unit), 1.0 / 6.0);
    }

    #[test]
    fn swapping_two_vertices_turns_the_sign() {
        let mut swapped = TETRAHEDRON;
        swapped.swap(1, 2);
        assert_relative_eq!(measure(&swapped), -measure(&TETRAHEDRON), max_relative = 1e-14);
    }

    #[test]
    fn gradients_reproduce_a_linear_field() {
        let slope = [2.0, -3.0, 0.5];
        let field = |x: &[f64; 3]| 1.0 + (0..3).map(|i| slope[i] * x[i]).sum::<f64>();
        let (gradients, volume) = gradients(&TETRAHEDRON).expect("a tetrahedron with a volume");
        for i in 0..3 {
            let found: f64 = (0..4).map(|a| field(&TETRAHEDRON[a]) * gradients[a][i]).sum();
            assert_relative_eq!(found, slope[i], max_relative = 1e-13);
        }
        assert_relative_eq!(volume, measure(&TETRAHEDRON), max_relative = 1e-14);
    }

    #[test]
    fn a_flat_simplex_has_no_gradients() {
        assert_eq!(gradients(&[[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]]), None);
    }

    #[test]
    fn edges_of_the_unit_triangle() {
        assert_relative_eq!(squared_edges(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]), 4.0);
    }
}
