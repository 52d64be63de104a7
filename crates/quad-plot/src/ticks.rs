//! Where ticks stand and how their numbers are written.
//!
//! On a logarithmic axis labels stand at whole decades where these are enough for an axis to be read; on shorter axes at 1 and 3, or at
//! 1, 2 and 5 times a power of ten; and on axes of less than a decade, where none of these gives three labels, at even steps. Ticks without
//! labels divide the decades between them.

/// The ticks of a logarithmic axis.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct LogTicks {
    /// Where labels stand.
    pub(super) labelled: Vec<f64>,
    /// The others.
    pub(super) minor: Vec<f64>,
}

/// Fewest labels that say what an axis' scale is.
const FEWEST: usize = 3;
/// How many more labels than aimed at an axis may have.
const CROWDED: f64 = 2.0;
/// Ends of the range count as inside to this share of a value.
const SLACK: f64 = 1e-9;

impl LogTicks {
    /// The ticks of an axis from `min` to `max`, both positive, on which `target` labels would look right.
    pub(super) fn of(min: f64, max: f64, target: f64) -> Self {
        let decades = max.log10() - min.log10();
        let every = (decades / (CROWDED * target)).ceil().max(1.0) as i32;
        let all = multiples(min, max, 1, &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0]);
        let whole = multiples(min, max, every, &[1.0]);
        if every > 1 {
            return Self {
                minor: multiples(min, max, 1, &[1.0]),
                labelled: whole,
            };
        }
        let candidates = [
            whole,
            multiples(min, max, 1, &[1.0, 3.0]),
            multiples(min, max, 1, &[1.0, 2.0, 5.0]),
        ];
        let most = (CROWDED * target).max(FEWEST as f64) + 1.0;
        let fits = |ticks: &Vec<f64>| ticks.len() >= FEWEST && ticks.len() as f64 <= most;
        let labelled = candidates.into_iter().find(fits);
        let labelled = labelled.unwrap_or_else(|| even_steps(min, max, target));
        Self { labelled, minor: all }
    }
}

/// These multiples of every `every`-th power of ten between `min` and `max`.
fn multiples(min: f64, max: f64, every: i32, factors: &[f64]) -> Vec<f64> {
    let first = min.log10().floor() as i32;
    let last = max.log10().ceil() as i32;
    let powers = (first..=last).filter(|power| power.rem_euclid(every) == 0);
    let inside = |v: &f64| (min * (1.0 - SLACK)..=max * (1.0 + SLACK)).contains(v);
    let all = powers.flat_map(|power| factors.iter().map(move |factor| factor * 10f64.powi(power)));
    all.filter(inside).collect()
}

/// Even steps between `min` and `max`, for an axis so short that it is nearly linear.
fn even_steps(min: f64, max: f64, target: f64) -> Vec<f64> {
    let step = nice_step((max - min) / target);
    let (first, last) = (
        (min / step - SLACK).ceil() as i64,
        (max / step + SLACK).floor() as i64,
    );
    (first..=last)
        .map(|i| i as f64 * step)
        .filter(|v| *v > 0.0)
        .collect()
}

/// The label of a tick of an axis from `min` to `max`: a plain number where the whole axis lies between a hundredth and a thousand, a power of ten
/// or a multiple of one otherwise.
pub(super) fn log_label(value: f64, min: f64, max: f64) -> String {
    // A value as close to a power of ten as rounding allows is one.
    let exponent = value.log10() + 1e-9;
    let decade = exponent.floor() as i32;
    if min >= 0.01 * (1.0 - SLACK) && max <= 1000.0 * (1.0 + SLACK) {
        let least = usize::try_from(-decade).unwrap_or(0);
        return format!("{:.*}", least.max(decimals_of(value)), value);
    }
    let factor = value / 10f64.powi(decade);
    if (factor - 1.0).abs() < 1e-6 {
        return format!("10{}", superscript(decade));
    }
    format!("{:.*}·10{}", decimals_of(factor), factor, superscript(decade))
}

/// 1, 2 or 5 times a power of ten, whichever is nearest to `raw` in ratio.
pub fn nice_step(raw: f64) -> f64 {
    if !(raw.is_finite() && raw > 0.0) {
        return 1.0;
    }
    let decade = 10f64.powf(raw.log10().floor());
    let distance = |factor: &f64| (raw / (factor * decade)).ln().abs();
    let nearest = [1.0, 2.0, 5.0, 10.0]
        .into_iter()
        .min_by(|a, b| distance(a).total_cmp(&distance(b)));
    nearest.unwrap_or(1.0) * decade
}

/// Decimals that tell multiples of `step` apart: 1 for 0.5, 2 for 0.25.
pub(super) fn decimals_of(step: f64) -> usize {
    let distinguishes = |decimals: &usize| {
        let scaled = step * 10f64.powi(*decimals as i32);
        (scaled - scaled.round()).abs() < 1e-6 * scaled
    };
    const MOST_DECIMALS: usize = 6;
    (0..MOST_DECIMALS).find(distinguishes).unwrap_or(MOST_DECIMALS)
}

/// An integer in superscript figures: `⁻³`.
pub fn superscript(value: i32) -> String {
    const FIGURES: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let figure = |c: char| c.to_digit(10).map_or('⁻', |digit| FIGURES[digit as usize]);
    value.to_string().chars().map(figure).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn exact_ticks_of_long_and_short_axes() {
        let labelled = |min, max, target| LogTicks::of(min, max, target).labelled;
        assert_eq!(labelled(1e-2, 1e2, 4.8), [0.01, 0.1, 1.0, 10.0, 100.0]);
        assert_eq!(labelled(1.0, 30.0, 4.8), [1.0, 3.0, 10.0, 30.0]);
        assert_eq!(labelled(1.0, 6.0, 4.8), [1.0, 2.0, 5.0]);
        let narrow: Vec<String> = labelled(1.1, 1.55, 4.8)
            .iter()
            .map(|t| log_label(*t, 1.1, 1.55))
            .collect();
        assert_eq!(narrow, ["1.1", "1.2", "1.3", "1.4", "1.5"]);
        assert_eq!(labelled(1e-20, 1.0, 4.0).len(), 7);
    }

    #[test]
    fn exact_labels() {
        assert_eq!(log_label(0.02, 0.01, 10.0), "0.02");
        assert_eq!(log_label(1.25, 1.0, 2.0), "1.25");
        assert_eq!(log_label(1e3, 1.0, 1e4), "10³");
        assert_eq!(log_label(2e-3, 1e-4, 1.0), "2·10⁻³");
        assert_eq!(log_label(1.25e5, 1e5, 2e5), "1.25·10⁵");
    }

    proptest! {
        #[test]
        fn prop_an_axis_has_labels_enough_and_not_too_many(low in -300.0..300.0_f64, decades in 0.02..40.0_f64, target in 2.0..9.0_f64) {
            let (min, max) = (10f64.powf(low), 10f64.powf((low + decades).min(307.0)));
            prop_assume!(max > 1.04 * min);
            let ticks = LogTicks::of(min, max, target);
            let count = ticks.labelled.len();
            // A step that is nice may be 1.6 times the one aimed at, so two targets give at least one tick, three at least two.
            prop_assert!(count >= 2 || target < 3.5, "{ticks:?}");
            prop_assert!(count as f64 <= 2.0 * target + 3.0, "{count} {target}");
            let inside = |v: &f64| (min * 0.999_999..=max * 1.000_001).contains(v);
            prop_assert!(ticks.labelled.iter().chain(&ticks.minor).all(inside));
        }
    }
}
