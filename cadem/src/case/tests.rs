use crate::*;

fn close(found: f64, expected: f64, share: f64) {
    assert!((found / expected - 1.0).abs() < share, "{found:e} is not {expected:e}");
}

#[test]
fn numbers_of_the_paper() {
    let table1 = Case::Table1.configuration();
    assert_eq!(table1.sides(), [0.2; 3]);
    assert_eq!(table1.kepler_bound(), 11);
    // Twice as many, and room for the three walls of a corner.
    assert_eq!(table1.slots(), 25);
    let material = table1.material();
    close(material.time_step, 1.118_034e-5, 1e-6);
    // Footnote 4: 8945 steps are 0.1 s.
    close(table1.steps as f64 * material.time_step, 0.1, 1e-4);
    close(TimeStep::Subdivisions(10.0).seconds(material.mass, material.stiffness), 3.512e-5, 1e-3);
    let Material { stiffness, damping, mass, radius, gravity, .. } = material;
    assert_eq!([stiffness, damping, mass, radius, gravity], [8000.0, 0.0015, 1e-4, 0.0005, 9.81]);
}

#[test]
fn the_small_systems() {
    let illustration = Case::Illustration.configuration();
    assert_eq!(illustration, Configuration { cells: [20; 3], ..Case::Table1.configuration() });
    let published = Case::Published.configuration();
    assert_eq!((published.walls, published.steps, published.cells), (Walls::PerSlot, 749, [20; 3]));
    assert_eq!((published.material().stiffness, published.material().time_step), (100.0, 1e-4));
    close(TimeStep::default().seconds(1e-4, 100.0), 1e-4, 1e-12);
}

#[test]
fn cases_have_names() {
    for case in Case::ALL {
        assert_eq!(case.to_string().parse::<Case>(), Ok(case));
        assert_eq!(case.configuration().check(), Ok(()));
    }
    let error = "table2".parse::<Case>().expect_err("no such case");
    assert_eq!(error.to_string(), "unknown case `table2`; use illustration, table1 or published");
}
