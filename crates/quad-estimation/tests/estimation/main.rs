//! Sensors, filters and estimators against closed forms, another crate, statistics and recorded flights.

mod bad_input;
mod closed_loop;
mod consistency;
mod jacobians;
mod late;
mod linear;
mod matched;
mod recorded;
mod sensors;
mod support;
