//! Axes: range, ticks and tick labels.

use super::ticks::{LogTicks, decimals_of, log_label};
pub use super::ticks::{nice_step, superscript};

/// An axis as the caller states it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Axis {
    /// Label with symbol and unit, rich text: `Height *z*, m`.
    pub label: String,
    /// Range, if it is not to follow from the data.
    pub range: Option<(f64, f64)>,
    /// Distance between ticks, if it is not to be chosen.
    pub step: Option<f64>,
    /// Linear or logarithmic.
    pub scale: Scale,
    /// Names of categories 1, 2, … instead of numbers.
    pub categories: Vec<String>,
}

/// How values map to the length of an axis.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Scale {
    /// In proportion.
    #[default]
    Linear,
    /// By the logarithm.
    Log,
}

/// An axis whose range and ticks are settled.
#[derive(Clone, Debug, PartialEq)]
pub struct SettledAxis {
    /// Lower end.
    pub min: f64,
    /// Upper end.
    pub max: f64,
    /// Linear or logarithmic.
    pub scale: Scale,
    /// Distance between ticks of a linear axis.
    pub step: f64,
    /// Power of ten that the tick labels of a linear axis leave out; it stands once, at the end of the axis.
    pub exponent: i32,
    /// How many ticks would look right.
    pub target_ticks: f64,
}

/// How much of the data's range is left free at each end, where an axis is padded.
const PADDING: f64 = 0.04;
/// The largest number that an axis shows, so that room beyond it is a number, too.
const LARGEST: f64 = 1e308;
/// Points farther from an axis than this, in lengths of it, are taken to be this far: farther than any page, near enough to be computed with.
const FARTHEST: f64 = 1e4;

impl Axis {
    /// Settles range and ticks for these values.
    ///
    /// `padded` leaves some room beyond the data (heights), an unpadded axis ends with them (times);
    /// `target_ticks` is how many ticks would look right. A stated range that is none (empty, not finite, or not positive on a
    /// logarithmic axis) is left to the data.
    pub fn settle(&self, values: impl Iterator<Item = f64>, padded: bool, target_ticks: f64) -> SettledAxis {
        let log = self.scale == Scale::Log;
        let usable = |v: &f64| v.is_finite() && (!log || *v > 0.0);
        let (low, high) = values
            .filter(usable)
            .map(|v| v.clamp(-LARGEST, LARGEST))
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| {
                (f64::min(low, v), f64::max(high, v))
            });
        let stated = self
            .range
            .filter(|(low, high)| usable(low) && usable(high) && low < high);
        let (min, max) = match stated {
            Some((low, high)) => (low.max(-LARGEST), high.min(LARGEST)),
            None if low > high => (if log { 0.1 } else { 0.0 }, 1.0),
            None if log => widen_log(low, high),
            None => widen(low, high, padded),
        };
        let target_ticks = target_ticks.max(1.0);
        let fitting = nice_step(max / target_ticks - min / target_ticks);
        let bearable = |step: &f64| *step > 0.0 && (max / step - min / step) <= MOST_TICKS;
        SettledAxis {
            min,
            max,
            scale: self.scale,
            step: self.step.filter(bearable).unwrap_or(fitting),
            exponent: if log {
                0
            } else {
                common_exponent(min.abs().max(max.abs()))
            },
            target_ticks,
        }
    }
}

fn widen(low: f64, high: f64, padded: bool) -> (f64, f64) {
    let range = high - low;
    let negligible = 1e-12 * low.abs().max(high.abs());
    let room = if range <= negligible {
        // Below this, a tenth of the value and the steps within it are no normal numbers.
        if low.abs() < 1e-300 { 1.0 } else { 0.1 * low.abs() }
    } else if padded {
        PADDING * range.min(LARGEST)
    } else {
        0.0
    };
    ((low - room).max(-LARGEST), (high + room).min(LARGEST))
}

/// Extends a logarithmic range to whole decades where that costs less than half a decade, else by a little.
fn widen_log(low: f64, high: f64) -> (f64, f64) {
    let (low, high) = (low.log10(), high.log10());
    let (floor, ceiling) = (low.floor(), high.ceil());
    let low = if low - floor < 0.5 { floor } else { low - 0.1 };
    let high = if ceiling - high < 0.5 { ceiling } else { high + 0.1 };
    let high = if high > low { high } else { low + 1.0 };
    // The decades of normal numbers.
    const DECADES: (f64, f64) = (-307.0, 308.0);
    let low = low.clamp(DECADES.0, DECADES.1 - 1.0);
    (10f64.powf(low), 10f64.powf(high.clamp(low + 1e-3, DECADES.1)))
}

/// More ticks than this no axis has, whatever step is asked for.
const MOST_TICKS: f64 = 200.0;
/// Axes whose largest value is below this carry a common power of ten.
const SMALLEST_PLAIN: f64 = 2e-3;
/// Axes whose largest value is above this carry a common power of ten.
const LARGEST_PLAIN: f64 = 5e4;

/// The power of ten, a multiple of three, that the labels of an axis up to `magnitude` leave out.
fn common_exponent(magnitude: f64) -> i32 {
    if magnitude == 0.0 || (SMALLEST_PLAIN..=LARGEST_PLAIN).contains(&magnitude) {
        0
    } else {
        power_of_thousand(magnitude)
    }
}

/// The power of ten, a multiple of three, at or below `magnitude`.
pub(super) fn power_of_thousand(magnitude: f64) -> i32 {
    // The least whose inverse is a number.
    const LEAST: i32 = -306;
    ((magnitude.log10() / 3.0).floor() as i32 * 3).max(LEAST)
}

