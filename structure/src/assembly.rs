//! From elements to global forces and the tangent.

mod round_off;

use partita_numerics::scatter::add_vector;
use partita_numerics::{Connectivity, DofMap, Pattern, Scatter};

use crate::elements::Elements;
use crate::error::StructureError;
use crate::kernel::{self, Blocks, Element, PointError};
use crate::material::AnyMaterial;
use crate::model::Rayleigh;
use crate::step::TangentWeights;

/// The motion at which forces are evaluated: each vector at its own level between `t_n` and `t_{n+1}`.
#[derive(Debug, Clone)]
pub(crate) struct Motion {
    pub(crate) displacement: Vec<f64>,
    pub(crate) velocity: Vec<f64>,
    pub(crate) acceleration: Vec<f64>,
}

/// The forces that resist a motion, on all dofs: prescribed rows hold their share of the reactions.
#[derive(Debug, Clone)]
pub(crate) struct Forces {
    /// `f_int(d)`
    pub(crate) internal: Vec<f64>,
    /// C v
    pub(crate) damping: Vec<f64>,
    /// M a
    pub(crate) inertia: Vec<f64>,
}

/// Where a tangent goes: factors of M, C and K, and the values on the pattern.
pub(crate) struct Tangent<'a> {
    pub(crate) weights: TangentWeights,
    pub(crate) values: &'a mut [f64],
}

/// Buffers of one element; they live as long as the solver.
#[derive(Debug, Clone)]
pub(crate) struct Local<const D: usize> {
    field: Vec<[f64; D]>,
    force: Vec<[f64; D]>,
    matrix: Vec<f64>,
    blocks: Blocks<D>,
    /// Sizes of forces, a node.
    sizes: Vec<f64>,
}

/// Everything about assembly that does not change during a run.
pub(crate) struct Assembly<const D: usize> {
    elements: Elements<D>,
    connectivity: Connectivity,
    dofs: DofMap,
    pattern: Pattern,
    scatter: Scatter,
    density: f64,
    material: AnyMaterial<D>,
    has_inertia: bool,
    damping: Option<Damping<D>>,
    /// M on the pattern; empty where nothing needs it.
    mass: Vec<f64>,
}

/// Why the material of `K_0` cannot fail.
const HOOKE: &str =
    "a linear law has a stress for every strain, and every law was asked for its tangent at rest";

/// Rayleigh damping, C = mass M + stiffness `K_0`.
struct Damping<const D: usize> {
    rayleigh: Rayleigh,
    /// The material of `K_0`.
    linearized: AnyMaterial<D>,
    /// C on the pattern.
    matrix: Vec<f64>,
}

impl<const D: usize> Assembly<D> {
    pub(crate) fn new(elements: Elements<D>, dofs: DofMap, density: f64, material: AnyMaterial<D>) -> Self {
        let connectivity = elements.connectivity();
        let pattern = Pattern::new(&dofs, &[&connectivity]);
        let scatter = Scatter::new(&pattern, &dofs, &connectivity);
        Self {
            elements,
            connectivity,
            dofs,
            pattern,
            scatter,
            density,
            material,
            has_inertia: true,
            damping: None,
            mass: Vec::new(),
        }
    }

    /// The same with the mass matrix, which inertia and damping need.
    pub(crate) fn with_mass(mut self) -> Self {
        let density = self.density;
        self.mass =
            self.matrix(|e, local| kernel::add_mass(self.elements.element(e), density, &mut local.matrix));
        self
    }

    /// The same without inertia in its forces.
    pub(crate) fn without_inertia(mut self) -> Self {
        self.has_inertia = false;
        self
    }

    /// The same with damping.
    pub(crate) fn with_damping(mut self, rayleigh: Rayleigh) -> Self {
        let mut matrix = self.linear_stiffness(rayleigh.stiffness);
        for (c, m) in matrix.iter_mut().zip(&self.mass) {
            *c += rayleigh.mass * m;
        }
        self.damping =
            Some(Damping { rayleigh, linearized: self.material.linearized().expect(HOOKE), matrix });
        self
    }

    /// `factor K_0` on the pattern: the stiffness of the undeformed structure.
    pub(crate) fn linear_stiffness(&self, factor: f64) -> Vec<f64> {
        let linearized = self.material.linearized().expect(HOOKE);
        self.matrix(|e, Local { field, force, matrix, blocks, .. }| {
            let element = self.elements.element(e);
            field.fill([0.0; D]);
            add_internal_force_and_tangent(element, &linearized, field, factor, force, matrix, blocks)
                .expect(HOOKE);
        })
    }

    pub(crate) fn dofs(&self) -> &DofMap {
        &self.dofs
    }

    pub(crate) fn pattern(&self) -> &Pattern {
        &self.pattern
    }

    /// M on the pattern.
    pub(crate) fn mass(&self) -> &[f64] {
        &self.mass
    }

