//! The page in `docs/reference/paper/` is what `percuss reproduce paper` writes today.

use std::{fs, ops::ControlFlow, path::Path};

use percuss_research::paper::{Assessment, reproduce};

/// Words are compared as words, numbers as numbers: the last digits may differ between C libraries.
fn assert_same(old: &str, new: &str) {
    let words = |text: &str| -> Vec<String> {
        text.split(|c: char| c.is_whitespace() || "|(;,:".contains(c))
            .filter(|word| !word.is_empty())
            .map(ToOwned::to_owned)
            .collect()
    };
    let (old, new) = (words(old), words(new));
    for (a, b) in old.iter().zip(&new) {
        let same = match (a.parse::<f64>(), b.parse::<f64>()) {
            (Ok(x), Ok(y)) => (x - y).abs() <= 0.02 * x.abs().max(y.abs()) + 2e-4,
            _ => a == b,
        };
        assert!(
            same,
            "docs/reference/paper/paper.md has `{a}` where `{b}` comes out: run `percuss reproduce paper --out docs/reference/paper`"
        );
    }
    assert_eq!(old.len(), new.len());
}

#[test]
fn the_page_in_the_docs_is_up_to_date() {
    let reproduction = reproduce(&mut |_| ControlFlow::Continue(())).unwrap();
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/reference/paper/paper.md");
    assert_same(&fs::read_to_string(path).unwrap(), &reproduction.page());

    let verdict = |place: &str, start: &str| {
        let found = reproduction
            .items
            .iter()
            .find(|item| item.place == place && item.statement.starts_with(start));
        found
            .unwrap_or_else(|| panic!("no item {place}: {start}"))
            .assessment
    };
    assert_eq!(
        verdict("Table 1", "penetrator mass"),
        Assessment::Reproduced
    );
    assert_eq!(
        verdict("Table 1", "time step 4.85e-9"),
        Assessment::Reproduced
    );
    assert_eq!(
        verdict("Table 1", "95 time steps"),
        Assessment::ReadingDependent
    );
    assert_eq!(
        verdict("Fig. 8", "40–80 elements are converged (published, chain)"),
        Assessment::Contradicted
    );
    assert_eq!(
        verdict("Fig. 11", "agrees with Woodward's tests"),
        Assessment::CannotBeKnown
    );
}

#[test]
fn it_can_be_broken_off() {
    let mut calls = 0;
    let result = reproduce(&mut |_| {
        calls += 1;
        if calls > 3 {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    });
    assert!(matches!(result, Err(percuss::Error::Cancelled { .. })));
    assert_eq!(calls, 4);
}