impl SettledAxis {
    /// Positions of the labelled ticks.
    pub fn ticks(&self) -> Vec<f64> {
        if self.scale == Scale::Log {
            return LogTicks::of(self.min, self.max, self.target_ticks).labelled;
        }
        // A thousandth of a step of slack, so that a tick at the very end is not lost to rounding.
        let slack = 1e-3;
        let first = (self.min / self.step - slack).ceil() as i64;
        let last = (self.max / self.step + slack).floor() as i64;
        (first..=last).map(|i| i as f64 * self.step).collect()
    }

    /// Positions of the short ticks without labels: those of a logarithmic axis.
    pub fn minor_ticks(&self) -> Vec<f64> {
        match self.scale {
            Scale::Linear => Vec::new(),
            Scale::Log => LogTicks::of(self.min, self.max, self.target_ticks).minor,
        }
    }

    /// The label of a tick: as many decimals as the step needs, and a true minus sign.
    pub fn tick_label(&self, value: f64) -> String {
        if self.scale == Scale::Log {
            return log_label(value, self.min, self.max);
        }
        if value.abs() < 1e-6 * self.step {
            return "0".into();
        }
        let unit = 10f64.powi(self.exponent);
        let sign = if value < 0.0 { "−" } else { "" };
        format!("{sign}{:.*}", decimals_of(self.step / unit), value.abs() / unit)
    }

    /// The power of ten that the tick labels leave out: `×10⁻⁶`, or nothing.
    pub fn exponent_label(&self) -> String {
        if self.exponent == 0 {
            String::new()
        } else {
            format!("×10{}", superscript(self.exponent))
        }
    }

    /// Position along the axis: 0 at the lower end, 1 at the upper.
    pub fn fraction(&self, value: f64) -> f64 {
        match self.scale {
            // Halves, since the difference of two numbers may be too large for one.
            Scale::Linear => (0.5 * value - 0.5 * self.min) / (0.5 * self.max - 0.5 * self.min),
            Scale::Log => (value.ln() - self.min.ln()) / (self.max.ln() - self.min.ln()),
        }
    }

    /// Position along the axis of a value that can be shown: none for one that is not finite, or not positive on a logarithmic axis.
    pub(super) fn place(&self, value: f64) -> Option<f64> {
        let shown = value.is_finite() && (self.scale == Scale::Linear || value > 0.0);
        shown.then(|| self.fraction(value).clamp(-FARTHEST, FARTHEST))
    }

    /// Position along the axis; the lower end for a value that can't be shown.
    pub(super) fn place_or_end(&self, value: f64) -> f64 {
        self.place(value).unwrap_or(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(min: f64, max: f64, step: f64, scale: Scale, values: &[f64]) -> Vec<String> {
        let axis = Axis {
            range: Some((min, max)),
            step: Some(step),
            scale,
            ..Axis::default()
        };
        let axis = axis.settle(std::iter::empty(), false, 5.0);
        values
            .iter()
            .map(|v| axis.tick_label(*v))
            .chain([axis.exponent_label()])
            .collect()
    }

    #[test]
    fn exact_tick_labels() {
        let linear = |max: f64, step, values: &[f64]| labels(-max, max, step, Scale::Linear, values);
        assert_eq!(linear(1.0, 0.5, &[-0.5, 0.0, 1.0]), ["−0.5", "0", "1.0", ""]);
        assert_eq!(linear(1.0, 0.25, &[1.0]), ["1.00", ""]);
        assert_eq!(linear(20.0, 10.0, &[20.0]), ["20", ""]);
        assert_eq!(linear(2e-5, 1e-5, &[-2e-5, 1e-5]), ["−20", "10", "×10⁻⁶"]);
        assert_eq!(linear(1.5e5, 5e4, &[1.5e5]), ["150", "×10³"]);
        assert_eq!(
            labels(0.1, 10.0, 1.0, Scale::Log, &[0.1, 0.2, 5.0]),
            ["0.1", "0.2", "5", ""]
        );
        assert_eq!(
            labels(1e-4, 1e-2, 1.0, Scale::Log, &[1e-4, 2e-3]),
            ["10⁻⁴", "2·10⁻³", ""]
        );
    }

    #[test]
    fn exact_nice_steps() {
        assert_eq!([0.03, 0.2, 0.236, 8.0].map(nice_step), [0.02, 0.2, 0.2, 10.0]);
        assert_eq!(nice_step(f64::NAN), 1.0);
    }

    #[test]
    fn prop_ticks_lie_inside_the_range() {
        let axis = Axis::default().settle([-1.0, 0.3, f64::NAN, 2.7].into_iter(), true, 5.0);
        let ticks = axis.ticks();
        assert!(
            ticks.len() >= 3 && ticks.iter().all(|t| (axis.min..=axis.max).contains(t)),
            "{ticks:?}"
        );
        assert!((axis.fraction(axis.min), axis.fraction(axis.max)) == (0.0, 1.0));
    }

    #[test]
    fn prop_degenerate_data_still_give_a_range() {
        for values in [vec![], vec![0.0], vec![3.0, 3.0], vec![f64::INFINITY]] {
            for scale in [Scale::Linear, Scale::Log] {
                let axis = Axis {
                    scale,
                    ..Axis::default()
                }
                .settle(values.clone().into_iter(), true, 5.0);
                assert!(
                    axis.max > axis.min && axis.step > 0.0,
                    "{values:?} {scale:?} {axis:?}"
                );
            }
        }
    }
}
