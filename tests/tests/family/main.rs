//! The model family as a whole: nine laws that hold between its members, and one battery of checks that
//! every member passes, on random vehicles, states and inputs.

mod allocation;
mod jacobians;
mod lanes;
mod law_1_linearisation;
mod law_2_3_rotor_limits;
mod law_4_linear_polynomial;
mod law_5_lift_and_restrict;
mod law_6_conservation;
mod law_7_symmetries;
mod law_8_formalisms;
mod law_9_representations;
mod mechanistic;
mod state_space;
mod support;
