//! Where displacements live: the geometry, its shape functions and their quadrature.

use partita_iga::{BasisValues, Derivatives, Element, Spline};
use partita_mesh::SolidMesh;
use partita_mesh::solid::{CellMap, reference};
use partita_numerics::{gauss, small};

use crate::boundary::Boundary;
use crate::elements::Elements;
use crate::error::StructureError;
use crate::patch::Patch;
use crate::tensor;

/// The space of displacements together with the reference configuration.
#[derive(Debug, Clone)]
pub enum Space<const D: usize> {
    /// One NURBS patch: the shape functions of the geometry carry the displacement (isogeometric analysis).
    Patch(Patch<D>),
    /// A mesh of isoparametric Lagrange elements: plane triangles and quadrilaterals of degree 1 and 2.
    Lagrange(SolidMesh<D>),
}

impl<const D: usize> From<Spline<D>> for Space<D> {
    fn from(spline: Spline<D>) -> Self {
        Self::Patch(spline.into())
    }
}

impl<const D: usize> From<SolidMesh<D>> for Space<D> {
    fn from(mesh: SolidMesh<D>) -> Self {
        Self::Lagrange(mesh)
    }
}

impl<const D: usize> Space<D> {
    /// Undeformed places of the nodes `[m]`: control points of a patch, nodes of a mesh.
    #[must_use]
    pub fn points(&self) -> &[[f64; D]] {
        match self {
            Self::Patch(patch) => patch.points(),
            Self::Lagrange(mesh) => mesh.points(),
        }
    }

    /// Number of nodes.
    #[must_use]
    pub fn node_count(&self) -> usize {
        self.points().len()
    }

    /// Nodes of some parts of the boundary, ascending, those on more than one part once.
    ///
    /// # Errors
    /// When the space has no such part: a patch has sides, those that a seam joins excepted, a mesh its groups.
    pub fn nodes_of(&self, parts: &Boundary) -> Result<Vec<usize>, StructureError> {
        let mut nodes = Vec::new();
        match (self, parts) {
            (Self::Patch(patch), Boundary::Sides(sides)) => {
                for &side in sides {
                    nodes.extend(patch.side_nodes(side)?);
                }
            }
            (Self::Lagrange(mesh), Boundary::Groups(groups)) => {
                for group in groups {
                    nodes.extend(group_nodes(mesh, group)?);
                }
            }
            (Self::Patch(_), Boundary::Groups(groups)) => {
                if let Some(group) = groups.first() {
                    return Err(StructureError::GroupOfPatch { group: group.clone() });
                }
            }
            (Self::Lagrange(mesh), Boundary::Sides(sides)) => {
                if let Some(&side) = sides.first() {
                    return Err(StructureError::SideOfMesh { side, known: mesh.group_names() });
                }
            }
        }
        nodes.sort_unstable();
        nodes.dedup();
        Ok(nodes)
    }

    /// A nodal field, one vector a node, at a place: the parameters of a patch, or the coordinates `[m]` of a point in the
    /// undeformed mesh. `None` outside of the mesh.
    ///
    /// # Panics
    /// When `at` has the wrong length, or lies outside the domain of a patch.
    #[must_use]
    pub fn evaluate(&self, at: &[f64], field: &[[f64; D]]) -> Option<[f64; D]> {
        match self {
            Self::Patch(patch) => Some(patch.evaluate(at, field)),
            Self::Lagrange(mesh) => {
                let place = at.try_into().expect("a place has one coordinate a dimension");
                mesh.locate(place).map(|location| mesh.evaluate(location, field))
            }
        }
    }

    /// Tabulates shape functions and reference gradients at the quadrature points: degree + 1 Gauss points a direction
    /// and element of a patch, the rules of [`reference::quadrature`] in a mesh.
    ///
    /// # Errors
    /// When the patch is no solid, or its map is not invertible at a quadrature point.
    pub fn elements(&self) -> Result<Elements<D>, StructureError> {
        match self {
            Self::Patch(patch) => tabulate_patch(patch),
            Self::Lagrange(mesh) => tabulate_mesh(mesh),
        }
    }
}

