//! Work at the interface.

use partita_coupling::models::tank::Tank;
use partita_coupling::{Bound, CouplingSettings, Criterion};

use crate::support::{TankMarch, imvls, settings, tank};

/// The fluid moves its boundary by backward Euler and gives F_{n+1} on the way of the step; the bottom balances the load
/// at n+1-alpha_f and, at radius 1, turns all it gets into its own energy. Under gravity alone the tank moves as one.
#[test]
fn bottom_gets_the_work_of_the_step_less_that_of_the_averaged_load() {
    let still = Tank { ballast: 0.0, spectral_radius: 1.0, residual_bound: 1e-13, ..Tank::default() };
    let tight = CouplingSettings {
        criterion: Criterion::InterfaceResidual(Bound::Relative(1e-13)),
        ..settings(imvls())
    };
    let mut run = tank(&still, 4, &tight);
    assert_eq!(run.interface_work().to_bits(), 0);
    let energy = |run: &TankMarch| {
        let motion = run.second().state().modes[0];
        // Amplitudes belong to modes of length one: (1, 1, 1, 1)/2.
        let square = |x: f64| 0.25 * still.width * x * x;
        0.5 * (still.bottom_mass * square(motion.velocity) + still.stiffness(0) * square(motion.displacement))
    };
    for _ in 0..10 {
        let (start, from, load) =
            (energy(&run), run.interface().x_tilde.clone(), run.interface().transferred_load.clone());
        run.step(0.01, &mut ()).unwrap();
        let end = run.interface();
        let lost: f64 =
            (0..4).map(|i| 0.5 * (end.transferred_load[i] - load[i]) * (end.x_tilde[i] - from[i])).sum();
        let (given, gained) = (run.interface_work(), energy(&run) - start);
        assert!((given - gained - lost).abs() < 1e-9 * given.abs(), "{given:e} {gained:e} {lost:e}");
    }
}

#[test]
fn restored_run_has_no_work_to_tell_until_its_next_step() {
    let settings = settings(imvls());
    let mut run = tank(&Tank::default(), 4, &settings);
    run.step(0.01, &mut ()).unwrap();
    assert!(run.interface_work() != 0.0);
    run.restore(&run.state()).unwrap();
    assert_eq!(run.interface_work().to_bits(), 0);
}
