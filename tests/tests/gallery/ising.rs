//! Magnetisation and energy against the exact solution of the infinite lattice (Onsager 1944, Yang 1952).

use crate::common::{assert_same_bits, run};
use xca_examples::models::ising::{Lattice, exact_magnetisation, model};

/// Onsager's energy of a spin in units of J: by the complete elliptic integral, as an arithmetic-geometric
/// mean.
fn exact_energy(temperature: f64) -> f64 {
    let coupling = 1.0 / temperature;
    let modulus = 2.0 * (2.0 * coupling).sinh() / (2.0 * coupling).cosh().powi(2);
    let (mut a, mut b) = (1.0, (1.0 - modulus * modulus).sqrt());
    for _ in 0..40 {
        (a, b) = ((a + b) / 2.0, (a * b).sqrt());
    }
    let integral = std::f64::consts::FRAC_PI_2 / a;
    let coth = 1.0 / (2.0 * coupling).tanh();
    -coth * (1.0 + 2.0 / std::f64::consts::PI * (2.0 * (2.0 * coupling).tanh().powi(2) - 1.0) * integral)
}

/// The mean of a series with its standard error, from means of blocks that are longer than correlations.
fn estimate(series: &[f64]) -> (f64, f64) {
    let blocks: Vec<f64> = series
        .chunks_exact(series.len() / 16)
        .map(|block| block.iter().sum::<f64>() / block.len() as f64)
        .collect();
    let mean = blocks.iter().sum::<f64>() / blocks.len() as f64;
    let variance = blocks.iter().map(|block| (block - mean).powi(2)).sum::<f64>() / (blocks.len() - 1) as f64;
    (mean, (variance / blocks.len() as f64).sqrt())
}

#[test]
fn exact_values_of_the_energy() {
    // At the critical temperature the energy is the root of 2, and at low temperatures -2.
    let critical = 2.0 / (1.0 + 2.0_f64.sqrt()).ln();
    assert!((exact_energy(critical * (1.0 + 1e-5)) + 2.0_f64.sqrt()).abs() < 1e-3);
    assert!((exact_energy(0.5) + 2.0).abs() < 1e-6);
}

/// Below and above the critical temperature, 2.269, on a lattice far larger than correlations.
#[test]
fn energy_and_magnetisation_are_onsagers() {
    let size = 64;
    for temperature in [2.0, 3.0] {
        let model = model(size, temperature, if temperature < 2.2 { 1.0 } else { 0.5 }).unwrap();
        let mut simulation = run(&model, 11, 400);
        let (mut energies, mut moments) = (Vec::new(), Vec::new());
        for _ in 0..1600 {
            simulation.run(2).unwrap();
            let spins = simulation.state().read(Lattice::SPIN).unwrap();
            let at = |x: usize, y: usize| f64::from(spins[y % size * size + x % size]);
            let cells = (0..size * size).map(|cell| (cell % size, cell / size));
            let energy: f64 = cells.map(|(x, y)| -at(x, y) * (at(x + 1, y) + at(x, y + 1))).sum();
            energies.push(energy / (size * size) as f64);
            moments.push(spins.iter().map(|spin| f64::from(*spin)).sum::<f64>() / (size * size) as f64);
        }
        let (energy, error) = estimate(&energies);
        let wanted = exact_energy(temperature);
        assert!(
            (energy - wanted).abs() < 4.0 * error + 1e-3,
            "at {temperature}: {energy} ± {error}, not {wanted}"
        );
        assert!(error < 0.01, "{error}");
        let (moment, error) = estimate(&moments);
        let wanted = exact_magnetisation(temperature);
        assert!(
            (moment - wanted).abs() < 4.0 * error + 1e-3,
            "at {temperature}: {moment} ± {error}, not {wanted}"
        );
    }
}

#[test]
fn same_bits() {
    assert_same_bits(&model(16, 2.2, 0.6).unwrap(), 10);
}
