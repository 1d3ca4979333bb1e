//! Thread pool, and the flag that stops it.

use std::{
    ops::ControlFlow,
    process,
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
};

use crate::failure::Failure;

/// Thread pool with this number of threads, by default one per core.
pub fn pool(threads: Option<u16>) -> Result<rayon::ThreadPool, Failure> {
    let mut pool = rayon::ThreadPoolBuilder::new();
    if let Some(threads) = threads {
        pool = pool.num_threads(usize::from(threads));
    }
    pool.build().map_err(|error| Failure::Usage {
        message: format!("cannot start the threads: {error}"),
        help: "give a smaller number with --threads".to_owned(),
    })
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
