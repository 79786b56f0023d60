//! What the mesh does when its boundary moves.

use approx::assert_relative_eq;
use partita_mesh::generate::{Diagonal, RectangleMesh, rectangle};
use partita_mesh::motion::prescribed_dofs;
use partita_mesh::{Mesh, MeshMotion, MotionError, MotionLaw, MotionMode, MotionQuality, MotionSettings};

use crate::boxes::{field, largest_difference, shaken, unit_cube, unit_square};

const ELASTIC: MotionLaw = MotionLaw::Elastic { poisson_ratio: 0.3, stiffening: 0.0 };
const HARMONIC: MotionLaw = MotionLaw::Harmonic { stiffening: 0.0 };

fn stiffened(law: MotionLaw, stiffening: f64) -> MotionLaw {
    match law {
        MotionLaw::Elastic { poisson_ratio, .. } => MotionLaw::Elastic { poisson_ratio, stiffening },
        MotionLaw::Harmonic { .. } => MotionLaw::Harmonic { stiffening },
    }
}

/// A motion and the displacement it committed last.
struct Run<const D: usize> {
    motion: MeshMotion<D>,
    prescribed: Vec<bool>,
    committed: Vec<f64>,
}

impl<const D: usize> Run<D> {
    fn new(mesh: &Mesh<D>, law: MotionLaw, mode: MotionMode, slide: &[&str]) -> Self {
        let prescribed = prescribed_dofs(mesh, slide).expect("straight sides slide");
        let settings = MotionSettings { law, mode };
        let motion = MeshMotion::new(mesh, settings, &prescribed).expect("a mesh that is held");
        let committed = vec![0.0; prescribed.len()];
        Self { motion, prescribed, committed }
    }

    /// One step: the prescribed entries follow `target`, the others must not be read.
    fn step(&mut self, target: &[f64]) -> Result<MotionQuality, MotionError> {
        let given = target.iter().zip(&self.prescribed).map(|(&d, &given)| if given { d } else { f64::NAN });
        let mut displacement: Vec<f64> = given.collect();
        self.motion.begin_step(&self.committed)?;
        self.motion.displace(&self.committed, &mut displacement)?;
        for dof in 0..target.len() {
            assert!(!self.prescribed[dof] || displacement[dof].to_bits() == target[dof].to_bits());
        }
        self.committed = displacement;
        self.motion.check(&self.committed)
    }
}

/// Two steps of an affine motion come out exactly, in both modes.
fn follows<const D: usize>(mesh: &Mesh<D>, law: MotionLaw, affine: impl Fn(&[f64; D]) -> [f64; D]) {
    for mode in [MotionMode::Reference, MotionMode::Incremental] {
        let mut run = Run::new(mesh, law, mode, &[]);
        for fraction in [0.4, 1.0] {
            let exact = field(mesh, |x| affine(x).map(|d| fraction * d));
            run.step(&exact).expect("nothing inverts");
            let error = largest_difference(&run.committed, &exact);
            assert!(error < 1e-13, "{law:?}, {mode:?}: off by {error:e}");
        }
    }
}

fn affine_2d([x, y]: &[f64; 2]) -> [f64; 2] {
    [0.05 + 0.2 * x - 0.1 * y, -0.3 + 0.15 * x + 0.1 * y]
}

fn affine_3d([x, y, z]: &[f64; 3]) -> [f64; 3] {
    [0.1 + 0.2 * x - 0.1 * y + 0.05 * z, 0.1 * x - 0.1 * y, -0.2 + 0.1 * x + 0.1 * y + 0.15 * z]
}

#[test]
fn affine_boundary_motion_is_followed_exactly_on_any_mesh() {
    for law in [ELASTIC, HARMONIC] {
        follows(&shaken(&unit_square(5, Diagonal::Alternating), 0.04), law, affine_2d);
        follows(&shaken(&unit_cube(3), 0.05), law, affine_3d);
    }
}

/// An affine motion is stress-free inside only where neighbours are equally stiff: cells of one size.
#[test]
fn affine_boundary_motion_is_followed_exactly_with_stiffening_on_equal_cells() {
    for law in [ELASTIC, HARMONIC] {
        for chi in [1.0, 1.7] {
            follows(&unit_square(4, Diagonal::Crossed), stiffened(law, chi), affine_2d);
            follows(&unit_cube(3), stiffened(law, chi), affine_3d);
        }
    }
}

