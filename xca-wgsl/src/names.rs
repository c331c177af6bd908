//! Names: those of the model where WGSL allows them, and no two the same where both are seen.

/// Words that a WGSL program cannot use as names.
const KEYWORDS: &str = "
alias break case const const_assert continue continuing default diagnostic discard else enable false fn for if let loop
override requires return struct switch true var while
NULL Self abstract active alignas alignof as asm asm_fragment async attribute auto await become cast catch class co_await
co_return co_yield coherent column_major common compile compile_fragment concept const_cast consteval constexpr constinit
crate debugger decltype delete demote demote_to_helper do dynamic_cast enum explicit export extends extern external
fallthrough filter final finally friend from fxgroup get goto groupshared highp impl implements import inline instanceof
interface layout lowp macro macro_rules match mediump meta mod module move mut mutable namespace new nil noexcept
noinline nointerpolation non_coherent noncoherent noperspective null nullptr of operator package packoffset
partition pass patch pixelfragment precise precision premerge priv protected pub public readonly ref regardless register
reinterpret_cast require resource restrict self set shared sizeof smooth snorm static static_assert static_cast std
subroutine super target template this thread_local throw trait try type typedef typeid typename typeof union unless
unorm unsafe unsized use using varying virtual volatile wgsl where with writeonly yield
";

/// Names that WGSL gives a meaning, which a model's name would hide.
const PREDECLARED: &str = "
bool f16 f32 f64 i32 i64 u32 u64 array atomic ptr sampler vec2 vec3 vec4 vec2i vec3i vec4i vec2u vec3u vec4u vec2f vec3f vec4f
vec2h vec3h vec4h mat2x2 mat2x3 mat2x4 mat3x2 mat3x3 mat3x4 mat4x2 mat4x3 mat4x4 binding_array
function private workgroup uniform storage read write read_write
abs acos acosh all any asin asinh atan atan2 atanh ceil clamp cos cosh countLeadingZeros countOneBits countTrailingZeros cross
degrees determinant distance dot exp exp2 extractBits faceForward firstLeadingBit firstTrailingBit floor fma fract frexp
insertBits inverse ldexp length log log2 max min mix modf normalize pow quantizeToF16 radians reflect refract reverseBits
round saturate select sign sin sinh smoothstep sqrt step tan tanh transpose trunc
bitcast arrayLength atomicLoad atomicStore atomicMin workgroupBarrier
";

/// Names of what the shader itself brings.
const OWN: &str = "
Real Destination Space Moment Fault Faults main space moment neighbour_offsets item_starts item_ends item_labels
item_cells destinations faults here here_index this_item element recorded_fault first_fault storage_index cell_index linear_index
neighbour_at valid_neighbour neighbour_direction neighbour_directions neighbour_exists record_fault report_fault has_fault multiply_high philox random_words random_bits random_real
cell_containing nearest_image shorter_way wrapped wrapped_along activity tile tiles run_number

";

/// The beginnings of the names of routines.
const PREFIXES: [&str; 28] = [
    "differs_",
    "changed_",
    "tuple_",
    "runtime_",
    "repeat_",
    "minimum_",
    "maximum_",
    "dot_",
    "cross_",
    "length_",
    "distance_",
    "normalize_",
    "saturate_",
    "infinity_",
    "copysign_",
    "signum_",
    "round_",
    "fraction_",
    "is_nan_",
    "is_finite_",
    "is_infinite_",
    "is_negative_",
    "remainder_",
    "rem_euclid_",
    "div_euclid_",
    "checked_",
    "truths_",
    "equal_",
];

/// Gives out names.
#[derive(Debug, Default)]
pub(crate) struct Names {
    module: Vec<String>,
    scopes: Vec<Vec<String>>,
}

impl Names {
    /// A name that the whole module sees. All of these are given out before the first local one.
    pub(crate) fn module(&mut self, wanted: &str) -> String {
        let name = self.free(wanted);
        self.module.push(name.clone());
        name
    }

