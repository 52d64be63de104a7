//! Mutated files for every reader; see the README for what it is asked and how.

mod mutate;
mod target;

use mutate::{Random, mutated};
use std::panic::{self, AssertUnwindSafe};
use std::process::ExitCode;
use std::time::{Duration, Instant};
use target::Target;

/// Memory that a reader may have at once, bytes; the seeds have less than 100 kB.
const MOST_BYTES: u64 = 512 << 20;

/// Longest case, s: a thousand times the usual one, on a busy machine.
const LONGEST_S: f64 = 20.0;

/// What is asked.
struct Asked {
    targets: Vec<String>,
    seconds: f64,
    count: Option<u64>,
    from: u64,
    seed: u64,
    write: Option<String>,
}

impl Asked {
    fn read(mut arguments: impl Iterator<Item = String>) -> Result<Self, String> {
        let mut asked = Self {
            targets: Vec::new(),
            seconds: 60.0,
            count: None,
            from: 0,
            seed: 1,
            write: None,
        };
        while let Some(argument) = arguments.next() {
            let mut value = || arguments.next().ok_or(format!("{argument} needs a value"));
            fn number<T: std::str::FromStr>(text: &str) -> Result<T, String> {
                text.parse().map_err(|_| format!("\"{text}\" is not a number"))
            }
            match argument.as_str() {
                "--seconds" => asked.seconds = number(&value()?)?,
                "--count" => asked.count = Some(number(&value()?)?),
                "--from" => asked.from = number(&value()?)?,
                "--seed" => asked.seed = number(&value()?)?,
                "--write" => asked.write = Some(value()?),
                _ => asked.targets.push(argument),
            }
        }
        Ok(asked)
    }
}

fn main() -> ExitCode {
    match Asked::read(std::env::args().skip(1)).and_then(|asked| fuzz(&asked)) {
        Ok(cases) => {
            println!("{cases} cases, none failed");
            ExitCode::SUCCESS
        }
        Err(why) => {
            eprintln!("error: {why}");
            ExitCode::FAILURE
        }
    }
}

/// Fuzzes what is asked for; how many cases there were.
fn fuzz(asked: &Asked) -> Result<u64, String> {
    let targets: Vec<Target> = (target::all().into_iter())
        .filter(|target| asked.targets.is_empty() || asked.targets.iter().any(|name| name == target.name))
        .collect();
    if targets.is_empty() {
        let known: Vec<&str> = target::all().iter().map(|target| target.name).collect();
        return Err(format!("unknown target; known: {}", known.join(", ")));
    }
    panic::set_hook(Box::new(|_| {}));
    let share = Duration::from_secs_f64(asked.seconds / targets.len() as f64);
    let (mut all, mut failed) = (0, Vec::new());
    for target in &targets {
        let begun = Instant::now();
        let mut case = asked.from;
        let mut slowest = (0.0, case);
        while match asked.count {
            Some(count) => case < asked.from + count,
            None => begun.elapsed() < share,
        } {
            let file = mutated(&target.seeds, &mut Random::of(asked.seed, case));
            if let Some(path) = &asked.write {
                std::fs::write(path, &file).map_err(|error| format!("{path}: {error}"))?;
            }
            let begun = Instant::now();
            let judgement = judged(target, &file);
            let seconds = begun.elapsed().as_secs_f64();
            if seconds > slowest.0 {
                slowest = (seconds, case);
            }
            if let Err(why) = judgement {
                let again = format!(
                    "cargo run -p fuzz -- {} --seed {} --from {case} --count 1 --write FILE",
                    target.name, asked.seed
                );
                failed.push(format!("{}: {why}; again with `{again}`", target.name));
                break;
            }
            case += 1;
        }
        let cases = case - asked.from;
        let what = if target.is_program { "runs" } else { "cases" };
        println!(
            "{:<16} {cases:>9} {what:<5} in {:.1} s, the slowest {:.3} s (case {})",
            target.name,
            begun.elapsed().as_secs_f64(),
            slowest.0,
            slowest.1
        );
        all += cases;
    }
    if failed.is_empty() {
        Ok(all)
    } else {
        Err(failed.join("\n"))
    }
}

/// What does not hold of a case.
fn judged(target: &Target, file: &[u8]) -> Result<(), String> {
    let begun = Instant::now();
    let mut read = Ok(());
    let memory = allocation_counter::measure(|| {
        let caught = panic::catch_unwind(AssertUnwindSafe(|| (target.read)(file)));
        read = caught.unwrap_or_else(|panic| {
            let text = panic.downcast_ref::<String>().map(String::as_str);
            let text = text.or_else(|| panic.downcast_ref::<&str>().copied());
            Err(format!("panicked: {}", text.unwrap_or("no message")))
        });
    });
    read?;
    let (seconds, bytes) = (begun.elapsed().as_secs_f64(), memory.bytes_max);
    if bytes > MOST_BYTES {
        return Err(format!("asked for {bytes} bytes"));
    }
    if seconds > LONGEST_S {
        return Err(format!("took {seconds} s"));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A few hundred cases of every reader of the libraries, the same ones every time.
    #[test]
    fn prop_no_reader_fails_on_mutated_files() {
        for target in target::all().iter().filter(|target| !target.is_program) {
            assert!(!target.seeds.iter().any(Vec::is_empty), "{}", target.name);
            (target.read)(&target.seeds[0]).unwrap();
            for case in 0..100 {
                let file = mutated(&target.seeds, &mut Random::of(7, case));
                judged(target, &file).unwrap_or_else(|why| panic!("{} case {case}: {why}", target.name));
            }
        }
    }
}
