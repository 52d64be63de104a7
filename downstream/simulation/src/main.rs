//! A quadrotor at level 3 before a tracking station, two seconds long.

use sifre::quad_ndi::quad_dynamics::{Level, Vehicle};
use sifre::quad_ndi::{AnyController, C3, Reference, Settings};
use sifre::quadrotor::Setup;
use sifre::{Engine, EtsSetup, Facing, GimballedEts, Member, ModelQuadrotor, steps};
use std::sync::Arc;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let vehicle = Arc::new(Vehicle::qball_x4());
    let c3 = AnyController::C3(C3::new(&vehicle, &Settings::default())?.into());
    let hold = Facing::agent(Reference::hold([4.0, 0.5, -1.0].into(), 0.0), "station");
    let quadrotor = Setup::new("quadrotor", &vehicle, Level::Three, c3, hold);
    let mut simulation = Engine::new(vec![
        Member::new(ModelQuadrotor::new(quadrotor)?, steps::QUADROTOR.step),
        Member::new(
            GimballedEts::new(EtsSetup::nominal("station", "quadrotor")),
            steps::ETS.step,
        ),
    ])?;
    let report = simulation.run(2.0, &mut ())?;
    println!("{}: {} steps of the agents", report.status, report.agent_steps);
    Ok(())
}
