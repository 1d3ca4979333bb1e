//! The page in `docs/reference/paper/` is what `percuss reproduce paper` writes today.

use std::ops::ControlFlow;

use percuss_research::paper::{Assessment, reproduce};

use crate::pages::assert_page;

#[test]
fn the_page_in_the_docs_is_up_to_date() {
    let reproduction = reproduce(&mut |_| ControlFlow::Continue(())).unwrap();
    assert_page(
        "docs/reference/paper/paper.md",
        &reproduction.page(),
        "percuss reproduce paper --out docs/reference/paper",
    );

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
