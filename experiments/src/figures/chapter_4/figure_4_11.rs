//! Figure 4.11: rotor dynamics, data against transfer functions for a step.

use super::identified::Found;
use super::motor_steps;
use crate::claim::Claim;
use crate::data::DataTable;
use crate::drawing::Drawing;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::plot::{Figure, Panel, reference_style, series_style};
use crate::rotor_bench::panels::{label, shown};
use crate::rotor_bench::{RotorBench, record};
use sysid::residual::Whiteness;
use sysid::rotor_dynamics::{Record, ResponseFit, Start, Structure, select};
use sysid::rotor_static::Quantity;

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "4.11",
    title: "Rotor dynamics: data against transfer functions for a step",
    description: "(a), (b) Transfer functions identified from a pseudo-random sequence about hover (virtual thrust stand, nominal rotor, \
                  10 s at 200 Hz), against a step they were not fitted to: thrust, and the reaction torque, which begins with the \
                  spin-up. (c) The autocorrelation of the fits' residuals with the band that holds white ones 95 times in a \
                  hundred. (d) Where a copy of the data is at hand, a real motor (NTNU, 50 Hz) with a first-order fit to each step; its source states no unit of \
                  speed.",
    kind: Kind::Plot,
    origin: Origin::VirtualLaboratory,
    claims: &[STATED, WHITE, ORDER],
    make: Make::Draw(draw),
};

const STATED: Claim = Claim::holds("fit % stated, for the sequence and for the step");
const WHITE: Claim = Claim::holds("residuals white");
const ORDER: Claim = Claim::holds(
    "the information criterion chooses two poles for the thrust and two poles with a zero for the torque",
);

/// One quantity: its fit, and the step.
struct Response {
    quantity: Quantity,
    fit: ResponseFit,
    step: Record,
    simulated: Vec<f64>,
}

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let bench = RotorBench::default();
    let vehicle = bench.vehicle(context)?;
    let rotor = bench.nominal(&vehicle)?;
    let hover = Found::of(&bench, &vehicle, &rotor)?.hover_duty;
    let (sequence, step) = (bench.sequence(&rotor, hover)?, bench.step(&rotor, hover)?);
    let respond = |quantity| -> Result<Response, ItemError> {
        let fit = select(&record(&sequence, quantity)?, &Structure::ALL, Start::Equilibrium)?.chosen;
        let step = record(&step, quantity)?;
        Ok(Response {
            quantity,
            simulated: fit.simulate(&step),
            fit,
            step,
        })
    };
    let responses = [respond(Quantity::Thrust)?, respond(Quantity::Torque)?];
    let motor = motor_steps::read(context)?;
    let mut figure = Figure::columns(if motor.is_some() { 2 } else { 3 });
    for response in &responses {
        figure = figure.panel(panel(response));
    }
    figure = figure.panel(autocorrelation(&responses));
    if let Some(motor) = &motor {
        figure = figure.panel(motor.panel());
    }
    let on_step = responses
        .each_ref()
        .map(|r| r.fit.validate(&r.step).unwrap_or(f64::NAN));
    let [thrust, torque] = &responses;
    let drawing = Drawing::picture(figure.draw())
        .data(table(&responses))
        .settings(&bench)?
        .check(
            STATED,
            on_step.iter().chain(&[thrust.fit.fit_percent, torque.fit.fit_percent]).all(|p| p.is_finite()),
            format!(
                "thrust {:.1} % of the sequence, {:.1} % of the step; torque {:.1} % and {:.1} %; what is missing is the sensors' \
                 noise",
                thrust.fit.fit_percent, on_step[0], torque.fit.fit_percent, on_step[1]
            ),
        )
        .check(
            WHITE,
            responses.iter().all(|r| r.fit.whiteness.is_white()),
            format!(
                "Ljung-Box p = {:.2} for thrust, {:.2} for torque, over 20 lags",
                thrust.fit.whiteness.p_value, torque.fit.whiteness.p_value
            ),
        )
        .check(
            ORDER,
            thrust.fit.structure == Structure::SecondOrder
                && torque.fit.structure == Structure::SecondOrderWithZero,
            format!("thrust {:?}, torque {:?}", thrust.fit.structure, torque.fit.structure),
        );
    Ok(match motor {
        Some(motor) => drawing.note(motor.words()),
        None => drawing.note(
            "The real motor's data (data/README.md, `ntnu_motor`) are not at hand: virtual laboratory only.",
        ),
    })
}

fn panel(response: &Response) -> Panel {
    let scale = shown(response.quantity);
    let over = |values: &[f64]| -> Vec<(f64, f64)> {
        let scaled = values.iter().map(|y| scale * y);
        response.step.times().iter().copied().zip(scaled).collect()
    };
    Panel::new("Time *t*, s", label(response.quantity))
        .markers("measured", reference_style(), over(response.step.outputs()))
        .line("model", series_style(1), over(&response.simulated))
}

fn autocorrelation(responses: &[Response; 2]) -> Panel {
    let bound = Whiteness::bound(responses[0].fit.residuals.len());
    let names = ["thrust residuals", "torque residuals"];
    let panel = Panel::new("Lag, samples", "Autocorrelation")
        .horizontal(bound, "95 % of white residuals")
        .horizontal(-bound, "")
        .y_range(-0.15, 0.15);
    responses
        .iter()
        .zip(names)
        .enumerate()
        .fold(panel, |panel, (i, (response, name))| {
            let lags = response.fit.whiteness.autocorrelation.iter();
            let points = (1..).map(f64::from).zip(lags.copied());
            panel.markers(name, series_style([0, 2][i]), points)
        })
}

fn table(responses: &[Response; 2]) -> DataTable {
    let [thrust, torque] = responses;
    DataTable::from_columns(&[
        ("t_s", thrust.step.times()),
        ("duty", thrust.step.inputs()),
        ("thrust_n", thrust.step.outputs()),
        ("simulated_thrust_n", &thrust.simulated),
        ("torque_n_m", torque.step.outputs()),
        ("simulated_torque_n_m", &torque.simulated),
    ])
    // Iterated fits end within Levenberg-Marquardt's own tolerance, far below the noise.
    .with_tolerance(1e-4)
}
