//! A type of your own in the place of each of the six traits: a simulation, a black box, an agent, a quadrotor, a station, an
//! optimiser.
//!
//! A drone on a rail (your quadrotor) passes a lighthouse (your station, which sweeps at constant rate) and a kite (your agent).
//! Your optimiser, a golden-section search, finds the sweep that lights the drone for longest. It doesn't matter to it that a flight costs
//! one run of the engine, or none at all: the last simulation is a formula.
//!
//! `cargo run -p sifre --example your_own`

use ets::{GimbalState, Link, Mode, Station};
use nalgebra::Vector3;
use optim::{Candidate, Evaluation, Limits, Optimiser, StopReason, TellError, Variable, minimise};
use quad_dynamics::{Flight, Level};
use quad_kinematics::EulerAngles;
use sifre::{
    Agent, AgentEvent, AgentId, BindError, BlackBox, BlackBoxError, Channel, Directory, Engine, Ets, Member,
    MemoryError, Moment, Observer, Published, Quadrotor, RecorderId, RunReport, RunStatus, Simulation,
    SimulationError, StepSize, steps,
};
use std::error::Error;

/// How long a flight lasts, s.
const DURATION_S: f64 = 4.0;

// --- An agent: a kite that swings above its peg. ---------------------------------------------------------------------

#[derive(Debug)]
struct Kite {
    time_s: f64,
}

impl Kite {
    fn at(time_s: f64) -> Published {
        let position = Vector3::new(3.0, 0.5 * time_s.sin(), -4.0);
        Published::at_rest(position, EulerAngles::level(0.0).rotation())
    }
}

/// What the agents of this example have in common: a state that is a function of the time.
macro_rules! clockwork {
    () => {
        fn advance(&mut self, now: &Moment<'_>) {
            self.time_s = now.next_s();
        }

        fn channels(&self) -> Vec<Channel> {
            Vec::new()
        }

        fn record(&self, _row: &mut [f64]) {}

        fn save(&self) -> Result<serde_json::Value, serde_json::Error> {
            serde_json::to_value(self.time_s)
        }

        fn restore(&mut self, memory: &serde_json::Value) -> Result<(), MemoryError> {
            self.time_s = serde_json::from_value(memory.clone())?;
            Ok(())
        }
    };
}

impl Agent for Kite {
    fn name(&self) -> &str {
        "kite"
    }

    fn kind(&self) -> &'static str {
        "kite"
    }

    fn published(&self) -> Published {
        Self::at(self.time_s)
    }

    fn decide(&mut self, _now: &Moment<'_>) -> Option<AgentEvent> {
        None
    }

    clockwork!();
}

// --- A quadrotor: a drone on a rail, 5 m north of the station, 1 m/s to the east. --------------------------------------

#[derive(Debug)]
struct OnRails {
    time_s: f64,
}

impl Quadrotor for OnRails {
    fn flight(&self) -> Flight<f64> {
        let Published {
            position,
            velocity,
            rotation,
            body_rates,
        } = self.published();
        Flight {
            position,
            velocity,
            attitude: rotation.euler_angles(),
            rotation,
            body_rates,
            thrusts: None,
        }
    }

    fn model_level(&self) -> Option<Level> {
        None
    }
}

impl Agent for OnRails {
    fn name(&self) -> &str {
        "drone"
    }

    fn kind(&self) -> &'static str {
        "on-rails"
    }

    fn published(&self) -> Published {
        let position = Vector3::new(5.0, self.time_s - 0.5 * DURATION_S, -1.0);
        Published {
            velocity: Vector3::y(),
            ..Published::at_rest(position, EulerAngles::level(std::f64::consts::PI).rotation())
        }
    }

    fn decide(&mut self, _now: &Moment<'_>) -> Option<AgentEvent> {
        None
    }

    clockwork!();
}

// --- A station: a lighthouse that turns at a constant rate and tracks nobody. -------------------------------------------

#[derive(Debug)]
struct Lighthouse {
    physics: ets::Ets<f64>,
    rate_rad_s: f64,
    time_s: f64,
    target: Option<AgentId>,
    face: ets::Face<f64>,
    lit_s: f64,
}

impl Lighthouse {
    fn turning(rate_rad_s: f64) -> Self {
        let physics = ets::Ets::<f64>::new(&Station::nominal());
        let face = physics
            .receiver
            .on(&physics.pedestal.origin(), &nalgebra::Matrix3::identity());
        Self {
            physics,
            rate_rad_s,
            time_s: 0.0,
            target: None,
            face,
            lit_s: 0.0,
        }
    }
}

