//! Sums over the flights of a row.

use super::flight::{Told, Truth};
use super::study::{KindOfFilter, Row};
use nalgebra::SVector;
use quad_dynamics::Level;
use quad_estimation::sensor::Quality;
use quad_estimation::{Filter, LevelProcess};

/// Steps between estimates that count; the last instant is one of them.
const EVERY: usize = 20;

/// A row in the making.
pub(super) struct Sums {
    row: Row,
    count: f64,
}

/// Squares of an estimate's errors: position, velocity, tilt, heading.
fn squares(error: &SVector<f64, 12>) -> [f64; 4] {
    let of = |from: usize, n: usize| error.rows(from, n).norm_squared();
    [of(0, 3), of(3, 3), of(6, 2), of(8, 1)]
}

impl Sums {
    pub(super) fn new(quality: Quality, level: Level, kind: KindOfFilter, factors: [f64; 2]) -> Self {
        let row = Row {
            quality,
            level,
            kind,
            factors,
            errors: [0.0; 4],
            nees: 0.0,
            flights: 0,
            told: Told::default(),
        };
        Self { row, count: 0.0 }
    }

    /// Filters one more flight; errors count from its second second on.
    pub(super) fn add(&mut self, truth: &Truth, filter: impl Filter<Process = LevelProcess>) {
        let memory_ns = self.row.quality.suite().longest_delay_ns();
        let (last, settled) = (truth.instants.len(), 2.0 / super::flight::STEP_S);
        let (row, count) = (&mut self.row, &mut self.count);
        let told = truth.filtered(filter, memory_ns, EVERY, |k, body, estimate| {
            if k as f64 >= settled {
                let now = squares(&estimate.error(body).vector());
                row.errors = std::array::from_fn(|i| row.errors[i] + now[i]);
                *count += 1.0;
            }
            if k == last {
                row.nees += estimate.nees(body);
            }
        });
        row.flights += 1;
        // A filter that lost its covariance has no errors that a mean could be taken of: they are infinite.
        let Ok(told) = told else {
            (row.errors, row.nees) = ([f64::INFINITY; 4], f64::INFINITY);
            return;
        };
        row.told.nis += told.nis;
        row.told.readings += told.readings;
        row.told.log_likelihood += told.log_likelihood;
    }

    /// The row, root mean squares drawn.
    pub(super) fn finished(mut self) -> Row {
        self.row.errors = self.row.errors.map(|sum| (sum / self.count).sqrt());
        self.row
    }
}
