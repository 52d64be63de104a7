//! A rotor on the virtual thrust stand, at rest and in motion: a small report with the truth beside each number, and a picture.
//!
//! `cargo run -p sysid --example identify_a_rotor [seed]`

use quad_dynamics::Vehicle;
use quad_dynamics::vehicle::derive::SteadyRotor;
use quad_plot::{Figure, Panel, series_style};
use std::error::Error;
use std::path::Path;
use sysid::Estimate;
use sysid::laboratory::generator;
use sysid::laboratory::thrust_stand::{BenchSupply, Prbs, StaticSweep, ThrustStand, uniform_times};
use sysid::rotor_dynamics::{Poles, Record, ResponseFit, Start, Structure, identify};
use sysid::rotor_static::{PropellerSample, PropellerScale, Quantity, coefficient};

const VOLTAGE_V: f64 = 11.1;

fn main() -> Result<(), Box<dyn Error>> {
    let seed = std::env::args().nth(1).map_or(Ok(1), |text| text.parse())?;
    let vehicle = Vehicle::qball_x4();
    let steady = SteadyRotor::of(&vehicle)?;
    let stand = ThrustStand::of(&vehicle)?;
    let supply = BenchSupply::Regulated { voltage_v: VOLTAGE_V };
    let mut random = generator(seed);
    println!(
        "{:<28} {:>24} {:>10}  95 % interval",
        "number", "estimate", "truth"
    );

    let sweep = StaticSweep {
        duties: (0..20).map(|i| 0.062 + 0.001 * f64::from(i)).collect(),
        supplies: vec![supply],
        readings: 50,
    };
    let samples = stand.sweep(&sweep, &mut random)?;
    let propeller = vehicle.require_propeller("this report")?;
    let scale = PropellerScale {
        diameter_m: propeller.diameter,
        air_density_kg_m3: vehicle.environment.air_density,
    };
    let rows: Vec<PropellerSample> = samples.iter().map(PropellerSample::from).collect();
    for (name, quantity, truth) in [
        ("C_T", Quantity::Thrust, propeller.thrust_coefficient),
        ("C_Q", Quantity::Torque, propeller.torque_coefficient),
    ] {
        let fit = coefficient(&rows, &scale, quantity)?;
        line(name, fit.parameters[0], truth);
    }

    let hover = steady.speed_at_thrust(vehicle.hover_thrust_per_rotor());
    let signal = Prbs {
        centre: vehicle.pwm.minimum + steady.duty(hover, VOLTAGE_V),
        amplitude: 0.001,
        hold_s: 0.04,
        skipped_bits: 0,
    };
    let times = uniform_times(0.005, 8.0)?;
    let response = stand.record(&times, signal.signal(), supply, &mut random)?;
    let record = Record::of(&response, |s| s.duty, |s| s.thrust_n)?;
    let fit = identify(&record, Structure::SecondOrder, Start::Equilibrium)?;
    if let Poles::Real { slow, fast } = fit.poles {
        line("slow pole, rad/s", slow, steady.motor_pole(hover));
        line(
            "fast pole, rad/s",
            fast,
            1.0 / vehicle.require_motor("this report")?.controller_lag,
        );
    }
    println!(
        "fit {:.1} %, residuals white: {}",
        fit.fit_percent,
        fit.whiteness.is_white()
    );
    for warning in &fit.warnings {
        println!("warning: {warning}");
    }
    draw(&record, &fit)
}

fn line(name: &str, estimate: Estimate, truth: f64) {
    let interval = estimate.interval();
    println!(
        "{name:<28} {:>12.5} ± {:<9.1e} {truth:>10.5}  {:.5} to {:.5}: {}",
        estimate.value,
        estimate.half_width(),
        interval.lower,
        interval.upper,
        if interval.contains(truth) {
            "inside"
        } else {
            "outside"
        }
    );
}

/// Measured and fitted thrust, and the residuals.
fn draw(record: &Record, fit: &ResponseFit) -> Result<(), Box<dyn Error>> {
    let over_time = |values: &[f64]| -> Vec<(f64, f64)> {
        record
            .times()
            .iter()
            .copied()
            .zip(values.iter().copied())
            .collect()
    };
    let thrust = Panel::new("Time *t*, s", "Thrust *T*, N")
        .line("measured", series_style(0), over_time(record.outputs()))
        .line("fit", series_style(1).dashed(""), over_time(&fit.simulated));
    let left = Panel::new("Time *t*, s", "Residual, N")
        .line("", series_style(0), over_time(&fit.residuals))
        .horizontal(0.0, "");
    let svg = Figure::columns(1).share_x().panel(thrust).panel(left).draw();
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../target/identify_a_rotor.svg");
    std::fs::write(&path, svg.document())?;
    println!("picture: {}", path.display());
    Ok(())
}