impl Ets for Lighthouse {
    fn target(&self) -> &str {
        "drone"
    }

    fn mode(&self) -> Mode {
        Mode::Searching
    }

    fn gimbal(&self) -> GimbalState<f64> {
        let pan = self.rate_rad_s * (self.time_s - 0.5 * DURATION_S) - self.physics.pedestal.heading;
        GimbalState::at_rest(pan, 0.2)
    }

    fn link(&self) -> Link<f64> {
        self.physics.link(&self.gimbal(), &self.face)
    }
}

impl Agent for Lighthouse {
    fn name(&self) -> &str {
        "lighthouse"
    }

    fn kind(&self) -> &'static str {
        "lighthouse"
    }

    fn bind(&mut self, directory: &Directory<'_>) -> Result<(), BindError> {
        self.target = Some(directory.find(self.target())?);
        Ok(())
    }

    fn published(&self) -> Published {
        let rotation = self.physics.pedestal.rotation(&self.gimbal());
        let rotation = quad_kinematics::Rotation::from_matrix(rotation.matrix);
        Published::at_rest(self.physics.pedestal.origin(), rotation)
    }

    fn decide(&mut self, now: &Moment<'_>) -> Option<AgentEvent> {
        let drone = now.published(self.target?);
        self.face = self.physics.receiver.on(&drone.position, &drone.rotation.matrix);
        let to = self.face.centre - self.physics.pedestal.origin();
        let bearing = to.y.atan2(to.x) - self.gimbal().pan - self.physics.pedestal.heading;
        // Lit while the bearing is within two degrees of the beam.
        if bearing.abs() < 2_f64.to_radians() {
            self.lit_s += now.step_s;
        }
        None
    }

    clockwork!();
}

// --- A black box: it counts. ---------------------------------------------------------------------------------------------

#[derive(Default)]
struct Counter {
    rows: usize,
}

impl BlackBox for Counter {
    fn begin(&mut self, _channels: &[Channel]) -> Result<(), BlackBoxError> {
        Ok(())
    }

    fn record(&mut self, _time_ns: u64, _row: &[f64]) -> Result<(), BlackBoxError> {
        self.rows += 1;
        Ok(())
    }

    fn finish(&mut self) -> Result<(), BlackBoxError> {
        Ok(())
    }
}

// --- A simulation: the drone as a formula, without a step. -----------------------------------------------------------------

struct Formula {
    names: Vec<String>,
    now_ns: u64,
    drone: Published,
}

impl Simulation for Formula {
    fn names(&self) -> &[String] {
        &self.names
    }

    fn now_ns(&self) -> u64 {
        self.now_ns
    }

    fn published(&self, name: &str) -> Option<&Published> {
        (name == "drone").then_some(&self.drone)
    }

    fn channels(&self) -> Vec<Channel> {
        Vec::new()
    }

    fn attach_box(
        &mut self,
        _step: StepSize,
        _black_box: Box<dyn BlackBox>,
    ) -> Result<RecorderId, SimulationError> {
        // There is nothing to record.
        Err(SimulationError::Empty)
    }

    fn detach_box(&mut self, _id: RecorderId) -> Option<Result<Box<dyn BlackBox>, BlackBoxError>> {
        None
    }

    fn run(&mut self, end_s: f64, _observer: &mut dyn Observer) -> Result<RunReport, SimulationError> {
        self.now_ns = StepSize::from_seconds(end_s)?.ns();
        self.drone = OnRails { time_s: end_s }.published();
        Ok(RunReport {
            status: RunStatus::Completed,
            time_s: end_s,
            agent_steps: 0,
        })
    }
}

/// Where the drone is after a time, s, whatever simulates it.
fn drone_after(simulation: &mut dyn Simulation, time_s: f64) -> Result<Vector3<f64>, Box<dyn Error>> {
    let report = simulation.run(time_s, &mut ())?;
    assert!(report.status.is_completed(), "{}", report.status);
    Ok(simulation.published("drone").ok_or("no drone")?.position)
}

// --- An optimiser: golden-section search of one variable. -------------------------------------------------------------------

struct GoldenSection {
    variable: [Variable; 1],
    bracket: [f64; 2],
    inner: Vec<Evaluation>,
    asked: u64,
    awaited: Option<Candidate>,
    best: Option<Evaluation>,
}

impl GoldenSection {
    fn over(variable: Variable) -> Self {
        Self {
            bracket: [variable.lower, variable.upper],
            variable: [variable],
            inner: Vec::new(),
            asked: 0,
            awaited: None,
            best: None,
        }
    }
}

