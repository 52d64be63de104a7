//! The virtual flight: the mechanistic vehicle under a controller, with inertial sensors, motion capture and voltmeter.
//!
//! The accelerometer sits in the centre of mass and measures the specific force `f = v̇_B + ω × v_B − R_BW g`, everything but
//! gravity over the mass; motion capture gives the velocity along body axes. Still air. The controller acts every
//! millisecond (RK4 between), and sees the true state: what the sensors do to a controller is another subject.

use super::shaking::excitation;
use super::{Generator, Sensor, SensorError};
use nalgebra::Vector3;
use quad_dynamics::{
    BuildError, Input, MechanisticQuadrotor, Phenomenon, PhenomenonSet, QuadrotorModel, Vehicle,
};
use quad_math::System;
use quad_ndi::{
    Airborne, C2, ClosedLoop, ControllerError, InCharge, Reference, Settings, TiltLaw, Trajectory,
    TrajectoryError, Waypoint,
};
use serde::{Deserialize, Serialize};

/// One sample of a flight; a row of a CSV with these columns.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FlightSample {
    /// Time, s.
    pub time_s: f64,
    /// Specific force along `x_B` (forward), m/s².
    pub force_x_m_s2: f64,
    /// Specific force along `y_B` (right), m/s².
    pub force_y_m_s2: f64,
    /// Specific force along `z_B` (down), m/s²: −g in hover.
    pub force_z_m_s2: f64,
    /// Roll rate p, rad/s.
    pub rate_x_rad_s: f64,
    /// Pitch rate q, rad/s.
    pub rate_y_rad_s: f64,
    /// Yaw rate r, rad/s.
    pub rate_z_rad_s: f64,
    /// Velocity along `x_B`, m/s.
    pub velocity_x_m_s: f64,
    /// Velocity along `y_B`, m/s.
    pub velocity_y_m_s: f64,
    /// Velocity along `z_B`, m/s.
    pub velocity_z_m_s: f64,
    /// Raw duty of rotor 1, rear.
    pub duty_1: f64,
    /// Raw duty of rotor 2, front.
    pub duty_2: f64,
    /// Raw duty of rotor 3, left.
    pub duty_3: f64,
    /// Raw duty of rotor 4, right.
    pub duty_4: f64,
    /// Battery voltage, V.
    pub battery_voltage_v: f64,
}

/// What is on board and what is flown.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FlightTest {
    /// Accelerometer, each axis, m/s².
    pub force: Sensor,
    /// Gyroscope, each axis, rad/s.
    pub rate: Sensor,
    /// Velocity by motion capture, each axis, m/s.
    pub velocity: Sensor,
    /// Voltmeter, V.
    pub voltage: Sensor,
    /// Half the side of the square that is flown, m.
    pub half_side_m: f64,
    /// Time for a side, s.
    pub side_s: f64,
    /// Sides flown.
    pub sides: u32,
    /// Milliseconds between samples.
    pub sample_every_ms: u32,
    /// Amplitude of each of the four tones (0.4 to 5.3 Hz) added to every rotor's duty, for flights that are to show the
    /// rotors' lag and the moments of inertia; 0 for none.
    pub excitation: f64,
}

impl Default for FlightTest {
    /// Consumer-grade inertial sensors, millimetres by motion capture, a square of 6 m with 3 s a side (5 m/s at most): assumed.
    fn default() -> Self {
        Self {
            force: Sensor {
                noise: 0.05,
                bias: 0.04,
                quantum: 0.005,
                minimum: -39.0,
                maximum: 39.0,
            },
            rate: Sensor {
                noise: 0.005,
                bias: 0.002,
                quantum: 0.001,
                minimum: -8.7,
                maximum: 8.7,
            },
            velocity: Sensor::noisy(0.01),
            voltage: Sensor {
                noise: 0.01,
                bias: 0.0,
                quantum: 0.02,
                minimum: 0.0,
                maximum: 20.0,
            },
            half_side_m: 3.0,
            side_s: 3.0,
            sides: 8,
            sample_every_ms: 20,
            excitation: 0.0,
        }
    }
}

