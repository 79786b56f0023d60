//! Where displacements live: the geometry, its shape functions and their quadrature.

use partita_iga::{BasisValues, Derivatives, Element, Side, Spline};
use partita_numerics::{gauss, small};

use crate::elements::Elements;
use crate::error::StructureError;
use crate::tensor;

/// The space of displacements together with the reference configuration.
#[derive(Debug, Clone)]
pub enum Space<const D: usize> {
    /// One NURBS patch: the shape functions of the geometry carry the displacement (isogeometric analysis).
    Patch(Spline<D>),
}

impl<const D: usize> Space<D> {
    /// Number of nodes: control points of a patch.
    #[must_use]
    pub fn node_count(&self) -> usize {
        match self {
            Self::Patch(spline) => spline.control_points().len(),
        }
    }

    /// Nodes of one side, ascending.
    ///
    /// # Errors
    /// When there is no such side.
    pub fn side_nodes(&self, side: Side) -> Result<Vec<usize>, StructureError> {
        match self {
            Self::Patch(spline) if spline.has_side(side) => Ok(spline.side(side).1),
            Self::Patch(_) => Err(StructureError::NoSuchSide { side }),
        }
    }

    /// Nodes of several sides, ascending, those on more than one side once.
    ///
    /// # Errors
    /// When there is no such side.
    pub fn nodes_of(&self, sides: &[Side]) -> Result<Vec<usize>, StructureError> {
        let mut nodes = Vec::new();
        for &side in sides {
            nodes.extend(self.side_nodes(side)?);
        }
        nodes.sort_unstable();
        nodes.dedup();
        Ok(nodes)
    }

    /// Tabulates shape functions and reference gradients at degree + 1 Gauss points a direction and element.
    ///
    /// # Errors
    /// When the patch is no solid, or its map is not invertible at a quadrature point.
    pub fn elements(&self) -> Result<Elements<D>, StructureError> {
        match self {
            Self::Patch(spline) => tabulate_patch(spline),
        }
    }
}

fn tabulate_patch<const D: usize>(spline: &Spline<D>) -> Result<Elements<D>, StructureError> {
    if spline.parameters() != D {
        return Err(StructureError::NotASolid { parameters: spline.parameters(), dimensions: D });
    }
    let rule = tensor_rule(&std::array::from_fn(|i| gauss::line(spline.knots()[i].degree() + 1)));
    let mut basis = BasisValues::new(spline);
    let mut elements = Elements::with_capacity(spline.element_count(), spline.active_count(), rule.len());
    for element in spline.elements() {
        elements.push_element(&spline.active_on(element.index()));
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
