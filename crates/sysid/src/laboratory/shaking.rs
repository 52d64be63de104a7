//! An excitation of the rotors on top of a controller: what an identification flight needs.
//!
//! `u_i = u_{c,i} + a Σ_k sin(2π f_k t + φ_{ik})`: the same four tones for every rotor with phases of its own, so that thrust,
//! roll and pitch are moved at once. Tones from 0.4 Hz (below it the controller takes part) to 5.3 Hz (above it the rotor
//! hardly answers), none a multiple of another.

use std::f64::consts::TAU;

/// Tones, Hz.
const TONES_HZ: [f64; 4] = [0.43, 1.7, 3.1, 5.3];
/// Phase of a tone from rotor to rotor, turns: of the first tone none, so that it moves the thrust alone.
const PHASES: [f64; 4] = [0.0, 0.31, 0.23, 0.37];

/// The excitation of each rotor at a time, s, for tones of an amplitude, duty.
pub(super) fn excitation(amplitude: f64, time_s: f64) -> [f64; 4] {
    std::array::from_fn(|rotor| {
        let tones = TONES_HZ.iter().zip(PHASES);
        let sum: f64 = tones
            .map(|(hertz, phase)| (TAU * (hertz * time_s + phase * rotor as f64)).sin())
            .sum();
        amplitude * sum
    })
}
