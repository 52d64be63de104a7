//! Figure beyond.4: what levels 1 to 4 save at level 5.

use super::guided::{DURATION_S, Pair, Race, step};
use super::optimisations::Effort;
use super::solutions::SEARCHED;
use crate::claim::Claim;
use crate::data::DataTable;
use crate::drawing::Drawing;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::plot::figure::Legends;
use crate::plot::style::Marker;
use crate::plot::{Figure, Panel, series_style};
use serde::Serialize;
use wpt_optim::Choice;

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "beyond.4",
    title: "Level 5 optimised with the help of levels 1 to 4",
    description: "Not in the source. Flights at level 5 that each search of a crossing in 10 s takes from the same start, anywhere in the box: guided by the lower levels (evolution and simplices \
                  at level 1, then corrected in trust regions level by level), and Nelder and Mead's simplex at level 5 alone. Crosses: flights until the best so far \
                  is within 1 % of the best that any search found; none where a search never gets there. Steps of 2 ms; the guided search by its defaults, the simplex to 10^{−4} of the box and 10^{−6} of the cost. (a) Two variables. (b) Four.",
    kind: Kind::Plot,
    origin: Origin::Simulated,
    claims: &[TWO_REACHES, TWO_SAVES, FOUR_REACHES, FOUR_SAVES],
    make: Make::Draw(draw),
};

const TWO_REACHES: Claim =
    Claim::holds("two variables: every guided search ends within 1 % of level 5's optimum");
const TWO_SAVES: Claim =
    Claim::holds("two variables: none takes more than a quarter of the plain search's flights at level 5");
const FOUR_REACHES: Claim =
    Claim::holds("four variables: every guided search ends within 1 % of level 5's optimum");
const FOUR_SAVES: Claim =
    Claim::holds("four variables: none takes more than a quarter of the plain search's flights at level 5");

/// Starts of each case.
const STARTS: u64 = 20;
const STARTS_QUICK: u64 = 2;
/// The share of the flights that is allowed.
const QUARTER: f64 = 0.25;

/// As they are written beside the figure.
#[derive(Serialize)]
struct Settings {
    duration_s: f64,
    starts: u64,
    step_s: f64,
}

fn panel(name: &str, race: &Race) -> Panel {
    let numbered = |flights: &dyn Fn(&Pair) -> Option<u64>| -> Vec<(f64, f64)> {
        let pairs = race.pairs.iter().enumerate();
        pairs
            .filter_map(|(k, pair)| Some((k as f64 + 1.0, flights(pair)? as f64)))
            .collect()
    };
    let (guided, plain) = (series_style(0), series_style(1));
    Panel::new("Start", "Flights at level 5")
        .caption(name)
        .log_y()
        .y_range(0.7, 1000.0)
        .x_range(0.0, race.pairs.len() as f64 + 1.0)
        .markers(
            "simplex alone",
            plain.marked(Marker::Square),
            numbered(&|p| Some(p.plain.evaluations)),
        )
        .markers(
            "until within 1 %",
            plain.marked(Marker::Cross),
            numbered(&|p| p.plain_until(race.best)),
        )
        .markers(
            "guided by levels 1 to 4",
            guided.marked(Marker::Circle),
            numbered(&|p| Some(p.guided_flights())),
        )
        .markers(
            "guided, until within 1 %",
            guided.marked(Marker::Cross),
            numbered(&|p| p.guided_until(race.best)),
        )
}

fn sum(race: &Race, of: impl Fn(&Pair) -> u64) -> u64 {
    race.pairs.iter().map(of).sum()
}

fn note(name: &str, race: &Race) -> String {
    let seconds = |of: &dyn Fn(&Pair) -> f64| race.pairs.iter().map(of).sum::<f64>();
    format!(
        "{name}: least cost {:.4}; {} guided and {} plain searches of {} end within 1 % of it. Flights at level 5: {} guided, {} plain. The guided searches flew \
         {} times at level 1 beside that and took {:.1} times the plain ones' time: they save flights of the expensive model, which pays where that costs much more \
         than here, where a flight of level 5 costs as much as two of level 1.",
        race.best,
        race.guided_as_good(),
        race.plain_as_good(),
        race.pairs.len(),
        sum(race, Pair::guided_flights),
        sum(race, |p| p.plain.evaluations),
        sum(race, |p| p.guided.calls[0]),
        seconds(&|p| p.guided.elapsed.as_secs_f64()) / seconds(&|p| p.plain.elapsed.as_secs_f64()),
    )
}

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let effort = Effort::of(context.quick);
    let starts = if context.quick { STARTS_QUICK } else { STARTS };
    let two = Race::run(Choice::Two, effort, starts)?;
    let four = Race::run(Choice::Four, effort, starts)?;
    let settings = Settings {
        duration_s: DURATION_S,
        starts,
        step_s: step(effort).seconds(),
    };
    let mut data = DataTable::new([
        "variables",
        "start",
        "guided_cost",
        "guided_flights",
        "plain_cost",
        "plain_flights",
    ])
    .with_tolerance(SEARCHED);
    let figure = Figure::columns(2)
        .legends(Legends::Common)
        .panel(panel("two variables", &two))
        .panel(panel("four variables", &four));
    for (variables, race) in [(2_u8, &two), (4, &four)] {
        for (k, pair) in race.pairs.iter().enumerate() {
            data.push([
                variables.into(),
                (k + 1).into(),
                pair.guided_cost().into(),
                (pair.guided_flights() as f64).into(),
                pair.plain.best.cost.into(),
                (pair.plain.evaluations as f64).into(),
            ]);
        }
    }
    let reaches = |race: &Race| race.guided_as_good() == race.pairs.len();
    let reached = |race: &Race| format!("{} of {}", race.guided_as_good(), race.pairs.len());
    let saved = |race: &Race| {
        let most = race
            .pairs
            .iter()
            .map(Pair::guided_flights)
            .max()
            .unwrap_or_default();
        format!(
            "at most {most} flights, {:.3} of the plain search's",
            race.largest_share()
        )
    };
    Ok(Drawing::picture(figure.draw())
        .data(data)
        .settings(&settings)?
        .check(TWO_REACHES, reaches(&two), reached(&two))
        .check(TWO_SAVES, two.largest_share() <= QUARTER, saved(&two))
        .check(FOUR_REACHES, reaches(&four), reached(&four))
        .check(FOUR_SAVES, four.largest_share() <= QUARTER, saved(&four))
        .note(note("Two variables", &two))
        .note(note("Four variables", &four)))
}
