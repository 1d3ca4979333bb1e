//! Threads that compute many shots, and the request to end them.

use std::{
    process,
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
};

use crate::failure::Failure;

/// As many threads as are asked for, or as there are cores.
pub fn pool(threads: Option<u16>) -> Result<rayon::ThreadPool, Failure> {
    let mut pool = rayon::ThreadPoolBuilder::new();
    if let Some(threads) = threads {
        pool = pool.num_threads(usize::from(threads));
    }
    pool.build().map_err(|error| Failure::Usage {
        message: format!("cannot start the threads: {error}"),
        help: "ask for fewer with --threads".to_owned(),
    })
}

/// Becomes true on the first Ctrl-C, or request of the system to end; the second one ends the program at once.
pub fn stop_on_request() -> Arc<AtomicBool> {
    let stop = Arc::new(AtomicBool::new(false));
    let flag = Arc::clone(&stop);
    // Without a handler Ctrl-C just ends the program, which leaves no file half written.
    let _ = ctrlc::set_handler(move || {
        if flag.swap(true, Ordering::Relaxed) {
            process::exit(130);
        }
    });
    stop
}
