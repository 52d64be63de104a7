//! Level 3 falls from its hover when it commands nothing: the height after half a second, beside `g t²/2`.

use quad_dynamics::quad_math::rk4_step;
use quad_dynamics::{BuildError, Input, Level, Level3, QuadrotorModel, Vehicle};

fn main() -> Result<(), BuildError> {
    let model = Level3::<f64>::build(&Vehicle::qball_x4(), &Level::Three.phenomena())?;
    let hover = model.hover([0.0; 3].into(), 0.0);
    let mut state = hover.state;
    for _ in 0..500 {
        state = rk4_step(&model, &state, &hover.input, 0.001);
    }
    // In equilibrium nothing moves.
    assert!(model.flight(&state).position.norm() < 1e-12);
    for _ in 0..500 {
        state = rk4_step(&model, &state, &Input::still_air([0.0; 4]), 0.001);
    }
    let fallen = model.flight(&state).position.z;
    // The rotors' thrust dies away with a bandwidth of some 15 rad/s: less than free fall.
    assert!(fallen > 0.5 && fallen < 0.5 * 9.81 * 0.25);
    println!("fell {fallen:.3} m in half a second");
    Ok(())
}
