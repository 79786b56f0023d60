//! Many runs of one scene: [studies](study) of accuracy against time, [maps](stability) of what converges.

pub mod stability;
pub mod study;
