//! The models of figure 5.2 and which of them is next above which.

use quad_dynamics::Phenomenon::{
    Blockage, Drag, GroundEffect, GyroscopicTorque, InputLimits, ProcessNoise, Turbulence, WindShear,
};
use quad_dynamics::{Feature, Level, Phenomenon, Resolution};

/// A model and its place: column from the left, row from below.
pub(super) struct Node {
    pub(super) resolution: Resolution,
    pub(super) column: f64,
    pub(super) row: f64,
    pub(super) words: String,
}

/// The levels, and models that phenomena make of them.
pub(super) fn nodes() -> Vec<Node> {
    let levels = Level::ALL.map(|level| {
        let resolution = Resolution::of(level, &level.phenomena());
        let kind = if resolution.is_linear() {
            "linear"
        } else {
            "non-linear"
        };
        let below = level.number().checked_sub(2).map(|i| Level::ALL[usize::from(i)]);
        let added = below
            .map(|b| resolution.beyond(&Resolution::of(b, &b.phenomena())))
            .unwrap_or_default();
        let added: Vec<String> = added.iter().map(written).collect();
        let head = format!("Level {}: {kind}, {} states", level.number(), resolution.states);
        Node {
            words: if added.is_empty() {
                head
            } else {
                format!("{head}\n+ {}", added.join(", "))
            },
            row: f64::from(level.number()) - 1.0,
            column: 0.0,
            resolution,
        }
    });
    let variants: [(Level, &[Phenomenon], f64, f64); 5] = [
        (Level::Two, &[Drag, GyroscopicTorque], 1.0, 2.0),
        (Level::Three, &[InputLimits], 1.0, 3.0),
        (Level::Four, &[GroundEffect], 1.0, 4.0),
        (Level::Five, &[Turbulence, WindShear, ProcessNoise], 0.0, 5.0),
        (Level::Five, &[GroundEffect, Blockage], 1.0, 5.0),
    ];
    let variants = variants.map(|(level, more, column, row)| {
        let on = more.iter().fold(level.phenomena(), |on, p| on.with(*p));
        let names: Vec<String> = more.iter().map(|p| written(&Feature::Phenomenon(*p))).collect();
        Node {
            resolution: Resolution::of(level, &on),
            column,
            row,
            words: format!("Level {}\n+ {}", level.number(), names.join(", ")),
        }
    });
    levels.into_iter().chain(variants).collect()
}

/// Pairs (lower, upper) with nothing between them: the covering relation.
pub(super) fn covers(nodes: &[Node]) -> Vec<(usize, usize)> {
    let below = |i: usize, j: usize| nodes[i].resolution < nodes[j].resolution;
    let pairs = (0..nodes.len()).flat_map(|i| (0..nodes.len()).map(move |j| (i, j)));
    pairs
        .filter(|&(i, j)| below(i, j) && !(0..nodes.len()).any(|k| below(i, k) && below(k, j)))
        .collect()
}

/// A feature in rich text: what switches on and off in italics.
fn written(feature: &Feature) -> String {
    match feature {
        Feature::Phenomenon(_) => format!("*{}*", feature.to_string().replace('-', " ")),
        _ => feature.to_string(),
    }
}
