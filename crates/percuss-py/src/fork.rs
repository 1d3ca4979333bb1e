//! Threads in a forked process: it has none of the pool that its parent had.

use std::{process, sync::OnceLock};

/// Process that the package was loaded in.
static LOADED_IN: OnceLock<u32> = OnceLock::new();

/// Remembers the process that loads the package.
pub fn remember_process() {
    LOADED_IN.get_or_init(process::id);
}

/// Does work that uses all threads, with a pool of its own in a process that was forked: the common pool would wait for threads that the
/// fork left behind.
pub fn with_threads<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    let is_forked = LOADED_IN.get().is_some_and(|id| *id != process::id());
    let pool = is_forked.then(|| rayon::ThreadPoolBuilder::new().build());
    match pool {
        Some(Ok(pool)) => pool.install(work),
        // Without threads of its own, the common pool fails in the same way.
        Some(Err(_)) | None => work(),
    }
}
