//! A scenario with its quadrotors at another model, from start to end.

use crate::exit::Failure;
use quad_dynamics::{Level, Phenomenon, PhenomenonSet};
use quad_ndi::Law;
use scenario::Scenario;

/// The controllers that fly the quadrotors at a level: those that belong to it, or the scenario's where they may fly.
pub(crate) fn laws(scenario: &Scenario, level: Level, keep: bool) -> Vec<Law> {
    let one = |quadrotor: &scenario::QuadrotorFile| {
        let given = quadrotor.controller.kind.at(quadrotor.level);
        let kept = keep && given.lowest_level() <= level;
        if kept { given } else { Law::paired(level) }
    };
    scenario.quadrotor.iter().map(one).collect()
}

/// The scenario with every quadrotor at a level, with these phenomena or the level's own, flown by these controllers.
pub(crate) fn at(
    scenario: &Scenario,
    level: Level,
    phenomena: Option<&PhenomenonSet>,
    laws: &[Law],
) -> Scenario {
    let mut scenario = scenario.clone();
    let has_drag = phenomena.unwrap_or(&level.phenomena()).contains(Phenomenon::Drag);
    for (quadrotor, law) in scenario.quadrotor.iter_mut().zip(laws) {
        quadrotor.level = level;
        quadrotor.phenomena = phenomena.cloned();
        quadrotor.level_changes.clear();
        quadrotor.level_rule = None;
        if !has_drag {
            // What moves in the air is not felt without drag.
            quadrotor.wind.shear = None;
            quadrotor.wind.turbulence = None;
        }
        quadrotor.controller.kind = (*law).into();
    }
    scenario
}

/// Rejects a scenario without quadrotors, and reports what is ignored where all levels are compared.
pub(crate) fn check(scenario: &Scenario) -> Result<(), Failure> {
    if scenario.quadrotor.is_empty() {
        return Err(Failure::Usage(
            "the scenario has no quadrotor: only quadrotors have levels".to_owned(),
        ));
    }
    for quadrotor in &scenario.quadrotor {
        let left_out = [
            ("phenomena", quadrotor.phenomena.is_some()),
            ("level_changes", !quadrotor.level_changes.is_empty()),
            ("level_rule", quadrotor.level_rule.is_some()),
            (
                "wind.shear where the level has no drag",
                quadrotor.wind.shear.is_some(),
            ),
            (
                "wind.turbulence where the level has no drag",
                quadrotor.wind.turbulence.is_some(),
            ),
        ];
        let named: Vec<_> = left_out
            .iter()
            .filter(|(_, is_there)| *is_there)
            .map(|(key, _)| *key)
            .collect();
        if !named.is_empty() {
            crate::report::complain(format!(
                "note: each level flies with its own phenomena throughout; for \"{}\" these are ignored: {}",
                quadrotor.name,
                named.join(", ")
            ));
        }
    }
    Ok(())
}
