//! Nothing but dependencies: the features that `experiments`, `sifre`, `identify` and the tests need of shared dependencies, taken together.
//!
//! Cargo builds a dependency once for each set of features that is asked of it. Programs of one workspace ask for different sets, since
//! each has dependencies of its own, and would so build four fifths of everything twice. Each of them depends on this crate, which asks for the
//! union. `cargo xtask features` checks that no difference is left.
