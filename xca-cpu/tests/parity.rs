//! Both engines, small.
use xca_core::prelude::*;
use xca_cpu::Cpu;

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Walker {
    #[position]
    position: Vector3<Real>,
    velocity: Vector3<Real>,
    seen: u32,
}

#[elementary_process]
fn walk(me: &mut Slot<Walker>) {
    for other in me.others_within(0.75) {
        me.seen = me.seen.wrapping_mul(31).wrapping_add(other.label());
        me.velocity += 0.01 * (me.position - other.position);
    }
}
#[elementary_process]
fn go(me: &mut Slot<Walker>) {
    me.velocity += Vector3::new(me.random(0) - 0.5, me.random(1) - 0.5, me.random(2) - 0.5) * 0.1;
    me.position += me.velocity * 0.2;
}
#[migration]
fn settle(me: &Slot<Walker>, space: &Space) -> Destination {
    space.cell_containing(me.position)
}

#[test]
fn same_bits() -> Result<(), Box<dyn std::error::Error>> {
    let model = Model::builder("walkers")
        .extents([7, 6, 5])
        .neighbourhood(Neighbourhood::moore(1))
        .population::<Walker>(20)
        .items_may_leave::<Walker>()
        .process(walk)
        .process(go)
        .process(settle)
        .initialise(|state| {
            let items = (0..300u32)
                .map(|l| {
                    let p = [l % 7, l / 7 % 6, l / 42 % 5]
                        .map(|i| f64::from(i) + f64::from(l * 7919 % 97) / 97.0);
                    Item {
                        label: l,
                        cell: p.map(|x| x as usize),
                        state: Walker {
                            position: Vector3::new(p[0], p[1], p[2]),
                            velocity: Vector3::splat(0.0),
                            seen: 0,
                        },
                    }
                })
                .collect();
            Ok(state.set_items(items)?)
        })
        .build()?;
    for precision in [Precision::F32, Precision::F64] {
        let options = RunOptions { precision, seed: 3 };
        let mut a = Simulation::new(&model, &Reference, options)?;
        for threads in [1, 2, 3] {
            let mut a = Simulation::new(&model, &Reference, options)?;
            let mut b = Simulation::new(&model, &Cpu::with_threads(threads)?, options)?;
            for step in 0..60 {
                a.step()?;
                b.step()?;
                assert!(a.snapshot() == b.snapshot(), "step {step}");
            }
        }
        a.run(60)?;
        println!("{:?} left {}", a.state().count_items::<Walker>()?, a.state().count_left::<Walker>()?);
    }
    Ok(())
}
