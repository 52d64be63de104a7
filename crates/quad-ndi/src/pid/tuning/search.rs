//! The search for one loop's gains: a box of logarithms, random starts, Nelder-Mead.

use super::trial::Bench;
use super::{LoopReport, StartReport, TunedLoop, TuningError, TuningOptions};
use crate::pid::PidSettings;
use optim::{Limits, NelderMead, Report, SimplexSettings, Variable, minimise};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::Rng;

/// Half-widths of the box in the logarithms of `k_p`, `k_i`, `k_d` over the placed ones: ln 10, ln 30, ln 10.
const BOX: [(&str, f64); 3] = [
    ("ln k_p", std::f64::consts::LN_10),
    ("ln k_i", 3.401_197_381_662_155),
    ("ln k_d", std::f64::consts::LN_10),
];

/// Half-width of the region that starts are drawn from, as a logarithm: a factor 4.
const START_REGION: f64 = 2.0 * std::f64::consts::LN_2;

/// Edge of the first simplex, as a logarithm.
const EDGE: f64 = 0.4;

/// Spread of the costs of a simplex at which the search has converged, however far apart its vertices are.
const CONVERGED: f64 = 1e-6;

/// The cost as a function of the logarithms of one loop's gains.
struct Problem<'a> {
    bench: &'a Bench,
    tuned: TunedLoop,
    settings: PidSettings,
}

impl Problem<'_> {
    /// The settings with this loop's gains multiplied.
    fn settings(&self, logarithms: &[f64]) -> PidSettings {
        let mut settings = self.settings;
        let gains = self.tuned.gains_mut(&mut settings);
        gains.proportional *= logarithms[0].exp();
        gains.integral *= logarithms[1].exp();
        gains.derivative *= logarithms[2].exp();
        settings
    }

    /// Nelder-Mead from one start.
    fn descend(&self, start: &[f64], flights: u64) -> Result<Report, TuningError> {
        let variables = BOX.map(|(name, half)| Variable {
            name: name.to_owned(),
            unit: "1".to_owned(),
            lower: -half,
            upper: half,
        });
        let mut simplex = vec![start.to_vec()];
        for (i, (_, half)) in BOX.into_iter().enumerate() {
            let mut corner = start.to_vec();
            corner[i] += if corner[i] + EDGE <= half { EDGE } else { -EDGE };
            simplex.push(corner);
        }
        let settings = SimplexSettings {
            spread: f64::INFINITY,
            cost_spread: CONVERGED,
            ..SimplexSettings::default()
        };
        let mut search = NelderMead::from_simplex(variables.to_vec(), simplex, settings)?;
        let cost = |logarithms: &[f64]| self.bench.cost(&self.settings(logarithms));
        Ok(minimise(&mut search, cost, Limits::evaluations(flights))?)
    }
}

/// A number in −1 … 1 from the upper 53 bits of the generator's next word.
fn unit(generator: &mut ChaCha8Rng) -> f64 {
    const SCALE: f64 = 1.0 / (1_u64 << 52) as f64;
    (generator.next_u64() >> 11) as f64 * SCALE - 1.0
}

/// Gains of one loop for the bench, from random starts and once more from the best end.
pub(super) fn search(
    bench: &Bench,
    options: &TuningOptions,
    tuned: TunedLoop,
    settings: &PidSettings,
    generator: &mut ChaCha8Rng,
) -> Result<LoopReport, TuningError> {
    let problem = Problem {
        bench,
        tuned,
        settings: *settings,
    };
    let cost_before = bench.cost(settings);
    let mut best = (cost_before, vec![0.0; BOX.len()]);
    let (mut starts, mut history) = (Vec::with_capacity(options.starts + 1), Vec::new());
    for number in 0..=options.starts {
        // Random starts, and at last the best end with a fresh simplex, lest an early collapse be the end.
        let start = if number < options.starts {
            BOX.iter().map(|_| unit(generator) * START_REGION).collect()
        } else {
            best.1.clone()
        };
        let report = problem.descend(&start, options.flights)?;
        history.extend(report.history.iter().map(|cost| cost.min(best.0)));
        starts.push(StartReport {
            cost: report.best.cost,
            evaluations: report.evaluations,
            stop: report.stop,
        });
        if report.best.cost < best.0 {
            best = (report.best.cost, report.best.candidate.values);
        }
    }
    let mut found = problem.settings(&best.1);
    Ok(LoopReport {
        tuned,
        gains: *tuned.gains_mut(&mut found),
        cost: best.0,
        cost_before,
        starts,
        history,
    })
}
