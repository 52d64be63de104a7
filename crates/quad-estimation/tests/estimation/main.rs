//! Sensors, filters and estimators against closed forms, another crate, statistics and recorded flights.

mod consistency;
mod jacobians;
mod linear;
mod matched;
mod support;
