//! Targets of the test `fuzz` for libFuzzer, which is guided by the coverage that an input reaches.
//!
//! Inputs, targets and what has to hold are those of `crates/percuss-cli/tests/fuzz`; nothing of them is written here.

#[path = "../../crates/percuss-cli/tests/fuzz"]
mod fuzz {
    pub mod http;
    pub mod mutate;
    pub mod oracle;
    pub mod targets;
}

#[path = "../../crates/percuss-cli/tests/support"]
mod support {
    mod inputs;

    pub use inputs::{CASE, Draw, status};

    /// Folder of the tests of the program.
    pub const TESTS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../crates/percuss-cli/tests");
}

use fuzz::{
    mutate, oracle,
    targets::{Target, targets},
};
pub use libfuzzer_sys;
use support::Draw;

thread_local! {
    static TARGET: Target = targets(&kind());
}

/// Kind of input of this program: its name.
fn kind() -> String {
    let program = std::env::current_exe().expect("the program has a path");
    let name = program.file_stem().expect("the program has a name");
    name.to_string_lossy().into_owned()
}

/// Gives an input to the target.
///
/// # Panics
/// When what has to hold does not.
pub fn attempt(input: &[u8]) {
    TARGET.with(|target| {
        if let Err(what) = oracle::tried(target, input) {
            panic!("{}: {what}", target.kind);
        }
    });
}

/// Changes an input: half of them by words and lines of valid ones, an eighth of all from a valid one.
pub fn mutate(data: &mut [u8], size: usize, longest: usize, seed: u32) -> usize {
    let mut draw = Draw(u64::from(seed));
    let bytes = match draw.below(8) {
        0..4 => return libfuzzer_sys::fuzzer_mutate(data, size, longest),
        4 => TARGET.with(|target| mutate::mutated(&mut draw, &target.seeds)),
        _ => {
            let text = String::from_utf8_lossy(&data[..size]).into_owned();
            TARGET.with(|target| mutate::changed(&mut draw, text, &target.seeds))
        }
    };
    let size = bytes.len().min(longest);
    data[..size].copy_from_slice(&bytes[..size]);
    size
}

/// Entry points of the engine.
#[macro_export]
macro_rules! guided {
    () => {
        $crate::libfuzzer_sys::fuzz_target!(|input: &[u8]| $crate::attempt(input));
        $crate::libfuzzer_sys::fuzz_mutator!(|data: &mut [u8],
                                              size: usize,
                                              longest: usize,
                                              seed: u32| {
            $crate::mutate(data, size, longest, seed)
        });
    };
}