    pub(crate) fn local(&self) -> Local<D> {
        let nodes = self.elements.nodes_per_element();
        Local {
            field: vec![[0.0; D]; nodes],
            force: vec![[0.0; D]; nodes],
            matrix: vec![0.0; (nodes * D).pow(2)],
            blocks: Blocks::new(nodes),
            sizes: vec![0.0; nodes],
        }
    }

    /// Forces of `motion` on all dofs and, where asked for, the tangent mass M + damping C + stiffness K(d).
    ///
    /// Fails where the material has no stress for the displacement; forces and tangent are then incomplete.
    pub(crate) fn evaluate(
        &self,
        motion: &Motion,
        mut tangent: Option<Tangent>,
        local: &mut Local<D>,
        forces: &mut Forces,
    ) -> Result<(), StructureError> {
        forces.clear();
        if let Some(tangent) = &mut tangent {
            self.start_tangent(tangent);
        }
        for e in 0..self.elements.len() {
            local.gather(self.elements.nodes(e), &motion.displacement);
            match &mut tangent {
                None => self.internal_force(e, local)?,
                Some(Tangent { weights, values }) => {
                    self.internal_force_and_tangent(e, weights.stiffness, local)?;
                    self.scatter.add_matrix(e, &local.matrix, values);
                }
            }
            add_vector(&self.connectivity, e, local.force.as_flattened(), &mut forces.internal);
            self.add_inertia(e, motion, local, forces);
            self.add_damping(e, motion, local, forces);
        }
        Ok(())
    }

    /// `(N_a, 1)` of every node `[m^D]`.
    pub(crate) fn volumes(&self) -> Vec<f64> {
        let mut volumes = vec![0.0; self.dofs.total() / D];
        let mut shares = vec![0.0; self.elements.nodes_per_element()];
        for e in 0..self.elements.len() {
            shares.fill(0.0);
            kernel::add_volume(self.elements.element(e), &mut shares);
            for (&node, share) in self.elements.nodes(e).iter().zip(&shares) {
                volumes[node] += share;
            }
        }
        volumes
    }

    /// `(N_a, b)` on all dofs for a body force b `[N/m^3]` that depends on the place.
    pub(crate) fn body_force(&self, b: impl Fn(&[f64; D]) -> [f64; D], force: &mut [f64]) {
        let mut local = vec![[0.0; D]; self.elements.nodes_per_element()];
        force.fill(0.0);
        for e in 0..self.elements.len() {
            local.fill([0.0; D]);
            let at_points = self.elements.places(e).iter().map(&b);
            kernel::add_body_force(self.elements.element(e), at_points, &mut local);
            add_vector(&self.connectivity, e, local.as_flattened(), force);
        }
    }

    /// The element, place `[m]` and value of the smallest det F of a displacement, if it is not positive.
    pub(crate) fn fold(&self, displacement: &[f64], local: &mut Local<D>) -> Option<(usize, [f64; D], f64)> {
        let mut worst = None;
        for e in 0..self.elements.len() {
            local.gather(self.elements.nodes(e), displacement);
            let (determinant, point) = kernel::smallest_determinant(self.elements.element(e), &local.field);
            let least = worst.map_or(0.0, |(_, _, least)| least);
            if determinant.is_nan() || determinant <= least {
                worst = Some((e, self.elements.places(e)[point], determinant));
            }
        }
        worst
    }

    /// Strain energy of a displacement `[J, in 2D J/m]`.
    pub(crate) fn strain_energy(&self, displacement: &[f64]) -> f64 {
        self.sum(displacement, |e, d| kernel::strain_energy(self.elements.element(e), self.material.law(), d))
    }

    /// Kinetic energy of a velocity `[J, in 2D J/m]`.
    pub(crate) fn kinetic_energy(&self, velocity: &[f64]) -> f64 {
        self.sum(velocity, |e, v| kernel::kinetic_energy(self.elements.element(e), self.density, v))
    }

    /// The part of the tangent that does not depend on the displacement.
    fn start_tangent(&self, tangent: &mut Tangent) {
        if self.mass.is_empty() {
            tangent.values.fill(0.0);
        }
        for (entry, m) in tangent.values.iter_mut().zip(&self.mass) {
            *entry = tangent.weights.mass * m;
        }
        if let Some(damping) = &self.damping {
            for (entry, c) in tangent.values.iter_mut().zip(&damping.matrix) {
                *entry += tangent.weights.damping * c;
            }
        }
    }

    fn internal_force(&self, e: usize, local: &mut Local<D>) -> Result<(), StructureError> {
        add_internal_force(self.elements.element(e), &self.material, &local.field, &mut local.force)
            .map_err(|error| self.deformed_too_far(e, error))
    }

