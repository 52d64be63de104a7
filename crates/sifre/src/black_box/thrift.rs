//! As much of Thrift's compact protocol as a Parquet file's structure takes: steps over fields, each held against the bytes that are left.
//!
//! The library that decodes the structure believes the number of elements of a list of Booleans, for which it takes no bytes, so that ten
//! bytes can keep it busy for hours. Here a list has at most as many elements as bytes follow. Source: Apache Thrift, "Thrift Compact
//! Protocol", and `parquet.thrift` of Apache Parquet.

/// Structures inside each other; Parquet's have eight.
const DEEPEST: u32 = 32;

/// Bytes that are walked over.
#[derive(Clone, Copy, Debug)]
pub(super) struct Thrift<'a> {
    bytes: &'a [u8],
}

/// The kind of a field or an element.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Boolean,
    Byte,
    Integer,
    Double,
    Binary,
    List,
    Map,
    Structure,
}

impl Kind {
    fn of(bits: u8) -> Option<Self> {
        Some(match bits {
            1 | 2 => Self::Boolean,
            3 => Self::Byte,
            4..=6 => Self::Integer,
            7 => Self::Double,
            8 => Self::Binary,
            9 | 10 => Self::List,
            11 => Self::Map,
            12 => Self::Structure,
            _ => return None,
        })
    }
}

impl<'a> Thrift<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self { bytes }
    }

    /// Bytes that are left.
    pub(super) fn left(&self) -> usize {
        self.bytes.len()
    }

    /// Steps over a structure; `None` if it is none, or has more elements than bytes.
    pub(super) fn structure(&mut self, depth: u32) -> Option<()> {
        self.fields(depth, &mut |_, _| Some(false))
    }

    /// Steps over a structure and gives each field's number to `take`, which reads it and says so, or leaves it.
    pub(super) fn fields(
        &mut self,
        depth: u32,
        take: &mut dyn FnMut(i64, &mut Self) -> Option<bool>,
    ) -> Option<()> {
        if depth > DEEPEST {
            return None;
        }
        let mut number = 0_i64;
        loop {
            let head = self.byte()?;
            if head == 0 {
                return Some(());
            }
            number = match head >> 4 {
                0 => self.integer()?,
                more => number.checked_add(i64::from(more))?,
            };
            let kind = Kind::of(head & 0x0f)?;
            // A Boolean field is in its head.
            if kind != Kind::Boolean && !take(number, self)? {
                self.skip(kind, depth)?;
            }
        }
    }

    /// A whole number of either sign.
    pub(super) fn integer(&mut self) -> Option<i64> {
        let zigzag = self.unsigned()?;
        Some((zigzag >> 1).cast_signed() ^ -(zigzag & 1).cast_signed())
    }

    fn byte(&mut self) -> Option<u8> {
        let (&byte, rest) = self.bytes.split_first()?;
        self.bytes = rest;
        Some(byte)
    }

    fn unsigned(&mut self) -> Option<u64> {
        let mut value = 0;
        for shift in (0..64).step_by(7) {
            let byte = self.byte()?;
            value |= u64::from(byte & 0x7f) << shift;
            if byte & 0x80 == 0 {
                return Some(value);
            }
        }
        None
    }

    fn skip_bytes(&mut self, count: u64) -> Option<()> {
        self.bytes = self.bytes.get(usize::try_from(count).ok()?..)?;
        Some(())
    }

    /// A number of elements, of which each has a byte at least.
    fn count(&self, count: u64) -> Option<u64> {
        (count <= self.left() as u64).then_some(count)
    }

    fn skip(&mut self, kind: Kind, depth: u32) -> Option<()> {
        match kind {
            // Of elements; the library takes none of them for a byte, so they are refused.
            Kind::Boolean => None,
            Kind::Byte => self.skip_bytes(1),
            Kind::Integer => self.unsigned().map(drop),
            Kind::Double => self.skip_bytes(8),
            Kind::Binary => {
                let count = self.unsigned()?;
                self.skip_bytes(count)
            }
            Kind::Structure => self.structure(depth + 1),
            Kind::List => {
                let head = self.byte()?;
                let count = match head >> 4 {
                    15 => self.unsigned()?,
                    few => u64::from(few),
                };
                let kind = Kind::of(head & 0x0f)?;
                (0..self.count(count)?).try_for_each(|_| self.skip_element(kind, depth))
            }
            Kind::Map => {
                let count = self.unsigned()?;
                if count == 0 {
                    return Some(());
                }
                let kinds = self.byte()?;
                let (key, value) = (Kind::of(kinds >> 4)?, Kind::of(kinds & 0x0f)?);
                (0..self.count(count)?).try_for_each(|_| {
                    self.skip_element(key, depth)?;
                    self.skip_element(value, depth)
                })
            }
        }
    }

    fn skip_element(&mut self, kind: Kind, depth: u32) -> Option<()> {
        match depth < DEEPEST {
            true => self.skip(kind, depth + 1),
            false => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Field 1 = −3 (i32), field 3 = a list of two bytes, the end.
    #[test]
    fn exact_a_structure_is_stepped_over_and_its_numbers_are_read() {
        let bytes = [0x15, 0x05, 0x29, 0x23, 7, 8, 0x00, 99];
        let mut thrift = Thrift::new(&bytes);
        let mut found = Vec::new();
        let fields = thrift.fields(0, &mut |number, at| {
            found.push(number);
            Some(number == 1 && at.integer() == Some(-3))
        });
        assert_eq!((fields, thrift.left(), found), (Some(()), 1, vec![1, 3]));
    }

    #[test]
    fn exact_more_elements_than_bytes_are_refused() {
        // A list of 2³¹ − 1 Booleans, one of as many bytes, one of lists in lists without end, a text longer than what follows.
        let lists: [&[u8]; 4] = [
            &[0x19, 0xf1, 0xff, 0xff, 0xff, 0xff, 0x07, 0x00],
            &[0x19, 0xf3, 0xff, 0xff, 0xff, 0xff, 0x07, 0x00],
            &[0x19; 100],
            &[0x18, 0x05, b'a', 0x00],
        ];
        for bytes in lists {
            assert_eq!(Thrift::new(bytes).structure(0), None, "{bytes:x?}");
        }
    }
}
