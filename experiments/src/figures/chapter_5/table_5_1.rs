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
    let header = [
        "Phenomenon",
        "Adds to the resolution",
        "Needs",
        "1",
        "2",
        "3",
        "4",
        "5",
        "Source",
    ];
    let mut shown = DisplayTable::new(header);
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
        let fits = Level::ALL.map(|level| {
            // What needs drag is asked for together with drag.
            let asked = PhenomenonSet::none().with(Phenomenon::Drag).with(phenomenon);
            asked.admitted_by(level.capabilities()).contains(phenomenon)
        });
        for (level, declared) in Level::ALL.into_iter().zip(fits) {
            let mut on = PhenomenonSet::none().with(phenomenon);
            if declared && level != Level::One {
                on = on.with(Phenomenon::Drag);
            }
            let built = AnyQuadrotor::<f64>::hovering(level, &vehicle, &on, Vector3::zeros(), 0.0).is_ok();
            tried += 1;
            agreed += u32::from(built == declared);
        }
        let by_itself = Level::ALL.map(|level| level.phenomena().contains(phenomenon));
        let mark = |i: usize| match (by_itself[i], fits[i]) {
            (true, _) => "●",
            (false, true) => "○",
            (false, false) => "",
        };
        let prerequisite = phenomenon.prerequisite().to_string();
        shown.push([
            phenomenon.name(),
            phenomenon.contribution(),
            &prerequisite,
            mark(0),
            mark(1),
            mark(2),
            mark(3),
            mark(4),
            phenomenon.source(),
        ]);
        data.push([
            phenomenon.name().into(),
            phenomenon.contribution().into(),
            prerequisite.as_str().into(),
            numbers(&fits).as_str().into(),
            numbers(&by_itself).as_str().into(),
            phenomenon.source().into(),
        ]);
    }
    wind(&mut shown, &mut data);
    Ok(Drawing::table(shown).data(data).check(
        BUILT,
        agreed == tried,
        format!("{agreed} of {tried} pairs of phenomenon and level build or are refused as declared"),
    ))
}

/// The levels of a list as text, `2 3 4`.
fn numbers(of: &[bool; 5]) -> String {
    let chosen = Level::ALL.iter().zip(of).filter(|(_, is)| **is);
    let numbers: Vec<String> = chosen.map(|(level, _)| level.number().to_string()).collect();
    numbers.join(" ")
}

/// The mean wind and its steps: no part of a model, but an input that models with drag feel.
fn wind(shown: &mut DisplayTable, data: &mut DataTable) {
    const NAME: &str = "wind and its steps (input)";
    const ADDS: &str = "mean velocity of the air, constant or stepping";
    let needs = Prerequisite::AirRelativeDrag.to_string();
    let drag = PhenomenonSet::none().with(Phenomenon::Drag);
    let fits = Level::ALL.map(|level| drag.admitted_by(level.capabilities()) == drag);
    let by_itself = Level::ALL.map(|level| level.phenomena().contains(Phenomenon::Drag));
    let mark = |i: usize| match (by_itself[i], fits[i]) {
        (true, _) => "●",
        (false, true) => "○",
        (false, false) => "",
    };
    shown.push([
        NAME,
        ADDS,
        &needs,
        mark(0),
        mark(1),
        mark(2),
        mark(3),
        mark(4),
        "thesis 3.7",
    ]);
    data.push([
        NAME.into(),
        ADDS.into(),
        needs.as_str().into(),
        numbers(&fits).as_str().into(),
        numbers(&by_itself).as_str().into(),
        "thesis 3.7".into(),
    ]);
}
