//! `percuss materials`.

use std::fs;

use tempfile::TempDir;

use crate::support::{CASE, flat, json, ok, percuss, shot};

#[test]
fn materials_are_listed_and_shown() {
    let folder = TempDir::new().unwrap();
    let text = ok(folder.path(), &["materials"]);
    assert!(text.lines().next().unwrap().starts_with("id "), "{text}");
    let line = text
        .lines()
        .find(|line| line.starts_with("copper-woodward"))
        .unwrap();
    for part in ["copper ★", "power_law", "8500"] {
        assert!(line.contains(part), "{line}");
    }
    assert!(
        text.lines().all(|line| line.chars().count() <= 100),
        "{text}"
    );
    let list = json(&ok(folder.path(), &["materials", "--json"]));
    assert_eq!(list.as_array().unwrap().len(), text.lines().count() - 1);

    let card = ok(folder.path(), &["materials", "show", "ofhc-copper"]);
    for part in [
        "id                      ofhc-copper-johnson-cook",
        "density                 8960 kg/m3",
        "elastic wave speed      3710 m/s",
        "impedance               33.24e6 kg/(m2 s)",
        "σ = (A + B ε_pⁿ)(1 + C ln ε̇*)(1 − T*ᵐ)",
        "trust: A\n  read in two independent places",
        "[johnson1983] Johnson & Cook 1983",
        "rivals of the same family\n  ofhc-copper-steinberg",
    ] {
        assert!(card.contains(part), "{part:?} is not in:\n{card}");
    }
    let card = json(&ok(
        folder.path(),
        &["materials", "show", "ofhc-copper", "--json"],
    ));
    assert_eq!(card["strength"]["johnson_cook"]["a"], "90 MPa");
    assert_eq!(card["rivals"][0], "ofhc-copper-steinberg");

    let said = percuss(folder.path(), ["materials", "show", "ofhc-coper"]);
    assert_eq!((said.code, said.stdout.as_str()), (2, ""));
    assert!(
        said.stderr.contains("did you mean `ofhc-copper`?"),
        "{}",
        said.stderr
    );
}

#[test]
fn materials_of_a_case_and_of_a_file_are_shown() {
    let record = "name = 'Foam'\ndensity = '30 kg/m3'\nyoungs_modulus = '20 MPa'\npoissons_ratio = 0.1\n\
                  strength.perfectly_plastic.flow_stress = '400 kPa'\n";
    let folder = shot(&format!("{CASE}\n[materials.foam]\n{record}"));
    fs::write(
        folder.path().join("mine.toml"),
        format!("[my-foam]\n{record}"),
    )
    .unwrap();
    let card = ok(
        folder.path(),
        &["materials", "show", "foam", "--case", "shot.toml"],
    );
    assert!(
        card.contains("shot (this case)") && card.contains("trust: user"),
        "{card}"
    );
    let card = ok(
        folder.path(),
        &["materials", "--file", "mine.toml", "show", "my-foam"],
    );
    assert!(
        card.contains("400 kPa") && card.contains("mine.toml"),
        "{card}"
    );
    let said = percuss(folder.path(), ["materials", "show", "foam"]);
    assert_eq!(said.code, 2);
}

#[test]
fn materials_are_searched_by_words() {
    let folder = TempDir::new().unwrap();
    let ids = |words: &[&str]| -> Vec<String> {
        let text = ok(folder.path(), &[&["materials"], words].concat());
        let lines = text.lines().skip(1);
        let id = |line: &str| line.split(' ').next().unwrap().to_owned();
        lines.map(id).collect()
    };
    let aluminium = ids(&["aluminium"]);
    assert!(
        aluminium.contains(&"2024-t4-steinberg".to_owned()),
        "{aluminium:?}"
    );
    assert_eq!(ids(&["Aluminum"]), aluminium);
    assert_eq!(ids(&["aluminium", "lesuer"]), ["6061-t6-lesuer"]);
    assert_eq!(
        ids(&["titanium"]),
        ["ti-6al-4v-static", "ti-6al-4v-steinberg"]
    );
    let found = json(&ok(folder.path(), &["materials", "tantalum", "--json"]));
    assert_eq!(found[0]["id"], "tantalum-steinberg");
    let said = percuss(folder.path(), ["materials", "unobtainium"]);
    assert_eq!((said.code, said.stdout.as_str()), (2, ""));
    assert!(
        said.stderr.contains("`percuss materials` lists all"),
        "{}",
        said.stderr
    );
    let said = percuss(folder.path(), ["materials", "show", "steel"]);
    for part in ["records of steel", "`4340`", "`weldox-460-e`"] {
        assert!(flat(&said.stderr).contains(part), "{}", said.stderr);
    }
}

#[test]
fn a_file_of_materials_has_headers_of_its_own_or_those_of_a_case() {
    let record = "name = 'Foam'\ndensity = '30 kg/m3'\nyoungs_modulus = '20 MPa'\npoissons_ratio = 0.1\n\
                  strength.perfectly_plastic.flow_stress = '400 kPa'\n";
    let case = CASE.replace("\"copper\"", "\"foam\"");
    let depth = |header: &str| {
        let folder = shot(&format!("material_files = ['mine.toml']\n{case}"));
        fs::write(
            folder.path().join("mine.toml"),
            format!("{header}\n{record}"),
        )
        .unwrap();
        ok(folder.path(), &["run", "--fast", "shot.toml", "-q"])
    };
    assert_eq!(depth("[foam]"), depth("[materials.foam]"));
}
