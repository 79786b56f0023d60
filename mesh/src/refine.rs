//! Regular refinement: every triangle is cut into four of its own shape.

use std::collections::HashMap;

use crate::cell::{CellKind, Cells};
use crate::error::MeshError;
use crate::mesh::{Mesh, NamedFacets};

/// Largest distance of a node from the circle that its group should lie on, as part of the radius.
const ON_CIRCLE: f64 = 1e-6;

/// A circle on which a boundary group lies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Circle<'a> {
    /// Name of the group.
    pub group: &'a str,
    /// Centre `[m]`.
    pub center: [f64; 2],
    /// Radius `[m]`.
    pub radius: f64,
}

/// The mesh with every triangle cut into four through the middles of its edges.
///
/// Old nodes keep their numbers, the middles follow in the order of the cells; cell `c` becomes the cells `4 c ..
/// 4 c + 4`. Boundary groups keep their names. The middle of an edge whose group lies on one of the `circles` is
/// put onto the circle, along its radius: a polygon refined towards the arc, not towards itself. Circles of groups
/// that the mesh does not have are passed over.
///
/// # Errors
/// [`MeshError::OffCircle`] when a node of such a group does not lie on its circle; [`MeshError::NotPositive`] when a
/// cell is too flat for the bend of its edge.
pub fn refine(mesh: &Mesh<2>, circles: &[Circle<'_>]) -> Result<Mesh<2>, MeshError> {
    for circle in circles {
        check_on_circle(mesh, circle)?;
    }
    let mut middles = Middles { points: mesh.points().to_vec(), numbers: HashMap::new() };
    let mut nodes = Vec::with_capacity(12 * mesh.cells().len());
    for cell in mesh.cells() {
        let [a, b, c] = [cell[0], cell[1], cell[2]];
        let [ab, bc, ca] = [middles.of(a, b), middles.of(b, c), middles.of(c, a)];
        nodes.extend([a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca]);
    }
    let mut groups: Vec<NamedFacets<2>> = Vec::with_capacity(mesh.groups().len());
    for group in mesh.groups() {
        let circle = circles.iter().find(|circle| circle.group == group.name);
        let mut halves = Vec::with_capacity(2 * group.facets.len());
        for facet in &group.facets {
            let [a, b] = facet.nodes;
            let middle = middles.of(a, b);
            if let Some(circle) = circle {
                middles.points[middle] = circle.nearest(middles.points[middle]);
            }
            halves.extend([[a, middle], [middle, b]]);
        }
        groups.push((group.name.clone(), halves));
    }
    Mesh::new(middles.points, Cells::new(CellKind::Triangle3, nodes), groups)
}

/// All points so far, and the middle of each edge by its ends.
struct Middles {
    points: Vec<[f64; 2]>,
    numbers: HashMap<[usize; 2], usize>,
}

impl Middles {
    /// Number of the node between two others.
    fn of(&mut self, a: usize, b: usize) -> usize {
        let Self { points, numbers } = self;
        *numbers.entry([a.min(b), a.max(b)]).or_insert_with(|| {
            points.push(std::array::from_fn(|i| 0.5 * (points[a][i] + points[b][i])));
            points.len() - 1
        })
    }
}

impl Circle<'_> {
    /// The point of the circle on the ray from the centre through `point`.
    fn nearest(&self, point: [f64; 2]) -> [f64; 2] {
        let stretch = self.radius / self.distance(point);
        std::array::from_fn(|i| self.center[i] + stretch * (point[i] - self.center[i]))
    }

    /// Distance of a point from the centre.
    fn distance(&self, point: [f64; 2]) -> f64 {
        (point[0] - self.center[0]).hypot(point[1] - self.center[1])
    }
}

