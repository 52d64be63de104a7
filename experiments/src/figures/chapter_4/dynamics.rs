//! The transfer functions of one rotor, beside those of its linearisation.

use super::identified::Found;
use crate::item::ItemError;
use crate::rotor_bench::{RotorBench, TestedRotor, record};
use quad_dynamics::Vehicle;
use sysid::Estimate;
use sysid::rotor_dynamics::{Coefficients, ResponseFit, Start, Structure, identify};
use sysid::rotor_static::Quantity;

/// The fits of one rotor.
pub(super) struct Fits {
    pub(super) thrust: ResponseFit,
    pub(super) torque: ResponseFit,
    /// ω_R, rad/s.
    pub(super) bandwidth: Estimate,
    /// `c_T1`, `c_T2`, `c_Q1`, `c_Q3`, `c_Q4`.
    pub(super) coefficients: [Estimate; 5],
    /// The same of the linearised rotor.
    pub(super) linearised: [f64; 5],
}

/// Identifies a rotor about its hover; the closed form is that at the mean of the commands.
pub(super) fn fit(bench: &RotorBench, vehicle: &Vehicle, rotor: &TestedRotor) -> Result<Fits, ItemError> {
    let hover = Found::of(bench, vehicle, rotor)?.hover_duty;
    let samples = bench.sequence(rotor, hover)?;
    let of = |quantity, structure| -> Result<ResponseFit, ItemError> {
        Ok(identify(
            &record(&samples, quantity)?,
            structure,
            Start::Equilibrium,
        )?)
    };
    let thrust = of(Quantity::Thrust, Structure::SecondOrder)?;
    let torque = of(Quantity::Torque, Structure::SecondOrderWithZero)?;
    let first = of(Quantity::Thrust, Structure::FirstOrder)?;
    let (
        Coefficients::SecondOrder { c1, c2 },
        Coefficients::SecondOrderWithZero { c1: q1, c3, c4, .. },
        Coefficients::FirstOrder { bandwidth },
    ) = (thrust.coefficients, torque.coefficients, first.coefficients)
    else {
        return Err(ItemError::new("a fit has the coefficients of its structure"));
    };
    let steady = rotor.truth(vehicle)?;
    let mean = samples.iter().map(|s| s.duty).sum::<f64>() / samples.len() as f64;
    let voltage = steady.effective_voltage(mean - rotor.stand.minimum_duty, bench.nominal_voltage_v);
    let l = steady.rotor_dynamics(steady.speed(voltage));
    Ok(Fits {
        thrust,
        torque,
        bandwidth,
        coefficients: [c1, c2, q1, c3, c4],
        linearised: [l.thrust_c1, l.thrust_c2, l.torque_c1, l.torque_c3, l.torque_c4],
    })
}
