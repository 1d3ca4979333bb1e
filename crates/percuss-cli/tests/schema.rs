//! `percuss schema` says what case files have.

use tempfile::TempDir;

use crate::support::{CASE, flat, json, ok, percuss, shot};

/// The keys that the reader of case files allows beside one that does not exist.
fn keys_allowed(case: &str) -> Vec<String> {
    let folder = shot(case);
    let said = percuss(folder.path(), ["run", "--fast", "shot.toml"]);
    assert_eq!(said.code, 2, "{case}");
    let message = flat(&said.stderr);
    let (_, allowed) = message
        .split_once("allowed: ")
        .unwrap_or_else(|| panic!("{message}"));
    let mut keys: Vec<String> = allowed.split(", ").map(str::to_owned).collect();
    keys.sort();
    keys
}

#[test]
fn the_schema_has_the_keys_that_case_files_have() {
    let folder = TempDir::new().unwrap();
    let schema = json(&ok(folder.path(), &["schema"]));
    assert_eq!(
        schema["$schema"],
        "https://json-schema.org/draft/2020-12/schema"
    );
    assert!(schema.get("$id").is_none());
    assert!(
        !schema.to_string().contains("null"),
        "a TOML file has no null"
    );
    let scheme = &schema["$defs"]["ChainOptions"]["properties"]["scheme"];
    assert_eq!(scheme["default"], "conservative");
    let material = "[materials.x]\nname = 'x'\ndensity = '1 g/cm3'\nyoungs_modulus = '1 GPa'\npoissons_ratio = 0.3\n";
    for (definition, case) in [
        ("", "zz = 1".to_owned()),
        ("Projectile", "projectile.zz = 1".to_owned()),
        ("Target", CASE.replace("thickness", "zz = 1, thickness")),
        (
            "Layer",
            CASE.replace(
                "{ material = \"alu",
                "{ layers = [{ zz = 1 }], material = \"alu",
            ),
        ),
        (
            "ChainOptions",
            CASE.replace("chain = {", "chain = { zz = 1,"),
        ),
        (
            "PublishedOptions",
            CASE.replace("chain = {", "chain = { published.zz = 1,"),
        ),
        (
            "ArtificialViscosity",
            CASE.replace("chain = {", "chain = { artificial_viscosity.zz = 1,"),
        ),
        (
            "Experiment",
            format!("{CASE}[[experiments]]\nsource = 'a'\nzz = 1"),
        ),
        ("Material", format!("{CASE}{material}zz = 1")),
        ("Validity", format!("{CASE}{material}validity.zz = 1")),
        (
            "PowerLaw",
            format!("{CASE}{material}strength.power_law.zz = 1"),
        ),
        (
            "JohnsonCook",
            format!("{CASE}{material}strength.johnson_cook.zz = 1"),
        ),
    ] {
        let object = match definition {
            "" => &schema,
            _ => &schema["$defs"][definition],
        };
        assert_eq!(object["additionalProperties"], false, "{definition}");
        let mut keys: Vec<&String> = object["properties"]
            .as_object()
            .unwrap_or_else(|| panic!("no {definition} in {schema}"))
            .keys()
            .collect();
        keys.sort();
        assert_eq!(
            keys,
            keys_allowed(&case).iter().collect::<Vec<_>>(),
            "{definition}"
        );
    }
}
