//! How the fluid is solved: everything that is neither physics nor mesh.

use partita_mesh::motion::MotionSettings;
use partita_numerics::newton;
use partita_numerics::time::BdfOrder;

pub use crate::flow::Tangent;
use crate::stabilization::INVERSE_CONSTANT;

/// Steady, or how time derivatives are taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TimeScheme {
    /// No time derivative and no `4/dt^2` in `tau_M`; the mesh velocity is zero.
    Steady,
    /// Backward differences of this order with steps of any size; the first step is of order one.
    Bdf(BdfOrder),
}

/// Fixes the constant that a fluid with prescribed velocity all round leaves free in its pressure.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PressurePin {
    /// The node whose pressure is prescribed.
    pub node: usize,
    /// Its pressure `[Pa]`.
    pub pressure: f64,
}

/// Settings of a fluid solver; immutable once it is built.
#[derive(Debug, Clone, PartialEq)]
pub struct FluidSettings {
    /// Steady or unsteady.
    pub time: TimeScheme,
    /// The derivative Newton's method uses.
    pub tangent: Tangent,
    /// Whether the fluid carries its own momentum with it. Without, `u - w` is replaced by `-w` everywhere, so that the
    /// equations are linear: those of Stokes on a moving mesh.
    pub convection: bool,
    /// `C_I` of `tau_M`, see [`INVERSE_CONSTANT`].
    pub inverse_constant: f64,
    /// Factor of `tau_C`; 1 is the formula of [`Stabilization`](crate::stabilization::Stabilization), 0 leaves the term out.
    ///
    /// With small steps `4/dt^2` rules `tau_M`, and `tau_C = rho h^2 / (4 dt)` grows without bound: on linear elements, which have
    /// few fields without divergence, it then damps the flow as a viscosity would.
    pub grad_div: f64,
    /// When Newton's method stops.
    pub newton: newton::Settings,
    /// How the mesh follows a moving boundary; unused where none moves.
    pub motion: MotionSettings,
    /// Boundary groups along which mesh nodes may slide; each is flat and normal to an axis.
    pub mesh_slide: Vec<String>,
    /// Needed exactly where velocity is prescribed all round and nothing moves.
    pub pressure_pin: Option<PressurePin>,
    /// How many threads factor and solve the linear systems; no bit of any result depends on it.
    ///
    /// Up to 10 000 unknowns there is one in any case. See [`Factor::with_threads`](partita_numerics::Factor::with_threads).
    pub threads: usize,
}

impl Default for FluidSettings {
    fn default() -> Self {
        Self {
            time: TimeScheme::Bdf(BdfOrder::One),
            tangent: Tangent::Full,
            convection: true,
            inverse_constant: INVERSE_CONSTANT,
            grad_div: 1.0,
            newton: newton::Settings::default(),
            motion: MotionSettings::default(),
            mesh_slide: Vec::new(),
            pressure_pin: None,
            threads: 1,
        }
    }
}
