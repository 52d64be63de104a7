//! Numbers that survive a text file bit for bit.

use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error};

/// An `f64` in JSON: a number where it is finite, its bits in hexadecimal (`"0x7ff8000000000000"`) where it
/// is not, since JSON knows neither NaN nor infinity.
#[derive(Clone, Copy, Debug)]
pub struct Exact(pub f64);

impl PartialEq for Exact {
    /// The same bits; unlike `f64`, NaN equals itself and −0 differs from 0.
    fn eq(&self, other: &Self) -> bool {
        self.0.to_bits() == other.0.to_bits()
    }
}

impl Eq for Exact {}

/// What is in the file.
#[derive(Serialize, Deserialize)]
#[serde(untagged)]
enum Written {
    Number(f64),
    Bits(String),
}

impl Serialize for Exact {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        if self.0.is_finite() {
            Written::Number(self.0).serialize(serializer)
        } else {
            Written::Bits(format!("{:#x}", self.0.to_bits())).serialize(serializer)
        }
    }
}

impl<'de> Deserialize<'de> for Exact {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        match Written::deserialize(deserializer)? {
            Written::Number(number) => Ok(Self(number)),
            Written::Bits(text) => text
                .strip_prefix("0x")
                .and_then(|digits| u64::from_str_radix(digits, 16).ok())
                .map(|bits| Self(f64::from_bits(bits)))
                .ok_or_else(|| D::Error::custom(format!("\"{text}\" is neither a number nor its bits, 0x…"))),
        }
    }
}

/// Numbers made exact.
pub(crate) fn exact(values: &[f64]) -> Vec<Exact> {
    values.iter().copied().map(Exact).collect()
}

/// Exact numbers as they were.
pub(crate) fn plain(values: &[Exact]) -> Vec<f64> {
    values.iter().map(|value| value.0).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn prop_any_bits_come_back(bits in any::<u64>()) {
            let number = Exact(f64::from_bits(bits));
            let text = serde_json::to_string(&number).unwrap();
            prop_assert_eq!(serde_json::from_str::<Exact>(&text).unwrap(), number);
            // By way of a tree of values, as snapshots go.
            let tree: serde_json::Value = serde_json::from_str(&text).unwrap();
            prop_assert_eq!(serde_json::from_value::<Exact>(tree).unwrap(), number);
        }
    }

    #[test]
    fn exact_special_numbers_come_back() {
        for number in [
            0.0,
            -0.0,
            1.0,
            f64::NAN,
            f64::INFINITY,
            f64::MIN_POSITIVE / 8.0,
            f64::MAX,
        ] {
            let text = serde_json::to_string(&Exact(number)).unwrap();
            assert_eq!(
                serde_json::from_str::<Exact>(&text).unwrap(),
                Exact(number),
                "{text}"
            );
        }
        assert!(serde_json::from_str::<Exact>("\"0xzz\"").is_err());
    }
}
