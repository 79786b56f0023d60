//! What round-off alone leaves of a residual.

use super::{Assembly, Damping, Local};
use crate::kernel;
use crate::step::TangentWeights;

impl<const D: usize> Assembly<D> {
    /// How much the forces of a displacement move when it is rounded, in units of the relative rounding error: the norm
    /// over the free dofs of
    ///
    /// ```text
    /// |K| |d| + mass M |d| + damping |C| |d|
    /// ```
    ///
    /// Inside an element the parts add up, as the error of one displacement does; those of different elements are taken to
    /// be independent.
    pub(crate) fn rounding(
        &self,
        displacement: &[f64],
        weights: &TangentWeights,
        local: &mut Local<D>,
    ) -> f64 {
        let mut squares = 0.0;
        for e in 0..self.elements.len() {
            local.gather(self.elements.nodes(e), displacement);
            self.add_rounding(e, weights, local);
            for (&node, force) in self.elements.nodes(e).iter().zip(&local.sizes) {
                if (0..D).any(|i| self.dofs.is_free(node * D + i)) {
                    squares += force * force;
                }
            }
        }
        squares.sqrt()
    }

    fn add_rounding(&self, e: usize, weights: &TangentWeights, local: &mut Local<D>) {
        let element = self.elements.element(e);
        let Local { field, force, sizes, .. } = local;
        sizes.fill(0.0);
        kernel::add_rounding(element, self.material.law(), 1.0, field, sizes);
        let mut density = if self.has_inertia { weights.mass * self.density } else { 0.0 };
        if let Some(Damping { rayleigh, linearized, .. }) = &self.damping {
            kernel::add_rounding(
                element,
                linearized.law(),
                weights.damping * rayleigh.stiffness,
                field,
                sizes,
            );
            density += weights.damping * rayleigh.mass * self.density;
        }
        field.as_flattened_mut().iter_mut().for_each(|d| *d = d.abs());
        kernel::add_inertia(element, density, field, force);
        for (size, force) in sizes.iter_mut().zip(&*force) {
            *size += force.iter().fold(0.0, |sum: f64, f| sum.hypot(*f));
        }
    }
}