fn group_nodes<const D: usize>(mesh: &SolidMesh<D>, group: &str) -> Result<Vec<usize>, StructureError> {
    mesh.group_nodes(group)
        .ok_or_else(|| StructureError::NoSuchGroup { group: group.to_owned(), known: mesh.group_names() })
}

/// As for a patch, `grad N_a = (dx/dxi)^-T dN_a/dxi`.
fn tabulate_mesh<const D: usize>(mesh: &SolidMesh<D>) -> Result<Elements<D>, StructureError> {
    let cells = mesh.cells();
    let rule = reference::quadrature(cells.kind);
    let nodes = cells.kind.node_count();
    let mut elements = Elements::with_capacity(cells.len(), nodes, rule.len());
    for (cell, cell_nodes) in cells.iter().enumerate() {
        elements.push_element(cell_nodes);
        for &(xi, weight) in &rule {
            let CellMap { shape, place, jacobian } = mesh.map(cell, xi);
            let determinant = small::determinant(&jacobian);
            let inverted = || StructureError::Inverted { element: cell, place: place.to_vec(), determinant };
            let (inverse, _) =
                small::inverse(&jacobian).filter(|_| determinant > 0.0).ok_or_else(inverted)?;
            let gradients = shape.derivatives[..nodes].iter().map(|derivative| {
                // Meshes are plane so far; `D` is 2 wherever this runs.
                let derivative: [f64; D] =
                    std::array::from_fn(|j| derivative.get(j).copied().unwrap_or_default());
                small::transpose_apply(&inverse, &derivative)
            });
            elements.push_point(place, weight * determinant, &shape.values[..nodes], gradients);
        }
    }
    Ok(elements)
}

fn tabulate_patch<const D: usize>(patch: &Patch<D>) -> Result<Elements<D>, StructureError> {
    let spline = patch.spline();
    if spline.parameters() != D {
        return Err(StructureError::NotASolid { parameters: spline.parameters(), dimensions: D });
    }
    let rule = tensor_rule(&std::array::from_fn(|i| gauss::line(spline.knots()[i].degree() + 1)));
    let mut basis = BasisValues::new(spline);
    let mut elements = Elements::with_capacity(spline.element_count(), spline.active_count(), rule.len());
    for element in spline.elements() {
        elements.push_element(&patch.nodes_of(&spline.active_on(element.index())));
        for &(unit, weight) in &rule {
            let xi: [f64; D] = element.at(unit);
            spline.basis_on(element.index(), &xi, Derivatives::First, &mut basis);
            push_point(spline, &element, weight, &basis, &mut elements)?;
        }
    }
    Ok(elements)
}

/// Maps one quadrature point: `grad N_a = (dx/dxi)^-T dN_a/dxi`, volume = det(dx/dxi) times that of the element's box.
fn push_point<const D: usize>(
    spline: &Spline<D>,
    element: &Element,
    weight: f64,
    basis: &BasisValues,
    elements: &mut Elements<D>,
) -> Result<(), StructureError> {
    let along = basis.first_of(spline.control_points());
    let jacobian = tensor::build(|i, j| along[j][i]);
    let place = basis.value_of(spline.control_points());
    let determinant = small::determinant(&jacobian);
    let inverted =
        || StructureError::Inverted { element: element.index(), place: place.to_vec(), determinant };
    let (inverse, _) = small::inverse(&jacobian).filter(|_| determinant > 0.0).ok_or_else(inverted)?;
    let gradients = basis.first().iter().map(|derivative| {
        let derivative: [f64; D] = std::array::from_fn(|j| derivative[j]);
        small::transpose_apply(&inverse, &derivative)
    });
    elements.push_point(place, weight * element.measure() * determinant, basis.values(), gradients);
    Ok(())
}

/// The product of one rule for each direction, on the unit cube.
fn tensor_rule<const D: usize>(rules: &[Vec<(f64, f64)>; D]) -> Vec<([f64; D], f64)> {
    let mut product = vec![([0.0; D], 1.0)];
    for (i, rule) in rules.iter().enumerate() {
        product = rule
            .iter()
            .flat_map(|&(x, w)| {
                product.iter().map(move |&(mut unit, weight)| {
                    unit[i] = x;
                    (unit, weight * w)
                })
            })
            .collect();
    }
    product
}
