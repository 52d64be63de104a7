//! Figure 5.2: the models of the family and their partial order, from their own declarations.

use crate::claim::Claim;
use crate::data::DataTable;
use crate::drawing::Drawing;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::plot::diagram::{
    ARROW, BLUE_TINT, Block, CONSTRUCTION, Diagram, GREEN_TINT, ORANGE_TINT, PLAIN, QUIET,
};
use crate::plot::svg::{Point, at};
use quad_dynamics::Phenomenon::{
    Blockage, Drag, GroundEffect, GyroscopicTorque, InputLimits, ProcessNoise, Turbulence, WindShear,
};
use quad_dynamics::{Feature, Level, Phenomenon, Resolution};

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "5.2",
    title: "Models available to describe the system",
    description: "The five levels (left) and some of the models between and above them that phenomena make (right, grey), drawn from the \
                  declarations in the code. An arrow leads from a model to one that contains all it contains, and more, with none of \
                  these in between; where no way leads along the arrows, neither model is higher. Parts in italics switch on and off.",
    kind: Kind::Diagram,
    origin: Origin::Derived,
    claims: &[ORDERED, PARTIAL],
    make: Make::Draw(draw),
};

const ORDERED: Claim = Claim::holds("each level contains what the level below it contains, and more");
const PARTIAL: Claim =
    Claim::holds("the order is a partial one: there are models of which neither is higher");

/// Height of one row on the page, px.
const PITCH: f64 = 92.0;
/// Rows, from level 1 up.
const ROWS: f64 = 6.0;
/// Size of a block, px.
const SIZE: (f64, f64) = (330.0, 54.0);

/// A model and its place: column from the left, row from below.
struct Node {
    resolution: Resolution,
    column: f64,
    row: f64,
    words: String,
}

/// The levels, and models that phenomena make of them.
fn nodes() -> Vec<Node> {
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
fn covers(nodes: &[Node]) -> Vec<(usize, usize)> {
    let below = |i: usize, j: usize| nodes[i].resolution < nodes[j].resolution;
    let pairs = (0..nodes.len()).flat_map(|i| (0..nodes.len()).map(move |j| (i, j)));
    pairs
        .filter(|&(i, j)| below(i, j) && !(0..nodes.len()).any(|k| below(i, k) && below(k, j)))
        .collect()
}

fn draw(_: &Context) -> Result<Drawing, ItemError> {
    let nodes = nodes();
    let mut diagram = Diagram::new(820.0, ROWS * PITCH + 6.0);
    let mut data = DataTable::new(["level", "states", "inputs", "linear", "features", "covers_rows"]);
    let edges = covers(&nodes);
    let blocks: Vec<Block> = nodes
        .iter()
        .map(|node| diagram.block(block(node), &node.words))
        .collect();
    for &(i, j) in &edges {
        let (from, to) = (blocks[i].top(), blocks[j].bottom());
        let is_chain = nodes[i].column == 0.0 && nodes[j].column == 0.0;
        diagram.arrow(
            &[from, landing(from, to)],
            if is_chain { ARROW } else { CONSTRUCTION },
        );
    }
    for (j, node) in nodes.iter().enumerate() {
        let r = &node.resolution;
        let features: Vec<String> = r.features.iter().map(ToString::to_string).collect();
        let covered: Vec<String> = edges
            .iter()
            .filter(|(_, upper)| *upper == j)
            .map(|(lower, _)| lower.to_string())
            .collect();
        data.push([
            f64::from(r.level.number()).into(),
            (r.states as f64).into(),
            (r.inputs as f64).into(),
            r.is_linear().to_string().as_str().into(),
            features.join("; ").as_str().into(),
            covered.join(" ").as_str().into(),
        ]);
    }
    let rising = nodes[..5]
        .windows(2)
        .filter(|pair| pair[0].resolution < pair[1].resolution)
        .count();
    let pairs = (0..nodes.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
    let apart = pairs
        .filter(|&(i, j)| nodes[i].resolution.partial_cmp(&nodes[j].resolution).is_none())
        .count();
    Ok(Drawing::picture(diagram.finish())
        .data(data)
        .check(
            ORDERED,
            rising == 4,
            format!("{rising} of 4 neighbours are in order of inclusion"),
        )
        .check(PARTIAL, apart > 0, format!("{apart} of 45 pairs are in no order")))
}

fn block(node: &Node) -> Block {
    let fill = match (
        node.words.starts_with("Level 4:"),
        node.words.starts_with("Level 5:"),
    ) {
        (true, _) => GREEN_TINT,
        (_, true) => ORANGE_TINT,
        _ if !node.words.contains(':') => QUIET,
        _ if node.resolution.is_linear() => PLAIN,
        _ => BLUE_TINT,
    };
    Block {
        centre: at(190.0 + 440.0 * node.column, PITCH * (ROWS - 0.5 - node.row)),
        size: SIZE,
        fill,
    }
}

/// Where an arrow ends: beside the middle of the block if it comes from the other column.
fn landing(from: Point, to: Point) -> Point {
    at(to.x + 0.12 * (from.x - to.x), to.y)
}

/// A feature in rich text: what switches on and off in italics.
fn written(feature: &Feature) -> String {
    match feature {
        Feature::Phenomenon(_) => format!("*{}*", feature.to_string().replace('-', " ")),
        _ => feature.to_string(),
    }
}
