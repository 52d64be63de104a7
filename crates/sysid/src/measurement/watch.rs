//! What is noticed row by row without holding the rows: time, gaps, stretches at an extreme, constants.

use super::{Column, Layout, ReadError, Remark, Signal};

/// Rows at the same extreme from which a column counts as saturated or stuck. Noise of one digit repeats a value a few
/// times by chance; a repeat of twenty is one in 10⁶ even where every other sample sits at the extreme.
const SATURATED_FROM: usize = 20;

pub(super) struct Watch<'a> {
    columns: &'a [Column],
    longest_step: Option<f64>,
    before: Option<f64>,
    gaps: usize,
    longest_gap: f64,
    line_of_gap: u64,
    extremes: Vec<Extremes>,
}

/// Both ends of what a column has shown.
#[derive(Clone, Copy)]
struct Extremes {
    low: Stretch,
    high: Stretch,
}

/// The most extreme value so far and how long it was held.
#[derive(Clone, Copy)]
struct Stretch {
    value: f64,
    run: usize,
    longest: usize,
    line: u64,
}

impl Stretch {
    fn at(value: f64, line: u64) -> Self {
        Self {
            value,
            run: 1,
            longest: 1,
            line,
        }
    }

    /// Takes the next value; `beyond` says whether it is more extreme.
    fn see(&mut self, value: f64, line: u64, beyond: bool) {
        if beyond {
            *self = Self::at(value, line);
        } else if value == self.value {
            self.run += 1;
            if self.run > self.longest {
                self.longest = self.run;
                self.line = line;
            }
        } else {
            self.run = 0;
        }
    }
}

impl<'a> Watch<'a> {
    pub(super) fn new(layout: &Layout<'a>) -> Self {
        Self {
            columns: layout.columns,
            longest_step: layout.longest_step,
            before: None,
            gaps: 0,
            longest_gap: 0.0,
            line_of_gap: 0,
            extremes: Vec::new(),
        }
    }

    pub(super) fn see(&mut self, line: u64, values: &[f64]) -> Result<(), ReadError> {
        if let (Some(longest), Some(&after)) = (self.longest_step, values.first()) {
            if let Some(before) = self.before {
                if after <= before {
                    return Err(ReadError::TimeNotRising { line, before, after });
                }
                self.see_step(line, after - before, longest);
            }
            self.before = Some(after);
        }
        if self.extremes.is_empty() {
            let start = |&value: &f64| Extremes {
                low: Stretch::at(value, line),
                high: Stretch::at(value, line),
            };
            self.extremes = values.iter().map(start).collect();
        } else {
            for (extremes, &value) in self.extremes.iter_mut().zip(values) {
                extremes.low.see(value, line, value < extremes.low.value);
                extremes.high.see(value, line, value > extremes.high.value);
            }
        }
        Ok(())
    }

    fn see_step(&mut self, line: u64, step: f64, longest: f64) {
        if step > longest {
            self.gaps += 1;
            if step > self.longest_gap {
                self.longest_gap = step;
                self.line_of_gap = line;
            }
        }
    }

    pub(super) fn remarks(&self) -> Vec<Remark> {
        let mut remarks = Vec::new();
        if self.gaps > 0 {
            remarks.push(Remark::Gaps {
                gaps: self.gaps,
                longest_s: self.longest_gap,
                line: self.line_of_gap,
            });
        }
        for (column, Extremes { low, high }) in self.columns.iter().zip(&self.extremes) {
            if low.value == high.value {
                // A single row is no constant; two rows may be.
                if low.longest > 1 {
                    remarks.push(Remark::Constant {
                        column: column.name,
                        value: low.value,
                        unit: column.unit,
                    });
                }
                continue;
            }
            if column.signal == Signal::Commanded {
                continue;
            }
            for stretch in [low, high] {
                if stretch.longest >= SATURATED_FROM {
                    remarks.push(Remark::Saturated {
                        column: column.name,
                        value: stretch.value,
                        unit: column.unit,
                        rows: stretch.longest,
                        line: stretch.line,
                    });
                }
            }
        }
        remarks
    }
}

/// A stretch at an extreme.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Saturation {
    /// The value that repeats.
    pub(crate) limit: f64,
    /// For how many samples.
    pub(crate) samples: usize,
}

/// The longest stretch at either extreme of a series, if it is long enough to be no chance.
pub(crate) fn saturation(values: &[f64]) -> Option<Saturation> {
    let first = *values.first()?;
    let (mut low, mut high) = (Stretch::at(first, 0), Stretch::at(first, 0));
    for &value in &values[1..] {
        low.see(value, 0, value < low.value);
        high.see(value, 0, value > high.value);
    }
    let worst = if low.longest > high.longest { low } else { high };
    (worst.longest >= SATURATED_FROM).then_some(Saturation {
        limit: worst.value,
        samples: worst.longest,
    })
}
