//! Check sums that notice a changed text. They keep nobody from changing it on purpose: they have no key.

/// The check sum of some bytes, 16 hexadecimal digits: FNV-1a with 64 bits.
///
/// ```text
/// h = (h ⊕ byte) · 1099511628211 mod 2⁶⁴     from h = 14695981039346656037
/// ```
///
/// Source: G. Fowler, L. C. Noll, K.-P. Vo, "The FNV Non-Cryptographic Hash Algorithm", 1991.
pub fn checksum(bytes: &[u8]) -> String {
    const OFFSET: u64 = 14_695_981_039_346_656_037;
    const PRIME: u64 = 1_099_511_628_211;
    let sum = bytes
        .iter()
        .fold(OFFSET, |sum, byte| (sum ^ u64::from(*byte)).wrapping_mul(PRIME));
    format!("{sum:016x}")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Test vectors of the source.
    #[test]
    fn exact_published_check_sums() {
        for (text, sum) in [
            ("", "cbf29ce484222325"),
            ("a", "af63dc4c8601ec8c"),
            ("foobar", "85944171f73967e8"),
        ] {
            assert_eq!(checksum(text.as_bytes()), sum);
        }
    }
}
