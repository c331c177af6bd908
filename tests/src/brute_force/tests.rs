use super::*;
#[test]
fn published() {
    let material = Material { stiffness: 100.0, ..Material::TABLE_1 };
    let placed = cadem::initial::authors_placement([20; 3], 0.002, material.radius, 1).unwrap();
    let t = std::time::Instant::now();
    let mut b = BruteForce { walls: Walls::PerSlot, time_step: 1e-4, ..BruteForce::new(material, [0.04; 3]) };
    b.particles = placed.iter().map(|p| Particle { position: p.position, velocity: [0.0; 3] }).collect();
    for s in 0..752 {
        if s % 100 == 0 || s > 746 {
            let e = b.energy();
            println!("{s} {:.12} {:e} {:?}", e.kinetic + e.potential, e.total(), t.elapsed());
        }
        b.step();
    }
}
