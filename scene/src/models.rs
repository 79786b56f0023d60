//! The scene's fields and choices in the words of the crates that solve them.

mod coupling;
#[cfg(test)]
mod defaults;
mod fluid;
mod structure;

use partita_numerics::newton::{self, Bound, Check};

pub use coupling::{one_call, settings as coupling_settings};
pub use fluid::{holders, model as fluid_model, nearest_node, settings as fluid_settings};
pub use structure::{
    boundary, model as structure_model, place_in, settings as structure_settings, side, supports,
};

use crate::schema;

pub(crate) fn newton(newton: &schema::Newton) -> newton::Settings {
    newton::Settings {
        bound: match newton.tolerance {
            schema::Tolerance::Relative(bound) => Bound::Relative(bound.get()),
            schema::Tolerance::Absolute(bound) => Bound::Absolute(bound.get()),
        },
        check: match newton.check {
            schema::Check::Before => Check::Before,
            schema::Check::Lagged => Check::Lagged,
        },
        max_iterations: newton.max_iterations.get(),
        reuse_factor: newton.reuse_factor.map(schema::Fraction::get),
        ..newton::Settings::default()
    }
}
