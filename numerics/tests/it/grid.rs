//! Systems of the size and kind the fields assemble: linear triangles on a structured grid of the unit square.

use partita_numerics::{Connectivity, DofMap, Pattern, Scatter};

/// A matrix over its pattern, with the dofs it was built from.
pub(crate) struct System {
    pub(crate) dofs: DofMap,
    pub(crate) pattern: Pattern,
    pub(crate) values: Vec<f64>,
}

impl System {
    /// Assembles the same element matrix for each triangle of one orientation.
    pub(crate) fn assemble(
        triangles: &Connectivity,
        prescribed: &[bool],
        element: impl Fn(usize) -> Vec<f64>,
    ) -> Self {
        let dofs = DofMap::new(prescribed);
        let pattern = Pattern::new(&dofs, &[triangles]);
        let scatter = Scatter::new(&pattern, &dofs, triangles);
        let mut values = vec![0.0; pattern.nonzeros()];
        for triangle in 0..triangles.len() {
            scatter.add_matrix(triangle, &element(triangle), &mut values);
        }
        Self { dofs, pattern, values }
    }
}

/// The nodes of all triangles of a grid of `n` x `n` squares, each cut from lower left to upper right.
///
/// Even triangles lie below the cut, odd ones above.
pub(crate) fn triangles(n: usize) -> Vec<usize> {
    let node = |i, j| j * (n + 1) + i;
    let squares = (0..n * n).map(|square| (square % n, square / n));
    squares
        .flat_map(|(i, j)| {
            let [a, b, c, d] = [node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)];
            [a, b, c, a, c, d]
        })
        .collect()
}

/// Whether the node of a grid of `n` x `n` squares lies on the boundary.
pub(crate) fn on_boundary(n: usize, node: usize) -> bool {
    let (i, j) = (node % (n + 1), node / (n + 1));
    i == 0 || j == 0 || i == n || j == n
}

/// The gradients of the three shape functions of a triangle with legs of length `h`.
pub(crate) fn gradients(h: f64, triangle: usize) -> [[f64; 2]; 3] {
    let unit = if triangle.is_multiple_of(2) {
        [[-1.0, 0.0], [1.0, -1.0], [0.0, 1.0]]
    } else {
        [[0.0, -1.0], [1.0, 0.0], [-1.0, 1.0]]
    };
    unit.map(|gradient| gradient.map(|slope| slope / h))
}

/// What an incompressible flow of density one does.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Flow {
    pub(crate) viscosity: f64,
    pub(crate) dt: f64,
    pub(crate) velocity: [f64; 2],
}

/// Linearized flow with pressure stabilization, 3 dofs a node: no slip all round, pressure fixed at the last
/// node or nowhere.
pub(crate) fn flow(n: usize, flow: Flow, pressure_is_fixed: bool) -> System {
    let nodes = (n + 1) * (n + 1);
    let prescribed: Vec<bool> = (0..3 * nodes)
        .map(|dof| match dof % 3 {
            2 => pressure_is_fixed && dof / 3 == nodes - 1,
            _ => on_boundary(n, dof / 3),
        })
        .collect();
    let connectivity = Connectivity::from_nodes(3, &triangles(n), 3);
    let h = 1.0 / n as f64;
    System::assemble(&connectivity, &prescribed, |triangle| flow_element(flow, h, &gradients(h, triangle)))
}

fn flow_element(flow: Flow, h: f64, gradients: &[[f64; 2]; 3]) -> Vec<f64> {
    let Flow { viscosity, dt, velocity } = flow;
    let dot = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
    let area = h * h / 2.0;
    let speed = dot(velocity, velocity).sqrt();
    let tau =
        ((2.0 / dt).powi(2) + (2.0 * speed / h).powi(2) + (12.0 * viscosity / (h * h)).powi(2)).powf(-0.5);
    let mut local = vec![0.0; 81];
    for a in 0..3 {
        for b in 0..3 {
            let entry = |i: usize, j: usize| (3 * a + i) * 9 + 3 * b + j;
            let mass = area / if a == b { 6.0 } else { 12.0 };
            let laplacian = area * dot(gradients[a], gradients[b]);
            let convection = area / 3.0 * dot(velocity, gradients[b]);
            for i in 0..2 {
                local[entry(i, i)] += mass / dt + viscosity * laplacian + convection;
                local[entry(i, 2)] -= area / 3.0 * gradients[a][i];
                local[entry(2, i)] += area / 3.0 * gradients[b][i];
                // Pressure stabilization of the momentum residual.
                local[entry(2, i)] +=
                    tau * gradients[a][i] * (area / 3.0 / dt + area * dot(velocity, gradients[b]));
            }
            local[entry(2, 2)] += tau * laplacian;
        }
    }
    local
}

/// Plane-strain elasticity with 2 dofs a node, fixed on the left side or nowhere.
pub(crate) fn elasticity(n: usize, poisson_ratio: f64, is_fixed: bool) -> System {
    let nodes = (n + 1) * (n + 1);
    let prescribed: Vec<bool> =
        (0..2 * nodes).map(|dof| is_fixed && (dof / 2).is_multiple_of(n + 1)).collect();
    let connectivity = Connectivity::from_nodes(3, &triangles(n), 2);
    let h = 1.0 / n as f64;
    let mu = 0.5 / (1.0 + poisson_ratio);
    let lambda = poisson_ratio / ((1.0 + poisson_ratio) * (1.0 - 2.0 * poisson_ratio));
    System::assemble(&connectivity, &prescribed, |triangle| {
        elastic_element(lambda, mu, h * h / 2.0, &gradients(h, triangle))
    })
}

fn elastic_element(lambda: f64, mu: f64, area: f64, g: &[[f64; 2]; 3]) -> Vec<f64> {
    let mut local = vec![0.0; 36];
    for (a, b) in (0..9).map(|k| (k / 3, k % 3)) {
        let dot = g[a][0] * g[b][0] + g[a][1] * g[b][1];
        for (i, j) in (0..4).map(|k| (k / 2, k % 2)) {
            let diagonal = if i == j { mu * dot } else { 0.0 };
            local[(2 * a + i) * 6 + 2 * b + j] =
                area * (lambda * g[a][i] * g[b][j] + mu * g[a][j] * g[b][i] + diagonal);
        }
    }
    local
}
