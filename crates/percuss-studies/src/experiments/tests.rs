use std::collections::{BTreeMap, BTreeSet};

use super::*;
use crate::{
    Error,
    material::{cavity_expansion_pressure, references},
    scenario::TargetBody,
};

const HEADER: &str = "id,kind,projectile_material,diameter_mm,mass_g,impact_velocity_m_s,target_material,thickness_mm,measured,unit";

fn read_rows(rows: &str) -> Result<Vec<Experiment>, Error> {
    read_str(
        "mine.csv",
        &format!("{HEADER}\n{rows}\n"),
        Library::built_in(),
    )
}

/// Line, column, text at the place, message and help of an error.
fn refused(text: &str) -> (usize, String, String, String, String) {
    match read_str("mine.csv", text, Library::built_in()) {
        Err(Error::Input(error)) => (
            error.line(),
            error.key.clone(),
            error.text[error.span.clone()].to_owned(),
            error.message.clone(),
            error.help.clone(),
        ),
        other => panic!("{other:?}"),
    }
}

#[test]
fn built_in_tests_are_complete() {
    let tests = built_in();
    // Every row of every file.
    let rows =
        |(_, text): &(&str, &str)| csv::Reader::from_reader(text.as_bytes()).records().count();
    assert_eq!(tests.len(), FILES.iter().map(rows).sum::<usize>());
    assert!(tests.len() >= 1133);
    let mut ids = BTreeSet::new();
    for test in tests {
        assert!(ids.insert(&test.id), "{}", test.id);
        assert!(
            references().contains_key(&test.source),
            "{}: {}",
            test.id,
            test.source
        );
        for (what, text) in [
            ("read_at", &test.read_at),
            ("licence", &test.licence),
            ("class", &test.projectile_class),
        ] {
            assert!(!text.is_empty(), "{}: {what}", test.id);
        }
        assert_ne!(test.trust, Trust::User, "{}", test.id);
    }
}

#[test]
fn built_in_files_have_the_columns_as_documented() {
    let names: Vec<&str> = COLUMNS.iter().map(|column| column.name).collect();
    let readme = include_str!("../../data/experiments/README.md");
    for (file, text) in FILES {
        assert_eq!(
            text.lines().next(),
            Some(names.join(",").as_str()),
            "{file}"
        );
        assert!(readme.contains(&format!("`{file}`")), "{file}");
    }
    for name in names {
        assert!(readme.contains(&format!("| `{name}` |")), "{name}");
    }
    let sources: BTreeSet<&str> = built_in().iter().map(|test| test.source.as_str()).collect();
    for source in sources {
        assert!(readme.contains(&format!("`{source}`")), "{source}");
    }
}

#[test]
fn no_repeated_row_counts_twice() {
    // What makes two rows the same measurement.
    let key = |test: &Experiment| {
        format!(
            "{:?} {} {:?} {:?} {:?} {} {} {:?} {} {:?}",
            test.kind,
            test.source,
            test.length,
            test.diameter,
            test.temperature,
            test.impact_velocity,
            test.obliquity_deg,
            test.target,
            test.measured,
            test.uncertainty,
        )
    };
    let mut seen = BTreeMap::new();
    for test in built_in().iter().filter(|test| test.counts()) {
        if let Some(other) = seen.insert(key(test), &test.id) {
            panic!("{} repeats {other}", test.id);
        }
    }
    let repeated = built_in().iter().filter(|test| test.duplicate_of.is_some());
    assert_eq!(repeated.clone().count(), 57);
    for test in repeated {
        let first = built_in()
            .iter()
            .find(|other| Some(&other.id) == test.duplicate_of.as_ref());
        assert!(
            first.is_some_and(|first| first.duplicate_of.is_none()),
            "{}",
            test.id
        );
    }
}

#[test]
fn every_usable_normal_test_is_a_case() {
    let mut cases = 0;
    for test in built_in().iter().filter(|test| test.no_case().is_none()) {
        for record in &test.projectile_materials {
            let scenario = test.scenario(record, Library::built_in()).unwrap();
            assert_eq!(scenario.name, test.id);
            assert_eq!(scenario.impact_velocity, test.impact_velocity);
            cases += 1;
        }
    }
    assert!(cases > 1000, "{cases}");
}

#[test]
fn a_plate_yields_where_its_table_says() {
    let test = built_in()
        .iter()
        .find(|test| test.id == "REL-0003")
        .unwrap();
    let scenario = test.scenario("apm2-core", Library::built_in()).unwrap();
    let TargetBody::Layers { layers, .. } = &scenario.target else {
        panic!("{:?}", scenario.target);
    };
    let material = &layers[0].material;
    let yields_at = material
        .strength
        .law()
        .initial_yield_stress(material)
        .unwrap();
    assert!((yields_at / 260e6 - 1.0).abs() < 1e-9, "{yields_at}");
    assert_eq!(material.yield_stress.unwrap().si(), 260e6);
    assert!(cavity_expansion_pressure(material).unwrap() > 4.0 * 260e6);
}

