//! The types of the numbers in VTK files.

/// The type of the numbers of an array.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names say it")]
pub enum NumberType {
    U8,
    I32,
    U32,
    F32,
    F64,
}

impl NumberType {
    const ALL: [Self; 5] = [Self::U8, Self::I32, Self::U32, Self::F32, Self::F64];

    /// The name in VTK.
    pub(super) fn vtk_name(self) -> &'static str {
        match self {
            Self::U8 => "UInt8",
            Self::I32 => "Int32",
            Self::U32 => "UInt32",
            Self::F32 => "Float32",
            Self::F64 => "Float64",
        }
    }

    /// The type with this name in VTK.
    pub(super) fn with_vtk_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|numbers| numbers.vtk_name() == name)
    }

    /// The number of bytes of a number.
    pub fn size(self) -> usize {
        match self {
            Self::U8 => 1,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }

    /// Converts the little-endian numbers of a file to the byte order of this machine, or the other way.
    pub fn of_this_machine(self, mut bytes: Vec<u8>) -> Vec<u8> {
        if cfg!(target_endian = "big") {
            bytes.chunks_exact_mut(self.size()).for_each(<[u8]>::reverse);
        }
        bytes
    }
}
