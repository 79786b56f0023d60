//! Which run it is: what decides about its numbers, in sixteen digits.

use partita_scene::Resolved;

/// The hash that Fowler, Noll and Vo call FNV-1a, in 64 bits: the same on every machine and with every compiler.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Fingerprint(u64);

impl Fingerprint {
    /// Of nothing.
    pub(crate) fn empty() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }

    /// Of a run of this scene to its end: of the version of the program, of what decides about a step, of the number of steps,
    /// and of what is probed. How often fields are written, or which warnings are accepted, changes nothing.
    pub(crate) fn of(resolved: &Resolved) -> Self {
        let scene = &resolved.scene;
        let start = Self::empty().and(env!("CARGO_PKG_VERSION")).and(&resolved.decisive());
        let probes = toml::to_string(&scene.output.probes).expect("probes were read from TOML");
        start.and(&scene.time.steps.to_string()).and(&probes)
    }

    /// Of that and of this text.
    pub(crate) fn and(self, text: &str) -> Self {
        let step = |hash: u64, byte: u8| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        // No text holds this byte: it keeps neighbours apart.
        Self(text.bytes().chain([0xff]).fold(self.0, step))
    }

    /// Sixteen hexadecimal digits.
    pub(crate) fn text(self) -> String {
        format!("{:016x}", self.0)
    }
}
