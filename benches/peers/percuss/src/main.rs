//! percuss in the benchmark against other programs: see `benches/peers/README.md`.
//!
//! `percuss-peers PROBLEM one|batch power|linear THREADS END` advances the chains of a problem and writes where they end; with `cavity` it computes runs of the
//! default model. `percuss-peers CASE sweep N THREADS` and `percuss-peers CASE runs N 1` compute runs of a case to rest. All print seconds by the clock and of the
//! processor; runs then print their elements times steps.

mod kernel;
mod problem;
mod runs;

use std::{env, error::Error, fs, process::ExitCode, time::Instant};

use percuss::Scenario;
use runs::End;
use rustix::time::{ClockId, clock_gettime};

/// What every part of this program fails with.
type Outcome<T> = Result<T, Box<dyn Error + Send + Sync>>;

/// Seconds that work takes, by the clock and of all processors.
fn timed<T>(work: impl FnOnce() -> T) -> (T, f64, f64) {
    let processor = || {
        let time = clock_gettime(ClockId::ProcessCPUTime);
        time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64
    };
    let (start, start_of_work) = (Instant::now(), processor());
    let result = work();
    (
        result,
        start.elapsed().as_secs_f64(),
        processor() - start_of_work,
    )
}

fn run(words: &[&str]) -> Outcome<()> {
    match *words {
        [case, what @ ("sweep" | "runs"), count, threads] => {
            complete(&runs::scenarios(case, count.parse()?)?, what, threads)?;
        }
        [problem, together, "cavity", threads, end] => {
            let ends = complete(&runs::of_cavity(problem)?, together, threads)?;
            write(end, ends.as_flattened())?;
        }
        [problem, together, law, threads, end] => {
            let problem = problem::read(problem)?;
            let pool = threads_of(threads)?;
            let advance = kernel::choose(together, law)?;
            let (ends, clock, processor) = timed(|| pool.install(|| advance(&problem)));
            println!("{clock:.9} {processor:.9}");
            write(end, &ends)?;
        }
        _ => return Err("usage: percuss-peers PROBLEM one|batch power|linear THREADS END".into()),
    }
    Ok(())
}

/// Computes complete runs, side by side or one by one, and prints how long that took.
fn complete(scenarios: &[Scenario], together: &str, threads: &str) -> Outcome<Vec<End>> {
    let pool = threads_of(threads)?;
    let compute = |scenarios| match together {
        "sweep" | "batch" => pool.install(|| runs::side_by_side(scenarios)),
        _ => runs::one_by_one(scenarios),
    };
    // The first run reads tables that all others share.
    compute(&scenarios[..scenarios.len().min(1)])?;
    let (ends, clock, processor) = timed(|| compute(scenarios));
    let ends = ends?;
    let amount = runs::amount(scenarios, &ends);
    println!("{clock:.9} {processor:.9} {amount}");
    Ok(ends)
}

fn write(path: &str, numbers: &[f64]) -> Outcome<()> {
    let bytes: Vec<u8> = numbers.iter().flat_map(|u| u.to_le_bytes()).collect();
    Ok(fs::write(path, bytes)?)
}

fn threads_of(count: &str) -> Outcome<rayon::ThreadPool> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(count.parse()?);
    Ok(pool.build()?)
}

fn main() -> ExitCode {
    let words: Vec<String> = env::args().skip(1).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    match run(&words) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("percuss-peers: {error}");
            ExitCode::FAILURE
        }
    }
}
