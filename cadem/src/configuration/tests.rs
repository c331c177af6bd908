use crate::*;
use xca_core::{Precision, Reference, RunOptions, Simulation};

fn table1() -> Configuration {
    Case::Table1.configuration()
}

fn refused(configuration: Configuration) -> String {
    let error = configuration.check().expect_err("it makes no sense");
    let same = model(&configuration, Vec::new()).expect_err("it makes no sense");
    assert_eq!(error.to_string(), same.to_string());
    error.to_string()
}

#[test]
fn values_that_make_no_sense() {
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(
            refused(Configuration { stiffness: bad, ..table1() }),
            format!("the parameter `stiffness` is {bad}, but must be above 0 and finite (N/m)")
        );
        assert!(refused(Configuration { mass: bad, ..table1() }).starts_with("the parameter `mass` is"));
        assert!(refused(Configuration { radius: bad, ..table1() }).starts_with("the parameter `radius` is"));
        assert!(refused(Configuration { cell_side: bad, ..table1() }).starts_with("the cell side is"));
        for time_step in [TimeStep::Seconds(bad), TimeStep::Fraction(bad)] {
            assert!(refused(Configuration { time_step, ..table1() }).contains("`time_step` is"));
        }
    }
    assert!(
        refused(Configuration { time_step: TimeStep::Subdivisions(0.0), ..table1() })
            .contains("`time_step` is inf")
    );
    assert_eq!(
        refused(Configuration { damping: -0.1, ..table1() }),
        "the parameter `damping` is -0.1, but must be at least 0 and finite (kg/s)"
    );
    assert!(refused(Configuration { gravity: f64::NAN, ..table1() }).contains("`gravity` is NaN"));
    for fine in [Configuration { damping: 0.0, ..table1() }, Configuration { gravity: 0.0, ..table1() }] {
        assert_eq!(fine.check(), Ok(()));
    }
}

#[test]
fn spaces_that_make_no_sense() {
    assert_eq!(
        refused(Configuration { radius: 0.001_001, ..table1() }),
        "the cell side is 0.002 m; it must be finite, and at least two radii of 0.001001 m, so that no contact reaches \
         beyond the neighbours"
    );
    assert_eq!(Configuration { radius: 0.001, ..table1() }.check(), Ok(()));
    assert!(refused(Configuration { cells: [3, 0, 3], ..table1() }).contains("[3, 0, 3] cells"));
    for cells in [[40_000; 3], [usize::MAX; 3]] {
        assert!(refused(Configuration { cells, ..table1() }).contains("BOUNDARY slots; labels for"));
    }
    // Sizes that only the framework knows to be too large, or too small for a torus.
    let error = model(&Configuration { cells: [2000; 3], ..table1() }, Vec::new()).expect_err("too large");
    assert!(error.to_string().contains("too large"), "{error}");
    let torus = Configuration { cells: [20, 2, 20], walls: Walls::PerSlot, ..table1() };
    let error = model(&torus, Vec::new()).expect_err("too narrow");
    assert!(error.to_string().contains("too far for 2 cells with a toroidal boundary"), "{error}");
}

#[test]
fn slots_hold_at_least_the_walls() {
    let with = |slots| Configuration { slots: Some(slots), ..table1() };
    assert_eq!(with(11).slots(), 11);
    assert_eq!(with(3).check(), Ok(()));
    let message = refused(Configuration { cells: [1, 4, 4], ..with(2) });
    assert_eq!(
        message,
        "2 slots do not hold the 4 BOUNDARY slots of cell [0, 0, 0]; give the cells more slots"
    );
    let open = Configuration { openings: Opening::all_faces(), ..with(1) };
    assert_eq!(open.check(), Ok(()));
    // Narrow cells, for which Kepler's bound is 1, and a tube.
    let narrow = Configuration { radius: 0.001, cells: [1, 1, 4], ..table1() };
    assert_eq!((narrow.kepler_bound(), narrow.slots()), (1, 8 + 5));
}

#[test]
fn parameters_have_names() {
    let mut configuration = table1();
    let error = configuration.set("viscosity", "1").expect_err("no such parameter");
    assert_eq!(
        error.to_string(),
        "no parameter is called `viscosity`; known parameters: stiffness, damping, mass, radius, gravity, time_step"
    );
    assert!(configuration.set("mass", "heavy").is_err());
    assert_eq!(configuration, table1());
    configuration.time_step = TimeStep::Subdivisions(20.0);
    for (name, value) in [("mass", "2e-4"), ("radius", "0.0004"), ("damping", "0"), ("gravity", "1.62")] {
        configuration.set(name, value).expect("it has this parameter");
    }
    let expected = Configuration {
        mass: 2e-4,
        radius: 0.0004,
        damping: 0.0,
        gravity: 1.62,
        time_step: TimeStep::Subdivisions(20.0),
        ..table1()
    };
    assert_eq!(configuration, expected);
}

#[test]
fn goes_through_a_file() {
    let configuration = Configuration {
        openings: vec![
            Opening::whole(Face::ZHigh),
            Opening { face: Face::ZLow, cells: Some(Rectangle { first: [8, 8], last: [11, 11] }) },
        ],
        slots: Some(11),
        ..Case::Published.configuration()
    };
    let text = toml::to_string(&configuration).expect("it can be written");
    assert_eq!(toml::from_str(&text), Ok(configuration));
    let text = "
        cells = [4, 4, 8]
        walls = 'per-slot'
        integrator = 'explicit'
        time_step = { subdivisions = 50 }
        openings = [{ face = 'z-low', cells = { first = [1, 1], last = [2, 2] } }]
    ";
    let expected = Configuration {
        cells: [4, 4, 8],
        walls: Walls::PerSlot,
        integrator: Integrator::Explicit,
        time_step: TimeStep::Subdivisions(50.0),
        openings: vec![Opening { face: Face::ZLow, cells: Some(Rectangle { first: [1, 1], last: [2, 2] }) }],
        ..Case::Illustration.configuration()
    };
    assert_eq!(toml::from_str(text), Ok(expected));
}

