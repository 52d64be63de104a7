//! Scenario files: what flies, where, how, for how long, as TOML.
