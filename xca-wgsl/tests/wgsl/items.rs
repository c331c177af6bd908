//! Processes over items, migrations, and cells that look at their items.

use crate::common::{accepted, function, written, written_with};
use xca_core::prelude::*;
use xca_wgsl::{Content, Dispatch, Options};

const VOID: u8 = 0;
const PARTICLE: u8 = 1;

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Dem {
    id: u8,
    #[position]
    position: Vector3<Real>,
    velocity: Vector3<Real>,
    force: Vector3<Real>,
}

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Field {
    density: Real,
    position: Real,
}

#[derive(Parameters, Clone, Debug)]
struct Material {
    radius: Real,
    stiffness: Real,
    damping: Real,
    step: Real,
}

#[helper]
fn contact_force(p: &Material, separation: Vector3<Real>, velocity: Vector3<Real>) -> Vector3<Real> {
    let distance = separation.length();
    let normal = separation / distance;
    let overlap = 2.0 * p.radius - distance;
    normal * (p.stiffness * overlap - p.damping * velocity.dot(normal))
}

#[elementary_process]
fn outer_contacts(me: &mut Slot<Dem>, p: &Material) {
    if me.id != PARTICLE {
        return;
    }
    let mut force = me.force;
    for other in me.others_in_neighbours_within(2.0 * p.radius) {
        if other.id == PARTICLE {
            force += contact_force(p, me.position - other.position, me.velocity - other.velocity);
        }
    }
    me.force = force;
}

#[test]
fn contacts() {
    accepted::<outer_contacts>();
    let options = Options { neighbourhood_size: Some(27), ..Options::default() };
    let shader = written_with::<outer_contacts>(&options);
    assert_eq!(shader.dispatch, Dispatch::Items(64));
    assert_eq!(
        function(&shader, "outer_contacts"),
        "\
fn outer_contacts() {
    if me.id != PARTICLE {
        return;
    }
    var force: vec3<Real> = me.force;
    let radius: Real = 2.0lf * p.radius;
    if !(radius >= Real() && radius <= space.covered) {
        report_fault(0xfffffffeu, radius);
    }
    let limit: Real = radius * radius;
    let centre: vec3<Real> = position_at(this_item);
    for (var neighbour: u32 = 1u; neighbour < 27u; neighbour += 1u) {
        let there: u32 = neighbour_at(neighbour);
        let end: u32 = item_ends[there];
        for (var other: u32 = item_starts[there]; other < end; other += 1u) {
            if other == this_item {
                continue;
            }
            let separation: vec3<Real> = centre - position_at(other);
            if !(dot_vec3_real(separation, separation) < limit) {
                continue;
            }
            if id_now[other] == PARTICLE {
                force += contact_force(me.position - position_at(other), me.velocity - velocity_at(other));
            }
        }
    }
    me.force = force;
}
"
    );
    assert_eq!(
        function(&shader, "contact_force"),
        "\
fn contact_force(separation: vec3<Real>, velocity: vec3<Real>) -> vec3<Real> {
    let distance_2: Real = length_vec3_real(separation);
    let normal: vec3<Real> = separation / distance_2;
    let overlap: Real = 2.0lf * p.radius - distance_2;
    return normal * (p.stiffness * overlap - p.damping * dot_vec3_real(velocity, normal));
}
"
    );
}

#[elementary_process]
fn move_(me: &mut Slot<Dem>, p: &Material) {
    if me.id == PARTICLE {
        me.velocity += me.force * p.step;
        me.position += me.velocity * p.step;
        if me.velocity.length_squared() > 1e6 {
            me.fault(3, me.velocity.length());
        }
    }
}

#[test]
fn motion_is_in_place() {
    accepted::<move_>();
    let shader = written::<move_>(Precision::F64);
    assert!(!shader.source.contains("_next"));
    assert!(shader.bindings.iter().any(|binding| matches!(binding.content, Content::Faults(_))));
}

