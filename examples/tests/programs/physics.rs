//! What the models must show.

use crate::running::{CADEM, HEAT, MOD2, Table, Workplace, report, vtk_array};
use std::f64::consts::PI;

/// The initial shape is an eigenvector of the scheme: it fades by the same factor in every step.
#[test]
fn heat_fades_as_the_scheme_says() {
    let place = Workplace::new();
    place.succeed(HEAT, "--size 15 --set alpha=0.15 --steps 200 --until 0 --every 50");
    let series = Table::read(&place.path("out/heat/observables.csv"));
    // The middle of 15 cells is a cell.
    let factor = 1.0 - 12.0 * 0.15 * (PI / 32.0).sin().powi(2);
    for (step, hottest) in series.column("step").into_iter().zip(series.column("hottest")) {
        let wanted = 100.0 * factor.powf(step);
        assert!((hottest / wanted - 1.0).abs() < 1e-12, "step {step}: {hottest}, not {wanted}");
    }
    assert_eq!(series.rows.len(), 5);
}

/// Halving the cells, four times as many steps reach the same time with a quarter of the error.
#[test]
fn heat_converges_to_the_solution_in_closed_form() {
    let place = Workplace::new();
    let error = |size: usize, steps: u64| {
        place.succeed(HEAT, &format!("--size {size} --steps {steps} --until 0"));
        let series = Table::read(&place.path("out/heat/observables.csv"));
        (series.last("time"), series.last("relative_error"))
    };
    let ((coarse_time, coarse), (time, fine)) = (error(15, 100), error(31, 400));
    assert!((time / coarse_time - 1.0).abs() < 1e-12);
    assert!((3.9..4.1).contains(&(coarse / fine)), "{coarse} {fine}");
    assert!(fine < 0.01, "{fine}");
}

#[test]
fn heat_stops_when_it_is_cool_enough() {
    let place = Workplace::new();
    let said = place.succeed(HEAT, "--size 20 --until 40");
    assert!(said.contains("no cell is further than 40 °C from 0 °C"), "{said}");
    let report = report(&place.path("out/heat"));
    assert_eq!(report["progress"]["outcome"], "stopped");
    let series = Table::read(&place.path("out/heat/observables.csv"));
    assert!((38.0..=40.0).contains(&series.last("hottest")));
    // 15 to 25 rows on the way, although no one knew where it ends.
    assert!((15..=25).contains(&series.rows.len()), "{}", series.rows.len());
}

/// After 2^k steps there are 27 copies of the figure; on a torus of 2^m cells the figure is back after
/// 2^(m-1).
#[test]
fn the_parity_rule_copies_its_figure() {
    const SIZE: usize = 32;
    let place = Workplace::new();
    place.succeed(MOD2, "--size 32 --steps 16 --every 1");
    let state = |step: usize| vtk_array(&place.path(&format!("out/mod2/frames/parity_{step:08}.vti")), "odd");
    let start = state(0);
    assert_eq!(start.iter().filter(|&&odd| odd == 1).count(), 6);
    for shift in [1, 2, 4, 8] {
        let mut wanted = vec![0_u8; SIZE.pow(3)];
        for (index, odd) in start.iter().enumerate() {
            let [x, y, z] = [index % SIZE, index / SIZE % SIZE, index / SIZE / SIZE];
            let places = |at: usize| [at + SIZE - shift, at, at + shift].map(|at| at % SIZE);
            for z in places(z) {
                for y in places(y) {
                    for x in places(x) {
                        wanted[(z * SIZE + y) * SIZE + x] ^= odd;
                    }
                }
            }
        }
        assert!(state(shift) == wanted, "step {shift}");
    }
    let copies = Table::read(&place.path("out/mod2/observables.csv")).column("odd_cells");
    assert_eq!((copies[4], copies[8], copies[16]), (27.0 * 6.0, 27.0 * 6.0, 6.0));
    assert!(state(16) == start && state(15) != start);
}

/// The run that the authors published ends with this energy (docs/cadem.md).
#[test]
fn the_published_run_of_cadem_ends_with_the_published_energy() {
    let place = Workplace::new();
    place.succeed(CADEM, "--case published");
    let series = Table::read(&place.path("out/cadem/observables.csv"));
    assert_eq!((series.last("step"), series.last("particles")), (749.0, 2602.0));
    let energy = series.last("kinetic_energy") + series.last("potential_energy");
    assert!((energy - 0.011_240_501).abs() < 5e-10, "{energy}");
}
