//! The engine's laws and its answers to bad input, one module per subject.

mod agreement;
mod air;
mod allocation;
mod bad_input;
mod convergence;
mod dynamic_resolution;
mod estimating;
mod ets_agent;
mod gusts;
mod laws;
mod levels;
mod optimising;
mod recording;
mod replay;
mod rollout;
mod scheduling;
mod stopping;
mod support;
mod wrong_starts;
