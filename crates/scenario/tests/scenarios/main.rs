//! Scenario files: what is read, what is refused, and what the ready ones do in the air.

mod bad_input;
mod diverging;
mod flown;
mod keys;
mod laws;
mod ready;
mod support;
