//! Nodes between groups: which part of their force belongs to which group.
//!
//! The consistent force at a node is the residual of its momentum rows. Where facets of several groups hold the velocity of
//! one node, it is the force on all of them together. It is taken apart by
//!
//! ```text
//! f_if = a_if + W_if (f_i - sum_g a_ig)      a_if = P_if int_f N_i (p n - mu (grad u + grad u^T) n)
//! ```
//!
//! where f and g run over the facets at node i that hold a velocity. `P_if` projects onto what the facet's condition holds: on
//! all directions, or on the normal of a slip wall, whose tangential traction is zero. Facets with a condition on the
//! stress hold nothing and get nothing. The rest, which vanishes with the element size and for linear solutions altogether,
//! is shared by the measures m of the facets,
//!
//! ```text
//! W_if = m_f Q_if (sum_g m_g Q_ig)^-1        Q_if = P_if + (projection on the directions that the node has free)
//! ```
//!
//! so that the parts sum to `f_i` and no wall gets a force that its condition cannot hold.

use partita_mesh::{BoundaryGroup, Facet, Mesh, simplex};
use partita_numerics::small::{dot, identity, inverse};

use crate::assembly::Iterate;
use crate::model::{BoundaryCondition, FluidModel};

/// What a condition holds of the velocity.
#[derive(Clone, Copy, PartialEq)]
enum Held {
    Nothing,
    Normal,
    All,
}

impl Held {
    fn by<const D: usize>(condition: &BoundaryCondition<D>) -> Self {
        match condition {
            BoundaryCondition::Interface
            | BoundaryCondition::RigidInterface
            | BoundaryCondition::WallMotion(_)
            | BoundaryCondition::NoSlip
            | BoundaryCondition::Velocity(_) => Self::All,
            BoundaryCondition::Slip => Self::Normal,
            BoundaryCondition::Traction(_)
            | BoundaryCondition::DoNothing { .. }
            | BoundaryCondition::StressFree { .. } => Self::Nothing,
        }
    }
}

/// A facet at a shared node.
#[derive(Clone, Copy)]
struct Side<const D: usize> {
    facet: Facet<D>,
    /// Its group, by its place in the mesh.
    group: usize,
    held: Held,
    /// `m_f` `[m^(D-1)]`.
    measure: f64,
    /// `Q_if`.
    shares: [[f64; D]; D],
    /// `a_if`, then `f_if` `[N/m in 2D, N in 3D]`.
    force: [f64; D],
}

/// The nodes that facets of several groups hold, with the force on each side as of the last assembly.
pub(crate) struct SharedNodes<const D: usize> {
    /// For each group of the mesh what its condition holds, and whether another field is on the other side.
    groups: Vec<(Held, bool)>,
    /// Ascending.
    nodes: Vec<usize>,
    /// Where the sides of each node start in `sides`, and the end of the last ones.
    starts: Vec<usize>,
    sides: Vec<Side<D>>,
}

impl<const D: usize> SharedNodes<D> {
    pub(crate) fn new(mesh: &Mesh<D>, model: &FluidModel<D>) -> Self {
        let of_group = |group: &BoundaryGroup<D>| {
            let condition = model.boundary.iter().find(|(name, _)| *name == group.name);
            let (_, condition) = condition.expect("a checked group has a condition");
            (Held::by(condition), condition.is_interface())
        };
        let groups: Vec<(Held, bool)> = mesh.groups().iter().map(of_group).collect();
        let mut found: Vec<(usize, Side<D>)> = Vec::new();
        for (group, boundary) in mesh.groups().iter().enumerate() {
            let held = groups[group].0;
            if held != Held::Nothing {
                for facet in &boundary.facets {
                    found.extend(facet.nodes.map(|node| (node, Side::new(*facet, group, held))));
                }
            }
        }
        // Stable: the sides of a node stay in the order of groups and facets.
        found.sort_by_key(|(node, _)| *node);
        let mut shared = Self { groups, nodes: Vec::new(), starts: vec![0], sides: Vec::new() };
        for sides in found.chunk_by(|(node, _), (next, _)| node == next) {
            let (node, first) = &sides[0];
            if sides.iter().any(|(_, side)| side.group != first.group) {
                shared.nodes.push(*node);
                shared.sides.extend(sides.iter().map(|(_, side)| side));
                shared.starts.push(shared.sides.len());
            }
        }
        shared
    }

    /// Whether a group of the mesh holds any velocity.
    pub(crate) fn holds(&self, group: usize) -> bool {
        self.groups[group].0 != Held::Nothing
    }

    /// Whether another field is on the other side of a group of the mesh.
    pub(crate) fn is_interface(&self, group: usize) -> bool {
        self.groups[group].1
    }