#[test]
fn a_file_with_an_unknown_name_is_refused() {
    for (text, known) in [
        ("stifness = 1.0", "stiffness"),
        ("walls = 'double'", "`single` or `per-slot`"),
        ("integrator = 'verlet'", "`semi-implicit` or `explicit`"),
        ("time_step = { hours = 1.0 }", "`fraction`, `subdivisions`, `seconds`"),
        ("openings = [{ face = 'top' }]", "`z-high`"),
        ("openings = [{ face = 'z-low', size = 3 }]", "`cells`"),
    ] {
        let error = toml::from_str::<Configuration>(text).expect_err("unknown").to_string();
        assert!(error.contains(known), "{error}");
    }
}

#[test]
fn a_time_step_that_is_too_long_for_a_contact_is_warned_of() {
    for case in [Case::Illustration, Case::Table1] {
        assert_eq!(case.configuration().warnings(Precision::F64), Vec::<String>::new(), "{case}");
    }
    // Nine pieces of a wall act at once in the program of the authors.
    let published = Case::Published.configuration().warnings(Precision::F64);
    assert!(published[0].starts_with("a contact with a wall takes 10.5 steps"), "{published:?}");
    // The numbers of the paper's benchmark, as docs/cadem.md has them.
    let duration = table1().material().contact_duration();
    assert!((duration / 2.483649e-4 - 1.0).abs() < 1e-6, "{duration}");
    let slow = Configuration { time_step: TimeStep::Seconds(2.483649e-5), ..table1() };
    assert_eq!(
        slow.warnings(Precision::F64),
        [
            "a contact takes 10.0 steps; fewer than 20 give a wrong energy; a time step of 1.242e-5 s is small enough"
        ]
    );
    let advised = Configuration { time_step: TimeStep::Seconds(1.2415e-5), ..table1() };
    assert!(advised.warnings(Precision::F64).is_empty());
}

/// How long a particle that meets a wall has it within its radius, in s, in steps that are far shorter than a
/// contact.
fn bounce(walls: Walls) -> f64 {
    let configuration = Configuration {
        cells: [3; 3],
        walls,
        gravity: 0.0,
        time_step: TimeStep::Seconds(1e-7),
        ..Case::Illustration.configuration()
    };
    let wall = configuration.wall(Face::ZLow);
    let radius = configuration.radius;
    let middle = 1.5 * configuration.cell_side;
    let particle =
        Particle { label: 1, position: [middle, middle, wall + radius + 1e-8], velocity: [0.0, 0.0, -0.1] };
    let model = model(&configuration, vec![particle]).unwrap();
    let mut simulation = Simulation::new(&model, &Reference, RunOptions::default()).unwrap();
    let mut steps = 0;
    loop {
        simulation.step().unwrap();
        let here = particles(&simulation.state()).unwrap()[0];
        let touches = here.position[2] - wall < radius;
        steps += i32::from(touches);
        if here.velocity[2] > 0.0 && !touches {
            return f64::from(steps) * 1e-7;
        }
    }
}

/// The law that is written down, against a particle that bounces.
#[test]
fn a_wall_holds_a_particle_as_long_as_it_says() {
    for walls in Walls::ALL {
        let material = Case::Illustration.configuration().material();
        let (found, wanted) = (bounce(walls), material.wall_contact_duration(walls.pieces()));
        assert!((found / wanted - 1.0).abs() < 0.02, "{walls}: {found} {wanted}");
    }
}

/// The warning names the speed at which `f32` begins to lose the motion, near the far end of the domain.
#[test]
fn f32_loses_slow_motion_where_it_says_so() {
    let configuration = table1();
    let lost = configuration.lost_speed();
    let (place, step) = (0.99 * configuration.sides()[0] as f32, configuration.material().time_step);
    assert_eq!(place + (0.99 * lost * step) as f32, place);
    assert!(place + (1.01 * lost * step) as f32 > place);
    let [warning] = &configuration.warnings(Precision::F32)[..] else { panic!("one warning") };
    assert!(warning.contains(&format!("slower than about {lost:.1e} m/s")), "{warning}");
}

/// The largest error of the kinetic energy after an undamped contact of about so many steps.
fn energy_error(steps: f64) -> f64 {
    let mut largest = 0.0_f64;
    for part in -10..=10 {
        let frequency = std::f64::consts::PI / (steps + f64::from(part) / 20.0);
        for phase in 0..400 {
            let (mut overlap, mut speed) = (1e-12 + f64::from(phase) / 400.0, 1.0_f64);
            while overlap > 0.0 {
                speed -= frequency * frequency * overlap;
                overlap += speed;
            }
            largest = largest.max((speed * speed - 1.0).abs());
        }
    }
    largest
}

/// The table of docs/cadem.md.
#[test]
fn energy_errors_fall_with_the_steps_of_a_contact() {
    for (steps, percent) in [(5.0, 13.4), (10.0, 2.8), (20.0, 0.65), (50.0, 0.1)] {
        let found = 100.0 * energy_error(steps);
        assert!((found / percent - 1.0).abs() < 0.03, "{steps} steps: {found} %");
    }
}