#[elementary_process]
fn searches(me: &mut Slot<Dem>, cell: &Cell<Field>, space: &Space) {
    let mut found = 0;
    for other in me.others() {
        if other.label() == me.label() + 1 {
            found += 1;
            break;
        }
        for second in me.others_in_cell_within(space.side()) {
            if second.label() > other.label() {
                continue;
            }
            if second.velocity.x > 0.0 {
                break;
            }
            me.force.x += other.position.x;
        }
        if found > 3 {
            continue;
        }
    }
    for other in me.others_within(0.5 * space.side()) {
        while found > 0 {
            found -= 1;
            if found == 2 {
                break;
            }
        }
        me.force -= other.force;
    }
    for other in me.others_in_cell_within(space.side()) {
        me.force += other.force;
    }
    for other in me.others_in_cell() {
        me.force += other.velocity;
    }
    for other in me.others_in_neighbours() {
        if other.velocity.x > 2.0 {
            break;
        }
        me.force -= other.velocity;
    }
    if me.id == VOID || me.index().z == 0 {
        return;
    }
    me.velocity.x += me.random(0) * cell.density - cell.position;
    me.velocity.y += me.random_bits(1) as Real * 1e-9;
}

#[test]
fn searches_of_all_kinds() {
    accepted::<searches>();
    let options = Options {
        boundaries: [Boundary::Toroidal, Boundary::Flat, Boundary::Flat].into(),
        ..Options::default()
    };
    let shader = written_with::<searches>(&options);
    let text = function(&shader, "searches");
    assert_eq!(text.matches(" = true;").count(), 2, "{text}");
    assert!(text.contains("nearest_image(centre - position_at(second))"), "{text}");
    let image = function(&shader, "nearest_image");
    assert!(
        image.contains("vec3<Real>(shorter_way(separation.x, space.extents.x), separation.y, separation.z)")
    );
    // Cells and items both have a `position`: their buffers have names of their own.
    assert!(shader.source.contains("cell.position = position_now_2[here];"));
}

#[migration]
fn reassign(me: &Slot<Dem>, space: &Space) -> Destination {
    if me.id == VOID {
        return Destination::Stay;
    }
    if me.position.z < 0.0 { Destination::Outside } else { space.cell_containing(me.position) }
}

#[test]
fn a_migration() {
    accepted::<reassign>();
    let shader = written::<reassign>(Precision::F64);
    assert_eq!(
        function(&shader, "reassign"),
        "\
fn reassign() -> Destination {
    if me.id == VOID {
        return 0xffffffffu;
    }
    if me.position.z < 0.0lf {
        return 0xfffffffeu;
    } else {
        return cell_containing(me.position);
    }
}
"
    );
    assert!(shader.source.contains("    destinations[item] = reassign();\n"));
}

#[migration]
fn leap(me: &Slot<Dem>, space: &Space) -> Destination {
    if me.velocity.length() > space.side() {
        me.fault(2, me.velocity.x);
    }
    match me.id {
        VOID => Destination::Stay,
        _ => space.cell_containing(me.position + me.velocity),
    }
}

#[test]
fn a_migration_with_a_fault() {
    accepted::<leap>();
}

#[elementary_process]
fn deposit(cell: &mut Cell<Field>, slots: &Slots<Dem>) {
    let mut sum = 0.0;
    let mut last = 0;
    for item in slots {
        if item.id == PARTICLE {
            sum += item.velocity.length();
        }
        if item.label() > 10 {
            break;
        }
        last = item.label();
    }
    cell.density = sum + last as Real;
}

#[test]
fn cells_look_at_their_items() {
    accepted::<deposit>();
    let text = function(&written::<deposit>(Precision::F64), "deposit");
    assert!(text.contains("    let end: u32 = item_ends[here];\n"), "{text}");
    assert!(text.contains("velocity_at(item)"), "{text}");
}
