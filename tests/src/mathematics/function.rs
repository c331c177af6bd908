//! The functions that are compared.

/// The functions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names say it")]
pub enum Function {
    Exp,
    Log,
    Pow,
    Sin,
    Cos,
    Tan,
    Atan,
    Atan2,
    Tanh,
    Exp2,
    ExpM1,
    Log2,
    Log10,
    Log1p,
    Cbrt,
    Hypot,
    Asin,
    Acos,
    Sinh,
    Cosh,
}

impl Function {
    /// All of them.
    pub const ALL: [Self; 20] = [
        Self::Exp,
        Self::Log,
        Self::Pow,
        Self::Sin,
        Self::Cos,
        Self::Tan,
        Self::Atan,
        Self::Atan2,
        Self::Tanh,
        Self::Exp2,
        Self::ExpM1,
        Self::Log2,
        Self::Log10,
        Self::Log1p,
        Self::Cbrt,
        Self::Hypot,
        Self::Asin,
        Self::Acos,
        Self::Sinh,
        Self::Cosh,
    ];

    /// What it is called.
    pub fn name(self) -> String {
        match self {
            Self::ExpM1 => "exp_m1".to_owned(),
            Self::Log1p => "log_1p".to_owned(),
            other => format!("{other:?}").to_lowercase(),
        }
    }
}
