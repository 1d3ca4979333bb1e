//! `percuss models`.

use std::path::Path;

use serde_json::Value;
use tempfile::TempDir;

use crate::support::{json, ok, percuss};

#[test]
fn models_are_listed_and_shown() {
    let folder = TempDir::new().unwrap();
    let text = ok(folder.path(), &["models"]);
    let row = text
        .lines()
        .find(|line| line.starts_with(" chain "))
        .unwrap();
    assert!(row.contains("1-D discrete element"), "{text}");
    assert!(
        text.lines().all(|line| line.chars().count() <= 80),
        "{text}"
    );
    let card = ok(folder.path(), &["models", "chain"]);
    for part in [
        "chain\n1-D discrete",
        "range of validity\n",
        "  - normal impact",
        "first choice for\n  - deforming projectiles",
        "options in [chain] of a case file\n  - ",
        "\n  - courant: Courant number",
        "page\n  - docs/models/chain.md: ",
    ] {
        assert!(card.contains(part), "{part:?} is not in:\n{card}");
    }
    assert!(
        card.lines().all(|line| line.chars().count() <= 80),
        "{card}"
    );
    assert!(!ok(folder.path(), &["models", "hydrodynamic"]).contains("options"));
    let said = percuss(folder.path(), ["models", "chian"]);
    assert_eq!(said.code, 2);
    assert!(
        said.stderr.contains("did you mean `chain`?"),
        "{}",
        said.stderr
    );
}

#[test]
fn models_as_json_hold_their_whole_validity_domain() {
    let folder = TempDir::new().unwrap();
    let list = json(&ok(folder.path(), &["models", "--json"]));
    assert_eq!(
        list[0],
        json(&ok(folder.path(), &["models", "chain", "--json"]))
    );
    assert_eq!(list[0]["name"], "chain");
    assert_eq!(list[0]["validity"]["noses"], serde_json::json!(["flat"]));
    assert_eq!(
        list[4]["options"],
        serde_json::json!(["projectile_strength", "target_resistance"])
    );
    let keys =
        |value: &Value| -> Vec<String> { value.as_object().unwrap().keys().cloned().collect() };
    for model in list.as_array().unwrap() {
        assert_eq!(
            keys(model),
            ["name", "options", "page", "summary", "validity"]
        );
        let page = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("../..")
            .join(model["page"].as_str().unwrap());
        assert!(page.is_file(), "{}", page.display());
        let validity = &model["validity"];
        assert_eq!(
            keys(validity),
            [
                "breaks_brittle",
                "first_choice",
                "fitted_to",
                "noses",
                "notes",
                "oblique_noses",
                "predicts",
                "projectile",
                "projectile_materials",
                "ranges",
                "sees_back_face",
                "separate_layers",
                "start_temperature",
                "target_materials",
                "targets",
            ]
        );
        for range in validity["ranges"].as_array().unwrap() {
            assert_eq!(keys(range), ["because", "max", "measure", "min", "outside"]);
            assert!(range["min"].is_number());
        }
        for choice in validity["first_choice"].as_array().unwrap() {
            assert_eq!(
                keys(choice),
                [
                    "because",
                    "noses",
                    "projectile",
                    "target_material",
                    "targets"
                ]
            );
        }
    }
}
