//! The run that the authors published with their program.

use super::*;

/// Their particles, in their box: softer than in the paper, with their law of walls.
fn published() -> BruteForce {
    let material = Material { stiffness: 100.0, ..Material::TABLE_1 };
    let placed = cadem::initial::authors_placement([20; 3], 0.002, material.radius, 1).expect("it fits");
    let particles = placed.iter().map(|placed| Particle::at_rest(placed.position)).collect();
    let empty = BruteForce::new(material, [0.04; 3]);
    BruteForce { particles, walls: Walls::PerSlot, ..empty }
}

#[test]
fn ends_with_the_energy_that_the_authors_print() {
    let mut system = published();
    close(system.time_step, 1e-4, 1e-18);
    let mut deepest = 0.0;
    for _ in 0..749 {
        system.step();
        let overlaps = system.wall_contacts().into_iter().map(|contact| contact.overlap);
        deepest = overlaps.fold(deepest, f64::max);
    }
    let Energy { kinetic, potential, .. } = system.energy();
    // They print nine decimals. A change of the first state by its last bits changes the eleventh.
    close(kinetic + potential, 0.011_240_501, 1e-9);
    // Centres stay inside the walls, so that it does not matter that their program drops the sign of a
    // distance.
    assert!(deepest < system.material.radius, "overlap {deepest}");
}
