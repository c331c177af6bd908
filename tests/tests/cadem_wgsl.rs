//! Every process of CADEM can be written as WGSL that naga accepts.

mod cadem_support;

use cadem::{Case, Configuration, Integrator, Opening, Walls};
use cadem_support::TestResult;
use naga::valid::{Capabilities, ValidationFlags, Validator};
use xca_core::{Boundary, Faces, Precision};
use xca_wgsl::{Options, shader};

#[test]
fn all_processes_are_valid_shaders() -> TestResult {
    let mut written = 0;
    for walls in Walls::ALL {
        for integrator in Integrator::ALL {
            let openings = Opening::all_faces();
            let configuration =
                Configuration { walls, integrator, openings, ..Case::Illustration.configuration() };
            let model = cadem::model(&configuration, Vec::new())?;
            for (process, precision) in model
                .processes()
                .iter()
                .flat_map(|process| [Precision::F32, Precision::F64].map(|precision| (process, precision)))
            {
                let options = Options {
                    precision,
                    neighbourhood_size: Some(27),
                    boundaries: Faces::all(match walls {
                        Walls::PerSlot => Boundary::Toroidal,
                        _ => Boundary::Flat,
                    }),
                    ..Options::default()
                };
                let shader = shader(&(process.body)(), &options)?;
                let module = naga::front::wgsl::parse_str(&shader.source)
                    .map_err(|error| error.emit_to_string(&shader.source))?;
                let capabilities =
                    if shader.needs_f64 { Capabilities::FLOAT64 } else { Capabilities::empty() };
                Validator::new(ValidationFlags::all(), capabilities)
                    .validate(&module)
                    .map_err(|error| error.emit_to_string(&shader.source))?;
                written += 1;
            }
        }
    }
    // Seven processes and the guard of open walls; one more under the law per-slot.
    assert_eq!(written, 2 * 2 * (7 + 8));
    Ok(())
}
