//! `sifre uncertainty`: what the standard errors of a vehicle's file make of a flight's numbers.
//!
//! The vehicle that flies is moved within its standard errors; its controller and its estimator believe in the nominal one
//! (or in the one that the scenario says), and the scenario's seed stays, so that nothing but the vehicle differs. Monte Carlo: draw n
//! takes its normal numbers from stream n of a ChaCha8 generator, quadrotor by quadrotor, so neither threads nor the number of draws
//! change a draw. First order: central differences, two flights per number ([`study::sensitivity`]).

mod output;
mod statistics;

use crate::disk::Beside;
use crate::exit::{Exit, Failure};
use crate::sweep::{MOST_RUNS, check_count, progress_bar, threads};
use crate::varied::{self, setting};
use crate::{interrupt, report};
use indicatif::ProgressBar;
use quad_dynamics::UncertainVehicle;
use quad_dynamics::vehicle::VehicleFile;
use quad_dynamics::vehicle::uncertain::UncertainNumber;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, StandardNormal};
use rayon::prelude::*;
use scenario::{End, Files, Flown, Keep, Scenario, Setting};
use std::collections::BTreeMap;
use std::path::PathBuf;
use study::sensitivity;

/// How it is used, as `--help` shows it.
const EXAMPLE: &str = "\
Example, with an identified vehicle:
  sifre uncertainty scenarios/horizontal-step.toml --set quadrotor.alpha.vehicle=identified.toml --runs 500

A file's standard errors have no correlations, so numbers are drawn independently of each other. With N draws the standard
deviation is known to 1/√(2N) of itself: 5 % with 200.";

/// Arguments of `sifre uncertainty`.
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLE)]
pub(crate) struct Arguments {
    /// Scenario file; at least one of its vehicle files must state standard errors.
    scenario: PathBuf,
    /// Number of vehicles drawn.
    #[arg(long, default_value_t = 200, value_parser = clap::value_parser!(u32).range(2..))]
    runs: u32,
    /// Seed of the draws.
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// Set a key of the scenario: `--set quadrotor.alpha.vehicle=identified.toml`. May be repeated. A parameter that
    /// is set has no standard error.
    #[arg(long = "set", value_name = "KEY=VALUE", value_parser = setting)]
    settings: Vec<Setting>,
    /// Number of threads [default: number of cores].
    #[arg(long)]
    jobs: Option<usize>,
    /// Largest number of runs; their metrics are held in memory, about a kilobyte each.
    #[arg(long, value_name = "N", default_value_t = MOST_RUNS)]
    most_runs: u64,
}

/// Carries standard errors to a flight's numbers.
pub(crate) fn run(arguments: &Arguments, json: bool) -> Result<Exit, Failure> {
    check_count(Some(arguments.runs.into()), arguments.most_runs)?;
    let scenario = varied::read(&arguments.scenario)?.with(&arguments.settings)?;
    let ensemble = Ensemble::of(scenario, Beside::of(&arguments.scenario), arguments.seed)?;
    let pool = threads(arguments.jobs)?;
    interrupt::listen();
    let nominal = interrupt::fly(&ensemble.scenario, &ensemble.files, &Keep::METRICS)?;
    match nominal.ending.end {
        End::Done => {}
        End::Interrupted => return Ok(Exit::Interrupted),
        _ => {
            return Err(Failure::Flight(format!(
                "the nominal flight must finish: {}",
                nominal.ending
            )));
        }
    }
    let jobs = ensemble.jobs(arguments.runs);
    let bar = progress_bar(jobs.len() as u64, 0, json);
    let flown: Vec<Option<Attempt>> =
        pool.install(|| jobs.par_iter().map(|job| ensemble.fly(*job, &bar)).collect());
    bar.finish_and_clear();
    let left = flown.iter().filter(|flown| flown.is_none()).count();
    let answer = statistics::Answer::of(&ensemble, &nominal, jobs.iter().copied().zip(flown));
    if json {
        report::print(&output::json(&ensemble, &answer))?;
    } else {
        report::say(output::text(&ensemble, &answer))?;
    }
    if left > 0 {
        report::complain(format!(
            "interrupted with {left} of {} flights left; the result is from the others",
            jobs.len()
        ));
        return Ok(Exit::Interrupted);
    }
    Ok(match answer.done {
        0 => Exit::Early,
        _ => Exit::Done,
    })
}

/// What is flown beside the nominal vehicle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Job {
    /// Only this number moved, up or down.
    Step { number: usize, side: Side },
    /// The vehicles drawn with this stream of numbers.
    Draw(u32),
}

/// Which way a number is moved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Side {
    Up,
    Down,
}

/// How a flight went: its numbers, or why there was none.
type Attempt = Result<Flown, String>;

/// A scenario and its uncertain vehicles.
struct Ensemble {
    scenario: Scenario,
    files: Beside,
    seed: u64,
    /// By the place of its quadrotor; none where all numbers are certain.
    vehicles: Vec<Option<UncertainVehicle>>,
    numbers: Vec<Number>,
}

/// An uncertain number of a quadrotor.
#[derive(Clone, Debug)]
struct Number {
    /// Place of its quadrotor.
    quadrotor: usize,
    /// Place among the quadrotor's own.
    own: usize,
    /// Its key with the quadrotor's name before, and what the file says.
    number: UncertainNumber,
}