/// Why a virtual flight was not flown.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FlightTestError {
    /// A sensor's numbers are wrong.
    #[error(transparent)]
    Sensor(#[from] SensorError),
    /// The vehicle lacks what the mechanistic model needs.
    #[error(transparent)]
    Build(#[from] BuildError),
    /// The controller's settings are wrong.
    #[error(transparent)]
    Controller(#[from] ControllerError),
    /// The manoeuvre is wrong.
    #[error(transparent)]
    Trajectory(#[from] TrajectoryError),
    /// The vehicle became non-finite.
    #[error("the flight diverged at {time_s} s: increase `side_s`")]
    Diverged {
        /// When, s.
        time_s: f64,
    },
}

/// Step of controller and integrator, s.
const STEP_S: f64 = 1e-3;

impl FlightTest {
    /// Flies a square about the origin and records it.
    ///
    /// # Errors
    /// Wrong sensors, a vehicle without mechanistic rotors, a manoeuvre that can't be flown.
    pub fn fly(
        &self,
        vehicle: &Vehicle,
        settings: &Settings,
        generator: &mut Generator,
    ) -> Result<Vec<FlightSample>, FlightTestError> {
        for sensor in [&self.force, &self.rate, &self.velocity, &self.voltage] {
            sensor.validate()?;
        }
        let phenomena = PhenomenonSet::none()
            .with(Phenomenon::Drag)
            .with(Phenomenon::GyroscopicTorque)
            .with(Phenomenon::InputLimits)
            .with(Phenomenon::VoltageSag);
        let model = MechanisticQuadrotor::<f64>::build(vehicle, &phenomena)?;
        let controller = C2::<f64>::new(vehicle, settings)?;
        let path = Trajectory::through(&self.waypoints())?;
        let start = path.flat_output(0.0);
        let hover = model.hover(start.position, start.yaw);
        let mut flying = ClosedLoop {
            plant: Airborne {
                model: &model,
                state: hover.state,
            },
            feedback: InCharge::from(controller),
        };
        let mut commands = hover.input.commands;
        let mut samples = Vec::new();
        let steps = (path.end_s() / STEP_S).round() as u32;
        for k in 0..=steps {
            let time_s = f64::from(k) * STEP_S;
            if k % self.sample_every_ms.max(1) == 0 {
                let (input, state) = (Input::still_air(commands), &flying.plant.state);
                let rate = model.derivative(state, &input);
                let body = &state.body;
                let down = body.attitude.conjugate().rotate(&Vector3::z());
                let force = rate.body.velocity + body.body_rates.cross(&body.velocity)
                    - down * vehicle.environment.gravity;
                let seen = Seen {
                    force,
                    rates: body.body_rates,
                    velocity: body.velocity,
                    duties: model
                        .rotor_set
                        .limited(&commands)
                        .map(|u| u + vehicle.pwm.zero_thrust),
                    voltage: model
                        .rotor_set
                        .rotor_inputs(&state.rotors, &state.supply, &input)
                        .1[0]
                        .voltage,
                };
                if !seen.force.iter().all(|f| f.is_finite()) {
                    return Err(FlightTestError::Diverged { time_s });
                }
                samples.push(self.read(time_s, &seen, generator));
            }
            let reference = Reference::following(
                path.flat_output(time_s),
                vehicle.environment.gravity,
                TiltLaw::Exact,
            );
            let shaking = Input::still_air(excitation(self.excitation, time_s));
            let controlled = flying.step(&reference, &shaking, STEP_S);
            commands = std::array::from_fn(|i| controlled[i] + shaking.commands[i]);
        }
        Ok(samples)
    }

    /// Corners of the square, visited in turn; each side is flown from rest to rest.
    fn waypoints(&self) -> Vec<Waypoint> {
        let a = self.half_side_m;
        let corners = [[-a, -a, 0.0], [a, -a, 0.0], [a, a, 0.0], [-a, a, 0.0]];
        let corner = |k: u32| Waypoint {
            time_s: f64::from(k) * self.side_s,
            position_m: corners[k as usize % corners.len()],
            velocity_m_s: [0.0; 3],
            yaw_rad: 0.0,
            yaw_rate_rad_s: 0.0,
        };
        (0..=self.sides.max(1)).map(corner).collect()
    }

    fn read(&self, time_s: f64, seen: &Seen, generator: &mut Generator) -> FlightSample {
        let force = seen.force.map(|x| self.force.read(x, generator));
        let rate = seen.rates.map(|x| self.rate.read(x, generator));
        let velocity = seen.velocity.map(|x| self.velocity.read(x, generator));
        let [duty_1, duty_2, duty_3, duty_4] = seen.duties;
        FlightSample {
            time_s,
            force_x_m_s2: force.x,
            force_y_m_s2: force.y,
            force_z_m_s2: force.z,
            rate_x_rad_s: rate.x,
            rate_y_rad_s: rate.y,
            rate_z_rad_s: rate.z,
            velocity_x_m_s: velocity.x,
            velocity_y_m_s: velocity.y,
            velocity_z_m_s: velocity.z,
            duty_1,
            duty_2,
            duty_3,
            duty_4,
            battery_voltage_v: self.voltage.read(seen.voltage, generator),
        }
    }
}

/// The truth at an instant.
struct Seen {
    force: Vector3<f64>,
    rates: Vector3<f64>,
    velocity: Vector3<f64>,
    duties: [f64; 4],
    voltage: f64,
}
