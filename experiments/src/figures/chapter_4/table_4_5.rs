//! Table 4.5: gains of the linear models, rotor by rotor.

use crate::claim::Claim;
use crate::data::DataTable;
use crate::drawing::{DisplayTable, Drawing};
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::rotor_bench::{PLACES, RotorBench};
use sysid::Estimate;
use sysid::rotor_static::linear_gains;

/// The table.
pub(super) const ITEM: Item = Item {
    id: "table-4.5",
    title: "Gains of the linear models of thrust and torque",
    description: "Lines *T* = *K*_{T} (*ū* − *ū*_{0}) and *Q* = *K*_{Q} (*ū* − *ū*_{0}) over the operating range (1 to 7.6 N) at 11.1 V, \
                  with 95 % intervals; *ū*_{0} is the zero of the thrust line, its interval by the delta method. Last column: line \
                  less rotor where the rotor carries a quarter of the vehicle.",
    kind: Kind::Table,
    origin: Origin::VirtualLaboratory,
    claims: &[LINE, ABOVE, FILE],
    make: Make::Draw(draw),
};

const LINE: Claim = Claim::holds("every stated interval contains what the same fit gives without noise");
const ABOVE: Claim = Claim::holds("every line overstates the thrust at hover, by 0.1 to 0.3 N");
const FILE: Claim =
    Claim::holds("the vehicle file's gains and zero lie inside the intervals of the nominal rotor");

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let bench = RotorBench::default();
    let vehicle = bench.vehicle(context)?;
    let hover = vehicle.hover_thrust_per_rotor();
    let mut shown = DisplayTable::new([
        "Rotor",
        "*K*_{T}, N",
        "*K*_{Q}, N m",
        "*ū*_{0}, %",
        "Error at hover, N",
    ]);
    let mut data = DataTable::new([
        "rotor",
        "thrust_gain_n",
        "thrust_gain_half_width",
        "torque_gain_n_m",
        "torque_gain_half_width",
        "zero_thrust_duty",
        "zero_thrust_half_width",
        "error_at_hover_n",
    ]);
    let (mut inside, mut all, mut errors) = (0, 0, Vec::new());
    let mut file = Vec::new();
    let rotors = [bench.nominal(&vehicle)?]
        .into_iter()
        .chain(bench.four(&vehicle)?);
    for (rotor, place) in rotors.zip(["nominal"].into_iter().chain(PLACES)) {
        let samples = bench.operating(&vehicle, &rotor)?;
        let gains = linear_gains(&samples)?;
        let noiseless = linear_gains(&rotor.noiseless(&samples))?;
        let found = [gains.thrust_gain, gains.torque_gain, gains.zero_thrust];
        let truth = [
            noiseless.thrust_gain,
            noiseless.torque_gain,
            noiseless.zero_thrust,
        ]
        .map(|e| e.value);
        let pairs = found.iter().zip(truth);
        inside += pairs.filter(|(e, truth)| e.interval().contains(*truth)).count();
        all += truth.len();
        let steady = rotor.truth(&vehicle)?;
        let speed = steady.speed_at_thrust(hover);
        let at_hover = rotor.stand.minimum_duty + steady.duty(speed, bench.nominal_voltage_v);
        let error = gains.thrust_at(at_hover).value - hover;
        errors.push(error);
        if rotor.number == 0 {
            let linear = vehicle.linear_rotor;
            let stored = [linear.thrust_gain, linear.torque_gain, vehicle.pwm.zero_thrust];
            file = found
                .iter()
                .zip(stored)
                .map(|(e, s)| (s - e.value) / e.half_width())
                .collect();
        }
        let [k_t, k_q, zero] = found;
        let name = if rotor.number == 0 {
            place.into()
        } else {
            format!("{} {place}", rotor.number)
        };
        let percent = zero.mapped(100.0 * zero.value, 100.0);
        shown.push([
            name,
            words(&k_t, 1),
            words(&k_q, 3),
            words(&percent, 3),
            format!("{error:.3}"),
        ]);
        data.push([
            place.into(),
            k_t.value.into(),
            k_t.half_width().into(),
            k_q.value.into(),
            k_q.half_width().into(),
            zero.value.into(),
            zero.half_width().into(),
            error.into(),
        ]);
    }
    let (least, most) = errors
        .iter()
        .fold((f64::INFINITY, 0.0_f64), |(l, m), e| (l.min(*e), m.max(*e)));
    Ok(Drawing::table(shown)
        .data(data)
        .settings(&bench)?
        .check(LINE, inside == all, format!("{inside} of {all}"))
        .check(ABOVE, least > 0.1 && most < 0.3, format!("{least:.3} to {most:.3} N"))
        .check(
            FILE,
            file.iter().all(|widths| widths.abs() <= 1.0),
            format!("K_T, K_Q and ū_0 of the file lie {file:.2?} half widths off"),
        )
        .note(
            "The rotor is curved: the residuals of each line follow the duty, which the fits announce. The intervals count the curve \
             as noise and are therefore wide; over another range the line would be another.",
        ))
}

fn words(estimate: &Estimate, digits: usize) -> String {
    format!("{:.digits$} ± {:.digits$}", estimate.value, estimate.half_width())
}