impl Ensemble {
    fn of(scenario: Scenario, files: Beside, seed: u64) -> Result<Self, Failure> {
        let (mut vehicles, mut numbers) = (Vec::new(), Vec::new());
        for (quadrotor, flown) in scenario.quadrotor.iter().enumerate() {
            let file = flown.vehicle_file(&files)?;
            let vehicle = UncertainVehicle::of(&file, &flown.vehicle)
                .map_err(|error| Failure::Usage(format!("quadrotor \"{}\": {error}", flown.name)))?;
            numbers.extend(vehicle.numbers().iter().enumerate().map(|(own, number)| Number {
                quadrotor,
                own,
                number: UncertainNumber {
                    key: format!("{}.{}", flown.name, number.key),
                    ..number.clone()
                },
            }));
            vehicles.push(Some(vehicle).filter(|vehicle| !vehicle.numbers().is_empty()));
        }
        if numbers.is_empty() {
            return Err(Failure::Usage(NOTHING_UNCERTAIN.to_owned()));
        }
        Ok(Self {
            scenario,
            files,
            seed,
            vehicles,
            numbers,
        })
    }

    fn jobs(&self, runs: u32) -> Vec<Job> {
        let sides = |number| [Side::Up, Side::Down].map(|side| Job::Step { number, side });
        let steps = (0..self.numbers.len()).flat_map(sides);
        steps.chain((0..runs).map(Job::Draw)).collect()
    }

    /// Flies a job; nothing if it was interrupted.
    fn fly(&self, job: Job, bar: &ProgressBar) -> Option<Attempt> {
        if interrupt::asked() {
            return None;
        }
        let flown = self.moved(job).and_then(|moved| {
            let plant = Swapped::of(self, &moved);
            interrupt::fly(&plant.scenario, &plant, &Keep::METRICS).map_err(|failure| failure.to_string())
        });
        bar.inc(1);
        match flown {
            Ok(flown) if flown.ending.end == End::Interrupted => None,
            flown => Some(flown),
        }
    }

    /// The vehicle files of a job, for the quadrotors whose vehicles differ from the nominal ones.
    fn moved(&self, job: Job) -> Result<BTreeMap<usize, VehicleFile>, String> {
        let vehicles = self.vehicles.iter().enumerate();
        let mut vehicles = vehicles.filter_map(|(k, vehicle)| Some((k, vehicle.as_ref()?)));
        match job {
            Job::Step { number, side } => {
                let number = &self.numbers[number];
                let moved = |(k, vehicle): (usize, &UncertainVehicle)| {
                    let [up, down] = sensitivity::deviations(vehicle.numbers().len(), number.own);
                    let deviations = match side {
                        Side::Up => up,
                        Side::Down => down,
                    };
                    (k, vehicle.file_at(&deviations))
                };
                Ok(vehicles
                    .find(|(k, _)| *k == number.quadrotor)
                    .map(moved)
                    .into_iter()
                    .collect())
            }
            Job::Draw(stream) => {
                let mut generator = ChaCha8Rng::seed_from_u64(self.seed);
                generator.set_stream(stream.into());
                let mut normal = || StandardNormal.sample(&mut generator);
                vehicles
                    .map(|(k, vehicle)| match vehicle.draw(&mut normal) {
                        Ok(drawn) => Ok((k, drawn.file)),
                        Err(error) => Err(error.to_string()),
                    })
                    .collect()
            }
        }
    }
}

/// What to do where nothing is uncertain.
const NOTHING_UNCERTAIN: &str = "\
no number of the scenario's vehicles has a standard error, so there is nothing to propagate. Files with standard errors come from \
identification (`identify`, or `cargo xtask identify` for a whole vehicle); name one with --set quadrotor.NAME.vehicle=FILE. By hand, a \
number is written { value = 1.4, source = \"scales\", standard_error = 0.01 }";

/// A scenario whose vehicles are others than its controllers believe.
struct Swapped<'a> {
    scenario: Scenario,
    files: &'a Beside,
    texts: BTreeMap<String, String>,
}

impl<'a> Swapped<'a> {
    fn of(ensemble: &'a Ensemble, moved: &BTreeMap<usize, VehicleFile>) -> Self {
        let mut swapped = Self {
            scenario: ensemble.scenario.clone(),
            files: &ensemble.files,
            texts: BTreeMap::new(),
        };
        for (&k, file) in moved {
            let quadrotor = &mut swapped.scenario.quadrotor[k];
            let name = format!("the moved vehicle of {}", quadrotor.name);
            if let (None, Some(vehicle)) = (&quadrotor.controller.vehicle, &ensemble.vehicles[k]) {
                let believed = format!("the nominal vehicle of {}", quadrotor.name);
                swapped
                    .texts
                    .insert(believed.clone(), vehicle.file_at(&[]).to_toml());
                quadrotor.controller.vehicle = Some(believed);
            }
            swapped.texts.insert(name.clone(), file.to_toml());
            quadrotor.vehicle = name;
            // They are in the file by now.
            quadrotor.parameters.clear();
        }
        swapped
    }
}

impl Files for Swapped<'_> {
    fn text(&self, name: &str) -> Result<String, std::io::Error> {
        self.texts
            .get(name)
            .map_or_else(|| self.files.text(name), |text| Ok(text.clone()))
    }
}
