//! The optimisers against SciPy's, closed forms, and the laws they promise.

mod bad_input;
mod laws;
mod minima;
mod multi_fidelity;
mod random_search;
mod scipy;
mod support;
