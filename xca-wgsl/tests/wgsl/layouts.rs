//! Hosts write buffers by the layouts that come with a shader: they must be those of WGSL.

use crate::common::{validate, written};
use xca_core::prelude::*;
use xca_wgsl::{Content, Layout};

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct State {
    value: Real,
}

#[derive(Parameters, Clone, Debug)]
struct Mixed {
    first: f32,
    direction: Vector3<Real>,
    count: u32,
    pair: Vector2<f64>,
    grid: Vector3<i32>,
    r#loop: Real,
    last: Vector4<f32>,
    end: i32,
}

#[derive(States, Clone, Copy, Debug, PartialEq)]
enum Ground {
    Rock,
    Soil,
}

#[derive(Parameters, Clone, Debug)]
struct Arrays {
    wet: bool,
    shares: [Real; 3],
    ground: Ground,
    directions: [Vector3<Real>; 2],
    marks: [bool; 5],
    pairs: [Vector2<u8>; 3],
    grounds: [Ground; 2],
    end: Real,
}

#[elementary_process]
fn everything(cell: &mut Cell<State>, p: &Mixed, space: &Space) {
    cell.value = p.direction.x * p.r#loop * cell.random(space.step() as usize) + space.side();
    if p.end == 3 {
        cell.fault(1, cell.value);
    }
}

#[elementary_process]
fn arrays(cell: &mut Cell<State>, p: &Arrays) {
    if p.wet && p.ground == Ground::Rock {
        cell.value = p.shares[1] + p.end;
    }
}

/// The elements of arrays lie as far apart as WGSL has them.
#[test]
fn arrays_lie_as_in_wgsl() {
    for precision in [Precision::F32, Precision::F64] {
        let shader = written::<arrays>(precision);
        let module = validate(&shader);
        let layout = shader.bindings.iter().find_map(|binding| match &binding.content {
            Content::Parameters { layout, .. } => Some(layout),
            _ => None,
        });
        let layout = layout.unwrap();
        let (_, type_) =
            module.types.iter().find(|(_, type_)| type_.name.as_deref() == Some("Arrays")).unwrap();
        let naga::TypeInner::Struct { members, span } = &type_.inner else { panic!("no struct") };
        assert_eq!(layout.size, *span);
        let mut checked = 0;
        for (field, member) in layout.fields.iter().zip(members) {
            assert_eq!(field.offset, member.offset, "{}", field.name);
            if let naga::TypeInner::Array { stride, .. } = module.types[member.ty].inner {
                assert_eq!(field.stride, stride, "{}", field.name);
                checked += 1;
            }
        }
        assert_eq!(checked, 5);
    }
}

#[test]
fn layouts_are_those_of_wgsl() {
    for precision in [Precision::F32, Precision::F64] {
        let shader = written::<everything>(precision);
        let module = validate(&shader);
        let mut checked = 0;
        for binding in &shader.bindings {
            let (structure, layout): (&str, &Layout) = match &binding.content {
                Content::Space(layout) => ("Space", layout),
                Content::Moment(layout) => ("Moment", layout),
                Content::Parameters { layout, .. } => ("Mixed", layout),
                Content::Faults(layout) => ("Fault", layout),
                _ => continue,
            };
            checked += 1;
            let (_, type_) =
                module.types.iter().find(|(_, type_)| type_.name.as_deref() == Some(structure)).unwrap();
            let naga::TypeInner::Struct { members, span } = &type_.inner else {
                panic!("{structure} is no struct")
            };
            assert_eq!(layout.size, *span, "{structure}");
            let offsets: Vec<u32> = layout.fields.iter().map(|field| field.offset).collect();
            assert_eq!(
                offsets,
                members.iter().map(|member| member.offset).collect::<Vec<_>>(),
                "{structure}"
            );
        }
        assert_eq!(checked, 4);
        let (_, faults) =
            module.types.iter().find(|(_, type_)| type_.name.as_deref() == Some("Faults")).unwrap();
        let naga::TypeInner::Struct { members, .. } = &faults.inner else { panic!("Faults is no struct") };
        assert_eq!(members.iter().map(|member| member.offset).collect::<Vec<_>>(), [0, 4, 8]);
    }
}