fn check_on_circle(mesh: &Mesh<2>, circle: &Circle<'_>) -> Result<(), MeshError> {
    for node in mesh.group_nodes(circle.group).unwrap_or_default() {
        let point = mesh.points()[node];
        let gap = (circle.distance(point) - circle.radius).abs();
        if gap.is_nan() || gap > ON_CIRCLE * circle.radius {
            return Err(MeshError::OffCircle {
                group: circle.group.to_owned(),
                node,
                place: point.into(),
                gap,
            });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::{Diagonal, RectangleMesh, rectangle};
    use crate::quality;

    /// A ring of 6 x 2 cells between the radii 1 and 2, cut open nowhere.
    fn ring() -> Mesh<2> {
        let point = |i: usize, radius: f64| {
            let angle = std::f64::consts::TAU * i as f64 / 6.0;
            [3.0 + radius * angle.cos(), 1.0 + radius * angle.sin()]
        };
        let points = (0..6).map(|i| point(i, 1.0)).chain((0..6).map(|i| point(i, 2.0))).collect();
        let (mut nodes, mut inner, mut outer) = (vec![], vec![], vec![]);
        for i in 0..6 {
            let j = (i + 1) % 6;
            nodes.extend([i, i + 6, j + 6, i, j + 6, j]);
            inner.push([i, j]);
            outer.push([i + 6, j + 6]);
        }
        let groups = vec![("inner".into(), inner), ("outer".into(), outer)];
        Mesh::new(points, Cells::new(CellKind::Triangle3, nodes), groups).expect("a ring")
    }

    #[test]
    fn four_cells_of_the_same_shape_fill_each() {
        let coarse = rectangle(&RectangleMesh {
            origin: [0.0; 2],
            size: [2.0, 1.0],
            divisions: [3, 2],
            pattern: Diagonal::Alternating,
        })
        .expect("a rectangle");
        let fine = refine(&coarse, &[]).expect("finer");
        assert_eq!(fine.cells().len(), 4 * coarse.cells().len());
        // Euler: one node more for every edge.
        assert_eq!(
            fine.points().len(),
            coarse.points().len() + coarse.cells().len() + coarse.points().len() - 1
        );
        assert_eq!(fine.points()[..coarse.points().len()], *coarse.points());
        let [before, after] = [&coarse, &fine].map(|mesh| quality::summary(mesh.points(), mesh.cells()));
        assert!((before.total_measure - after.total_measure).abs() < 1e-14);
        assert!((before.worst_quality - after.worst_quality).abs() < 1e-13);
        for (group, finer) in coarse.groups().iter().zip(fine.groups()) {
            assert_eq!((&group.name, 2 * group.facets.len()), (&finer.name, finer.facets.len()));
        }
        assert!(fine.ungrouped_boundary().is_empty());
    }

    /// The area between the circles is 3 pi; that of the polygons tends to it with the square of the edge.
    #[test]
    fn new_nodes_lie_on_the_circles() {
        let circles = [("inner", 1.0), ("outer", 2.0)].map(|(group, radius)| Circle {
            group,
            center: [3.0, 1.0],
            radius,
        });
        let mut mesh = ring();
        let mut errors = vec![];
        for _ in 0..4 {
            mesh = refine(&mesh, &circles).expect("finer");
            let area = quality::summary(mesh.points(), mesh.cells()).total_measure;
            errors.push(3.0 * std::f64::consts::PI - area);
            for circle in circles {
                for node in mesh.group_nodes(circle.group).expect("a group") {
                    assert!((circle.distance(mesh.points()[node]) - circle.radius).abs() < 1e-14);
                }
            }
        }
        for pair in errors.windows(2) {
            assert!((pair[0] / pair[1] - 4.0).abs() < 0.05, "{errors:?}");
        }
    }

    #[test]
    fn a_group_off_its_circle_is_refused() {
        let circle = Circle { group: "outer", center: [3.0, 1.0], radius: 2.001 };
        let error = refine(&ring(), &[circle]).expect_err("another circle");
        assert!(matches!(&error, MeshError::OffCircle { group, node: 6, .. } if group == "outer"), "{error}");
        assert!(miette::Diagnostic::help(&error).is_some(), "{error}");
    }
}
