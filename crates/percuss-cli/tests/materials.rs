//! `percuss materials`.

use std::fs;

use tempfile::TempDir;

use crate::support::{CASE, json, ok, percuss, shot};

#[test]
fn materials_are_listed_and_shown() {
    let folder = TempDir::new().unwrap();
    let text = ok(folder.path(), &["materials"]);
    assert!(text.lines().next().unwrap().starts_with("id "), "{text}");
    let line = text
        .lines()
        .find(|line| line.starts_with("copper-woodward"))
        .unwrap();
    for part in ["copper ★", "power_law", "8500", "woodward1982"] {
        assert!(line.contains(part), "{line}");
    }
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
