use crate::*;

fn table1() -> Configuration {
    Case::Table1.configuration()
}

fn refused(configuration: &Configuration, particles: &[Particle]) -> ParticleError {
    let error = configuration.check_particles(particles).expect_err("no run can start so");
    let same = model(configuration, particles.to_vec()).expect_err("no run can start so");
    assert_eq!(same.to_string(), error.to_string());
    error
}

#[test]
fn positions_and_velocities_are_numbers() {
    let [fine, nan] = [[0.01; 3], [0.01, f64::NAN, 0.01]];
    let error = refused(&table1(), &[Particle::at_rest(3, fine), Particle::at_rest(4, nan)]);
    assert_eq!(error.labels(), (4, None));
    assert_eq!(
        error.to_string(),
        "the position of particle 4 is [0.01, NaN, 0.01]; it must be three finite numbers"
    );
    let error =
        refused(&table1(), &[Particle { label: 1, position: fine, velocity: [0.0, 0.0, f64::INFINITY] }]);
    assert!(error.to_string().starts_with("the velocity of particle 1 is"), "{error}");
}

#[test]
fn particles_are_inside_the_domain_and_before_the_walls() {
    for position in [[-1e-9, 0.1, 0.1], [0.1, 0.2, 0.1], [0.1, 0.1, 7.0]] {
        let error = refused(&table1(), &[Particle::at_rest(9, position)]);
        assert_eq!(error, ParticleError::Outside { label: 9, position, sides: [0.2; 3] });
        // Nothing lets them.
        let lenient = Configuration { allow_overlaps: true, openings: Opening::all_faces(), ..table1() };
        refused(&lenient, &[Particle::at_rest(9, position)]);
    }
    let inset = [Particle::at_rest(1, [0.1, 0.1, 0.0004])];
    assert_eq!(table1().check_particles(&inset), Ok(()));
    let per_slot = Configuration { walls: Walls::PerSlot, ..table1() };
    let error = refused(&per_slot, &inset);
    assert_eq!(
        error.to_string(),
        "particle 1 at [0.1, 0.1, 0.0004] m is behind the wall z-low, which this wall law puts at 0.0005 m; `allow_overlaps` (`--allow-overlaps` on the command line) lets it"
    );
    let open = Configuration { openings: vec![Opening::whole(Face::ZLow)], ..per_slot.clone() };
    assert_eq!(open.check_particles(&inset), Ok(()));
    assert_eq!(Configuration { allow_overlaps: true, ..per_slot }.check_particles(&inset), Ok(()));
}

#[test]
fn labels_are_small_and_unique() {
    let at = |label, x| Particle::at_rest(label, [x, 0.1, 0.1]);
    assert_eq!(table1().check_particles(&[at(0, 0.1), at(FIRST_BOUNDARY_LABEL - 1, 0.11)]), Ok(()));
    let error = refused(&table1(), &[at(FIRST_BOUNDARY_LABEL, 0.1)]);
    assert_eq!(
        error.to_string(),
        "the label 2147483648 is too large; labels of particles are less than 2147483648"
    );
    let error = refused(&table1(), &[at(6, 0.1), at(5, 0.11), at(6, 0.12)]);
    assert_eq!(error.to_string(), "two particles have the label 6");
}

#[test]
fn particles_do_not_overlap_unless_allowed() {
    let at = |label, x| Particle::at_rest(label, [x, 0.1, 0.1]);
    // Two overlaps across cells; touching is no overlap (0.0625 and 2^-10 are exact).
    let binary = Configuration { radius: 1.0 / 2048.0, ..table1() };
    assert_eq!(binary.check_particles(&[at(1, 0.0625), at(2, 0.0625 + 1.0 / 1024.0)]), Ok(()));
    let particles = [at(30, 0.1019), at(7, 0.1), at(20, 0.1028), at(8, 0.1008), at(1, 0.15)];
    let error = refused(&table1(), &particles);
    assert_eq!(error.labels(), (7, Some(8)));
    let ParticleError::Overlap { distance, diameter, pairs, .. } = error else { panic!("{error}") };
    assert!((distance - 0.0008).abs() < 1e-12);
    assert_eq!((diameter, pairs), (0.001, 2));
    assert_eq!(Configuration { allow_overlaps: true, ..table1() }.check_particles(&particles), Ok(()));
}

#[test]
fn the_authors_particles_are_accepted() {
    for case in [Case::Illustration, Case::Published] {
        let configuration = case.configuration();
        let particles = configuration.authors_particles().expect("they can be placed");
        assert_eq!(particles.len(), 2602);
        assert_eq!(configuration.check_particles(&particles), Ok(()));
    }
}