#[test]
fn translation_is_followed_exactly_with_stiffening_on_any_mesh() {
    for law in [ELASTIC, HARMONIC] {
        let law = stiffened(law, 1.5);
        follows(&shaken(&unit_square(5, Diagonal::Right), 0.04), law, |_| [0.3, -0.2]);
        follows(&shaken(&unit_cube(3), 0.05), law, |_| [0.3, -0.2, 0.1]);
    }
}

/// A linearized rotation strains nothing, so the elastic mesh follows it with any stiffness.
#[test]
fn small_rotation_is_followed_exactly_by_the_elastic_mesh() {
    let mesh = shaken(&unit_square(5, Diagonal::Right), 0.04);
    let mut run = Run::new(&mesh, stiffened(ELASTIC, 1.5), MotionMode::Reference, &[]);
    let exact = field(&mesh, |[x, y]| [-0.2 * y, 0.2 * x]);
    run.step(&exact).expect("nothing inverts");
    assert!(largest_difference(&run.committed, &exact) < 1e-13);

    let mesh = shaken(&unit_cube(3), 0.05);
    let mut run = Run::new(&mesh, stiffened(ELASTIC, 1.5), MotionMode::Reference, &[]);
    let exact = field(&mesh, |[x, y, z]| [-0.2 * y + 0.1 * z, 0.2 * x, -0.1 * x]);
    run.step(&exact).expect("nothing inverts");
    assert!(largest_difference(&run.committed, &exact) < 1e-13);
}

#[test]
fn harmonic_components_do_not_see_each_other() {
    let mesh = shaken(&unit_square(5, Diagonal::Left), 0.04);
    let mut run = Run::new(&mesh, HARMONIC, MotionMode::Reference, &[]);
    run.step(&field(&mesh, |[x, y]| [0.0, 0.1 * x * (1.0 - x) * (1.0 - y)])).expect("nothing inverts");
    assert!(run.committed.iter().step_by(2).all(|&d| d == 0.0));
    assert!(run.committed.iter().skip(1).step_by(2).any(|&d| d > 0.01));
}

/// Layers of heights `h_1`, `h_2` in series carry one stress: their strains are as `(h_1/h_2)^chi`.
#[test]
fn stiffening_divides_the_strain_as_springs_in_series_do() {
    let (lower, upper) = (0.2, 0.8);
    let strip =
        RectangleMesh { origin: [0.0; 2], size: [1.0, 1.0], divisions: [3, 2], pattern: Diagonal::Crossed };
    let strip = rectangle(&strip).expect("a strip");
    let height = |y: f64| if y < 0.5 { 2.0 * lower * y } else { lower + 2.0 * upper * (y - 0.5) };
    let graded = strip.points().iter().map(|&[x, y]| [x, height(y)]).collect();
    let strip = strip.with_points(graded).expect("two layers");
    for law in [ELASTIC, HARMONIC] {
        for chi in [0.0, 1.0, 2.0] {
            let mut run = Run::new(&strip, stiffened(law, chi), MotionMode::Reference, &["left", "right"]);
            run.step(&field(&strip, |[_, y]| [0.0, if *y > 0.999 { -0.1 } else { 0.0 }])).expect("valid");
            let ratio = (lower / upper).powf(chi);
            let upper_strain = -0.1 / (upper + lower * ratio);
            let lower_strain = upper_strain * ratio;
            let exact = field(&strip, |[_, y]| {
                [0.0, if *y <= lower { lower_strain * y } else { -0.1 + upper_strain * (y - 1.0) }]
            });
            let error = largest_difference(&run.committed, &exact);
            assert!(error < 1e-14, "{law:?}, chi = {chi}: off by {error:e}");
        }
    }
}

#[test]
fn sliding_sides_let_the_mesh_shrink_evenly() {
    let mesh = unit_square(6, Diagonal::Crossed);
    let lift = |[_, y]: &[f64; 2]| [0.0, if *y == 0.0 { 0.7 } else { 0.0 }];
    let mut sliding = Run::new(&mesh, MotionLaw::default(), MotionMode::Reference, &["left", "right"]);
    let quality = sliding.step(&field(&mesh, lift)).expect("every cell keeps 0.3 of its area");
    let exact = field(&mesh, |[_, y]| [0.0, 0.7 * (1.0 - y)]);
    assert!(largest_difference(&sliding.committed, &exact) < 1e-13);
    assert_relative_eq!(quality.smallest_ratio, 0.3, max_relative = 1e-11);

    let mesh = unit_cube(3);
    let lift = |[_, y, _]: &[f64; 3]| [0.0, if *y == 0.0 { 0.7 } else { 0.0 }, 0.0];
    let walls = ["left", "right", "front", "back"];
    let mut sliding = Run::new(&mesh, MotionLaw::default(), MotionMode::Reference, &walls);
    sliding.step(&field(&mesh, lift)).expect("every cell keeps 0.3 of its volume");
    let exact = field(&mesh, |[_, y, _]| [0.0, 0.7 * (1.0 - y), 0.0]);
    assert!(largest_difference(&sliding.committed, &exact) < 1e-13);
}

