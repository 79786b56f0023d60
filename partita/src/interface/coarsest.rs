//! How coarse the fluid is where it meets the structure.

use partita_fluid::FluidSolver;
use partita_structure::StructureSolver;

/// The longest facet of the fluid's interface beside the element of the structure there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Coarsest {
    /// Length of the facet \[m\].
    pub(crate) facet: f64,
    /// Length of the element that is closest to its middle \[m\].
    pub(crate) element: f64,
    /// The middle of the facet \[m\].
    pub(crate) place: [f64; 2],
}

impl Coarsest {
    /// Elements of the structure along the facet.
    pub(crate) fn ratio(&self) -> f64 {
        self.facet / self.element
    }

    /// Whether there are more than so many elements along the facet, and not by round-off alone.
    pub(crate) fn exceeds(&self, elements: f64) -> bool {
        self.ratio() > (1.0 + SAME) * elements
    }
}

/// Ratios closer than this are one, up to round-off.
const SAME: f64 = 1e-9;

/// The facet that is the longest beside its element; the first of several.
pub(crate) fn coarsest(fluid: &FluidSolver<2>, structure: &StructureSolver<2>) -> Option<Coarsest> {
    let elements = structure.space().boundary_elements(&structure.model().wetted);
    let points = fluid.mesh().points();
    let of_facet = |[a, b]: [[f64; 2]; 2]| {
        let place = [0, 1].map(|c| f64::midpoint(a[c], b[c]));
        let nearest = elements
            .iter()
            .min_by(|one, other| distance_to_line(&place, one).total_cmp(&distance_to_line(&place, other)))?;
        Some(Coarsest { facet: distance(&a, &b), element: distance(&nearest[0], &nearest[1]), place })
    };
    let all = fluid.interface_facets().filter_map(|facet| of_facet(facet.nodes.map(|node| points[node])));
    all.reduce(|best, next| if next.exceeds(best.ratio()) { next } else { best })
}

/// Distance of a point from the line between two others.
fn distance_to_line(point: &[f64; 2], [start, end]: &[[f64; 2]; 2]) -> f64 {
    let along = [end[0] - start[0], end[1] - start[1]];
    let square = along[0].powi(2) + along[1].powi(2);
    let s = ((point[0] - start[0]) * along[0] + (point[1] - start[1]) * along[1]) / square;
    let s = s.clamp(0.0, 1.0);
    distance(point, &[start[0] + s * along[0], start[1] + s * along[1]])
}

fn distance(a: &[f64; 2], b: &[f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}
