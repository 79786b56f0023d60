//! Every method on the models.

use std::fmt::Write;

use partita_coupling::models::tank::Tank;
use partita_coupling::models::tube::Tube;

use crate::support::{all_accelerations, settings, tank, tube};

#[test]
fn every_accelerator_solves_tube_and_tank() {
    let mut table = String::new();
    for (name, acceleration) in all_accelerations() {
        let mut counts = [0; 2];
        let mut march = tube(&Tube::default(), &settings(acceleration));
        for _ in 0..10 {
            let record = march.step(1e-3, &mut ()).unwrap();
            assert!(record.converged);
            counts[0] += record.iterations;
        }
        let mut march = tank(&Tank::default(), 20, &settings(acceleration));
        for _ in 0..10 {
            let record = march.step(1e-2, &mut ()).unwrap();
            assert!(record.converged);
            counts[1] += record.iterations;
        }
        writeln!(table, "{name:<10} tube {:>4}  tank {:>4}", counts[0], counts[1]).unwrap();
    }
    println!("{table}");
}

#[test]
fn print_eigenvalues() {
    println!("{:?}", &Tube::default().eigenvalues(1e-3).unwrap()[..5]);
    println!("{:?}", &Tank::default().eigenvalues(1e-2, true, 20).unwrap()[..5]);
}
