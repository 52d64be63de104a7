//! Quadrotors.

use super::start::Starts;
use super::{AgentInfo, AgentKind, Built, Task, controller, estimator, own_seed};
use crate::error::ScenarioError;
use crate::file::{LevelChange, QuadrotorFile, Scenario, TurbulenceFile};
use crate::library::Library;
use quad_dynamics::{CommandLimits, Level, Phenomenon, PhenomenonSet};
use sifre::quadrotor::{Gusts, LevelChoice, ProcessNoiseSource, Script, Setup, Start, Turbulence, Wind};
use sifre::{Facing, Member, ModelQuadrotor, Schedule, ScheduleError};
use std::sync::Arc;

/// Adds a quadrotor to what is built.
pub(super) fn add<'a>(
    built: &mut Built,
    scenario: &Scenario,
    file: &'a QuadrotorFile,
    (library, starts): (&Library<'_>, &Starts<'a>),
) -> Result<(), ScenarioError> {
    let flown = library.vehicle(&file.name, &file.vehicle, &file.parameters)?;
    let believed = match &file.controller.vehicle {
        Some(name) => library.vehicle(&file.name, name, &toml::Table::new())?,
        None => Arc::clone(&flown),
    };
    let law = file.controller.kind.at(file.level);
    let limits = any_phenomenon(file, Phenomenon::InputLimits).then(|| CommandLimits::of(&believed));
    let pilot = controller::assemble(&file.name, &file.controller, law, &believed, limits)?;
    let task = Task::of(file, flown.environment.gravity, law.tilt_law())?;
    let begin = starts.start(file)?;

    built.goals.extend(task.goal(&file.name));
    note_wind(built, file);
    let level = choice(file.level, file.phenomena.as_ref());
    let setup = match &file.facing {
        Some(faced) => {
            let facing = Facing::agent(task, faced.clone());
            Setup::new(file.name.clone(), &flown, level, pilot, facing)
        }
        None => Setup::new(file.name.clone(), &flown, level, pilot, task),
    };
    let setup = Setup {
        start: Start {
            position_m: begin.position.into(),
            yaw_rad: begin.yaw,
        },
        velocity_m_s: begin.velocity.into(),
        script: script(file, own_seed(scenario.seed, &file.name))?,
        estimation: estimator::assemble(built, file, believed, own_seed(scenario.seed, &file.name))?,
        substeps: file.substeps,
        ..setup
    };
    built
        .members
        .push(Member::new(ModelQuadrotor::new(setup)?, file.step_s));
    built.agents.push(AgentInfo {
        name: file.name.clone(),
        kind: AgentKind::Quadrotor {
            vehicle: flown,
            level: file.level,
            law,
        },
    });
    Ok(())
}

/// A level with what is switched on at it.
pub(super) fn choice(level: Level, phenomena: Option<&PhenomenonSet>) -> LevelChoice {
    LevelChoice {
        level,
        phenomena: phenomena.cloned(),
    }
}

/// The levels that it flies at, in order.
fn levels(file: &QuadrotorFile) -> impl Iterator<Item = LevelChoice> {
    let changes = file.level_changes.iter();
    let changes = changes.map(|change| choice(change.level, change.phenomena.as_ref()));
    let by_rule = file
        .level_rule
        .iter()
        .flat_map(|rule| [rule.fine.clone(), rule.coarse.clone()]);
    std::iter::once(choice(file.level, file.phenomena.as_ref()))
        .chain(changes)
        .chain(by_rule)
}

fn any_phenomenon(file: &QuadrotorFile, phenomenon: Phenomenon) -> bool {
    levels(file).any(|level| level.phenomena().contains(phenomenon))
}

/// What happens to it.
fn script(file: &QuadrotorFile, seed: u64) -> Result<Script, ScenarioError> {
    let refuse = |key| {
        let agent = file.name.clone();
        move |source: ScheduleError| ScenarioError::Schedule { agent, key, source }
    };
    let steps = file
        .wind
        .steps
        .iter()
        .map(|step| (step.from_s, step.velocity_m_s));
    let before = file.wind.velocity_m_s;
    // Air that is still before the first step needs no entry of its own.
    let first = (before != [0.0; 3]).then_some((0.0, before));
    let changes = file.level_changes.iter();
    let change = |change: &LevelChange| (change.from_s, choice(change.level, change.phenomena.as_ref()));
    let (offsets, turbulence) = (file.command_offsets.iter(), file.wind.turbulence);
    Ok(Script {
        wind_m_s: Schedule::new(first.into_iter().chain(steps)).map_err(refuse("wind.steps"))?,
        level: Schedule::new(changes.map(change)).map_err(refuse("level_changes"))?,
        command_offset: Schedule::new(offsets.map(|offset| (offset.from_s, offset.duty)))
            .map_err(refuse("command_offsets"))?,
        wind: Wind {
            shear: file.wind.shear,
            turbulence: turbulence.map(|file| gusts(file, seed)),
            ..Wind::default()
        },
        process_noise: file.process_noise.map(|noise| ProcessNoiseSource {
            acceleration_m_s2_sqrt_hz: noise.acceleration_m_s2_sqrt_hz,
            angular_acceleration_rad_s2_sqrt_hz: noise.angular_acceleration_rad_s2_sqrt_hz,
            seed,
        }),
        rule: file.level_rule.clone(),
    })
}

/// Its turbulence.
fn gusts(file: TurbulenceFile, seed: u64) -> Turbulence {
    Turbulence {
        w20_m_s: file.w20_m_s,
        seed,
        gusts: match file.rotational {
            true => Gusts::All,
            false => Gusts::Linear,
        },
    }
}

/// Notes if the wind has no effect.
fn note_wind(built: &mut Built, file: &QuadrotorFile) {
    let still = |wind: &[f64; 3]| *wind == [0.0; 3];
    let is_calm = still(&file.wind.velocity_m_s) && file.wind.steps.iter().all(|s| still(&s.velocity_m_s));
    if !is_calm && !any_phenomenon(file, Phenomenon::Drag) {
        built.notes.push(format!(
            "\"{}\" flies in wind at level {} without drag and is not affected by it: set phenomena = [\"drag\"] (levels 2 and \
             3) or fly at level 4 or 5",
            file.name,
            file.level.number()
        ));
    }
}
