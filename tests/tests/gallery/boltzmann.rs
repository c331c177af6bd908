//! Fluids: a shear wave fades as the Navier-Stokes equations say, at second order; the cavity has the
//! velocities of Ghia et al. 1982.

use crate::common::{assert_same_bits, run};
use std::f64::consts::TAU;
use xca_core::prelude::*;
use xca_examples::models::{boltzmann, cavity};

/// Density and velocity of a cell.
fn moments(fluid: &[f64; boltzmann::DIRECTIONS], directions: &[[i32; 3]]) -> (f64, Vector3<f64>) {
    let (mut density, mut momentum) = (0.0, Vector3::splat(0.0));
    for (f, direction) in fluid.iter().zip(directions) {
        let [x, y, z] = direction.map(f64::from);
        density += f;
        momentum += Vector3::new(x, y, z) * *f;
    }
    (density, momentum / density)
}

/// A wave of the velocity along y that changes along x and z: the exact solution fades by `exp(-viscosity k²
/// t)`. With half the cells' side, four times as many steps reach the same time.
fn shear_error(size: usize) -> f64 {
    let (viscosity, steps) = (0.05, (size * size / 4) as u64);
    let (amplitude, k) = (0.32 / size as f64, TAU / size as f64);
    let phase = move |cell: [usize; 3]| k * (cell[0] + cell[2]) as f64;
    let wave = move |site: Site| Vector3::new(0.0, amplitude * phase(site.cell()).cos(), 0.0);
    let model = boltzmann::model([size, 3, size], viscosity, wave).unwrap();
    let mut simulation = run(&model, 0, steps);
    let state = simulation.state();
    let directions = boltzmann::neighbourhood().unwrap().displacements([0; 3]).to_vec();
    let fade = (-viscosity * 2.0 * k * k * steps as f64).exp();
    let kept = state.read(boltzmann::Fluid::VELOCITY).unwrap();
    let (mut errors, mut norm, mut mass) = (0.0, 0.0, 0.0);
    for (cell, f) in state.read(boltzmann::Fluid::F).unwrap().iter().enumerate() {
        let (density, velocity) = moments(f, &directions);
        assert!((velocity - kept[cell]).length() < 1e-14, "collisions keep the momentum");
        let wanted = fade * amplitude * phase(state.geometry().indices(cell)).cos();
        errors += (velocity.y - wanted).powi(2);
        norm += wanted * wanted;
        mass += density;
    }
    let cells = (size * size * 3) as f64;
    assert!((mass / cells - 1.0).abs() < 1e-12, "mass is kept");
    (errors / norm).sqrt()
}

#[test]
fn a_shear_wave_fades_at_second_order() {
    let (coarse, fine) = (shear_error(12), shear_error(24));
    let order = (coarse / fine).log2();
    assert!((1.8..2.2).contains(&order), "errors {coarse} and {fine}: order {order}");
    assert!(fine < 0.015, "{fine}");
}

/// Ghia, Ghia and Shin, Journal of Computational Physics 48, 1982: u on the vertical line through the middle,
/// in parts of the lid's speed.
const GHIA: [(f64, [(f64, f64); 5]); 2] = [
    (100.0, [(0.9766, 0.84123), (0.9531, 0.68717), (0.7344, 0.00332), (0.5, -0.20581), (0.1719, -0.10150)]),
    (400.0, [(0.9766, 0.75837), (0.9531, 0.55892), (0.7344, 0.16256), (0.5, -0.11477), (0.2813, -0.32726)]),
];

/// The velocity along x at a height of the middle line, between cells; the lid and the floor are half a cell
/// beyond the last ones.
fn along_x(state: &State<'_>, size: usize, height: f64) -> f64 {
    let row = |y: usize| {
        let [left, right] =
            [size / 2 - 1, size / 2].map(|x| state.get(cavity::Fluid::VELOCITY, [x, y, 0]).unwrap().x);
        (left + right) / 2.0
    };
    let place = height * size as f64 - 0.5;
    let (below, part) = (place.floor() as usize, place.fract());
    row(below) * (1.0 - part) + row((below + 1).min(size - 1)) * part
}

#[test]
fn the_cavity_has_the_velocities_of_ghia() {
    let size = 64;
    for (reynolds, measured) in GHIA {
        let model = cavity::model(size as u32, reynolds).unwrap();
        let mut simulation = run(&model, 0, 30_000);
        let state = simulation.state();
        for (height, wanted) in measured {
            let found = along_x(&state, size, height) / 0.1;
            assert!((found - wanted).abs() < 0.02, "Re {reynolds}, height {height}: {found}, not {wanted}");
        }
    }
}

#[test]
fn same_bits() {
    let swirl = |site: Site| Vector3::new(0.05 * site.random(0), -0.03, 0.05 * site.random(1));
    assert_same_bits(&boltzmann::model([5, 4, 3], 0.02, swirl).unwrap(), 6);
    assert_same_bits(&cavity::model(7, 50.0).unwrap(), 8);
}
