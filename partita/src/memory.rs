//! How much memory a run will take, from its numbers of unknowns.
//!
//! Nearly all of it holds factors of sparse matrices. In two dimensions the factors of a fluid of `n` unknowns have
//! O(n log n) entries; those of a narrow patch of splines about `(2 p + 1)^2` an unknown. The constants were fitted to the
//! peak resident memory of the tank (1 step, fluid with 663 to 150735 unknowns, structure with 21008 to 83018 of degree 2
//! and 3); there the estimates lie within 15 % of what was measured.

/// The program with its libraries and nothing in it \[bytes\].
const PROGRAM: f64 = 8.0e6;
/// A fluid's memory for each unknown and each doubling of their number \[bytes\].
const FLUID: f64 = 200.0;
/// What an unknown takes whatever their number, for the mesh, the pattern and the motion of the mesh, in such doublings.
const BESIDES: f64 = 1.35;
/// A structure's memory for each unknown and each of the functions that meet at it \[bytes\].
const STRUCTURE: f64 = 250.0;

/// Estimated peak memory of a run \[bytes\]: `fluid` and `structure` are numbers of unknowns, zero for a field that is not
/// there, `degrees` those of the structure's spline.
#[must_use]
pub fn estimate(fluid: usize, structure: usize, degrees: [usize; 2]) -> f64 {
    let (fluid, structure) = (fluid as f64, structure as f64);
    let doublings = fluid.max(1.0).log2() + BESIDES;
    let functions: f64 = degrees.map(|degree| (2 * degree + 1) as f64).iter().product();
    PROGRAM + FLUID * fluid * doublings + STRUCTURE * structure * functions
}

/// Bytes in a unit that is read at a glance.
#[must_use]
pub fn words(bytes: f64) -> String {
    let (factor, unit) = if bytes < 1e9 { (1e6, "MB") } else { (1e9, "GB") };
    let amount = bytes / factor;
    if amount < 10.0 { format!("{amount:.1} {unit}") } else { format!("{amount:.0} {unit}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Unknowns of fluid and structure, degree, and the peak resident memory of the program \[kB\].
    const MEASURED: [(usize, usize, usize, f64); 8] = [
        (663, 360, 2, 10_272.0),
        (9_843, 360, 2, 38_144.0),
        (38_883, 360, 2, 135_656.0),
        (150_735, 360, 2, 557_424.0),
        (663, 21_008, 2, 128_776.0),
        (663, 82_008, 2, 547_764.0),
        (663, 21_518, 3, 272_756.0),
        (663, 83_018, 3, 1_162_640.0),
    ];

    #[test]
    fn the_estimate_is_near_what_was_measured() {
        for (fluid, structure, degree, kilobytes) in MEASURED {
            let ratio = estimate(fluid, structure, [degree; 2]) / (1024.0 * kilobytes);
            assert!((0.85..1.2).contains(&ratio), "{fluid} + {structure} unknowns: {ratio} of the measured");
        }
    }

    #[test]
    fn amounts_are_written_in_the_unit_that_fits() {
        assert_eq!([9.5e6, 1.24e8, 2.31e9].map(words), ["9.5 MB", "124 MB", "2.3 GB"]);
    }
}
