//! Figure 5.2: the models of the family and their partial order, from their own declarations.

use super::models::{Node, covers, nodes};
use crate::claim::Claim;
use crate::data::DataTable;
use crate::drawing::Drawing;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::plot::diagram::{
    ARROW, BLUE_TINT, Block, CONSTRUCTION, Diagram, GREEN_TINT, ORANGE_TINT, PLAIN, QUIET,
};
use crate::plot::svg::{Point, at};

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "5.2",
    title: "Models available to describe the system",
    description: "The five levels (left) and some of the models between and above them that phenomena make (right, grey), drawn from the \
                  declarations in the code. An arrow leads from a model to one that contains all it contains, and more, with none of \
                  these in between; where no way leads along the arrows, neither model is higher. Parts in italics switch on and off. \
                  Solid arrows: the chain of the levels; dashed: all others. White: linear; blue: rigid body and lag; green: identified rotors; orange: mechanistic rotors.",
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
/// Widths of the blocks of the two columns and their height, px.
const WIDTHS: (f64, f64) = (410.0, 290.0);
/// Height of a block, px.
const HEIGHT: f64 = 54.0;

fn draw(_: &Context) -> Result<Drawing, ItemError> {
    let nodes = nodes();
    let mut diagram = Diagram::new(850.0, ROWS * PITCH + 6.0);
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
    let (x, width) = if node.column == 0.0 {
        (215.0, WIDTHS.0)
    } else {
        (695.0, WIDTHS.1)
    };
    Block {
        centre: at(x, PITCH * (ROWS - 0.5 - node.row)),
        size: (width, HEIGHT),
        fill,
    }
}

/// Where an arrow ends: beside the middle of the block if it comes from the other column.
fn landing(from: Point, to: Point) -> Point {
    at(to.x + 0.12 * (from.x - to.x), to.y)
}
