//! The elements of a structure, tabulated once in the reference configuration.

use partita_numerics::Connectivity;

use crate::kernel::Element;

/// Nodes, quadrature weights, shape functions and their gradients of all elements: what the kernel reads.
///
/// All elements have the same number of nodes and of quadrature points. A new kind of space only has to fill this.
#[derive(Debug, Clone)]
pub struct Elements<const D: usize> {
    nodes_per_element: usize,
    points_per_element: usize,
    nodes: Vec<usize>,
    weights: Vec<f64>,
    values: Vec<f64>,
    gradients: Vec<[f64; D]>,
    places: Vec<[f64; D]>,
}

impl<const D: usize> Elements<D> {
    /// Room for `count` elements.
    pub(crate) fn with_capacity(count: usize, nodes_per_element: usize, points_per_element: usize) -> Self {
        let points = count * points_per_element;
        Self {
            nodes_per_element,
            points_per_element,
            nodes: Vec::with_capacity(count * nodes_per_element),
            weights: Vec::with_capacity(points),
            values: Vec::with_capacity(points * nodes_per_element),
            gradients: Vec::with_capacity(points * nodes_per_element),
            places: Vec::with_capacity(points),
        }
    }

    /// Appends an element; its quadrature points follow by [`push_point`](Self::push_point).
    pub(crate) fn push_element(&mut self, nodes: &[usize]) {
        assert_eq!(nodes.len(), self.nodes_per_element, "all elements have the same number of nodes");
        self.nodes.extend_from_slice(nodes);
    }

    /// Appends a quadrature point to the last element.
    pub(crate) fn push_point(
        &mut self,
        place: [f64; D],
        weight: f64,
        values: &[f64],
        gradients: impl ExactSizeIterator<Item = [f64; D]>,
    ) {
        assert_eq!(values.len(), self.nodes_per_element, "one value a node");
        assert_eq!(gradients.len(), self.nodes_per_element, "one gradient a node");
        self.places.push(place);
        self.weights.push(weight);
        self.values.extend_from_slice(values);
        self.gradients.extend(gradients);
    }

    /// Number of elements.
    #[must_use]
    pub fn len(&self) -> usize {
        self.nodes.len() / self.nodes_per_element
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// Number of nodes of each element.
    #[must_use]
    pub fn nodes_per_element(&self) -> usize {
        self.nodes_per_element
    }

    /// Nodes of element `e`.
    #[must_use]
    pub fn nodes(&self, e: usize) -> &[usize] {
        &self.nodes[e * self.nodes_per_element..][..self.nodes_per_element]
    }

    /// Element `e` as the kernel sees it.
    #[must_use]
    pub fn element(&self, e: usize) -> Element<'_, D> {
        let points = e * self.points_per_element..(e + 1) * self.points_per_element;
        let entries = points.start * self.nodes_per_element..points.end * self.nodes_per_element;
        Element {
            weights: &self.weights[points],
            values: &self.values[entries.clone()],
            gradients: &self.gradients[entries],
        }
    }

    /// Quadrature points of element `e` in the reference configuration `[m]`.
    #[must_use]
    pub fn places(&self, e: usize) -> &[[f64; D]] {
        &self.places[e * self.points_per_element..][..self.points_per_element]
    }

    /// The dofs `node * D + c` of all elements.
    #[must_use]
    pub fn connectivity(&self) -> Connectivity {
        Connectivity::from_nodes(self.nodes_per_element, &self.nodes, D)
    }
}
