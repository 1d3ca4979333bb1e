//! Thread pool, and the flag that stops it.

use std::{
    error::Error,
    fmt::Display,
    ops::ControlFlow,
    process,
    sync::{
        Arc, OnceLock,
        atomic::{AtomicBool, Ordering},
    },
    thread,
};

use percuss::units::shorten;

use crate::failure::Failure;

/// Most threads: more take memory and wait for each other.
pub const MOST_THREADS: u16 = 1024;
/// Addresses that the stack of a thread takes [bytes].
const STACK: u64 = 2 << 20;
/// Variable of the environment with the number of threads.
const VARIABLE: &str = "RAYON_NUM_THREADS";

/// Starts the threads that all commands share.
///
/// # Errors
/// [`Failure::Usage`] where the system gives no more threads, or the environment asks for too many.
pub fn start() -> Result<(), Failure> {
    if let Some(value) = std::env::var_os(VARIABLE) {
        let value = value.to_string_lossy();
        // Not a number, and 0, stand for one per core.
        let wanted: Option<u128> = value.parse().ok();
        if wanted.is_some_and(|wanted| wanted > MOST_THREADS.into()) {
            return Err(Failure::Usage {
                message: format!("{VARIABLE} = `{}` is too much", shorten(&value)),
                help: format!("allowed: 1 to {MOST_THREADS}, and 0 for one per core"),
            });
        }
        check_stacks(wanted.unwrap_or(0) as u64)?;
    }
    // They are started once, and what failed cannot be tried again.
    static POOL: OnceLock<Result<(), String>> = OnceLock::new();
    let pool = POOL.get_or_init(|| {
        match rayon::ThreadPoolBuilder::new().build_global() {
            // A caller of the library may have started them before: that error has no source.
            Err(error) if error.source().is_some() => Err(error.to_string()),
            _ => Ok(()),
        }
    });
    if let Err(reason) = pool {
        return Err(refused(reason));
    }
    static ONE_MORE: OnceLock<()> = OnceLock::new();
    if ONE_MORE.get().is_none() {
        // Commands start some more, one at a time.
        match thread::Builder::new()
            .spawn(|| ())
            .map(thread::JoinHandle::join)
        {
            Err(error) => return Err(refused(&error)),
            Ok(_) => drop(ONE_MORE.set(())),
        }
    }
    Ok(())
}

/// Thread pool with this number of threads, by default one per core.
pub fn pool(threads: Option<u16>) -> Result<rayon::ThreadPool, Failure> {
    let mut pool = rayon::ThreadPoolBuilder::new();
    if let Some(threads) = threads {
        check_stacks(threads.into())?;
        pool = pool.num_threads(usize::from(threads));
    }
    pool.build().map_err(|error| refused(&error))
}

/// Refuses threads whose stacks exceed the limit of addresses: once all are taken, the C library ends the program.
fn check_stacks(threads: u64) -> Result<(), Failure> {
    #[cfg(unix)]
    {
        let limit = rustix::process::getrlimit(rustix::process::Resource::As).current;
        if limit.is_some_and(|limit| threads * STACK > limit) {
            return Err(refused(&format!(
                "{threads} threads take more addresses than `ulimit -v` allows"
            )));
        }
    }
    #[cfg(not(unix))]
    let _ = threads * STACK;
    Ok(())
}

fn refused(error: &dyn Display) -> Failure {
    Failure::Usage {
        message: format!("cannot start the threads: {error}"),
        help: format!(
            "set {VARIABLE} or `--threads` to a smaller number, or allow more processes and memory (`ulimit -u`, `ulimit -v`)"
        ),
    }
}

/// Flag that becomes true on the first Ctrl-C or termination request; the second one ends the program at once.
pub fn stop_on_request() -> Arc<AtomicBool> {
    let stop = Arc::new(AtomicBool::new(false));
    let flag = Arc::clone(&stop);
    // Without a handler Ctrl-C ends the program, which leaves no incomplete file.
    let _ = ctrlc::set_handler(move || {
        if flag.swap(true, Ordering::Relaxed) {
            process::exit(130);
        }
    });
    stop
}

/// What a run is to do: go on as its progress says, unless the flag is set.
pub fn unless_stopped(stop: &AtomicBool, go_on: ControlFlow<()>) -> ControlFlow<()> {
    match stop.load(Ordering::Relaxed) {
        true => ControlFlow::Break(()),
        false => go_on,
    }
}
