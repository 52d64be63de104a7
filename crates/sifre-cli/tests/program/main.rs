//! The program as a user meets it: exit codes and messages.

mod bad_input;
mod cameras;
mod commands;
mod figures;
mod interrupted;
mod optimise;
mod outputs;
mod questions;
mod saved;
mod support;
mod sweeps;
mod uncertainty;
