//! Do stated intervals contain the truth as often as they say?

/// Seeds of a coverage test.
const SEEDS: u64 = 200;

/// Asserts that 95 % intervals contain the truth in 90 to 99 % of the seeds.
///
/// Of 200 intervals that each contain the truth with probability 0.95, 180 to 198 do so in 999 of 1000 such tests
/// (binomial distribution); the seeds are fixed, so the outcome is too.
pub(crate) fn assert_covers(interval_contains_truth: impl Fn(u64) -> bool) {
    let hits = (0..SEEDS).filter(|&seed| interval_contains_truth(seed)).count();
    assert!(
        (180..=198).contains(&hits),
        "{hits} of {SEEDS} intervals contain the truth"
    );
}
