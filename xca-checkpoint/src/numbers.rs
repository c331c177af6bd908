//! Exact numbers in JSON.

use serde::{Deserialize, Serialize};

/// A number that survives JSON to the last bit. JSON cannot hold numbers that are not finite, so they are
/// written as their bits in hexadecimal.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
#[serde(into = "Spelt", try_from = "Spelt")]
pub struct Exact(pub f64);

#[derive(Serialize, Deserialize)]
#[serde(untagged)]
enum Spelt {
    Number(f64),
    Bits(String),
}

impl From<Exact> for Spelt {
    fn from(Exact(value): Exact) -> Self {
        if value.is_finite() { Self::Number(value) } else { Self::Bits(format!("{:#018x}", value.to_bits())) }
    }
}

impl TryFrom<Spelt> for Exact {
    type Error = String;

    fn try_from(spelt: Spelt) -> Result<Self, String> {
        match spelt {
            Spelt::Number(value) => Ok(Self(value)),
            Spelt::Bits(text) => {
                let bits = text.strip_prefix("0x").and_then(|digits| u64::from_str_radix(digits, 16).ok());
                bits.map(|bits| Self(f64::from_bits(bits))).ok_or_else(|| format!("`{text}` is not a number"))
            }
        }
    }
}

/// Compares the bits.
impl PartialEq for Exact {
    fn eq(&self, other: &Self) -> bool {
        self.0.to_bits() == other.0.to_bits()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn json_keeps_every_bit() {
        let mut numbers = vec![0.0, -0.0, 0.1 + 0.2, 5e-324, f64::MAX, f64::INFINITY, 2602.0];
        numbers.push(f64::from_bits(0x7ff0_0000_dead_beef));
        let mut bits = 1_u64;
        for _ in 0..2000 {
            bits = bits.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            numbers.push(f64::from_bits(bits));
        }
        for number in numbers {
            let text = serde_json::to_string(&Exact(number)).unwrap();
            let back: Exact = serde_json::from_str(&text).unwrap();
            assert_eq!(back.0.to_bits(), number.to_bits(), "{text}");
        }
        assert_eq!(serde_json::to_string(&Exact(f64::NEG_INFINITY)).unwrap(), "\"0xfff0000000000000\"");
        assert!(serde_json::from_str::<Exact>("\"0.5\"").is_err());
    }
}
