//! The program as a user meets it: exit codes and messages.

mod bad_input;
mod commands;
mod interrupted;
mod support;
mod sweeps;
