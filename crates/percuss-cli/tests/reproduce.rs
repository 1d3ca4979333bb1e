//! `percuss reproduce`.

use tempfile::TempDir;

use crate::support::{json, names_in, ok, percuss};

#[test]
fn the_paper_is_told_as_text_as_data_and_as_a_folder() {
    let folder = TempDir::new().unwrap();
    let said = percuss(
        folder.path(),
        ["reproduce", "paper", "--json", "--out", "paper"],
    );
    let object = json(&said.stdout);
    assert_eq!((said.code, &object["work"]), (0, &"paper".into()));
    let items = object["items"].as_array().unwrap();
    for item in items {
        let verdict = item["assessment"].as_str().unwrap();
        let known = [
            "reproduced",
            "reading_dependent",
            "contradicted",
            "cannot_be_known",
        ];
        assert!(known.contains(&verdict), "{verdict}");
        assert!(!item["finding"].as_str().unwrap().is_empty());
    }
    assert!(items.len() > 15 && !object["tables"].as_array().unwrap().is_empty());
    let names = names_in(&folder.path().join("paper"));
    assert!(names.iter().any(|name| name == "paper.md"), "{names:?}");
    // Without a folder the items are printed, and nothing is written.
    let text = ok(folder.path(), &["reproduce", "paper"]);
    assert!(text.starts_with("The seed paper, item by item\n") && !text.contains("wrote"));
    assert_eq!(names_in(folder.path()), ["paper"]);
    assert_eq!(percuss(folder.path(), ["reproduce", "nature"]).code, 2);
}
