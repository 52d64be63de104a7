//! Mutations of a file that follow from a number alone.

/// Numbers at which readers break: signs, limits of types, digits without end.
const WORDS: [&str; 18] = [
    "0",
    "-1",
    "1e308",
    "-1e308",
    "1e999",
    "nan",
    "inf",
    "1e-320",
    "99999999999999999999",
    "4294967296",
    "9223372036854775807",
    "18446744073709551615",
    "0.000000001",
    "\u{1b}[2J",
    "\u{202e}",
    "\"",
    "[",
    "=",
];

/// Whole numbers at which lengths break.
const LENGTHS: [u64; 8] = [0, 1, 0x7f, 0xffff, 0x7fff_ffff, 0xffff_ffff, 1 << 60, u64::MAX];

/// Random numbers by splitmix64 (Steele, Lea, Flood, OOPSLA 2014).
#[derive(Clone, Debug)]
pub(crate) struct Random(u64);

impl Random {
    /// The numbers of a case.
    pub(crate) fn of(seed: u64, case: u64) -> Self {
        let mut random = Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ case);
        random.next();
        random
    }

    /// The next number.
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number below a bound; 0 where that is 0.
    fn below(&mut self, bound: usize) -> usize {
        match bound {
            0 => 0,
            _ => (self.next() % bound as u64) as usize,
        }
    }
}

/// One of the seeds with one to six mutations.
pub(crate) fn mutated(seeds: &[Vec<u8>], random: &mut Random) -> Vec<u8> {
    let mut file = seeds[random.below(seeds.len())].clone();
    for _ in 0..=random.below(6) {
        mutate(&mut file, seeds, random);
    }
    file
}

fn mutate(file: &mut Vec<u8>, seeds: &[Vec<u8>], random: &mut Random) {
    let at = random.below(file.len());
    let end = (at + random.below(64)).min(file.len());
    match random.below(10) {
        0 if !file.is_empty() => file[at] ^= 1 << random.below(8),
        1 if !file.is_empty() => file[at] = random.next() as u8,
        2 => file.insert(at, random.next() as u8),
        3 => drop(file.drain(at..end)),
        4 => {
            let copy = file[at..end].to_vec();
            let to = random.below(file.len() + 1);
            file.splice(to..to, copy);
        }
        5 => file.truncate(at),
        6 => replace_number(file, at, WORDS[random.below(WORDS.len())].as_bytes()),
        7 => {
            let bytes = LENGTHS[random.below(LENGTHS.len())].to_le_bytes();
            let width = [1, 2, 4, 8][random.below(4)].min(file.len() - at);
            file[at..at + width].copy_from_slice(&bytes[..width]);
        }
        8 => {
            let other = &seeds[random.below(seeds.len())];
            let from = random.below(other.len());
            let to = (from + random.below(200)).min(other.len());
            file.splice(at..end, other[from..to].iter().copied());
        }
        _ => drop_line(file, at),
    }
}

/// Puts a word in the place of the next number.
fn replace_number(file: &mut Vec<u8>, from: usize, word: &[u8]) {
    let is_part = |byte: &u8| byte.is_ascii_digit() || matches!(byte, b'.' | b'-');
    let Some(start) = file[from..].iter().position(u8::is_ascii_digit).map(|k| from + k) else {
        return;
    };
    let length = file[start..].iter().take_while(|byte| is_part(byte)).count();
    file.splice(start..start + length, word.iter().copied());
}

/// Removes the line of a byte.
fn drop_line(file: &mut Vec<u8>, at: usize) {
    let is_end = |byte: &u8| *byte == b'\n';
    let start = file[..at].iter().rposition(is_end).map_or(0, |k| k + 1);
    let end = file[at..]
        .iter()
        .position(is_end)
        .map_or(file.len(), |k| at + k + 1);
    file.drain(start..end);
}
