//! Table 5.1: the phenomena, what each adds and what each needs, from their declarations.

use crate::claim::Claim;
use crate::data::DataTable;
use crate::drawing::{DisplayTable, Drawing};
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::vehicle::{NOMINAL_VEHICLE, load_vehicle};
use nalgebra::Vector3;
use quad_dynamics::{AnyQuadrotor, Level, Phenomenon, PhenomenonSet, Prerequisite};

/// The table.
pub(super) const ITEM: Item = Item {
    id: "table-5.1",
    title: "Phenomena: contribution to resolution and prerequisites",
    description: "Each part of a model that switches on and off: what it adds, what it needs, which levels include it (●) or accept \
                  it (○), and the source of its equation. Printed from the declarations in the code. The mean wind and its \
                  steps are inputs of every model and act through drag.",
    kind: Kind::Table,
    origin: Origin::Derived,
    claims: &[BUILT],
    make: Make::Draw(draw),
};

const BUILT: Claim = Claim::holds(
    "each phenomenon can be built at the levels that meet its declared prerequisite and at no other",
);

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let vehicle = load_vehicle(context, NOMINAL_VEHICLE)?;
    let numbers = Level::ALL.map(|level| level.number().to_string());
    let before = ["Phenomenon", "Adds to the resolution", "Needs"];
    let header = before.into_iter().chain(numbers.iter().map(String::as_str));
    let mut shown = DisplayTable::new(header.chain(["Source"]));
    let mut data = DataTable::new([
        "phenomenon",
        "contribution",
        "prerequisite",
        "levels",
        "by_itself",
        "source",
    ]);
    let (mut tried, mut agreed) = (0, 0);
    for phenomenon in Phenomenon::ALL {
        let row = Row {
            name: phenomenon.name(),
            adds: phenomenon.contribution(),
            needs: phenomenon.prerequisite(),
            source: phenomenon.source(),
            fits: Level::ALL.map(|level| {
                // What needs drag is asked for together with drag.
                let asked = PhenomenonSet::none().with(Phenomenon::Drag).with(phenomenon);
                asked.admitted_by(level.capabilities()).contains(phenomenon)
            }),
            own: Level::ALL.map(|level| level.phenomena().contains(phenomenon)),
        };
        for (level, declared) in Level::ALL.into_iter().zip(row.fits) {
            let mut on = PhenomenonSet::none().with(phenomenon);
            if declared && level != Level::LOWEST {
                on = on.with(Phenomenon::Drag);
            }
            let built = AnyQuadrotor::<f64>::hovering(level, &vehicle, &on, Vector3::zeros(), 0.0).is_ok();
            tried += 1;
            agreed += u32::from(built == declared);
        }
        row.write(&mut shown, &mut data);
    }
    wind().write(&mut shown, &mut data);
    Ok(Drawing::table(shown).data(data).check(
        BUILT,
        agreed == tried,
        format!("{agreed} of {tried} pairs of phenomenon and level build or are refused as declared"),
    ))
}

/// The mean wind and its steps: no part of a model, but an input that models with drag feel.
fn wind() -> Row {
    let drag = PhenomenonSet::none().with(Phenomenon::Drag);
    Row {
        name: "wind and its steps (input)",
        adds: "mean velocity of the air, constant or stepping",
        needs: Prerequisite::AirRelativeDrag,
        source: "thesis 3.7",
        fits: Level::ALL.map(|level| drag.admitted_by(level.capabilities()) == drag),
        own: Level::ALL.map(|level| level.phenomena().contains(Phenomenon::Drag)),
    }
}

/// One answer for each level.
type PerLevel = [bool; Level::ALL.len()];

/// A phenomenon, and at which levels it is.
struct Row {
    name: &'static str,
    adds: &'static str,
    needs: Prerequisite,
    source: &'static str,
    /// Whether the level can have it.
    fits: PerLevel,
    /// Whether the level has it by itself.
    own: PerLevel,
}

impl Row {
    fn write(&self, shown: &mut DisplayTable, data: &mut DataTable) {
        let needs = self.needs.to_string();
        let marks = self.own.iter().zip(&self.fits).map(|pair| match pair {
            (true, _) => "●",
            (false, true) => "○",
            (false, false) => "",
        });
        let before = [self.name, self.adds, &needs];
        shown.push(before.into_iter().chain(marks).chain([self.source]));
        data.push([
            self.name.into(),
            self.adds.into(),
            needs.as_str().into(),
            numbers(&self.fits).as_str().into(),
            numbers(&self.own).as_str().into(),
            self.source.into(),
        ]);
    }
}

/// The levels of a list as text, `2 3 4`.
fn numbers(of: &PerLevel) -> String {
    let chosen = Level::ALL.iter().zip(of).filter(|(_, is)| **is);
    let numbers: Vec<String> = chosen.map(|(level, _)| level.number().to_string()).collect();
    numbers.join(" ")
}
