//! The members of the family: a scene file each, and what is set in it.

/// One run.
pub(super) struct Member {
    /// What is switched on or left out.
    pub(super) name: &'static str,
    /// Which of the two lists it stands in.
    pub(super) list: List,
    pub(super) scene: Scene,
    /// Keys set beside those of all members.
    pub(super) set: &'static [&'static str],
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum List {
    /// Effects switched on one by one.
    Ladder,
    /// All of them but one.
    Without,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Scene {
    /// A fluid alone.
    Rigid,
    /// Fluid and structure.
    Elastic,
}

impl Scene {
    /// Its file, from the root of the workspace.
    pub(super) fn file(self) -> &'static str {
        match self {
            Self::Rigid => "scenes/beam-in-channel/rigid.toml",
            Self::Elastic => "scenes/beam-in-channel/scene.toml",
        }
    }

    /// What all members of this scene are solved with: bounds well below the errors to be seen, and quadratic convergence,
    /// which the scene of the paper leaves out on purpose.
    pub(super) fn settings(self) -> &'static [&'static str] {
        match self {
            Self::Rigid => &["fluid.newton={tolerance={relative=1e-9}}"],
            Self::Elastic => &[
                "fluid.newton={tolerance={relative=1e-9}}",
                "structure.newton={tolerance={relative=1e-9}}",
                "fluid.tangent=full",
                "coupling.acceleration=iqn_ils",
                "coupling.convergence={changes=1e-6}",
                "output.fields_every=0",
                "output.checkpoint_every=0",
            ],
        }
    }
}

/// The member that all others are compared with.
pub(super) const WHOLE: &str = "+ structure moves the fluid (all)";

const LINEAR: &str = "structure.material={linear_elastic={young_modulus=2.4e7,poisson_ratio=0.3}}";
const STOKES: &str = "fluid.convection=false";
const STEADY: &str = "fluid.time_scheme=steady";
const STATIC: &str = "structure.time_scheme=quasi_static";
const ONE_WAY: &str = "coupling.direction=one_way";

/// All members, in the order of the page.
pub(super) fn all() -> Vec<Member> {
    let member = |name, list, scene, set| Member { name, list, scene, set };
    let ladder = |name, scene, set| member(name, List::Ladder, scene, set);
    let without = |name, set| member(name, List::Without, Scene::Elastic, set);
    vec![
        ladder("steady Stokes flow, rigid beam", Scene::Rigid, &[STOKES, STEADY]),
        ladder("+ fluid inertia", Scene::Rigid, &[STOKES]),
        ladder("+ convection", Scene::Rigid, &[]),
        ladder("+ elastic beam, linear, quasi-static, one way", Scene::Elastic, &[ONE_WAY, LINEAR, STATIC]),
        ladder("+ structural inertia", Scene::Elastic, &[ONE_WAY, LINEAR]),
        ladder("+ geometric nonlinearity", Scene::Elastic, &[ONE_WAY]),
        ladder(WHOLE, Scene::Elastic, &[]),
        without("without convection", &[STOKES]),
        without("without fluid inertia (and structural)", &[STEADY, STATIC]),
        without("without structural inertia", &[STATIC]),
        without("without geometric nonlinearity", &[LINEAR]),
        without("without convection and geometric nonlinearity", &[STOKES, LINEAR]),
    ]
}
