//! What is varied: lists and ranges of values, and distributions.

use crate::varied::value_of;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, Normal, Uniform};
use scenario::Setting;
use toml::Value;

/// A key and the values that it takes one after the other.
#[derive(Clone, Debug)]
pub(crate) struct Axis {
    /// Path of the key.
    pub(crate) key: String,
    /// Its values.
    pub(crate) values: Values,
}

/// The values of an [`Axis`].
#[derive(Clone, Debug)]
pub(crate) enum Values {
    /// As given.
    List(Vec<Value>),
    /// Evenly spaced, both ends included; at least two.
    Range { low: f64, high: f64, count: u32 },
}

impl Values {
    /// How many there are.
    pub(crate) fn len(&self) -> usize {
        match self {
            Self::List(values) => values.len(),
            Self::Range { count, .. } => *count as usize,
        }
    }

    /// One of them, from 0.
    fn at(&self, place: usize) -> Value {
        match self {
            Self::List(values) => values[place].clone(),
            Self::Range { low, high, count } => {
                // Weights instead of increments: both ends are met exactly.
                let share = place as f64 / f64::from(count - 1);
                Value::Float(low * (1.0 - share) + high * share)
            }
        }
    }

    /// The texts among them, which may be names of files.
    pub(crate) fn texts(&self) -> impl Iterator<Item = &str> {
        let list = match self {
            Self::List(values) => values.as_slice(),
            Self::Range { .. } => &[],
        };
        list.iter().filter_map(Value::as_str)
    }
}

/// A key that is drawn.
#[derive(Clone, Debug)]
pub(crate) struct Draw {
    /// Path of the key.
    pub(crate) key: String,
    law: Law,
}

#[derive(Clone, Copy, Debug)]
enum Law {
    Normal(Normal<f64>),
    Uniform(Uniform<f64>),
}

impl Axis {
    /// The key at its `place`-th value.
    pub(crate) fn setting(&self, place: usize) -> Setting {
        Setting {
            key: self.key.clone(),
            value: self.values.at(place),
        }
    }
}

/// The keys of the `number`-th draw.
pub(crate) fn draw(draws: &[&Draw], seed: u64, number: u64) -> Vec<Setting> {
    let mut generator = ChaCha8Rng::seed_from_u64(seed);
    generator.set_stream(number);
    let one = |draw: &&Draw| {
        let value = match draw.law {
            Law::Normal(normal) => normal.sample(&mut generator),
            Law::Uniform(uniform) => uniform.sample(&mut generator),
        };
        Setting {
            key: draw.key.clone(),
            value: Value::Float(value),
        }
    };
    draws.iter().map(one).collect()
}

/// Reads `key=a,b,c`; values with commas in brackets are not split.
pub(crate) fn set(text: &str) -> Result<Axis, String> {
    let (key, values) = key_and(text, "KEY=A,B,C")?;
    let values = match value_of(&format!("[{values}]")) {
        Value::Array(values) => values,
        _ => values.split(',').map(|value| value_of(value.trim())).collect(),
    };
    if values.is_empty() {
        return Err(format!("\"{text}\": no values after the key"));
    }
    let values = Values::List(values);
    Ok(Axis { key, values })
}

/// Reads `key=low:high:n`.
pub(crate) fn range(text: &str) -> Result<Axis, String> {
    let (key, range) = key_and(text, "KEY=LOW:HIGH:N")?;
    let wrong =
        || format!("\"{range}\" is not a range: write LOW:HIGH:N with two numbers and a count of at least 2");
    let parts: Vec<&str> = range.split(':').collect();
    let [low, high, count] = parts[..] else {
        return Err(wrong());
    };
    let (low, high) = (number(low)?, number(high)?);
    let count: u32 = count.trim().parse().ok().filter(|&n| n >= 2).ok_or_else(wrong)?;
    Ok(Axis {
        key,
        values: Values::Range { low, high, count },
    })
}

/// Reads `key=mean:deviation`.
pub(crate) fn normal(text: &str) -> Result<Draw, String> {
    let (key, [mean, deviation]) = key_and_two(text, "KEY=MEAN:DEVIATION")?;
    let law = Normal::new(mean, deviation).map_err(|error| format!("\"{text}\": {error}"))?;
    Ok(Draw {
        key,
        law: Law::Normal(law),
    })
}

/// Reads `key=low:high`.
pub(crate) fn uniform(text: &str) -> Result<Draw, String> {
    let (key, [low, high]) = key_and_two(text, "KEY=LOW:HIGH")?;
    let law = Uniform::new_inclusive(low, high).map_err(|error| format!("\"{text}\": {error}"))?;
    Ok(Draw {
        key,
        law: Law::Uniform(law),
    })
}

fn key_and<'a>(text: &'a str, form: &str) -> Result<(String, &'a str), String> {
    let (key, rest) = text
        .split_once('=')
        .ok_or_else(|| format!("\"{text}\": write {form}"))?;
    Ok((key.trim().to_owned(), rest.trim()))
}

fn key_and_two(text: &str, form: &str) -> Result<(String, [f64; 2]), String> {
    let (key, rest) = key_and(text, form)?;
    let (a, b) = rest
        .split_once(':')
        .ok_or_else(|| format!("\"{text}\": write {form}"))?;
    Ok((key, [number(a)?, number(b)?]))
}

fn number(text: &str) -> Result<f64, String> {
    let number: Option<f64> = text.trim().parse().ok();
    number
        .filter(|number| number.is_finite())
        .ok_or_else(|| format!("\"{text}\" is not a finite number"))
}