    /// Takes the forces apart, from the iterate that `residual` belongs to.
    pub(crate) fn update(&mut self, iterate: &Iterate<D>, residual: &[f64], prescribed: &[bool]) {
        for (k, &node) in self.nodes.iter().enumerate() {
            let sides = &mut self.sides[self.starts[k]..self.starts[k + 1]];
            let row = node * (D + 1);
            let mut rest: [f64; D] = std::array::from_fn(|c| -residual[row + c]);
            let free = free_directions(iterate, node, &prescribed[row..row + D]);
            let mut all = [[0.0; D]; D];
            for side in &mut *sides {
                side.measure_traction(iterate, node, &free);
                for i in 0..D {
                    rest[i] -= side.force[i];
                    for j in 0..D {
                        all[i][j] += side.measure * side.shares[i][j];
                    }
                }
            }
            // Slip walls that were folded onto each other while they moved leave nothing to invert.
            let weighted = inverse(&all).map(|(inverse, _)| times(&inverse, &rest));
            let whole: f64 = sides.iter().map(|side| side.measure).sum();
            for side in sides {
                let part = match &weighted {
                    Some(weighted) => times(&side.shares, weighted),
                    None => rest.map(|rest| rest / whole),
                };
                for i in 0..D {
                    side.force[i] += side.measure * part[i];
                }
            }
        }
    }

    /// The part of the force at `node` that acts on the groups that are `asked` for; `None` where that is all of it, as at
    /// nodes that one group alone holds.
    pub(crate) fn part_at(&self, node: usize, asked: impl Fn(usize) -> bool) -> Option<[f64; D]> {
        let k = self.nodes.binary_search(&node).ok()?;
        let sides = &self.sides[self.starts[k]..self.starts[k + 1]];
        if sides.iter().all(|side| asked(side.group)) {
            return None;
        }
        let mut sum = [0.0; D];
        for side in sides.iter().filter(|side| asked(side.group)) {
            for i in 0..D {
                sum[i] += side.force[i];
            }
        }
        Some(sum)
    }
}

impl<const D: usize> Side<D> {
    fn new(facet: Facet<D>, group: usize, held: Held) -> Self {
        Self { facet, group, held, measure: 0.0, shares: [[0.0; D]; D], force: [0.0; D] }
    }

    /// Sets measure, `Q_if` and `a_if`.
    fn measure_traction(&mut self, iterate: &Iterate<D>, node: usize, free: &[[f64; D]; D]) {
        let area_vector = self.facet.area_vector(iterate.points);
        self.measure = dot(&area_vector, &area_vector).sqrt();
        self.force = traction_at(&self.facet, node, &area_vector, iterate);
        self.shares = identity();
        if self.held == Held::Normal {
            let normal = area_vector.map(|s| s / self.measure);
            let projection: [[f64; D]; D] =
                std::array::from_fn(|i| std::array::from_fn(|j| normal[i] * normal[j]));
            self.force = times(&projection, &self.force);
            self.shares = std::array::from_fn(|i| std::array::from_fn(|j| projection[i][j] + free[i][j]));
        }
    }
}

/// `int_f N_i (p n - mu (grad u + grad u^T) n)`, the stress of the cell behind the facet.
fn traction_at<const D: usize>(
    facet: &Facet<D>,
    node: usize,
    area_vector: &[f64; D],
    iterate: &Iterate<D>,
) -> [f64; D] {
    let pressure = |node: usize| iterate.values[node * (D + 1) + D];
    let pressures = pressure(node) + facet.nodes.iter().map(|node| pressure(*node)).sum::<f64>();
    let mean = pressures / (D * (D + 1)) as f64;
    let nodes = iterate.cells.cell(facet.cell);
    let (gradients, _) = simplex::gradients(&simplex::vertices(iterate.points, nodes))
        .expect("the cells of a moved mesh have a volume");
    let share = iterate.flow.viscosity / D as f64;
    let mut force = area_vector.map(|s| mean * s);
    for (gradient, &node) in gradients.iter().zip(nodes) {
        let velocity: [f64; D] = std::array::from_fn(|i| iterate.values[node * (D + 1) + i]);
        let (along, across) = (dot(gradient, area_vector), dot(&velocity, area_vector));
        for i in 0..D {
            // (grad u + grad u^T) n, with grad u = sum of u_a (x) grad N_a
            force[i] -= share * (velocity[i] * along + gradient[i] * across);
        }
    }
    force
}

/// The projection on the directions in which nothing holds a node.
fn free_directions<const D: usize>(iterate: &Iterate<D>, node: usize, prescribed: &[bool]) -> [[f64; D]; D] {
    let axes = identity();
    let frame = iterate.frames.at(node).unwrap_or(&axes);
    let mut projection = [[0.0; D]; D];
    for (direction, _) in frame.iter().zip(prescribed).filter(|(_, prescribed)| !**prescribed) {
        for i in 0..D {
            for j in 0..D {
                projection[i][j] += direction[i] * direction[j];
            }
        }
    }
    projection
}

fn times<const D: usize>(a: &[[f64; D]; D], x: &[f64; D]) -> [f64; D] {
    std::array::from_fn(|i| dot(&a[i], x))
}
