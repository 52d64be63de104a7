//! Figure est.1: errors of the estimate by the filter's level and by the quality of the sensors.

use super::study::Study;
use crate::claim::Claim;
use crate::data::DataTable;
use crate::drawing::Drawing;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::plot::{Figure, Panel, series_style};
use quad_dynamics::Level;
use quad_estimation::sensor::Quality;

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "est.1",
    title: "State estimation: errors by the filter's level and by the quality of its sensors",
    description: "An error-state Kalman filter on each level estimates the same four flights of level 5 (with noise, along the trajectory of \
                  figure 6.17) from accelerometer, gyroscope, magnetometer, sonar and position fixes of three qualities. The noise of a \
                  lower level is the likeliest on a flight of its own. Root mean squares from the second second on.",
    kind: Kind::Plot,
    origin: Origin::Simulated,
    claims: &[QUALITY, LEVEL, SENSORS_FIRST],
    make: Make::Draw(draw),
};

const QUALITY: Claim =
    Claim::holds("at every level every error grows from good to poor and from poor to very poor sensors");
const LEVEL: Claim = Claim::holds(
    "with every quality of sensors no lower level has smaller errors of position, velocity or tilt than level 5, the truth's own",
);
const SENSORS_FIRST: Claim = Claim::holds(
    "the sensors matter more than the level: from good to very poor every error grows by a larger factor than from level 5 to the worst level",
);

/// The panels: name of the column, label, factor into its unit.
const SHOWN: [(&str, &str, f64); 3] = [
    ("position_m", "Position error, m", 1.0),
    ("velocity_m_s", "Velocity error, m/s", 1.0),
    ("tilt_deg", "Tilt error, °", 57.295_779_513_082_32),
];

/// The flights have the same truth and sensors for all filters; below a per cent two filters are the same.
const SAME: f64 = 0.01;

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let study = Study::of(context)?;
    let error = |quality, level, i: usize| Ok::<f64, ItemError>(study.extended(quality, level)?.errors[i]);
    let mut data = DataTable::new(["quality", "level", "position_m", "velocity_m_s", "tilt_deg"]);
    let mut figure = Figure::columns(3).panel_size(200.0, 220.0);
    for (i, (_, label, scale)) in SHOWN.iter().enumerate() {
        let mut panel = Panel::new("Level of the filter", *label).log_y().x_step(1.0);
        for (k, quality) in Quality::ALL.into_iter().enumerate() {
            let points = Level::ALL
                .into_iter()
                .map(|level| Ok((f64::from(level.number()), scale * error(quality, level, i)?)))
                .collect::<Result<Vec<_>, ItemError>>()?;
            let name = if i == 0 {
                format!("{} sensors", quality.name())
            } else {
                String::new()
            };
            panel = panel.line("", series_style(k), points.iter().copied()).markers(
                name,
                series_style(k),
                points,
            );
        }
        figure = figure.panel(panel);
    }
    let (mut grows, mut best) = (true, true);
    let (mut by_level, mut by_sensors) = ([0.0_f64; 3], [f64::INFINITY; 3]);
    let mut worst_gain = 0.0_f64;
    for i in 0..3 {
        for level in Level::ALL {
            let [good, poor, very_poor] = [
                error(Quality::Good, level, i)?,
                error(Quality::Poor, level, i)?,
                error(Quality::VeryPoor, level, i)?,
            ];
            grows &= good < poor && poor < very_poor;
            by_sensors[i] = by_sensors[i].min(very_poor / good);
            for quality in Quality::ALL {
                let ratio = error(quality, level, i)? / error(quality, Level::Five, i)?;
                best &= ratio > 1.0 - SAME;
                worst_gain = worst_gain.max(1.0 - ratio);
                by_level[i] = by_level[i].max(ratio);
            }
        }
    }
    for quality in Quality::ALL {
        for level in Level::ALL {
            data.push([
                quality.name().into(),
                f64::from(level.number()).into(),
                error(quality, level, 0)?.into(),
                error(quality, level, 1)?.into(),
                (SHOWN[2].2 * error(quality, level, 2)?).into(),
            ]);
        }
    }
    Ok(Drawing::picture(figure.draw())
        .data(data)
        .check(
            QUALITY,
            grows,
            format!(
                "from good to very poor by factors of at least {by_sensors:.1?} (position, velocity, tilt)"
            ),
        )
        .check(
            LEVEL,
            best,
            format!("a lower level is better by {:.1} % at most", 100.0 * worst_gain),
        )
        .check(
            SENSORS_FIRST,
            (0..3).all(|i| by_sensors[i] > by_level[i]),
            format!("worst level over level 5: factors of {by_level:.2?}; sensors: {by_sensors:.1?}"),
        ))
}
