//! What stops a process: faults that it reports, and what ends it in Rust.

use xca_core::ir::FunctionKind;

/// What happened, as the record of a fault tells by its number.
///
/// Rust stops a process by a panic where an index lies beyond an array, a division has no result or a range
/// runs in steps of 0. A shader cannot: it records the fault, goes on with a value in range, and an engine
/// throws the step away.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[repr(u32)]
pub enum FaultKind {
    /// The process reported it: `number` is the code, `value` the value.
    Reported = 0,
    /// It asked for the neighbour `number`, which the neighbourhood does not have.
    BeyondNeighbourhood = 1,
    /// It asked for the element `number` of an array of `limit` elements.
    BeyondArray = 2,
    /// It divided an integer by zero.
    DivisionByZero = 3,
    /// It divided the least number of its type by -1.
    DivisionOverflow = 4,
    /// It asked for the remainder of a division by zero.
    RemainderByZero = 5,
    /// It asked for the remainder of the least number of its type divided by -1.
    RemainderOverflow = 6,
    /// It ran over a range in steps of 0.
    ZeroStep = 7,
}

impl FaultKind {
    const ALL: [Self; 8] = [
        Self::Reported,
        Self::BeyondNeighbourhood,
        Self::BeyondArray,
        Self::DivisionByZero,
        Self::DivisionOverflow,
        Self::RemainderByZero,
        Self::RemainderOverflow,
        Self::ZeroStep,
    ];

    /// The kind with this number.
    pub fn from_number(number: u32) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| *kind as u32 == number)
    }

    /// What Rust says where it stops a process for this reason; nothing where it does not.
    pub fn panic_message(self, number: u32, limit: u32) -> Option<String> {
        Some(match self {
            Self::Reported | Self::BeyondNeighbourhood => return None,
            Self::BeyondArray => {
                format!("index out of bounds: the len is {limit} but the index is {number}")
            }
            Self::DivisionByZero => "attempt to divide by zero".to_owned(),
            Self::DivisionOverflow => "attempt to divide with overflow".to_owned(),
            Self::RemainderByZero => "attempt to calculate the remainder with a divisor of zero".to_owned(),
            Self::RemainderOverflow => "attempt to calculate the remainder with overflow".to_owned(),
            Self::ZeroStep => "assertion failed: step != 0".to_owned(),
        })
    }
}

/// How a fault is kept until the process has ended.
pub(crate) fn record(kind: FunctionKind) -> String {
    let label = if kind == FunctionKind::Cells { "0xffffffffu" } else { "item_labels[this_item]" };
    format!(
        "// The first fault of a cell or item counts.
fn record_fault(kind: u32, number: u32, limit: u32, value: Real) {{
    if !has_fault {{
        has_fault = true;
        recorded_fault = Fault(linear_index(here_index), {label}, kind, number, limit, value);
    }}
}}
"
    )
}

/// What a process calls to report a fault.
pub(crate) const REPORT: &str = "fn report_fault(code: u32, value: Real) {
    record_fault(0u, code, 0u, value);
}
";

/// Stands at the beginning of a loop that may have no end after a fault.
const EXIT: &str = "// ends after a fault";

/// The line at the beginning of a loop that might have no end with the values that stand in for those which
/// Rust would have stopped at.
pub(crate) fn exit(indent: usize) -> String {
    format!("{:width$}{EXIT}\n", "", width = 4 * indent)
}

/// The text of a function whose loops end after a fault, where any operation is checked at all.
pub(crate) fn with_exits(text: &str, checks: bool) -> String {
    text.lines().fold(String::new(), |mut written, line| {
        match line.strip_suffix(EXIT) {
            Some(_) if !checks => {}
            Some(indent) => {
                for part in ["if has_fault {", "    break;", "}"] {
                    written.extend([indent, part, "\n"]);
                }
            }
            None => written.extend([line, "\n"]),
        }
        written
    })
}

#[cfg(test)]
mod tests {
    use super::FaultKind;
    use std::hint::black_box;

    /// Rust itself is asked, by panics that are caught.
    #[test]
    fn messages_are_those_of_rust() {
        let message = |work: fn() -> i32| {
            let panic = std::panic::catch_unwind(work).unwrap_err();
            panic
                .downcast_ref::<String>()
                .cloned()
                .or_else(|| panic.downcast_ref::<&str>().map(|&text| text.to_owned()))
        };
        let told = |kind: FaultKind| kind.panic_message(7, 3);
        assert_eq!(told(FaultKind::BeyondArray), message(|| black_box([1, 2, 3])[black_box(7)]));
        assert_eq!(told(FaultKind::DivisionByZero), message(|| 1 / black_box(0)));
        assert_eq!(told(FaultKind::DivisionOverflow), message(|| i32::MIN / black_box(-1)));
        assert_eq!(told(FaultKind::RemainderByZero), message(|| 1 % black_box(0)));
        assert_eq!(told(FaultKind::RemainderOverflow), message(|| i32::MIN % black_box(-1)));
        let steps = || (0..3).step_by(black_box(0)).sum();
        assert_eq!(told(FaultKind::ZeroStep), message(steps));
        assert_eq!(told(FaultKind::Reported), None);
    }

    #[test]
    fn numbers_name_kinds() {
        for kind in FaultKind::ALL {
            assert_eq!(FaultKind::from_number(kind as u32), Some(kind));
        }
        assert_eq!(FaultKind::from_number(8), None);
    }
}
