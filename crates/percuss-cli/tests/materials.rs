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
    assert_eq!(ids(&["6061", "lesuer"]), ["6061-t6-lesuer"]);
    assert_eq!(
        ids(&["ti-6al-4v"]),
        ["ti-6al-4v-meyer", "ti-6al-4v-static", "ti-6al-4v-steinberg"]
    );
    assert_eq!(
        ids(&["--group", "steel", "--hardness", "360..370"]),
        ["rha-class-1-plate"]
    );
    assert_eq!(
        ids(&["--family", "ofhc-copper"]),
        ["ofhc-copper-johnson-cook", "ofhc-copper-steinberg"]
    );
    for (words, part) in [
        (&["--group", "cheese"][..], "'cheese'"),
        (&["--hardness", "350"], "FROM..TO"),
        (&["--hardness", "1..2"], "no material fits --group"),
        (&["--family", "ofhc-coper"], "did you mean `ofhc-copper`?"),
        (&["tin", "--group", "steel"], "that the options leave"),
    ] {
        let said = percuss(folder.path(), [&["materials"], words].concat());
        assert_eq!((said.code, said.stdout.as_str()), (2, ""));
        assert!(flat(&said.stderr).contains(part), "{}", said.stderr);
    }
    let found = json(&ok(folder.path(), &["materials", "thorium", "--json"]));
    assert_eq!(found[0]["id"], "thorium-steinberg");
    let said = percuss(folder.path(), ["materials", "unobtainium"]);
    assert_eq!((said.code, said.stdout.as_str()), (2, ""));
    assert!(
        said.stderr.contains("`percuss materials` lists all"),
        "{}",
        said.stderr
    );
    let said = percuss(folder.path(), ["materials", "show", "steel"]);
    for part in ["records of steel", "`4340`", "`304`"] {
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

#[test]
fn a_material_answers_to_its_aliases() {
    let folder = TempDir::new().unwrap();
    let card = ok(folder.path(), &["materials", "show", "RHA"]);
    for part in [
        "id                      rha-class-1-plate",
        "group                   steel",
        "aliases                 rha, rolled-homogeneous-armour,",
        "Brinell hardness        364",
    ] {
        assert!(card.contains(part), "{part:?} is not in:\n{card}");
    }
    let depth = |name: &str| {
        let folder = shot(&CASE.replace("\"copper\"", &format!("\"{name}\"")));
        ok(folder.path(), &["run", "--fast", "shot.toml", "-q"])
    };
    assert_eq!(depth("ofhc"), depth("ofhc-copper"));
    for (name, parts) in [
        (
            "5083",
            &["several materials", "`5083-h112`, `5083-h116`"][..],
        ),
        ("Dyneema", &["delaminating", "percuss limit --shots"]),
        ("A36", &["no published law", "`1006`"]),
    ] {
        let shot = shot(&CASE.replace("\"copper\"", &format!("\"{name}\"")));
        let said = percuss(shot.path(), ["run", "shot.toml"]);
        assert_eq!(said.code, 2);
        for part in parts {
            assert!(flat(&said.stderr).contains(part), "{}", said.stderr);
        }
    }
}

#[test]
fn flow_curves_are_compared() {
    let folder = TempDir::new().unwrap();
    let said = ok(
        folder.path(),
        &["materials", "compare", "ofhc", "4340", "--rate", "1 1/s"],
    );
    // 90 + 292 · 0.1^0.31 and 792 + 510 · 0.1^0.26 MPa.
    for part in ["ofhc-copper-johnson-cook", "233", "1072"] {
        assert!(said.contains(part), "{said}");
    }
    let line = ["materials", "compare", "rha", "1006", "--out", "curves"];
    let files = ok(folder.path(), &line);
    assert!(files.contains("flow-curves.json"), "{files}");
    let text = fs::read_to_string(folder.path().join("curves/flow-curves.json")).unwrap();
    let curves = json(&text);
    assert_eq!(curves.as_array().unwrap().len(), 4);
    assert_eq!(curves[2]["material"], "1006-johnson-cook");
    // Without strain the law has its yield stress, but for the strain where its slope begins.
    let first = curves[2]["flow_stress_mpa"][0].as_f64().unwrap();
    assert!((350.0..350.2).contains(&first), "{first}");
    let svg = fs::read_to_string(folder.path().join("curves/flow-curves.svg")).unwrap();
    assert!(svg.contains("Flow stress (MPa)") && svg.contains("rha-class-1-plate"));
    for (option, part) in [("--rate=5", "unit"), ("--temperature=1e9 K", "6e3 K")] {
        let said = percuss(folder.path(), ["materials", "compare", "rha", option]);
        assert_eq!(said.code, 2);
        assert!(flat(&said.stderr).contains(part), "{}", said.stderr);
    }
}
