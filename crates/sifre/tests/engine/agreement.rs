//! The engine flies what the plain loop flies, bit for bit.

use crate::support::{c1, c3, ms, pid, position, vehicle};
use quad_dynamics::{AnyQuadrotor, Input, Level, Level3, QuadrotorModel};
use quad_math::TimeGrid;
use quad_ndi::{
    Airborne, C3, ClosedLoop, FlightPlan, FlightStatus, Flyer, InCharge, Plant, Reference, Settings,
};
use sifre::black_box::MemoryBox;
use sifre::quadrotor::Setup;
use sifre::{Engine, Member, ModelQuadrotor};
use std::num::NonZeroU64;

#[test]
fn agree_with_the_plain_loop_at_every_level() {
    let vehicle = vehicle();
    let to = Reference::hold([0.5, -0.3, -1.0].into(), 0.4);
    for level in Level::ALL {
        for controller in [c1(&vehicle), c3(&vehicle), pid(&vehicle)] {
            if controller.check(level).is_err() {
                continue;
            }
            let setup = Setup::new("alpha", &vehicle, level, controller.clone(), to);
            let member = Member::new(ModelQuadrotor::new(setup).unwrap(), ms(1.0));
            let mut simulation = Engine::new(vec![member]).unwrap();
            let id = simulation.attach(ms(5.0), MemoryBox::with_room_for(101)).unwrap();
            assert!(simulation.run(0.5, &mut ()).unwrap().status.is_completed());
            let recording = simulation.detach::<MemoryBox>(id).unwrap().unwrap().recording;

            let model =
                AnyQuadrotor::hovering(level, &vehicle, &level.phenomena(), [0.0; 3].into(), 0.0).unwrap();
            let plan = FlightPlan {
                grid: TimeGrid::from_seconds(1e-3, 0.5).unwrap(),
                record_every: NonZeroU64::new(5).unwrap(),
            };
            let log = Flyer::new(&vehicle, model, controller)
                .unwrap()
                .fly(&plan, |_| to);
            assert_eq!(log.status, FlightStatus::Completed);
            assert_eq!(log.records.len(), recording.len());
            let column = |name: &str| {
                recording
                    .column(&format!("alpha.{name}"))
                    .unwrap()
                    .collect::<Vec<_>>()
            };
            let (x, yaw, u4) = (column("position.x"), column("attitude.yaw"), column("command.4"));
            let (q, wanted) = (column("body_rate.q"), column("reference.position.z"));
            for (k, (record, time_s)) in log.records.iter().zip(recording.times_s()).enumerate() {
                assert_eq!(record.time_s, time_s);
                assert_eq!(record.flight.position.x, x[k]);
                assert_eq!(record.flight.attitude.yaw, yaw[k]);
                assert_eq!(record.flight.body_rates.y, q[k]);
                assert_eq!(record.commands[3], u4[k]);
                assert_eq!(record.reference.flat.position.z, wanted[k]);
            }
        }
    }
}

/// The pure step that rollouts repeat.
#[test]
fn agree_with_the_pure_step() {
    let vehicle = vehicle();
    let to = Reference::hold([0.5, -0.3, -1.0].into(), 0.4);
    let setup = Setup::new("alpha", &vehicle, Level::Three, c3(&vehicle), to);
    let member = Member::new(ModelQuadrotor::new(setup).unwrap(), ms(1.0));
    let mut simulation = Engine::new(vec![member]).unwrap();
    simulation.run(2.0, &mut ()).unwrap();

    let model = Level3::<f64>::build(&vehicle, &Level::Three.phenomena()).unwrap();
    let c3 = C3::new(&vehicle, &Settings::default()).unwrap();
    let hover = model.hover([0.0; 3].into(), 0.0);
    let mut flying = ClosedLoop {
        plant: Airborne {
            model: &model,
            state: hover.state,
        },
        feedback: InCharge::from(c3),
    };
    for _ in 0..2000 {
        flying.step(&to, &Input::still_air([0.0; 4]), 1e-3);
    }
    assert_eq!(position(&simulation, "alpha"), flying.plant.flight().position);
}
