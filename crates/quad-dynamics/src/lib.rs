//! placeholder
mod any;
pub mod build;
mod error;
mod forces;
mod lagrange;
mod level1;
mod model;
mod phenomenon;
mod quadrotor;
mod rigid_body;
pub mod vehicle;

pub use any::{AnyQuadrotor, InFlight};
pub use error::{BuildError, ModelName};
pub use forces::{Drag, RotorGeometry, gyroscopic_torque};
pub use level1::{Level1, LinearRate, LinearState};
pub use model::{Flight, Hover, Input, Level, NoSuchLevel, QuadrotorModel, RotorSnapshot, Snapshot, StateOf};
pub use phenomenon::{Phenomenon, PhenomenonSet, Prerequisite};
pub use quadrotor::{
    CommandLimits, CurrentDraw, Level2, Level3, Level4, Level5, MechanisticQuadrotor, Quadrotor,
    QuadrotorRate, QuadrotorState, RotorSet, SpinningRotors,
};
pub use rigid_body::{RigidBody, RigidBodyRate, RigidBodyState, Wrench};
pub use vehicle::{Vehicle, VehicleError};
