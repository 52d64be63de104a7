use super::*;
use crate::laboratory::thrust_stand::{Prbs, irregular_times, uniform_times};
use crate::laboratory::{Sensor, generator};
use crate::{Estimate, Warning};

mod coverage;
mod exact;
mod mechanistic;
mod motor_steps;
mod refusals;

/// A response whose transfer function is known.
#[derive(Clone, Copy)]
struct Truth {
    structure: Structure,
    gain: f64,
    offset: f64,
    /// `K c_1` of the zero.
    kappa: f64,
    /// Denominator's coefficients, highest power first.
    denominator: [f64; 2],
}

impl Truth {
    fn second_order(c1: f64, c2: f64) -> Self {
        Self {
            structure: Structure::SecondOrder,
            gain: 2.0,
            offset: 0.3,
            kappa: 0.0,
            denominator: [c1, c2],
        }
    }

    /// The output at the record's times by the model itself, from rest.
    fn outputs(&self, times: &[f64], input: impl Fn(f64) -> f64) -> Vec<ResponseSample> {
        let sample = |&time_s: &f64| ResponseSample {
            time_s,
            input: input(time_s),
            output: time_s,
        };
        let mut samples: Vec<ResponseSample> = times.iter().map(sample).collect();
        let record = Record::new(&samples).unwrap();
        let model = model::Model {
            record: &record,
            structure: self.structure,
            start: Start::Equilibrium,
        };
        let mut parameters = vec![self.gain, self.offset];
        if self.structure == Structure::SecondOrderWithZero {
            parameters.push(self.kappa);
        }
        let used = &self.denominator[2 - self.structure.order()..];
        parameters.extend(used.iter().map(|c| c.ln()));
        for (sample, y) in samples.iter_mut().zip(model.output(&parameters)) {
            sample.output = y;
        }
        samples
    }
}

/// The same response with white noise.
fn noisy(samples: &[ResponseSample], deviation: f64, seed: u64) -> Record {
    let (sensor, mut random) = (Sensor::noisy(deviation), generator(seed));
    let with_noise = |s: &ResponseSample| ResponseSample {
        output: sensor.read(s.output, &mut random),
        ..*s
    };
    Record::new(&samples.iter().map(with_noise).collect::<Vec<_>>()).unwrap()
}

/// A binary sequence about zero.
fn prbs(hold_s: f64) -> impl Fn(f64) -> f64 {
    Prbs {
        centre: 0.0,
        amplitude: 1.0,
        hold_s,
        skipped_bits: 0,
    }
    .signal()
}
