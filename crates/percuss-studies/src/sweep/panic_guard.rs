//! Panics of a run as its error, without output between the lines of a progress bar.

use std::{
    any::Any,
    cell::RefCell,
    panic::{self, AssertUnwindSafe},
    sync::Once,
};

thread_local! {
    /// Where this thread panicked, while it is inside [`catch_panic`].
    static PLACE: RefCell<Option<String>> = const { RefCell::new(None) };
}

/// What a function returns, or what it said when it panicked and where. What the function changes elsewhere is not to be used
/// after a panic.
pub(super) fn catch_panic<T>(function: impl FnOnce() -> T) -> Result<T, String> {
    static HOOK: Once = Once::new();
    HOOK.call_once(|| {
        let before = panic::take_hook();
        panic::set_hook(Box::new(move |info| {
            let inside = PLACE.with_borrow_mut(|place| {
                if let (Some(place), Some(at)) = (place.as_mut(), info.location()) {
                    *place = format!(" at {}:{}", at.file(), at.line());
                }
                place.is_some()
            });
            if !inside {
                before(info);
            }
        }));
    });
    let outer = PLACE.replace(Some(String::new()));
    let result = panic::catch_unwind(AssertUnwindSafe(function));
    let place = PLACE.replace(outer).unwrap_or_default();
    result.map_err(|payload| {
        let message = message(&*payload);
        format!("this is a fault of the program, please report it: it panicked{place}: {message}")
    })
}

fn message(payload: &dyn Any) -> &str {
    let text = payload.downcast_ref::<&str>().copied();
    let text = text.or_else(|| payload.downcast_ref::<String>().map(String::as_str));
    text.unwrap_or("without a message")
}
