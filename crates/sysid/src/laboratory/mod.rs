//! The virtual laboratory: measurements of a vehicle whose parameters are known, so that identification can be judged.
//!
//! Each instrument takes the truth and adds what real instruments add: noise, bias, quantisation, limits of range and a
//! sampling rate. Everything is seeded: the generator is an argument (ChaCha8, `rand_chacha`).

pub mod flights;
pub mod load_cells;
pub mod pendulum;
mod sensor;
mod shaking;
pub mod supports;
pub mod thrust_stand;

pub use sensor::{Sensor, SensorError};

/// The generator of all virtual measurements: named, because a seed is part of a result.
pub type Generator = rand_chacha::ChaCha8Rng;

/// The generator of a seed.
pub fn generator(seed: u64) -> Generator {
    rand_chacha::rand_core::SeedableRng::seed_from_u64(seed)
}
