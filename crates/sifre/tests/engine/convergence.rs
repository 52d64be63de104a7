//! Halving step sizes: at which order a run converges.
//!
//! The order is `p = log₂ |x_h − x_h/2| / |x_h/2 − x_h/4|`, which is exact up to the next term of the error's
//! expansion, a share of the order of h itself.

use crate::support::{c3, ms, position, vehicle};
use nalgebra::Vector3;
use proptest::prelude::*;
use quad_dynamics::{AnyQuadrotor, Level, PhenomenonSet};
use quad_math::FixedStep;
use quad_ndi::Reference;
use sifre::quadrotor::{LevelChoice, OpenLoop, Setup, Start};
use sifre::{Engine, Facing, Follow, Member, ModelQuadrotor, Schedule};
use std::num::NonZeroU32;

/// The order that three results show, each with steps half as long as the one before.
fn order(x: &[Vector3<f64>; 3]) -> f64 {
    ((x[0] - x[1]).norm() / (x[1] - x[2]).norm()).log2()
}

/// Without drag there is no kink.
fn smooth(level: Level) -> LevelChoice {
    LevelChoice {
        level,
        phenomena: Some(PhenomenonSet::none()),
    }
}

/// Where an open-loop flight of 0.4 s with uneven commands ends.
fn open_loop(level: Level, uneven: [f64; 4], method: FixedStep, step_ms: f64) -> Vector3<f64> {
    let vehicle = vehicle();
    let hover = AnyQuadrotor::<f64>::hovering(level, &vehicle, &PhenomenonSet::none(), Vector3::zeros(), 0.0)
        .unwrap()
        .hover_input()
        .commands;
    let commands = std::array::from_fn(|i| hover[i] * (1.1 + uneven[i]));
    let pilot = OpenLoop(Schedule::new([(0.0, commands)]).unwrap());
    let hold = Reference::hold(Vector3::zeros(), 0.0);
    let setup = Setup {
        method,
        ..Setup::new("alpha", &vehicle, smooth(level), pilot, hold)
    };
    let member = Member::new(ModelQuadrotor::new(setup).unwrap(), ms(step_ms));
    let mut simulation = Engine::new(vec![member]).unwrap();
    assert!(simulation.run(0.4, &mut ()).unwrap().status.is_completed());
    position(&simulation, "alpha")
}

/// A leader in a closed loop and one who follows and faces it, at unequal steps times a factor.
fn pair(factor: f64, substeps: u32) -> [Vector3<f64>; 2] {
    let vehicle = vehicle();
    let substeps = NonZeroU32::new(substeps).unwrap();
    let to = Reference::hold([0.4, 0.3, -0.5].into(), 0.5);
    let leader = Setup {
        substeps,
        ..Setup::new("leader", &vehicle, smooth(Level::Three), c3(&vehicle), to)
    };
    let follow = Facing::agent(Follow::agent("leader", [-1.0, 0.5, -0.2], 0.0), "leader");
    let follower = Setup {
        substeps,
        start: Start {
            position_m: [-1.0, 0.0, 0.0],
            yaw_rad: 0.0,
        },
        ..Setup::new("follower", &vehicle, smooth(Level::Four), c3(&vehicle), follow)
    };
    let mut simulation = Engine::new(vec![
        Member::new(ModelQuadrotor::new(leader).unwrap(), ms(2.0 * factor)),
        Member::new(ModelQuadrotor::new(follower).unwrap(), ms(5.0 * factor)),
    ])
    .unwrap();
    assert!(simulation.run(0.6, &mut ()).unwrap().status.is_completed());
    ["leader", "follower"].map(|name| position(&simulation, name))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// One agent whose inputs don't depend on the step: the integrator's own order.
    #[test]
    fn prop_an_open_loop_converges_at_the_integrators_order(
        level in prop::sample::select(vec![Level::Two, Level::Three, Level::Four]),
        // Away from zero, where there would be no motion to measure.
        uneven in [-0.1..-0.05_f64, 0.05..0.1_f64, 0.02..0.05_f64, -0.05..-0.02_f64],
    ) {
        let runge_kutta = [20.0, 10.0, 5.0].map(|step| open_loop(level, uneven, FixedStep::Rk4, step));
        let p = order(&runge_kutta);
        // The next term: a share of the order of h ω_R / 4 = 0.07 at 20 ms and 15 rad/s.
        prop_assert!((p - 4.0).abs() < 0.1, "RK4 at {level}: order {p}");
        let euler = [2.0, 1.0, 0.5].map(|step| open_loop(level, uneven, FixedStep::Euler, step));
        let p = order(&euler);
        // The same at 2 ms.
        prop_assert!((p - 1.0).abs() < 0.02, "Euler at {level}: order {p}");
    }
}

/// Sampled controllers and published states are held over a step: everything together converges at first order.
#[test]
fn exact_coupled_agents_converge_at_the_order_of_the_hold() {
    let runs = [0.5, 0.25, 0.125].map(|factor| pair(factor, 1));
    for agent in 0..2 {
        let p = order(&runs.map(|run| run[agent]));
        // The next term: 2.5 ms times the position loop's 3 rad/s.
        assert!((p - 1.0).abs() < 0.01, "agent {agent}: order {p}");
    }
}

/// With the samples where they are, the integrator's steps alone converge at its order.
#[test]
fn exact_substeps_converge_at_the_integrators_order() {
    let runs = [2, 4, 8].map(|substeps| pair(1.0, substeps));
    for agent in 0..2 {
        let p = order(&runs.map(|run| run[agent]));
        // The next term: 2.5 ms times the 100 rad/s of level 4's fast rotor pole.
        assert!((p - 4.0).abs() < 0.25, "agent {agent}: order {p}");
    }
}
