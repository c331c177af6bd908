//! What the macros make of right code gives no warning, however strict its author is. Clippy looks at it too.
#![forbid(unsafe_code)]
#![deny(
    warnings,
    missing_docs,
    unused_qualifications,
    missing_debug_implementations,
    missing_copy_implementations
)]
#![deny(rust_2018_idioms, single_use_lifetimes, trivial_casts, trivial_numeric_casts, unused_lifetimes)]
#![deny(explicit_outlives_requirements, unnameable_types, let_underscore_drop, unused_results, unit_bindings)]
#![deny(clippy::all, clippy::pedantic)]

use xca_core::prelude::*;

/// The number of a grain that moves.
const MOVING: u8 = 1;

/// The ground.
#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Ground {
    height: Real,
    kind: u8,
    slope: Vector2<Real>,
}

/// Grains on it.
#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Grain {
    /// The centre.
    #[position]
    centre: Vector3<Real>,
    kind: u8,
    force: Vector3<Real>,
}

/// How they push each other.
#[derive(Parameters, Clone, Copy, Debug)]
struct Material {
    #[parameter(unit = "m", positive)]
    radius: Real,
    #[parameter(range = 0..=3)]
    rule: u32,
}

/// The square.
#[helper]
#[must_use]
fn square(x: Real) -> Real {
    x * x
}

/// The push of one grain on another.
#[helper]
#[must_use]
fn push(p: &Material, separation: Vector3<Real>, space: &Space) -> Vector3<Real> {
    let distance = separation.length();
    if distance < space.side() / 1000.0 {
        return Vector3::splat(0.0);
    }
    separation * (square(p.radius) / distance)
}

/// Evens out the ground.
#[elementary_process]
fn erode(cell: &mut Cell<Ground>, grains: &Slots<Grain>, p: &Material) {
    let mut flux = 0.0;
    for n in 1..cell.neighbour_count() {
        let other = cell.neighbour(n);
        flux += other.height - cell.height;
    }
    match cell.kind {
        MOVING => cell.height += flux / 4.0,
        2 | 3..=9 => return,
        _ => {}
    }
    for grain in grains {
        cell.height += grain.centre.z * cell.random(p.rule as usize);
    }
    cell.slope += Vector2::splat(square(flux));
    if !(cell.height < 1000.0) {
        cell.fault(1, cell.height);
    }
}

/// Adds the pushes.
#[elementary_process]
fn collide(me: &mut Slot<Grain>, ground: &Cell<Ground>, p: &Material, space: &Space) {
    for other in me.others_within(2.0 * p.radius) {
        if other.label() < me.label() {
            me.force += push(p, me.centre - other.centre, space) * ground.height;
        }
    }
    let lanes = [me.force.x, me.force.y];
    let mut largest = 0.0;
    for lane in 0..2 {
        largest = lanes[lane].max(largest);
    }
    me.force.z = largest;
}

/// Moves the grains.
#[migration]
fn settle(me: &Slot<Grain>, space: &Space) -> Destination {
    if me.kind == MOVING { space.cell_containing(me.centre) } else { Destination::Stay }
}

mod apart {
    use xca_core::prelude::*;

    #[derive(Substates, Clone, Debug)]
    pub(super) struct Hidden {
        kind: u8,
    }

    #[derive(Parameters, Clone, Debug)]
    pub(super) struct Rule {
        pub(super) number: u32,
    }

    #[helper]
    const fn twice(kind: u8) -> u8 {
        kind * 2
    }

    #[elementary_process]
    #[allow(clippy::cast_possible_truncation, reason = "rules are below 256")]
    pub(super) fn apply(cell: &mut Cell<Hidden>, rule: &Rule) {
        cell.kind = twice(cell.kind) + rule.number as u8;
    }
}

#[test]
fn right_code_gives_no_warning() -> Result<(), ModelError> {
    let _grains = Model::builder("grains")
        .extents([2, 2, 2])
        .neighbourhood(Neighbourhood::moore(1))
        .substates::<Ground>()
        .population::<Grain>(2)
        .parameters(Material { radius: 0.25, rule: 0 })
        .process(erode)
        .process(collide)
        .process(settle)
        .build()?;
    let _apart = Model::builder("apart")
        .extents([1, 1, 1])
        .substates::<apart::Hidden>()
        .parameters(apart::Rule { number: 3 })
        .process(apart::apply)
        .build()?;
    Ok(())
}