#[test]
fn only_what_was_fitted_is_not_blind() {
    let calibrated: BTreeSet<&str> = built_in()
        .iter()
        .filter(|test| test.split == Split::Calibration)
        .map(|test| test.source.as_str())
        .collect();
    assert_eq!(calibrated, BTreeSet::from(["johnson1983"]));
    let mut splits = BTreeMap::new();
    for test in built_in() {
        let split = splits.entry(&test.source).or_insert(test.split);
        assert_eq!(
            *split, test.split,
            "{} is split within its source",
            test.source
        );
    }
}

#[test]
fn a_file_needs_a_few_columns_only() {
    let tests =
        read_rows("a,ballistic_limit,apm2-core,6.2,5.3,,aluminium-2024-t351,20,500,m/s").unwrap();
    assert_eq!(tests[0].impact_velocity, 500.0);
    assert_eq!(tests[0].projectile_class, "apm2-core");
    assert!((tests[0].mass.unwrap() - 5.3e-3).abs() < 1e-15);
    assert_eq!(tests[0].trust, Trust::User);
    let tests = read_rows("a,taylor,copper,7.6,9,200,rigid-wall,,20,mm").unwrap();
    assert!((tests[0].measured - 0.02).abs() < 1e-15);
}

/// A column of a measured quantity stands for its kind and unit.
#[test]
fn columns_have_names_and_units_of_laboratories() {
    let text = "# Series 4\nProjectile material;Target material;Dia. (in);L [mm];Thickness, mm;Vs (ft/s);Vr (m/s);DoP_mm;Operator\n\
        copper;aluminium-2024-t351;0,3;20;25;1000;;3,5;ab\n\
        copper;aluminium-2024-t351;0,3;20;5;1000;120;;ab\n";
    let text = text.replace("Dia.", "Diameter");
    let file = super::read::file("tests.csv", &text, Library::built_in()).unwrap();
    assert_eq!(file.unread_columns, ["Operator"]);
    assert_eq!(
        file.read_as,
        [
            "`Diameter (in)` as `diameter_mm`, converted",
            "`L [mm]` as `length_mm`",
            "`Vs (ft/s)` as `impact_velocity_m_s`, converted",
            "`Vr (m/s)` as `residual_velocity_m_s`",
            "`DoP_mm` as `depth_of_penetration_mm`",
        ]
    );
    let [depth, residual] = file.tests.as_slice() else {
        panic!("{:?}", file.tests);
    };
    assert_eq!(
        (depth.kind, residual.kind),
        (Kind::Depth, Kind::ResidualVelocity)
    );
    assert_eq!(
        (depth.id.as_str(), residual.id.as_str()),
        ("row 1", "row 2")
    );
    let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-12 * b, "{a} {b}");
    let in_inches = "projectile_material,target_material,diameter_mm,length_mm,thickness_mm,impact_velocity_m_s,DoP (in),uncertainty\n\
        copper,aluminium-2024-t351,5,20,25,300,0.1,0.02\n";
    let tests = super::read_str("tests.csv", in_inches, Library::built_in()).unwrap();
    near(tests[0].measured, 2.54e-3);
    near(tests[0].uncertainty.unwrap(), 0.508e-3);
    near(depth.measured, 3.5e-3);
    near(depth.impact_velocity, 304.8);
    near(depth.diameter.unwrap(), 7.62e-3);
    near(residual.measured, 120.0);

    for (from, to, message, help) in [
        (
            "Vs (ft/s)",
            "Vs",
            "the unit of `Vs` is missing",
            "write `Vs (m/s)`",
        ),
        (
            "DoP_mm",
            "Vres (m/s)",
            "two columns are of `residual_velocity`: `Vr (m/s)` and `Vres (m/s)`",
            "remove one",
        ),
        (
            "Projectile material",
            "Projectile",
            "lacks `projectile_material`",
            "`Projectile` can be one of `projectile_class`, `projectile_material`; ",
        ),
        (
            "Target material",
            "Material",
            "lacks `target_material`",
            "`Material` can be one of `projectile_material`, `target_material`; ",
        ),
        (";3,5;ab", ";;ab", "no measured value", "final_length_mm"),
        (
            "120;;ab",
            "120;3;ab",
            "more than one measured value",
            "a row of its own",
        ),
    ] {
        let found = refused(&text.replace(from, to));
        assert!(found.3.contains(message), "{found:?}");
        assert!(found.4.contains(help), "{found:?}");
    }
}

#[test]
fn results_that_no_impact_can_have_are_refused() {
    let header = HEADER.replace("mass_g", "length_mm");
    for (row, words) in [
        (
            "a,taylor,copper,7.6,20,200,rigid-wall,,20.1,mm",
            "the final length is larger than the length of 20 mm",
        ),
        (
            "a,residual_velocity,copper,7.6,20,200,aluminium-2024-t351,5,201,m/s",
            "larger than the impact velocity",
        ),
    ] {
        let text = format!("{header}\n{row}\n");
        let error = read_str("tests.csv", &text, Library::built_in()).unwrap_err();
        assert!(error.to_string().contains(words), "{error}");
    }
}

