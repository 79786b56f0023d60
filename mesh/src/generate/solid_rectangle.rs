//! Triangles and quadrilaterals of degree 1 and 2 in a rectangle.

use super::check_box;
use crate::cell::{CellKind, Cells};
use crate::error::MeshError;
use crate::solid::{NamedEdges, SolidMesh, reference};

/// A rectangle and its divisions.
#[derive(Debug, Clone, PartialEq)]
pub struct SolidRectangle {
    /// Lower left corner `[m]`.
    pub origin: [f64; 2],
    /// Width and height `[m]`.
    pub size: [f64; 2],
    /// Squares in x and y.
    pub divisions: [usize; 2],
}

/// Meshes a rectangle for a solid; boundary groups `left`, `right`, `bottom`, `top`.
///
/// Triangles halve each square from its lower left to its upper right corner. Nodes are numbered x fastest.
///
/// ```
/// use partita_mesh::CellKind;
/// use partita_mesh::generate::{SolidRectangle, solid_rectangle};
///
/// let plate = SolidRectangle { origin: [0.0, 0.0], size: [2.0, 0.1], divisions: [10, 1] };
/// let mesh = solid_rectangle(&plate, CellKind::Quadrilateral8)?;
/// assert_eq!(mesh.points().len(), 21 * 3 - 10);
/// # Ok::<(), partita_mesh::MeshError>(())
/// ```
///
/// # Errors
/// [`MeshError::InvalidBox`] for a size that is not positive or no divisions, [`MeshError::NotSolid`] for cells that are
/// neither triangles nor quadrilaterals.
pub fn solid_rectangle(rectangle: &SolidRectangle, kind: CellKind) -> Result<SolidMesh<2>, MeshError> {
    let SolidRectangle { origin, size, divisions } = rectangle;
    check_box(origin, size, divisions)?;
    if !reference::is_plane_solid(kind) {
        return Err(MeshError::NotSolid { found: kind, dimension: 2 });
    }
    let lattice = Lattice::new(*divisions, kind);
    SolidMesh::new(lattice.points(origin, size), lattice.cells(), lattice.sides())
}

/// The grid of half squares; nodes lie on some of its points, on which those are depends on the kind of cells.
struct Lattice {
    divisions: [usize; 2],
    kind: CellKind,
    /// Number of the node at each point of the grid, x fastest.
    numbers: Vec<Option<usize>>,
}

impl Lattice {
    fn new(divisions: [usize; 2], kind: CellKind) -> Self {
        let is_node = |p: usize, q: usize| match kind {
            CellKind::Triangle6 | CellKind::Quadrilateral9 => true,
            CellKind::Quadrilateral8 => p.is_multiple_of(2) || q.is_multiple_of(2),
            _ => p.is_multiple_of(2) && q.is_multiple_of(2),
        };
        let mut count = 0;
        let mut numbers = Vec::new();
        for q in 0..=2 * divisions[1] {
            for p in 0..=2 * divisions[0] {
                numbers.push(is_node(p, q).then_some(count));
                count += usize::from(is_node(p, q));
            }
        }
        Self { divisions, kind, numbers }
    }

    fn node(&self, p: usize, q: usize) -> usize {
        self.numbers[q * (2 * self.divisions[0] + 1) + p].expect("cells lie on nodes")
    }

    fn points(&self, origin: &[f64; 2], size: &[f64; 2]) -> Vec<[f64; 2]> {
        let width = 2 * self.divisions[0] + 1;
        let place = |index: usize| {
            let point = [index % width, index / width];
            [0, 1].map(|i| origin[i] + size[i] * (point[i] as f64 / (2 * self.divisions[i]) as f64))
        };
        (0..self.numbers.len()).filter(|&index| self.numbers[index].is_some()).map(place).collect()
    }

    fn cells(&self) -> Cells {
        let places = reference::nodes(self.kind);
        let mut nodes = Vec::new();
        for j in 0..self.divisions[1] {
            for i in 0..self.divisions[0] {
                // Steps of half a square from its lower left corner to a node of a cell in it.
                let mut push = |steps: &dyn Fn([f64; 2]) -> [f64; 2]| {
                    nodes.extend(places.iter().map(|&xi| {
                        let [p, q] = steps(xi).map(half_steps);
                        self.node(2 * i + p, 2 * j + q)
                    }));
                };
                if reference::corner_count(self.kind) == 3 {
                    push(&|[x, y]| [2.0 * (x + y), 2.0 * y]);
                    push(&|[x, y]| [2.0 * x, 2.0 * (x + y)]);
                } else {
                    push(&|[x, y]| [x + 1.0, y + 1.0]);
                }
            }
        }
        Cells::new(self.kind, nodes)
    }

    fn sides(&self) -> Vec<NamedEdges> {
        let kind = reference::edge_kind(self.kind);
        let [nx, ny] = self.divisions;
        let side = |name: &str, squares: usize, point: &dyn Fn(usize) -> [usize; 2]| {
            let edge = |square: usize| [2 * square, 2 * square + 2, 2 * square + 1];
            let nodes = (0..squares).flat_map(|square| {
                let steps = edge(square).into_iter().take(kind.node_count());
                steps.map(|step| {
                    let [p, q] = point(step);
                    self.node(p, q)
                })
            });
            (name.to_owned(), Cells::new(kind, nodes.collect()))
        };
        vec![
            side("left", ny, &|step| [0, step]),
            side("right", ny, &|step| [2 * nx, step]),
            side("bottom", nx, &|step| [step, 0]),
            side("top", nx, &|step| [step, 2 * ny]),
        ]
    }
}

/// 0, 1 or 2: the places of nodes are exact numbers.
fn half_steps(step: f64) -> usize {
    [0.0, 1.0, 2.0].iter().position(|known| (step - known).abs() < 0.25).expect("0, 1 or 2 steps")
}
