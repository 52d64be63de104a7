//! Controller c3 takes level 3 a metre up.

use quad_ndi::quad_dynamics::{Input, Level, Level3, QuadrotorModel, Vehicle};
use quad_ndi::{Airborne, C3, ClosedLoop, InCharge, Plant, Reference, Settings};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let vehicle = Vehicle::qball_x4();
    let model = Level3::<f64>::build(&vehicle, &Level::Three.phenomena())?;
    let c3 = C3::new(&vehicle, &Settings::default())?;
    let plant = Airborne {
        model: &model,
        state: model.hover([0.0; 3].into(), 0.0).state,
    };
    let mut flying = ClosedLoop {
        plant,
        feedback: InCharge::from(c3),
    };
    let up = Reference::hold([0.0, 0.0, -1.0].into(), 0.0);
    for _ in 0..5000 {
        flying.step(&up, &Input::still_air([0.0; 4]), 0.001);
    }
    let height = -flying.plant.flight().position.z;
    assert!((height - 1.0).abs() < 0.01, "{height}");
    println!("height after 5 s: {height:.4} m");
    Ok(())
}
