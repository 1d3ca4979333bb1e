//! Progress bar on standard error, shown after one second.

use std::{
    ops::ControlFlow,
    time::{Duration, Instant},
};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// Time before the progress is shown.
const DELAY: Duration = Duration::from_secs(1);
/// Time after which the time left is estimated from less than a hundredth.
const PATIENCE: Duration = Duration::from_secs(10);
const STEPS: u64 = 1000;

/// Progress bar that appears after a delay, if standard error is a terminal.
pub struct Progress {
    bar: ProgressBar,
    start: Instant,
    wanted: bool,
    /// Progress at the first update: a resumed run does not start at 0.
    first: Option<f64>,
    furthest: f64,
}

impl Progress {
    pub fn new(wanted: bool) -> Self {
        let bar = ProgressBar::with_draw_target(Some(STEPS), ProgressDrawTarget::hidden());
        if let Ok(style) = ProgressStyle::with_template("[{bar:24}] {percent:>3} %  {wide_msg}") {
            bar.set_style(style.progress_chars("=> "));
        }
        Self {
            bar,
            start: Instant::now(),
            wanted,
            first: None,
            furthest: 0.0,
        }
    }

    /// Shows the progress, 0 to 1, and a short text.
    pub fn update(&mut self, fraction: f64, words: &str) {
        let elapsed = self.start.elapsed();
        let first = *self.first.get_or_insert(fraction.clamp(0.0, 1.0));
        if !self.wanted || elapsed < DELAY {
            return;
        }
        // The estimate never decreases.
        self.furthest = self.furthest.max(fraction.clamp(0.0, 1.0));
        self.bar.set_position((self.furthest * STEPS as f64) as u64);
        self.bar.set_message(format!(
            "{words}{}",
            time_left(elapsed, first, self.furthest)
        ));
        if self.bar.is_hidden() {
            self.bar
                .set_draw_target(ProgressDrawTarget::stderr_with_hz(8));
        }
    }

    /// Progress callback of a command.
    pub fn callback(&mut self) -> impl FnMut(f64, &str) -> ControlFlow<()> + Send {
        |fraction, words| {
            self.update(fraction, words);
            ControlFlow::Continue(())
        }
    }

    /// Removes the bar.
    pub fn finish(self) {
        self.bar.finish_and_clear();
    }
}

fn time_left(elapsed: Duration, first: f64, fraction: f64) -> String {
    let done = fraction - first;
    // A little progress says little, but a run of days has no more after a while.
    if done < 0.01 && (elapsed < PATIENCE || done <= 0.0) {
        return String::new();
    }
    let seconds = elapsed.as_secs_f64() * (1.0 - fraction) / done;
    match seconds {
        ..90.0 => format!(", about {} s left", seconds.ceil()),
        ..5400.0 => format!(", about {:.0} min left", seconds / 60.0),
        ..172_800.0 => format!(", about {:.1} h left", seconds / 3600.0),
        _ => format!(", about {:.0} days left", seconds / 86_400.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_time_left_is_shown_once_it_says_something() {
        let left =
            |seconds: u64, done: f64| time_left(Duration::from_secs(seconds), 0.1, 0.1 + done);
        assert_eq!(left(5, 0.001), "");
        assert_eq!(left(60, 0.0), "");
        assert_eq!(left(10, 0.1), ", about 80 s left");
        assert_eq!(left(60, 0.01), ", about 89 min left");
        assert_eq!(left(60, 0.001), ", about 15.0 h left");
        assert_eq!(left(60, 1e-5), ", about 62 days left");
    }
}
