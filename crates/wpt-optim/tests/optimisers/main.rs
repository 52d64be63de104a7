//! The optimisers against SciPy's and argmin's, closed forms, and the laws they promise.

mod bad_input;
mod laws;
mod libraries;
mod minima;
mod support;
