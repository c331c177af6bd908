//! Writes processes as WGSL and has naga read and check them.

use xca_core::{Boundary, ElementaryProcess, Precision};
use xca_wgsl::{Error, Options, Shader, shader};

/// Writes the process for one precision; naga must accept it.
pub(crate) fn written<P: ElementaryProcess>(precision: Precision) -> Shader {
    written_with::<P>(&Options { precision, ..Options::default() })
}

/// Writes the process with these options; naga must accept it.
pub(crate) fn written_with<P: ElementaryProcess>(options: &Options) -> Shader {
    let process = P::process();
    match shader(&(process.body)(), options) {
        Ok(shader) => {
            validate(&shader);
            shader
        }
        Err(error) => panic!("{error}"),
    }
}

/// Writes the process for both precisions, with and without a known neighbourhood.
pub(crate) fn accepted<P: ElementaryProcess>() {
    for precision in [Precision::F32, Precision::F64] {
        for neighbourhood_size in [None, Some(7)] {
            for boundaries in
                [[Boundary::Flat; 3], [Boundary::Toroidal, Boundary::Flat, Boundary::Reflecting]]
            {
                for opaque_zero in [false, true] {
                    let options = Options {
                        precision,
                        neighbourhood_size,
                        boundaries: boundaries.into(),
                        opaque_zero,
                        ..Options::default()
                    };
                    written_with::<P>(&options);
                }
            }
        }
    }
}

/// The error that writing the process gives.
pub(crate) fn refused<P: ElementaryProcess>() -> Error {
    let process = P::process();
    shader(&(process.body)(), &Options::default()).expect_err("must be refused")
}

/// The module as naga reads it.
pub(crate) fn validate(shader: &Shader) -> naga::Module {
    let source = &shader.source;
    let module = match naga::front::wgsl::parse_str(source) {
        Ok(module) => module,
        Err(error) => panic!("{}\n{}", error.emit_to_string(source), numbered(source)),
    };
    let capabilities = if shader.needs_f64 {
        naga::valid::Capabilities::FLOAT64
    } else {
        naga::valid::Capabilities::empty()
    };
    let mut validator = naga::valid::Validator::new(naga::valid::ValidationFlags::all(), capabilities);
    if let Err(error) = validator.validate(&module) {
        panic!("{}\n{}", error.emit_to_string(source), numbered(source));
    }
    module
}

fn numbered(source: &str) -> String {
    source.lines().enumerate().map(|(number, line)| format!("{:4} {line}\n", number + 1)).collect()
}

/// The lines of the function with this name.
pub(crate) fn function(shader: &Shader, name: &str) -> String {
    let start = format!("fn {name}(");
    let lines = shader.source.lines().skip_while(|line| !line.starts_with(&start));
    let mut text = String::new();
    for line in lines {
        text.push_str(line);
        text.push('\n');
        if line == "}" {
            break;
        }
    }
    text
}
