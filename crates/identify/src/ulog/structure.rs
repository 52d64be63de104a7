//! The structure of a ULog, looked through before the library reads it: what would take more memory or time than a log can need.
//!
//! A log is a head of 16 bytes and messages: length (u16), kind, payload. Messages `F` define formats, which may contain each other and repeat
//! fields; messages `A` subscribe to a format, and the library keeps its list of fields for each. Source: PX4 user guide, "ULog file format".

use std::collections::HashMap;
use std::io::{self, Read};

/// Bytes of the head.
const HEAD: usize = 16;

/// Most fields of a format, those of nested formats counted: a message has at most 65535 bytes.
const MOST_FIELDS: u64 = u16::MAX as u64;

/// Most fields of all subscriptions, some 100 bytes each; logs have some ten thousand.
const MOST_SUBSCRIBED: u64 = 1 << 20;

/// Formats that may contain each other in a row; PX4's have three.
const DEEPEST: u32 = 16;

/// The formats of a log by their names: types and repetitions of their fields.
type Formats = HashMap<String, Vec<(String, u64)>>;

/// Looks through a log.
///
/// # Errors
/// A format that repeats or nests its fields beyond what a message can hold; subscriptions with more fields than a log can need; a file that
/// can't be read. A log that is cut off is not one.
pub(super) fn check(mut log: impl Read) -> Result<(), String> {
    let mut head = [0; HEAD];
    if !filled(&mut log, &mut head)? {
        return Ok(());
    }
    let (mut formats, mut subscribed) = (Formats::new(), 0_u64);
    let (mut start, mut payload) = ([0; 3], Vec::new());
    while filled(&mut log, &mut start)? {
        payload.resize(usize::from(u16::from_le_bytes([start[0], start[1]])), 0);
        if !filled(&mut log, &mut payload)? {
            break;
        }
        match start[2] {
            b'F' => {
                let (name, fields) = format(&String::from_utf8_lossy(&payload))?;
                formats.insert(name, fields);
            }
            b'A' => {
                let name = String::from_utf8_lossy(payload.get(3..).unwrap_or_default());
                subscribed += count(&formats, &name, 0)?;
                if subscribed > MOST_SUBSCRIBED {
                    return Err(format!(
                        "its subscriptions have more than {MOST_SUBSCRIBED} fields"
                    ));
                }
            }
            _ => {}
        }
    }
    formats
        .keys()
        .try_for_each(|name| count(&formats, name, 0).map(drop))
}

/// Reads as many bytes as there is room for; whether there were as many.
fn filled(log: &mut impl Read, to: &mut [u8]) -> Result<bool, String> {
    match log.read_exact(to) {
        Ok(()) => Ok(true),
        Err(error) if error.kind() == io::ErrorKind::UnexpectedEof => Ok(false),
        Err(error) => Err(error.to_string()),
    }
}

/// Name and fields of a format, as in `name:uint64_t timestamp;float[3] gyro_rad;`. What is wrong otherwise is the library's to tell.
fn format(text: &str) -> Result<(String, Vec<(String, u64)>), String> {
    let (name, fields) = text.split_once(':').unwrap_or((text, ""));
    let field = |field: &str| {
        let kind = field.split(' ').next().unwrap_or_default();
        let Some((kind, repeated)) = kind.split_once('[') else {
            return Ok((kind.to_owned(), 1));
        };
        let times = repeated.trim_end_matches(']').parse().unwrap_or(u64::MAX);
        if times > MOST_FIELDS {
            return Err(format!(
                "the format {name} has a field {field}: at most {MOST_FIELDS} fit into a message"
            ));
        }
        Ok((kind.to_owned(), times))
    };
    let fields: Result<_, String> = fields.split(';').filter(|f| !f.is_empty()).map(field).collect();
    Ok((name.to_owned(), fields?))
}

/// Fields of a format, nested ones and itself counted; 1 of a type that is no format.
fn count(formats: &Formats, name: &str, depth: u32) -> Result<u64, String> {
    let Some(fields) = formats.get(name) else {
        return Ok(1);
    };
    if depth > DEEPEST {
        return Err(format!(
            "the format {name} contains itself, or formats more than {DEEPEST} deep"
        ));
    }
    let mut sum = 1_u64;
    for (kind, times) in fields {
        sum = sum.saturating_add(times.saturating_mul(count(formats, kind, depth + 1)?));
        if sum > MOST_FIELDS {
            return Err(format!("the format {name} has more than {MOST_FIELDS} fields"));
        }
    }
    Ok(sum)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A log of these messages.
    fn log(messages: &[(u8, &[u8])]) -> Vec<u8> {
        let mut bytes = vec![0; HEAD];
        for (kind, payload) in messages {
            bytes.extend(u16::try_from(payload.len()).unwrap().to_le_bytes());
            bytes.push(*kind);
            bytes.extend(*payload);
        }
        bytes
    }

    #[test]
    fn exact_formats_that_no_message_can_hold_are_refused() {
        let refused = |formats: &[&str]| {
            let messages: Vec<(u8, &[u8])> = formats.iter().map(|f| (b'F', f.as_bytes())).collect();
            check(log(&messages).as_slice())
        };
        refused(&["a:uint64_t timestamp;float[3] x;b inner;", "b:float y;"]).unwrap();
        assert!(
            refused(&["a:float[4000000000] x;"])
                .unwrap_err()
                .contains("float[4000000000]")
        );
        assert!(
            refused(&["a:b x;", "b:a y;"])
                .unwrap_err()
                .contains("contains itself")
        );
        // Each is small; together 300³ fields, of no size.
        assert!(
            refused(&["a:b[300] x;", "b:c[300] x;", "c:d[300] x;", "d:"])
                .unwrap_err()
                .contains("more than")
        );
    }

    #[test]
    fn exact_subscriptions_are_counted_and_cut_logs_are_none() {
        let format = (b'F', &b"a:float[60000] x;"[..]);
        let many: Vec<(u8, &[u8])> = std::iter::once(format)
            .chain([(b'A', &b"\0\0\0a"[..]); 20])
            .collect();
        assert!(
            check(log(&many).as_slice())
                .unwrap_err()
                .contains("subscriptions")
        );
        let one = log(&many[..2]);
        (0..one.len()).for_each(|end| check(&one[..end]).unwrap());
    }
}
