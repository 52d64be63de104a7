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
                  lower level is the likeliest on a flight of its own. Root mean squares from the second second on. The tilt of level 1 is worse with good sensors than with poor ones: it trusts them too far for its \
                  linear model.",
    kind: Kind::Plot,
    origin: Origin::Simulated,
    claims: &[QUALITY, LEVEL, LEVEL_VERY_POOR, SENSORS_FIRST],
    make: Make::Draw(draw),
};

const QUALITY: Claim = Claim::does_not_hold(
    "at every level every error grows from good to poor and from poor to very poor sensors",
    "level 1 trusts good sensors too far for its linear model (NIS of 1.9), and its tilt is worse with them than with poor ones",
);
const LEVEL: Claim = Claim::holds(
    "with good and with poor sensors no lower level has errors of position, velocity or tilt smaller than level 5, the truth's own, by more \
     than a per cent",
);
const LEVEL_VERY_POOR: Claim = Claim::does_not_hold(
    "with very poor sensors too no lower level has errors smaller than level 5 by more than a per cent",
    "there the levels differ by less than four flights can resolve: level 3 happens to have a smaller tilt error",
);
const SENSORS_FIRST: Claim = Claim::does_not_hold(
    "the sensors matter more than the level: from good to very poor every error grows by a larger factor than from level 5 to the worst level",
    "so it is for position and velocity; the tilt of level 1 with good sensors is several times that of level 5, and grows little with worse ones",
);

/// The panels: name of the column, label, factor into its unit.
const SHOWN: [(&str, &str, f64); 3] = [
    ("position_m", "Position error, cm", 1e2),
    ("velocity_m_s", "Velocity error, m s^{−1}", 1.0),
    ("tilt_deg", "Tilt error, deg", 57.295_779_513_082_32),
];

/// The flights have the same truth and sensors for all filters; below a per cent two filters are the same.
const SAME: f64 = 0.01;

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let study = Study::of(context)?;
    let error = |quality, level, i: usize| Ok::<f64, ItemError>(study.extended(quality, level)?.errors[i]);
    let mut data = DataTable::new(["quality", "level", "position_m", "velocity_m_s", "tilt_deg"]);
    let mut figure = Figure::columns(3).panel_size(200.0, 220.0);
    for (i, (_, label, scale)) in SHOWN.iter().enumerate() {
        let mut panel = Panel::new("Level of the filter", *label)
            .log_y()
            .x_range(0.7, 5.3)
            .x_step(1.0);
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
    let mut grows = true;
    let (mut by_level, mut by_sensors) = ([0.0_f64; 3], [f64::INFINITY; 3]);
    // How much better a lower level is than level 5, at most; very poor sensors apart.
    let (mut gain, mut gain_very_poor) = (0.0_f64, 0.0_f64);
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
                let of_quality = match quality {
                    Quality::VeryPoor => &mut gain_very_poor,
                    Quality::Good | Quality::Poor => &mut gain,
                };
                *of_quality = of_quality.max(1.0 - ratio);
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
            gain < SAME,
            format!("a lower level is better by {:.1} % at most", 100.0 * gain),
        )
        .check(
            LEVEL_VERY_POOR,
            gain_very_poor < SAME,
            format!(
                "a lower level is better by {:.1} % at most",
                100.0 * gain_very_poor
            ),
        )
        .check(
            SENSORS_FIRST,
            (0..3).all(|i| by_sensors[i] > by_level[i]),
            format!("worst level over level 5: factors of {by_level:.2?}; sensors: {by_sensors:.1?}"),
        ))
}