    fn internal_force_and_tangent(
        &self,
        e: usize,
        scale: f64,
        local: &mut Local<D>,
    ) -> Result<(), StructureError> {
        let Local { field, force, matrix, blocks, .. } = local;
        add_internal_force_and_tangent(
            self.elements.element(e),
            &self.material,
            field,
            scale,
            force,
            matrix,
            blocks,
        )
        .map_err(|error| self.deformed_too_far(e, error))
    }

    fn deformed_too_far(&self, element: usize, PointError { point, source }: PointError) -> StructureError {
        StructureError::DeformedTooFar {
            element,
            place: self.elements.places(element)[point].to_vec(),
            source,
        }
    }

    fn add_inertia(&self, e: usize, motion: &Motion, local: &mut Local<D>, forces: &mut Forces) {
        if self.has_inertia {
            local.gather(self.elements.nodes(e), &motion.acceleration);
            kernel::add_inertia(self.elements.element(e), self.density, &local.field, &mut local.force);
            add_vector(&self.connectivity, e, local.force.as_flattened(), &mut forces.inertia);
        }
    }

    fn add_damping(&self, e: usize, motion: &Motion, local: &mut Local<D>, forces: &mut Forces) {
        if let Some(Damping { rayleigh: Rayleigh { mass, stiffness }, linearized, .. }) = &self.damping {
            let element = self.elements.element(e);
            local.gather(self.elements.nodes(e), &motion.velocity);
            kernel::add_inertia(element, mass * self.density, &local.field, &mut local.force);
            // K_0 v is the internal force of the linear material at the displacement v.
            local.field.as_flattened_mut().iter_mut().for_each(|v| *v *= stiffness);
            add_internal_force(element, linearized, &local.field, &mut local.force).expect(HOOKE);
            add_vector(&self.connectivity, e, local.force.as_flattened(), &mut forces.damping);
        }
    }

    /// A constant matrix on the pattern from its element matrices.
    fn matrix(&self, fill: impl Fn(usize, &mut Local<D>)) -> Vec<f64> {
        let mut values = vec![0.0; self.pattern.nonzeros()];
        let mut local = self.local();
        for e in 0..self.elements.len() {
            local.matrix.fill(0.0);
            fill(e, &mut local);
            self.scatter.add_matrix(e, &local.matrix, &mut values);
        }
        values
    }

    /// A quantity of a nodal field, summed over the elements.
    fn sum(&self, field: &[f64], quantity: impl Fn(usize, &[[f64; D]]) -> f64) -> f64 {
        let mut local = self.local();
        let of_element = |e| {
            local.gather(self.elements.nodes(e), field);
            quantity(e, &local.field)
        };
        (0..self.elements.len()).map(of_element).sum()
    }
}

/// [`kernel::add_internal_force`], where the usual materials are called directly and the others through their trait.
#[inline]
fn add_internal_force<const D: usize>(
    element: Element<D>,
    material: &AnyMaterial<D>,
    displacement: &[[f64; D]],
    force: &mut [[f64; D]],
) -> Result<(), PointError> {
    match material {
        AnyMaterial::Isotropic(material) => {
            kernel::add_internal_force(element, material, displacement, force)
        }
        AnyMaterial::Custom(law) => kernel::add_internal_force(element, law.as_ref(), displacement, force),
    }
}

/// [`kernel::add_internal_force_and_tangent`] in the same way.
#[inline]
fn add_internal_force_and_tangent<const D: usize>(
    element: Element<D>,
    material: &AnyMaterial<D>,
    field: &[[f64; D]],
    scale: f64,
    force: &mut [[f64; D]],
    matrix: &mut [f64],
    blocks: &mut Blocks<D>,
) -> Result<(), PointError> {
    match material {
        AnyMaterial::Isotropic(material) => {
            kernel::add_internal_force_and_tangent(element, material, field, scale, force, matrix, blocks)
        }
        AnyMaterial::Custom(law) => {
            kernel::add_internal_force_and_tangent(element, law.as_ref(), field, scale, force, matrix, blocks)
        }
    }
}

impl<const D: usize> Local<D> {
    /// Takes a field at the nodes of an element and clears its force.
    fn gather(&mut self, nodes: &[usize], field: &[f64]) {
        let field = field.as_chunks::<D>().0;
        for (local, &node) in self.field.iter_mut().zip(nodes) {
            *local = field[node];
        }
        self.force.fill([0.0; D]);
    }
}

impl Motion {
    pub(crate) fn new(dofs: usize) -> Self {
        Self { displacement: vec![0.0; dofs], velocity: vec![0.0; dofs], acceleration: vec![0.0; dofs] }
    }
}

impl Forces {
    pub(crate) fn new(dofs: usize) -> Self {
        Self { internal: vec![0.0; dofs], damping: vec![0.0; dofs], inertia: vec![0.0; dofs] }
    }

    fn clear(&mut self) {
        self.internal.fill(0.0);
        self.damping.fill(0.0);
        self.inertia.fill(0.0);
    }
}
