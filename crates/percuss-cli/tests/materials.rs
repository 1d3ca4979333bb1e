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
fn the_list_has_the_brinell_hardness() {
    let folder = TempDir::new().unwrap();
    let text = ok(folder.path(), &["materials", "2139-t8"]);
    let words = |line: usize| -> Vec<&str> {
        let line = text.lines().nth(line).unwrap();
        line.split_whitespace().collect()
    };
    assert_eq!(words(0)[5..], ["HB", "trust"], "{text}");
    assert_eq!(words(1)[4..], ["2810", "153", "B"], "{text}");
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
        (&["--hardness", "400..200"], "reversed: write 200..400"),
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
        ("Dyneema", &["delaminating", "percuss limit --tests"]),
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

/// Records go to a deck and back, and a case runs with them.
#[test]
fn a_deck_is_written_and_read_and_run() {
    let folder = TempDir::new().unwrap();
    let here = folder.path();
    let deck = [
        "materials",
        "export",
        "4340",
        "ofhc",
        "--format",
        "ls-dyna",
        "--units",
        "mm-kg-ms",
        "--out",
        "metals.k",
    ];
    assert!(ok(here, &deck).contains("metals.k"));
    let import = ["materials", "import", "metals.k", "--units", "mm-kg-ms"];
    let said = percuss(here, import);
    assert!(
        said.stderr.contains("warning:") && said.stderr.contains("D3 = 2.12 is taken as -2.12"),
        "{}",
        said.stderr
    );
    assert!(
        said.stdout.contains("[4340-steel-johnson-cook]"),
        "{}",
        said.stdout
    );
    assert!(said.stdout.contains("a = \"792 MPa\""), "{}", said.stdout);
    fs::write(here.join("metals.toml"), &said.stdout).unwrap();
    let case = "material_files = ['metals.toml']\n\
        projectile = { material = 'ofhc-copper-johnson-cook', length = '12 mm', diameter = '4 mm', impact_velocity = '300 m/s' }\n\
        target = { material = '4340-steel-johnson-cook', thickness = '25 mm' }\n";
    fs::write(here.join("own.toml"), case).unwrap();
    let library = case.lines().skip(1).collect::<Vec<_>>().join("\n");
    let library = library.replace("4340-steel-johnson-cook", "4340-johnson-cook");
    fs::write(here.join("library.toml"), library).unwrap();
    let depth = |name: &str| {
        let text = ok(here, &["run", name, "--fast", "--json"]);
        json(&text)["results"][0]["depth_of_penetration_mm"]
            .as_f64()
            .unwrap()
    };
    let (own, library) = (depth("own.toml"), depth("library.toml"));
    assert!((own / library - 1.0).abs() < 1e-2, "{own} {library}");

    for (words, code, said) in [
        (
            vec![
                "materials",
                "import",
                "metals.k",
                "--units",
                "mm-kg-ms",
                "--file",
                "own.toml",
            ],
            2,
            "`--file` has no effect with `materials import`",
        ),
        (
            vec!["materials", "import", "gone.k", "--units", "mm-kg-ms"],
            4,
            "give the path of a file that exists",
        ),
        (
            vec!["materials", "export", "4340", "--out", "gone/steel.toml"],
            4,
            "make its folder first",
        ),
    ] {
        let refused = percuss(here, words);
        assert_eq!(refused.code, code, "{}", refused.stderr);
        assert!(refused.stderr.contains(said), "{}", refused.stderr);
    }
    let wrong = percuss(
        here,
        ["materials", "import", "metals.k", "--units", "mm-t-s"],
    );
    assert_eq!((wrong.code, wrong.stdout.as_str()), (2, ""));
    for words in ["metals.k:", "density", "the deck was read in mm-t-s"] {
        assert!(flat(&wrong.stderr).contains(words), "{}", wrong.stderr);
    }
}

/// TOML that is exported is a file of materials; what a deck cannot say is refused.
#[test]
fn exported_records_are_read_and_refusals_have_reasons() {
    let folder = TempDir::new().unwrap();
    let here = folder.path();
    let text = ok(here, &["materials", "export", "rha", "copper"]);
    fs::write(here.join("mine.toml"), text).unwrap();
    // By id and by family it is one record.
    let deck = |names: &[&str]| {
        let end = ["--format", "ls-dyna", "--units", "m-kg-s"];
        ok(here, &[&["materials", "export"], names, &end[..]].concat())
    };
    assert_eq!(
        deck(&["4340", "4340-johnson-cook", "4340"]),
        deck(&["4340"])
    );
    let listed = ok(here, &["materials", "--file", "mine.toml", "--json"]);
    assert!(listed.contains("mine.toml"), "{listed}");
    for (arguments, words) in [
        (
            vec!["copper", "--format", "ls-dyna", "--units", "m-kg-s"],
            "`power_law` is no Johnson–Cook law",
        ),
        (
            vec!["rha", "--units", "m-kg-s"],
            "`--units` has an effect with `--format ls-dyna` only",
        ),
        (
            vec!["rha", "--format", "ls-dyna"],
            "`--format ls-dyna` needs `--units`",
        ),
        (
            vec!["rha", "--format", "ls-dyna", "--units", "mm-kg-s"],
            "mm-kg-ms",
        ),
        (vec!["no-such-metal"], "no-such-metal"),
    ] {
        let arguments = [vec!["materials", "export"], arguments].concat();
        let said = percuss(here, &arguments);
        assert_eq!((said.code, said.stdout.as_str()), (2, ""), "{arguments:?}");
        assert!(flat(&said.stderr).contains(words), "{}", said.stderr);
    }
}

#[test]
fn records_go_through_json_and_a_table() {
    let folder = TempDir::new().unwrap();
    let path = folder.path();
    let names = ["ofhc-copper-johnson-cook", "copper-woodward"];
    let toml = ok(path, &[&["materials", "export"], &names[..]].concat());
    for (format, file) in [("json", "two.json"), ("csv", "two.csv")] {
        let more = ["--format", format, "--out", file];
        ok(
            path,
            &[&["materials", "export"], &names[..], &more].concat(),
        );
        let again = ok(path, &["materials", "import", file]);
        assert_eq!(again, toml, "{format}");
    }
    // A spreadsheet adds a column and converts another.
    let table = fs::read_to_string(path.join("two.csv")).unwrap();
    let mut lines = table.lines();
    let header = lines.next().unwrap();
    let rows: Vec<String> = lines.map(|line| format!("{line},12\n")).collect();
    fs::write(
        path.join("more.csv"),
        format!("{header},price\n{}", rows.concat()),
    )
    .unwrap();
    let said = percuss(
        path,
        ["materials", "import", "more.csv", "--out", "more.toml"],
    );
    assert!(
        said.stderr.contains("column `price` is not read"),
        "{}",
        said.stderr
    );
    assert_eq!(fs::read_to_string(path.join("more.toml")).unwrap(), toml);
    for (words, message) in [
        (
            vec!["two.csv", "--units", "mm-t-s"],
            "`--units` has no effect on JSON and tables",
        ),
        (vec!["two.k"], "a deck needs `--units`"),
    ] {
        let said = percuss(path, [vec!["materials", "import"], words].concat());
        assert_eq!(said.code, 2);
        assert!(said.stderr.contains(message), "{}", said.stderr);
    }
}
