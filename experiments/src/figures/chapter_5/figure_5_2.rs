//! Figure 5.2: the models of the family, from their own declarations.

use crate::claim::Claim;
use crate::data::DataTable;
use crate::drawing::Drawing;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::plot::diagram::{ARROW, BLUE_TINT, Block, Diagram, GREEN_TINT, ORANGE_TINT, PLAIN};
use crate::plot::style::INK;
use crate::plot::svg::{Anchor, TextLook, at};
use quad_dynamics::{Feature, Level, Resolution};

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "5.2",
    title: "Models available to describe the system",
    description: "The five levels in order of resolution, drawn from the declarations in the code: the number of states of \
                  each and, beside each arrow, what enters on the way up. Parts in italics switch on and off.",
    kind: Kind::Diagram,
    origin: Origin::Derived,
    claims: &[ORDERED],
    make: Make::Draw(draw),
};

const ORDERED: Claim = Claim::holds("each level contains what the level below it contains, and more");

/// Height of one level on the page, px.
const PITCH: f64 = 84.0;

/// Words that begin where they are put.
const LEFT: TextLook = TextLook {
    size: 12.0,
    anchor: Anchor::Start,
    colour: INK,
    rotation: 0.0,
    bold: false,
};

fn draw(_: &Context) -> Result<Drawing, ItemError> {
    let family = Level::ALL.map(|level| Resolution::of(level, &level.phenomena()));
    let mut diagram = Diagram::new(560.0, 5.0 * PITCH + 6.0);
    let mut data = DataTable::new(["level", "states", "inputs", "linear", "features"]);
    let blocks = family.each_ref().map(|r| {
        let n = r.level.number();
        let fill = match (r.is_linear(), r.is_empirical()) {
            (true, _) => PLAIN,
            (false, false) => BLUE_TINT,
            (false, true) => {
                if n == 4 {
                    GREEN_TINT
                } else {
                    ORANGE_TINT
                }
            }
        };
        let words = format!(
            "Level {n}\n{}, {} states",
            if r.is_linear() { "linear" } else { "non-linear" },
            r.states
        );
        let block = Block {
            centre: at(130.0, PITCH * (5.5 - f64::from(n))),
            size: (180.0, 48.0),
            fill,
        };
        diagram.block(block, &words)
    });
    for (i, pair) in family.windows(2).enumerate() {
        diagram.arrow(&[blocks[i].top(), blocks[i + 1].bottom()], ARROW);
        let added = pair[1].beyond(&pair[0]).iter().map(written).collect::<Vec<_>>();
        let middle = 0.5 * (blocks[i].top().y + blocks[i + 1].bottom().y);
        diagram.styled_text(at(146.0, middle + 4.0), &format!("+ {}", added.join(", ")), LEFT);
    }
    for r in &family {
        let features: Vec<String> = r.features.iter().map(ToString::to_string).collect();
        data.push([
            f64::from(r.level.number()).into(),
            (r.states as f64).into(),
            (r.inputs as f64).into(),
            r.is_linear().to_string().as_str().into(),
            features.join("; ").as_str().into(),
        ]);
    }
    let rising = family.windows(2).filter(|pair| pair[0] < pair[1]).count();
    Ok(Drawing::picture(diagram.finish()).data(data).check(
        ORDERED,
        rising == 4,
        format!("{rising} of 4 neighbours are in order of inclusion"),
    ))
}

/// A feature in rich text: what switches on and off in italics.
fn written(feature: &Feature) -> String {
    match feature {
        Feature::Phenomenon(_) => format!("*{feature}*"),
        _ => feature.to_string(),
    }
}
