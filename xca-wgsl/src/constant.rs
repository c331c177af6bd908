//! Constants of the surrounding Rust code.

use crate::error::Problem;
use crate::inference::constant_type;
use crate::literal;
use crate::shader::Options;
use crate::types;
use xca_core::ScalarType;
use xca_core::ir::Constant;

/// The value of a constant, written out.
pub(crate) fn constant_text(name: &str, value: &Constant, options: &Options) -> Result<String, Problem> {
    match value {
        Constant::Bool(value) => Ok(value.to_string()),
        Constant::U8(value) => literal::integer(i128::from(*value), ScalarType::U8),
        Constant::I32(value) => literal::integer(i128::from(*value), ScalarType::I32),
        Constant::U32(value) => literal::integer(i128::from(*value), ScalarType::U32),
        Constant::State(number, _) => Ok(format!("{number}u")),
        Constant::F32(value) => literal::float((*value).into(), ScalarType::F32, options),
        Constant::Real(value) => literal::float(*value, ScalarType::Real, options),
        Constant::Vector(elements) | Constant::Array(elements) => {
            let type_ = constant_type(name, value)?;
            let elements = elements
                .iter()
                .map(|element| {
                    if constant_type(name, element)? != element_type(&type_) {
                        return Err(Problem::unsupported(
                            format!("the constant `{name}`"),
                            "its elements differ in type",
                        ));
                    }
                    constant_text(name, element, options)
                })
                .collect::<Result<Vec<_>, _>>()?;
            Ok(format!("{}({})", type_.wgsl(), elements.join(", ")))
        }
    }
}

fn element_type(type_: &types::Type) -> types::Type {
    match type_ {
        types::Type::Array(element, _) => (**element).clone(),
        types::Type::Vector(scalar, _) => types::Type::Scalar(*scalar),
        other => other.clone(),
    }
}