#[test]
fn slips_are_found_where_they_are() {
    let good = "a,depth,copper,4.8,2,230,aluminium-2024-t351,25,0.05,mm";
    for (row, column, at, message, help) in [
        (
            good.replace("4.8", "4,8"),
            "id",
            "b",
            "11 fields",
            "double quotes",
        ),
        (
            good.replace("4.8", "4.8 mm"),
            "diameter_mm",
            "4.8 mm",
            "`4.8 mm` is no number",
            "unit is in the name",
        ),
        (
            good.replace("4.8", "nan"),
            "diameter_mm",
            "nan",
            "no number",
            "",
        ),
        (
            good.replace("4.8", "-4.8"),
            "diameter_mm",
            "-4.8",
            "out of range",
            "allowed",
        ),
        (
            good.replace("depth", "dept"),
            "kind",
            "dept",
            "unknown value `dept`",
            "did you mean `depth`? allowed: taylor",
        ),
        (
            good.replace("mm", "m/s"),
            "unit",
            "m/s",
            "unknown value `m/s`",
            "allowed: mm",
        ),
        (
            good.replace("copper", "coper"),
            "projectile_material",
            "coper",
            "no material is named `coper`",
            "did you mean `copper`?",
        ),
        (
            good.replace("aluminium-2024", "\"alu,\""),
            "target_material",
            "\"alu,\"-t351",
            "no material is named",
            "give its properties",
        ),
        (
            good.replace("230", ""),
            "impact_velocity_m_s",
            "",
            "is empty",
            "write its value",
        ),
        (
            good.replace(",2,", ",,"),
            "mass_g",
            "",
            "either `length_mm` or `mass_g`",
            "fill in one",
        ),
        (
            good.replace("0.05", "0"),
            "measured",
            "0",
            "out of range",
            "residual velocity",
        ),
        (
            good.replace("aluminium-2024-t351", "rigid-wall"),
            "target_material",
            "rigid-wall",
            "a rigid wall has no depth",
            "write the material",
        ),
        (
            good.replace("depth", "taylor"),
            "target_material",
            "aluminium-2024-t351",
            "has a rigid wall",
            "rigid-wall",
        ),
        (
            good.replace("25,", "semi-infinte,"),
            "thickness_mm",
            "semi-infinte",
            "is no number",
            "",
        ),
        (
            good.replace("a,depth", "first,depth"),
            "id",
            "first",
            "a second test is named",
            "another id",
        ),
    ] {
        let row = row.replacen("a,", "b,", 1);
        let text = format!(
            "{HEADER}\r\n{}\r\n\r\n{row}\r\n",
            good.replacen("a,", "first,", 1)
        );
        let found = refused(&text);
        assert_eq!((found.0, found.1.as_str()), (4, column), "{row}: {found:?}");
        assert_eq!(found.2.trim_matches(|c| c == ',' || c == '\r'), at, "{row}");
        assert!(found.3.contains(message), "{row}: {found:?}");
        assert!(found.4.contains(help), "{row}: {found:?}");
    }
}

#[test]
fn slips_in_the_first_line_are_found() {
    let found = refused("id,kind\n");
    assert_eq!(found.0, 1);
    assert!(
        found
            .3
            .contains("lacks `projectile_material`, `diameter_mm`"),
        "{found:?}"
    );
    let found = refused(&format!(
        "{}\n",
        HEADER.replace("diameter_mm", "diametr_mm")
    ));
    assert_eq!(
        (found.1.as_str(), found.2.as_str()),
        ("diametr_mm", "diametr_mm")
    );
    assert!(
        found.4.starts_with("did you mean `diameter_mm`?"),
        "{found:?}"
    );
    let found = refused(&format!("{HEADER},id\n"));
    assert!(found.3.contains("two columns are named `id`"), "{found:?}");
    assert!(
        refused(&HEADER.replace(',', ":"))
            .4
            .contains("separated by commas")
    );
    assert!(refused(HEADER).3.contains("no test"));
    assert!(refused("").3.contains("lacks"));
}

#[test]
fn a_hot_rod_starts_hot_and_a_room_is_a_room() {
    let of = |id: &str, record: &str| {
        let test = built_in().iter().find(|test| test.id == id).unwrap();
        test.scenario(record, Library::built_in())
            .unwrap()
            .projectile
            .temperature
    };
    assert_eq!(
        of("TAY-CU-GUSTETP-16", "etp-copper-johnson-cook"),
        Some(718.0)
    );
    assert_eq!(of("TAY-CU-GUSTETP-04", "etp-copper-johnson-cook"), None);
}
