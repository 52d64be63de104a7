//! The command line of the simulation engine.

fn main() {}
