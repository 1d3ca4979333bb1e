//! The integration tests of a crate are one program, `tests/main.rs`. A file that it does not name would never run.

use std::{fs, path::Path};

use crate::support::names_in;

#[test]
fn every_file_of_tests_is_part_of_the_test_program() {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut programs = 0;
    for name in names_in(&crates) {
        let tests = crates.join(name).join("tests");
        let Ok(main) = fs::read_to_string(tests.join("main.rs")) else {
            continue;
        };
        programs += 1;
        for file in names_in(&tests) {
            let module = file.strip_suffix(".rs").filter(|module| *module != "main");
            let named = |module| main.contains(&format!("\nmod {module};"));
            assert!(module.is_none_or(named), "{}", tests.join(file).display());
        }
    }
    assert!(programs >= 3, "{programs}");
}