/// Bottom side pushed up in a smooth bump; the other sides are held.
fn bump<const D: usize>(mesh: &Mesh<D>, height: f64) -> Vec<f64> {
    field(mesh, |x| {
        let mut displacement = [0.0; D];
        if x[1] == 0.0 {
            displacement[1] = (0..D)
                .filter(|&c| c != 1)
                .fold(height, |product, c| product * (std::f64::consts::PI * x[c]).sin().powi(2));
        }
        displacement
    })
}

/// Largest bump, in steps of 0.02 m, before a cell inverts.
fn survived<const D: usize>(mesh: &Mesh<D>, law: MotionLaw, mode: MotionMode) -> f64 {
    let mut run = Run::new(mesh, law, mode, &[]);
    let mut steps = 0;
    while run.step(&bump(mesh, 0.02 * f64::from(steps + 1))).is_ok() {
        steps += 1;
        assert!(steps < 50, "the bump has passed the top");
    }
    0.02 * f64::from(steps)
}

#[test]
fn small_steps_survive_a_larger_motion_than_one_from_the_reference() {
    let square = unit_square(10, Diagonal::Crossed);
    let cube = unit_cube(4);
    for law in [MotionLaw::default(), stiffened(HARMONIC, 1.0)] {
        let heights = |mode| [survived(&square, law, mode), survived(&cube, law, mode)];
        let (reference, incremental) = (heights(MotionMode::Reference), heights(MotionMode::Incremental));
        for (reference, incremental) in reference.into_iter().zip(incremental) {
            assert!(incremental > 1.2 * reference, "{law:?}: {incremental} m against {reference} m");
        }
    }
}

/// The same mesh with its nodes drawn towards the moving bottom, `y -> y^2`.
fn graded<const D: usize>(mesh: &Mesh<D>) -> Mesh<D> {
    let mut points = mesh.points().to_vec();
    for point in &mut points {
        point[1] *= point[1];
    }
    mesh.with_points(points).expect("graded cells are positive")
}

#[test]
fn stiffening_keeps_small_cells_in_shape() {
    let (square, cube) = (graded(&unit_square(10, Diagonal::Right)), graded(&unit_cube(4)));
    for law in [ELASTIC, HARMONIC] {
        let qualities = |law| {
            let mut plane = Run::new(&square, law, MotionMode::Reference, &[]);
            let mut space = Run::new(&cube, law, MotionMode::Reference, &[]);
            [
                plane.step(&bump(&square, 0.1)).map_or(0.0, |q| q.smallest_quality),
                space.step(&bump(&cube, 0.1)).map_or(0.0, |q| q.smallest_quality),
            ]
        };
        let (plain, stiff) = (qualities(law), qualities(stiffened(law, 1.0)));
        for (plain, stiff) in plain.into_iter().zip(stiff) {
            assert!(stiff > 1.1 * plain, "{law:?}: quality {stiff} with stiffening, {plain} without");
        }
    }
}

#[test]
fn motion_from_the_reference_forgets_its_history() {
    let mesh = unit_square(5, Diagonal::Left);
    let mut run = Run::new(&mesh, MotionLaw::default(), MotionMode::Reference, &[]);
    run.step(&bump(&mesh, 0.1)).expect("valid");
    let first = run.committed.clone();
    run.step(&bump(&mesh, -0.2)).expect("valid");
    run.step(&bump(&mesh, 0.1)).expect("valid");
    assert_eq!(run.committed, first);
}

#[test]
fn resumed_incremental_motion_continues_bit_for_bit() {
    let mesh = unit_square(5, Diagonal::Crossed);
    let mut whole = Run::new(&mesh, MotionLaw::default(), MotionMode::Incremental, &["left"]);
    whole.step(&bump(&mesh, 0.1)).expect("valid");
    let mut resumed = Run::new(&mesh, MotionLaw::default(), MotionMode::Incremental, &["left"]);
    resumed.committed.clone_from(&whole.committed);
    whole.step(&bump(&mesh, 0.15)).expect("valid");
    resumed.step(&bump(&mesh, 0.15)).expect("valid");
    assert_eq!(whole.committed, resumed.committed);
}

