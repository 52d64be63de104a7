//! Table 4.4: coefficients of the polynomials, thrust and torque against PWM duty and voltage, rotor by rotor.

use crate::claim::Claim;
use crate::data::DataTable;
use crate::drawing::{DisplayTable, Drawing};
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::rotor_bench::{PLACES, RotorBench};
use sysid::rotor_static::{Quantity, polynomial};

/// The table.
pub(super) const ITEM: Item = Item {
    id: "table-4.4",
    title: "Polynomial coefficients of thrust and torque against PWM duty and voltage",
    description: "Cubics *k*_{1} *x* + *k*_{2} *x*^{2} + *k*_{3} *x*^{3} in *x* = (*ū* − *ū*_{min}) *V*_{b}, V, fitted to the readings of \
                  figures E.4 to E.7, with 95 % intervals and residual standard deviation *s*; torque in mN m. The rotors differ as \
                  rotors of one kind do.",
    kind: Kind::Table,
    origin: Origin::VirtualLaboratory,
    claims: &[BEST, STATED],
    make: Make::Draw(draw),
};

const BEST: Claim =
    Claim::holds("every stated interval contains the coefficient that the same fit gives without noise");
const STATED: Claim =
    Claim::holds("coefficients with intervals: k_2, the square law of a propeller, is known within 5 %");

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let bench = RotorBench::default();
    let vehicle = bench.vehicle(context)?;
    let mut shown = DisplayTable::new(["Rotor", "", "*k*_{1}", "*k*_{2}", "*k*_{3}", "*s*"]);
    let mut data = DataTable::new([
        "rotor",
        "quantity",
        "k1",
        "k1_half_width",
        "k2",
        "k2_half_width",
        "k3",
        "k3_half_width",
        "residual_standard_deviation",
    ]);
    let (mut inside, mut all, mut widest) = (0, 0, 0.0_f64);
    for (rotor, place) in bench.four(&vehicle)?.iter().zip(PLACES) {
        let found = bench.characterise(rotor)?;
        let noiseless = rotor.noiseless(&found.samples);
        for (quantity, name, unit) in [
            (Quantity::Thrust, "thrust, N", 1.0),
            (Quantity::Torque, "torque, mN m", 1e3),
        ] {
            let fit = found.fit(quantity);
            let truth = polynomial(&noiseless, rotor.stand.minimum_duty, quantity)?.values();
            let contains = fit.parameters.iter().zip(truth);
            inside += contains
                .filter(|(k, truth)| k.interval().contains(*truth))
                .count();
            all += truth.len();
            widest = widest.max(fit.parameters[1].half_width() / fit.parameters[1].value);
            let deviation = fit.goodness.standard_deviation;
            let word = |i: usize| {
                let k = fit.parameters[i];
                format!("{:.3} ± {:.3}", unit * k.value, unit * k.half_width()).replace('-', "−")
            };
            let residual = format!("{:.3}", unit * deviation);
            shown.push([
                format!("{} {place}", rotor.number),
                name.into(),
                word(0),
                word(1),
                word(2),
                residual,
            ]);
            let [k1, k2, k3] = fit.parameters;
            data.push([
                place.into(),
                name.split(',').next().unwrap_or_default().into(),
                k1.value.into(),
                k1.half_width().into(),
                k2.value.into(),
                k2.half_width().into(),
                k3.value.into(),
                k3.half_width().into(),
                deviation.into(),
            ]);
        }
    }
    Ok(Drawing::table(shown)
        .data(data)
        .settings(&bench)?
        .check(BEST, inside == all, format!("{inside} of {all}"))
        .check(STATED, widest < 0.05, format!("widest half width {:.1} %", 100.0 * widest))
        .note(
            "The readings' own noise is 7 mN and 0.17 mN m a point; the rest of *s* is what no cubic describes, and an interval \
             that counts it as noise is wide rather than right: for another range of duty and voltage the best cubic is another.",
        ))
}