    /// The name of a routine, which no variable of a model takes.
    pub(crate) fn routine(&mut self, wanted: &str) -> String {
        let name = if self.module.iter().any(|known| known == wanted) {
            self.free(wanted)
        } else {
            wanted.to_owned()
        };
        self.module.push(name.clone());
        name
    }

    /// A name for the innermost block.
    pub(crate) fn local(&mut self, wanted: &str) -> String {
        let name = self.free(wanted);
        if let Some(scope) = self.scopes.last_mut() {
            scope.push(name.clone());
        }
        name
    }

    pub(crate) fn open(&mut self) {
        self.scopes.push(Vec::new());
    }

    pub(crate) fn close(&mut self) {
        self.scopes.pop();
    }

    fn free(&self, wanted: &str) -> String {
        let base = cleaned(wanted);
        if self.is_free(&base) {
            return base;
        }
        let mut number = 2_u64;
        loop {
            let name = format!("{}_{number}", base.trim_end_matches('_'));
            if self.is_free(&name) {
                return name;
            }
            number += 1;
        }
    }

    fn is_free(&self, name: &str) -> bool {
        let taken = [KEYWORDS, PREDECLARED, OWN].iter().any(|words| contains(words, name))
            || self.module.iter().chain(self.scopes.iter().flatten()).any(|known| known == name);
        !taken && !is_routine(name)
    }
}

/// Whether the name looks like a routine's; numbered ones do not.
fn is_routine(name: &str) -> bool {
    let numbered =
        name.rsplit('_').next().is_some_and(|end| !end.is_empty() && end.chars().all(|c| c.is_ascii_digit()));
    !numbered && (PREFIXES.iter().any(|prefix| name.starts_with(prefix)) || name.ends_with("_at"))
}

fn contains(words: &str, name: &str) -> bool {
    words.split_whitespace().any(|word| word == name)
}

/// A field of a struct: fields are only seen after a dot, so that keywords alone are in the way.
pub(crate) fn field(name: &str) -> String {
    let name = cleaned(name);
    if contains(KEYWORDS, &name) { format!("{name}_") } else { name }
}

/// An identifier of WGSL: no `r#`, not only `_`, not two at the beginning.
fn cleaned(name: &str) -> String {
    let name = crate::program::bare(name);
    let bare = name.trim_start_matches('_');
    match (bare.is_empty(), name.starts_with("__")) {
        (true, _) => "unused".to_owned(),
        (false, true) => format!("_{bare}"),
        (false, false) => name.to_owned(),
    }
}

/// Whether the text contains the word.
pub(crate) fn mentions(text: &str, word: &str) -> bool {
    let is_part = |c: char| c == '_' || c.is_alphanumeric();
    text.match_indices(word).any(|(start, _)| {
        let before = text[..start].chars().next_back();
        let after = text[start + word.len()..].chars().next();
        !before.is_some_and(is_part) && !after.is_some_and(is_part)
    })
}

#[cfg(test)]
mod tests {
    use super::{Names, field};

    #[test]
    fn names_stay_apart() {
        let mut names = Names::default();
        assert_eq!(names.module("temperature"), "temperature");
        names.open();
        assert_eq!(names.local("temperature"), "temperature_2");
        assert_eq!(names.local("flux"), "flux");
        names.open();
        assert_eq!(names.local("flux"), "flux_2");
        names.close();
        names.open();
        assert_eq!(names.local("flux"), "flux_2");
    }

    #[test]
    fn words_of_wgsl_are_avoided() {
        let mut names = Names::default();
        names.open();
        assert_eq!(names.local("r#type"), "type_2");
        assert_eq!(names.local("_"), "unused");
        assert_eq!(names.local("__x"), "_x");
        assert_eq!(names.local("here"), "here_2");
        assert_eq!(names.local("ldexp"), "ldexp_2");
        assert_eq!(names.local("minimum_real"), "minimum_real_2");
        assert_eq!(field("type"), "type_");
        assert_eq!(field("position"), "position");
    }
}