impl Optimiser for GoldenSection {
    fn variables(&self) -> &[Variable] {
        &self.variable
    }

    fn ask(&mut self) -> Option<Candidate> {
        if self.awaited.is_some() || self.is_done() {
            return None;
        }
        let [low, high] = self.bracket;
        let share = 0.5 * (5_f64.sqrt() - 1.0);
        let (left, right) = (high - share * (high - low), low + share * (high - low));
        let x = match self.inner.first() {
            Some(known) if (known.candidate.values[0] - left).abs() < 1e-9 => right,
            _ => left,
        };
        let candidate = Candidate {
            id: self.asked,
            values: vec![x],
        };
        self.asked += 1;
        self.awaited = Some(candidate.clone());
        Some(candidate)
    }

    fn tell(&mut self, candidate: &Candidate, cost: f64) -> Result<(), TellError> {
        if self.awaited.as_ref() != Some(candidate) {
            return Err(TellError::NotAwaited { id: candidate.id });
        }
        self.awaited = None;
        let told = Evaluation {
            candidate: candidate.clone(),
            cost,
        };
        if self.best.as_ref().is_none_or(|best| cost < best.cost) {
            self.best = Some(told.clone());
        }
        self.inner.push(told);
        if let [a, b] = self.inner.as_mut_slice() {
            if a.candidate.values[0] > b.candidate.values[0] {
                std::mem::swap(a, b);
            }
            let keeps_left = a.cost <= b.cost;
            let [left, right] = [a.candidate.values[0], b.candidate.values[0]];
            if keeps_left {
                self.bracket[1] = right;
                self.inner.truncate(1);
            } else {
                self.bracket[0] = left;
                self.inner.remove(0);
            }
        }
        Ok(())
    }

    fn renew(&mut self) {
        self.awaited = None;
    }

    fn best(&self) -> Option<&Evaluation> {
        self.best.as_ref()
    }

    fn evaluations(&self) -> u64 {
        self.asked - u64::from(self.awaited.is_some())
    }

    fn ending(&self) -> Option<StopReason> {
        let width = self.variable[0].upper - self.variable[0].lower;
        let spread = (self.bracket[1] - self.bracket[0]) / width;
        (spread < 1e-3).then_some(StopReason::Converged {
            spread,
            cost_spread: 0.0,
        })
    }
}

/// One flight past the lighthouse: rows recorded, and for how long it lit the drone, s.
fn pass(rate_rad_s: f64) -> Result<(usize, f64), Box<dyn Error>> {
    let mut engine = Engine::new(vec![
        Member::new(OnRails { time_s: 0.0 }, steps::QUADROTOR.step),
        Member::new(Lighthouse::turning(rate_rad_s), steps::ETS.step),
        Member::new(Kite { time_s: 0.0 }, steps::QUADROTOR.step),
    ])?;
    let id = engine.attach(steps::BLACK_BOX.step, Counter::default())?;
    drone_after(&mut engine, DURATION_S)?;
    let rows = engine.detach::<Counter>(id).ok_or("attached above")??.rows;
    let lighthouse: &Lighthouse = engine.agent("lighthouse").ok_or("no lighthouse")?;
    Ok((rows, lighthouse.lit_s))
}

fn main() -> Result<(), Box<dyn Error>> {
    let rate = Variable {
        name: "rate".into(),
        unit: "rad/s".into(),
        lower: 0.05,
        upper: 0.6,
    };
    let mut search = GoldenSection::over(rate);
    let dark_s = |x: &[f64]| pass(x[0]).map_or(DURATION_S, |(_, lit_s)| DURATION_S - lit_s);
    let report = minimise(&mut search, dark_s, Limits::evaluations(40))?;
    let best = report.best.candidate.values[0];
    let (rows, lit_s) = pass(best)?;
    println!(
        "{} flights; {best:.3} rad/s lights the drone for {lit_s:.2} s of {DURATION_S} s",
        report.evaluations
    );
    println!("the black box counted {rows} rows");

    // The same question of the engine and of a formula.
    let mut formula = Formula {
        names: vec!["drone".into()],
        now_ns: 0,
        drone: OnRails { time_s: 0.0 }.published(),
    };
    let mut engine = Engine::new(vec![Member::new(OnRails { time_s: 0.0 }, steps::QUADROTOR.step)])?;
    let (a, b) = (drone_after(&mut formula, 1.0)?, drone_after(&mut engine, 1.0)?);
    assert_eq!(a, b);
    Ok(())
}
