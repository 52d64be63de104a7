//! Panels and data of the static characterisations.

use super::{MEASURED_THRUST, RotorBench};
use crate::data::DataTable;
use crate::plot::{Panel, series_style};
use quad_rotor::Cubic;
use sysid::Fit;
use sysid::rotor_static::{Quantity, StaticSample, cubic};

/// Where the words about the propeller's measurements stand, left of the curves, %.
const WORDS_AT: f64 = 6.2;

/// Label of the duty's axis.
pub(crate) const DUTY: &str = "Duty *ū*, %";

/// Axis label of a quantity.
pub(crate) const fn label(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::Thrust => "Thrust *T*, N",
        Quantity::Torque => "Torque *Q*, mN m",
    }
}

/// From N or N m to the axis' unit.
pub(crate) const fn shown(quantity: Quantity) -> f64 {
    match quantity {
        Quantity::Thrust => 1.0,
        Quantity::Torque => 1e3,
    }
}

/// Polynomials of one rotor, with the readings they were fitted to.
pub(crate) struct Characterisation {
    pub(crate) samples: Vec<StaticSample>,
    pub(crate) thrust: Fit<3>,
    pub(crate) torque: Fit<3>,
}

impl Characterisation {
    pub(crate) fn fit(&self, quantity: Quantity) -> &Fit<3> {
        match quantity {
            Quantity::Thrust => &self.thrust,
            Quantity::Torque => &self.torque,
        }
    }

    pub(crate) fn cubic(&self, quantity: Quantity) -> Cubic<f64> {
        cubic(self.fit(quantity))
    }
}

/// Whether a sample was taken at about this voltage, V.
fn is_at(sample: &StaticSample, voltage: f64) -> bool {
    (sample.battery_voltage_v - voltage).abs() < 0.3
}

/// Readings against the duty, a series per voltage, with the polynomial.
pub(crate) fn against_duty(
    bench: &RotorBench,
    minimum_duty: f64,
    of: &Characterisation,
    quantity: Quantity,
) -> Panel {
    let (k, scale) = (of.cubic(quantity), shown(quantity));
    let mut panel = Panel::new(DUTY, label(quantity)).x_range(5.0, 10.2);
    for (i, &voltage) in bench.voltages_v.iter().enumerate() {
        let fitted = (0..=80).map(|j| {
            let above = 0.05 * f64::from(j) / 80.0;
            (100.0 * (minimum_duty + above), scale * k.value(above * voltage))
        });
        panel = panel.line(format!("cubic, {voltage} V"), series_style(i), fitted);
    }
    for (i, &voltage) in bench.voltages_v.iter().enumerate() {
        let at = of.samples.iter().filter(|s| is_at(s, voltage));
        let points = at.map(|s| (100.0 * s.duty, scale * s.of(quantity)));
        panel = panel.markers(format!("measured, {voltage} V"), series_style(i), points);
    }
    match quantity {
        Quantity::Thrust => {
            panel
                .horizontal(MEASURED_THRUST, "")
                .annotate(WORDS_AT, MEASURED_THRUST, "end of propeller data")
        }
        Quantity::Torque => panel,
    }
}

/// Residuals against `x = (ū − ū_min) V_b`, a series per voltage.
pub(crate) fn residuals(
    bench: &RotorBench,
    minimum_duty: f64,
    of: &Characterisation,
    quantity: Quantity,
) -> Panel {
    let words = match quantity {
        Quantity::Thrust => "Residual, mN",
        Quantity::Torque => "Residual, mN m",
    };
    let panel = Panel::new("*x* = (*ū* − *ū*_{min}) *V*_{b}, V", words)
        .x_range(0.0, 0.66)
        .horizontal(0.0, "");
    let pairs = || of.samples.iter().zip(&of.fit(quantity).residuals);
    bench
        .voltages_v
        .iter()
        .enumerate()
        .fold(panel, |panel, (i, &voltage)| {
            let at = pairs().filter(|(s, _)| is_at(s, voltage));
            let points = at.map(|(s, r)| (s.effective(minimum_duty), 1e3 * r));
            panel.markers("", series_style(i), points)
        })
}

/// The readings and their fits.
pub(crate) fn table(of: &Characterisation, minimum_duty: f64) -> DataTable {
    let mut data = DataTable::new([
        "duty",
        "battery_voltage_v",
        "thrust_n",
        "torque_n_m",
        "speed_rad_s",
        "fitted_thrust_n",
        "fitted_torque_n_m",
    ]);
    for s in &of.samples {
        let x = s.effective(minimum_duty);
        data.push([
            s.duty.into(),
            s.battery_voltage_v.into(),
            s.thrust_n.into(),
            s.torque_n_m.into(),
            s.speed_rad_s.into(),
            of.cubic(Quantity::Thrust).value(x).into(),
            of.cubic(Quantity::Torque).value(x).into(),
        ]);
    }
    data
}
