//! Does the missed power grow with spot offset and incidence? The check of figure 7.1's claim.

use crate::figures::sweep;
use ets::Station;

/// Twice what the quadrature promises, per watt of the beam.
pub(super) const QUADRATURE: f64 = 2e-7;

/// Whether the claim holds, and the numbers found.
pub(super) struct Growth {
    pub(super) holds: bool,
    pub(super) measured: String,
}

/// Over the study's limits in steps of 3 mm and 1°: no step down beyond the quadrature, and a rise from each end to the other.
pub(super) fn within_the_limits(station: &Station, missed: &impl Fn(f64, f64) -> f64) -> Growth {
    let limits = &station.limits;
    let (offsets, angles) = (
        sweep(0.0, limits.spot, 50),
        sweep(0.0, limits.incidence.to_degrees(), 40),
    );
    let grid: Vec<Vec<f64>> = angles
        .iter()
        .map(|&a| offsets.iter().map(|&e| missed(e, a)).collect())
        .collect();
    let mut least = f64::INFINITY;
    for i in 0..grid.len() {
        for j in 0..offsets.len() {
            if j > 0 {
                least = least.min(grid[i][j] - grid[i][j - 1]);
            }
            if i > 0 {
                least = least.min(grid[i][j] - grid[i - 1][j]);
            }
        }
    }
    // Offset 0.12 m: inside the sensor, where the spot's edge reaches past its own.
    let (square, oblique) = (
        missed(0.8 * limits.spot, 0.0),
        missed(0.8 * limits.spot, limits.incidence.to_degrees()),
    );
    let (centred, edge) = (grid[0][0], grid[0][offsets.len() - 1]);
    // Beside the quadrature: what arrives is what the air leaves at the range of the sensor's centre, which one degree about a fixed spot
    // moves by up to 0.15 m · 0.0175.
    let light = station.beam.through(&station.atmosphere);
    let moved = limits.spot * angles[1].to_radians();
    let noise = (QUADRATURE + light.attenuation * moved) * light.power;
    Growth {
        holds: least >= -noise && oblique > square + noise && edge > centred + noise,
        measured: format!(
            "within the limits (0.15 m, 40°) no step falls by more than {:.1e} W, {noise:.1e} W expected of quadrature and air; {centred:.0e} W centred, {edge:.2} W at the limit of offset; at 0.12 m \
             {square:.4} W at 0° and {oblique:.4} W at 40°",
            (-least).max(0.0)
        ),
    }
}