/// A step of incremental motion is the motion of the committed mesh taken as a reference of its own.
fn starts_from_the_committed_mesh<const D: usize>(mesh: &Mesh<D>) {
    let mut incremental = Run::new(mesh, MotionLaw::default(), MotionMode::Incremental, &[]);
    incremental.step(&bump(mesh, 0.2)).expect("valid");
    let committed = incremental.committed.clone();
    let moved = mesh.points().iter().zip(committed.chunks_exact(D));
    let moved = moved.map(|(x, d)| std::array::from_fn(|c| x[c] + d[c])).collect();
    let moved = mesh.with_points(moved).expect("still a mesh");
    let mut fresh = Run::new(&moved, MotionLaw::default(), MotionMode::Reference, &[]);

    incremental.step(&bump(mesh, 0.3)).expect("valid");
    let change = |target: &[f64]| target.iter().zip(&committed).map(|(t, c)| t - c).collect::<Vec<_>>();
    fresh.step(&change(&bump(mesh, 0.3))).expect("valid");
    let difference = largest_difference(&change(&incremental.committed), &fresh.committed);
    assert!(difference < 1e-13, "off by {difference:e}");
}

#[test]
fn incremental_motion_starts_from_the_committed_mesh() {
    starts_from_the_committed_mesh(&unit_square(6, Diagonal::Alternating));
    starts_from_the_committed_mesh(&unit_cube(3));
}

#[test]
fn incremental_motion_stays_where_nothing_moves() {
    let mesh = unit_square(5, Diagonal::Left);
    let mut run = Run::new(&mesh, MotionLaw::default(), MotionMode::Incremental, &[]);
    run.step(&bump(&mesh, 0.3)).expect("valid");
    let before = run.committed.clone();
    run.step(&bump(&mesh, 0.3)).expect("valid");
    assert_eq!(run.committed, before);
}

#[test]
fn repeated_displacements_within_a_step_do_not_add_up() {
    let mesh = unit_square(5, Diagonal::Crossed);
    let mut run = Run::new(&mesh, MotionLaw::default(), MotionMode::Incremental, &[]);
    run.step(&bump(&mesh, 0.1)).expect("valid");
    let mut first = bump(&mesh, 0.12);
    run.motion.begin_step(&run.committed).expect("valid");
    run.motion.displace(&run.committed, &mut first).expect("valid");
    let mut again = bump(&mesh, 0.2);
    run.motion.displace(&run.committed, &mut again).expect("valid");
    again = bump(&mesh, 0.12);
    run.motion.displace(&run.committed, &mut again).expect("valid");
    assert_eq!(first, again);
}

#[test]
fn mesh_without_free_nodes_keeps_what_is_prescribed() {
    let mesh = unit_square(1, Diagonal::Right);
    let mut run = Run::new(&mesh, MotionLaw::default(), MotionMode::Incremental, &[]);
    let exact = field(&mesh, affine_2d);
    run.step(&exact).expect("nothing inverts");
    assert_eq!(run.committed, exact);
}

#[test]
fn quality_of_a_motion_is_measured_against_the_reference() {
    let mesh = unit_square(2, Diagonal::Right);
    let run = Run::new(&mesh, MotionLaw::default(), MotionMode::Reference, &[]);
    let mut displacement = vec![0.0; 18];
    displacement[8..10].copy_from_slice(&[0.25, 0.25]);
    let quality = run.motion.check(&displacement).expect("no cell inverts");
    // Of the two cells that lose area, each keeps half of it.
    assert_relative_eq!(quality.smallest_ratio, 0.5, max_relative = 1e-13);
    assert_relative_eq!(quality.smallest_measure, 0.0625, max_relative = 1e-13);
    assert_eq!(mesh.cells().cell(quality.cell)[0], 4);
    assert!(quality.smallest_quality > 0.0);

    // Cells of different sizes are each compared with themselves.
    let drawn_up = mesh.points().iter().map(|&[x, y]| [x, y * (2.0 - y)]).collect();
    let mesh = mesh.with_points(drawn_up).expect("cells that shrink towards the top");
    let run = Run::new(&mesh, MotionLaw::default(), MotionMode::Reference, &[]);
    let quality = run.motion.check(&field(&mesh, |[x, y]| [0.1 * x, -0.2 * y])).expect("no cell inverts");
    assert_relative_eq!(quality.smallest_ratio, 1.1 * 0.8, max_relative = 1e-13);
}
