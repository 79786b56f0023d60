//! The warnings by name.

/// What a warning is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// A piece of the structure is not held.
    FreeStructure,
    /// The ends of a ring almost meet.
    OpenSeam,
    /// The structure pulls the corner of a fixed wall along.
    DraggedCorner,
    /// The fluid's interface is coarser than the structure's.
    CoarseInterface,
    /// A wall jumps, or starts at full speed.
    MotionJump,
    /// The time scheme of a coupled structure keeps the highest frequencies.
    UndampedStructure,
    /// The time step does not resolve the first vibration.
    LongStep,
    /// The load is large beside Young's modulus.
    SoftStructure,
    /// The Reynolds number is far beyond those tested.
    ReynoldsNumber,
    /// The flow crosses many cells in one step.
    CourantNumber,
    /// Convection dominates the single cell by far.
    CellReynoldsNumber,
    /// The fixed relaxation is too large for the added mass.
    AddedMass,
    /// A tolerance below round-off.
    TightTolerance,
    /// A tolerance so loose that nothing is solved.
    LooseTolerance,
    /// A formula without a finite value where it is not needed.
    NotFinite,
}

impl Kind {
    /// All of them, in the order of the docs.
    pub const ALL: [Self; 15] = [
        Self::FreeStructure,
        Self::OpenSeam,
        Self::DraggedCorner,
        Self::CoarseInterface,
        Self::MotionJump,
        Self::UndampedStructure,
        Self::LongStep,
        Self::SoftStructure,
        Self::ReynoldsNumber,
        Self::CourantNumber,
        Self::CellReynoldsNumber,
        Self::AddedMass,
        Self::TightTolerance,
        Self::LooseTolerance,
        Self::NotFinite,
    ];

    /// The name by which a scene accepts it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::FreeStructure => "free_structure",
            Self::OpenSeam => "open_seam",
            Self::DraggedCorner => "dragged_corner",
            Self::CoarseInterface => "coarse_interface",
            Self::MotionJump => "motion_jump",
            Self::UndampedStructure => "undamped_structure",
            Self::LongStep => "long_step",
            Self::SoftStructure => "soft_structure",
            Self::ReynoldsNumber => "reynolds_number",
            Self::CourantNumber => "courant_number",
            Self::CellReynoldsNumber => "cell_reynolds_number",
            Self::AddedMass => "added_mass",
            Self::TightTolerance => "tight_tolerance",
            Self::LooseTolerance => "loose_tolerance",
            Self::NotFinite => "not_finite",
        }
    }

    /// When it is given, for the docs.
    #[must_use]
    pub const fn meaning(self) -> &'static str {
        match self {
            Self::FreeStructure => "The structure, or a piece of it, can move freely as a rigid body.",
            Self::OpenSeam => {
                "Opposite sides of the structure's patch almost touch, within a thousandth of the way round, and are not joined."
            }
            Self::DraggedCorner => {
                "A fixed wall of the fluid ends at the interface, and the structure moves that corner off the wall."
            }
            Self::CoarseInterface => {
                "An edge of the fluid's interface is longer than 3 elements of the structure there; where a scene asks for \
                 `transfer = \"interpolation\"`, which then acts like point loads, longer than 1.5."
            }
            Self::MotionJump => {
                "A prescribed wall motion is not zero at t = 0, or starts at full speed in a fluid at rest."
            }
            Self::UndampedStructure => {
                "The time scheme of a coupled structure does not damp the highest frequencies (spectral radius above 0.9, \
                 or Newmark's gamma below 0.55): the force at the interface then oscillates from step to step."
            }
            Self::LongStep => {
                "The time step is longer than a tenth of the structure's first natural period without fluid."
            }
            Self::SoftStructure => {
                "The load expected on the structure exceeds a tenth of Young's modulus, or sound is slower in a dense \
                 solid than 100 m/s: the modulus may have been typed in MPa or GPa."
            }
            Self::ReynoldsNumber => {
                "The Reynolds number of the prescribed velocities and the smaller extent of the mesh exceeds 10 000: ten times \
                 the largest of the benchmarks."
            }
            Self::CourantNumber => {
                "The largest prescribed velocity crosses more than 50 mean cell sizes in one time step."
            }
            Self::CellReynoldsNumber => {
                "The Reynolds number of the largest prescribed velocity and the mean cell size exceeds 500."
            }
            Self::AddedMass => {
                "The constant relaxation factor exceeds 2/(1 + added-mass ratio), the largest for which the coupling \
                 iteration of the structure's first mode converges in an inviscid fluid."
            }
            Self::TightTolerance => "A tolerance lies below what double precision can resolve.",
            Self::LooseTolerance => {
                "An absolute tolerance exceeds the load, or a relative one is too loose for the coupling: the field \
                 would hardly be solved."
            }
            Self::NotFinite => {
                "A formula has no finite value at t = 0 on its boundary. (Where a run would use such a value it is an error.)"
            }
        }
    }

    /// The warning of this name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }
}
