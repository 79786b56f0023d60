//! The scenes of the study, and how they are run.

/// A scene with what is set in it.
pub(super) struct Case {
    pub(super) name: &'static str,
    /// From the root of the workspace.
    pub(super) scene: &'static str,
    /// What is set in it, in words.
    pub(super) changes: &'static str,
    /// Keys that all runs of the case have.
    pub(super) set: &'static [&'static str],
    /// Keys that the runs with coarse steps have; the reference goes without.
    pub(super) coarse: &'static [&'static str],
    /// Size of a coarse step \[s\].
    pub(super) step: f64,
    /// Number of coarse steps.
    pub(super) steps: usize,
    /// Steps of the reference in one coarse step.
    pub(super) finer: usize,
    /// Whether there is a fluid, and with it a force.
    pub(super) coupled: bool,
}

/// The flap that the default is judged by.
pub(super) const FLAP: &str = "flap, BDF2";

/// The fluid is as heavy as the flap, which the starting flow makes swing. The stabilization depends on the step size; without
/// grad-div and with a viscous part that rules, it hardly does, so that smaller steps solve the same problem in space.
const FLAP_SETTINGS: &[&str] = &[
    "fluid.density=10",
    "fluid.viscosity=2",
    "fluid.boundary.inflow={velocity=[\"2.5*y*(4 - y)*t\", 0]}",
    "fluid.time_scheme=bdf2",
    "fluid.tangent=full",
    "fluid.grad_div=0",
    "fluid.inverse_constant=3.6e4",
    "fluid.newton={tolerance={relative=1e-9}}",
    "structure.newton={tolerance={relative=1e-9}}",
    "coupling.acceleration=iqn_ils",
    "coupling.convergence={changes=1e-7}",
    "output.fields_every=0",
    "output.checkpoint_every=0",
];

const FSI1_SETTINGS: &[&str] = &[
    "fluid.boundary.inflow={velocity=[\"1.5*0.2*4*y*(0.41 - y)/0.41^2*t/10\", 0]}",
    "fluid.time_scheme=bdf2",
    "fluid.grad_div=0",
    "fluid.inverse_constant=3.6e3",
    "fluid.newton={tolerance={relative=1e-8}}",
    "coupling.acceleration={iqn_imvls={initial_relaxation=0.1}}",
    "coupling.predictor=quadratic",
    "output.fields_every=0",
    "output.checkpoint_every=0",
    "output.probes.load={fluid_force=\"flag\"}",
];

/// In the order of the page.
pub(super) const CASES: [Case; 4] = [
    Case {
        name: FLAP,
        scene: "scenes/beam-in-channel",
        changes: "a fluid as heavy as the flap, an inflow that grows linearly from rest, and BDF2",
        set: FLAP_SETTINGS,
        coarse: &[],
        step: 0.01,
        steps: 100,
        finer: 16,
        coupled: true,
    },
    Case {
        name: "flap, BDF1",
        scene: "scenes/beam-in-channel",
        changes: "the same changes and BDF1; its reference is the run with BDF2, so that the errors include those of the \
                  first-order scheme",
        set: FLAP_SETTINGS,
        coarse: &["fluid.time_scheme=bdf1"],
        step: 0.01,
        steps: 100,
        finer: 16,
        coupled: true,
    },
    Case {
        name: "FSI1 made unsteady",
        scene: "scenes/turek-hron-fsi1",
        changes: "BDF2 and generalized-alpha in place of the steady schemes, and an inflow that grows \
                  linearly from rest; the force is that on the flag",
        set: FSI1_SETTINGS,
        coarse: &[],
        step: 0.1,
        steps: 100,
        finer: 8,
        coupled: true,
    },
    Case {
        name: "CSM3, a structure alone",
        scene: "scenes/turek-hron-csm3",
        changes: "larger steps; no fluid, so that the errors are those of the structure's time scheme alone",
        set: &["output.fields_every=0", "output.checkpoint_every=0"],
        coarse: &[],
        step: 0.02,
        steps: 250,
        finer: 16,
        coupled: false,
    },
];
