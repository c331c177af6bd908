//! Every construct of the subset compiles.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Heat {
    temperature: Real,
    kind: u8,
}
#[derive(Parameters, Clone, Debug)]
struct Conduction {
    alpha: Real,
}

#[elementary_process]
fn diffuse(cell: &mut Cell<Heat>, p: &Conduction) {
    let mut flux = 0.0;
    for n in 1..cell.neighbours() {
        flux += cell.neighbour(n).temperature - cell.temperature;
    }
    cell.temperature += p.alpha * flux;
}

const PARTICLE: u8 = 1;
#[derive(Substates, Clone, Copy, Debug)]
struct Dem {
    id: u8,
    #[position]
    position: Vector3<Real>,
    velocity: Vector3<Real>,
    force: Vector3<Real>,
}

#[helper]
fn contact(p: &Conduction, d: Vector3<Real>) -> Vector3<Real> {
    let l = d.length();
    if l < 0.5 {
        return Vector3::splat(0.0);
    }
    d * (p.alpha / l)
}

#[elementary_process]
fn outer(me: &mut Slot<Dem>, p: &Conduction) {
    if me.id != PARTICLE {
        return;
    }
    for other in me.others_in_neighbours_within(2.0 * p.alpha) {
        if other.id == PARTICLE {
            me.force += contact(p, me.position - other.position);
        }
    }
    for other in me.others_in_cell() {
        match other.id {
            PARTICLE => me.force.x += 1.0,
            2..=3 => me.force.y += 2.0,
            _ => {}
        }
    }
}

#[migration]
fn reassign(me: &Slot<Dem>, space: &Space) -> Destination {
    if me.id == PARTICLE { space.cell_containing(me.position) } else { Destination::Stay }
}

#[test]
fn names() {
    use xca_core::ElementaryProcess;
    assert_eq!(diffuse::process().access.len(), 1);
    assert_eq!(outer::process().access.len(), 4);
    let _ = reassign::process();
}
