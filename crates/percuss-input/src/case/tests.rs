use super::*;
use crate::error::{Error, Subject};

const SHORT: &str = r#"
projectile = { material = "copper", length = "12.74 mm", diameter = "4.8 mm", impact_velocity = "230 m/s" }
target = { material = "aluminium-2024-t351", thickness = "25 mm" }
"#;

#[test]
fn a_short_case_resolves() {
    let scenario = load_str("short", SHORT).unwrap();
    assert_eq!(scenario.projectile.material_id, "copper-woodward");
    assert!((scenario.projectile.mass / 1.96e-3 - 1.0).abs() < 1e-3);
}

#[test]
fn an_error_knows_whether_it_is_of_a_material() {
    const MINE: &str = "[materials.mine]\nname = 'mine'\ndensity = '8 g/cm3'\nyoungs_modulus = '100 GPa'\npoissons_ratio = 0.3\n\
                        strength.perfectly_plastic = { flow_stress = '300 MPa' }\n";
    let of = |text: &str| match load_str("short", text) {
        Err(Error::Input(error)) => error.subject,
        other => panic!("{other:?}"),
    };
    let with_mine = format!("{SHORT}{MINE}");
    for (right, wrong, subject) in [
        ("\"copper\"", "\"coper\"", Subject::Material),
        (
            "\"aluminium-2024-t351\"",
            "\"unobtainium\"",
            Subject::Material,
        ),
        ("'8 g/cm3'", "'8 kg/m3'", Subject::Material),
        ("'300 MPa'", "'300 mm'", Subject::Material),
        ("strength.", "strenght.", Subject::Material),
        // The name of a material is text; what is not belongs to the case.
        ("\"copper\"", "5", Subject::Case),
        ("\"12.74 mm\"", "\"12.74 kg\"", Subject::Case),
        ("\"25 mm\"", "\"-1 mm\"", Subject::Case),
        ("target =", "targte =", Subject::Case),
    ] {
        assert_ne!(with_mine.replace(right, wrong), with_mine, "{right}");
        assert_eq!(of(&with_mine.replace(right, wrong)), subject, "{wrong}");
    }
    let files = format!("material_files = ['mine.toml']\n{SHORT}");
    assert_eq!(of(&files), Subject::Material);
    let folder = std::env::temp_dir().join(format!("percuss-subject-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("mine.toml"), "[mine]\nname = 5\n").unwrap();
    let read = super::scenario(&Document::new("short", files).in_folder(&folder));
    std::fs::remove_dir_all(&folder).unwrap();
    let Err(Error::Input(error)) = read else {
        panic!("a file of materials with an error");
    };
    assert_eq!(error.subject, Subject::Material);
    assert!(error.file.ends_with("mine.toml"), "{}", error.file);
}

/// The short case with a nose.
fn with_nose(nose: &str) -> String {
    SHORT.replace("diameter =", &format!("nose = {nose}, diameter ="))
}

#[test]
fn a_nose_is_given_by_any_of_its_dimensions() {
    let scenario =
        |nose: &str| load_str("nose", &with_nose(nose)).unwrap_or_else(|e| panic!("{nose}: {e}"));
    for (known, others) in [
        (
            "{ cone = { length_to_diameter = 0.8660254037844386 } }",
            [
                "{ cone = { angle = '60 deg' } }",
                "{ cone = { half_angle = '30 deg' } }",
            ],
        ),
        (
            "{ ogive = { crh = 1.5 } }",
            [
                "{ ogive = { radius = '7.2 mm' } }",
                // 4.8 mm sqrt(1.25)
                "{ ogive = { length = '5.366563145999495 mm' } }",
            ],
        ),
    ] {
        let expected = scenario(known).projectile;
        for nose in others {
            let found = scenario(nose).projectile;
            let [length, same] = [&found, &expected].map(|rod| rod.nose.length(rod.diameter));
            assert!((length / same - 1.0).abs() < 1e-14, "{nose}");
            assert!((found.mass / expected.mass - 1.0).abs() < 1e-14, "{nose}");
            // A case keeps the dimension that it was given, and gives the same bits from its own text.
            let case: Case = Document::new("nose", with_nose(nose)).parse().unwrap();
            let text = toml::to_string(&case).unwrap();
            let again: Case = Document::new("nose", text.clone()).parse().unwrap();
            assert_eq!(again, case, "{text}");
            assert_eq!(load_str("nose", &text).unwrap().projectile, found, "{text}");
        }
    }
}

#[test]
fn the_angle_of_a_cone_is_varied() {
    let template = |nose: &str| Template::of(&Document::new("nose", with_nose(nose))).unwrap();
    let cone = template("{ cone = { angle = '90 deg' } }");
    let varied = |template: &Template, key: &str| {
        template.scenario(&[(key, toml::Value::String("60 deg".to_owned()))])
    };
    let found = varied(&cone, "projectile.nose.cone.angle").unwrap();
    let written = load_str("nose", &with_nose("{ cone = { angle = '60 deg' } }")).unwrap();
    assert_eq!(found.projectile, written.projectile);
    // A second dimension beside that of the case would contradict it.
    let by_length = template("{ cone = { length_to_diameter = 0.5 } }");
    let refused = varied(&by_length, "projectile.nose.cone.angle").unwrap_err();
    assert_eq!(refused[0].key, "projectile.nose.cone.angle");
    assert!(
        refused[0]
            .message
            .contains("`cone.length_to_diameter`, not by `cone.angle`")
    );
    assert!(
        refused[0]
            .help
            .contains("projectile.nose.cone.length_to_diameter")
    );
    assert!(varied(&cone, "projectile.nose.ogive.radius").is_err());
}

#[test]
fn yaw_is_known_and_refused() {
    let with = |yaw: &str| {
        load_str(
            "yaw",
            &SHORT.replace("diameter =", &format!("yaw = '{yaw}', diameter =")),
        )
    };
    assert_eq!(with("0 deg").unwrap(), load_str("yaw", SHORT).unwrap());
    let error = with("2 deg").unwrap_err().to_string();
    assert!(error.contains("no model computes yaw"), "{error}");
}

#[test]
fn digits_are_an_index_in_a_list_and_a_key_in_a_table() {
    const LAYERS: &str = "[target]\nlayers = [{ material = '7075', thickness = '10 mm' }, { material = 'copper', thickness = '5 mm' }]\n";
    let with = |text: &str| {
        let text = format!(
            "[projectile]\nmaterial = '4340'\nlength = '20 mm'\ndiameter = '5 mm'\nimpact_velocity = '300 m/s'\n{LAYERS}{text}"
        );
        Template::of(&Document::new("digits", text))
    };
    let material = |id: &str, density: &str| {
        format!(
            "[materials.{id}]\nname = '{id}'\ndensity = '{density}'\nyoungs_modulus = '200 GPa'\npoissons_ratio = 0.3\n\
             strength.perfectly_plastic = {{ flow_stress = '1 GPa' }}\n"
        )
    };
    let own = format!(
        "{}{}",
        material("4340", "7.85 g/cm3"),
        material("7075", "2.8 g/cm3")
    );
    let template = with(&own).unwrap();
    let change = |key: &str, value: &str| template.scenario(&[(key, value.into())]);
    let denser = change("materials.4340.density", "8 g/cm3").unwrap();
    assert_eq!(denser.projectile.material.density.si(), 8000.0);
    let constant = "materials.7075.strength.perfectly_plastic.flow_stress";
    let harder = change(constant, "2 GPa").unwrap();
    let before = template.scenario(&[]).unwrap();
    assert_ne!(
        format!("{:?}", harder.target),
        format!("{:?}", before.target)
    );
    let thicker = change("target.layers.1.thickness", "6 mm").unwrap();
    assert!((thicker.target_thickness().unwrap() - 16e-3).abs() < 1e-12);
    let said = |key: &str| {
        let diagnostics = change(key, "1 mm").unwrap_err();
        diagnostics[0].message.clone()
    };
    for (key, message) in [
        (
            "target.layers.2.thickness",
            "the case has no `target.layers.2`: the list has 2 entries, counted from 0",
        ),
        ("projectile.0.length", "the case has no list `projectile`"),
        (
            "target.plates.0.thickness",
            "the case has no list `target.plates`",
        ),
        (
            "projectile.length.0",
            "the case has no list `projectile.length`",
        ),
        ("materials.4130.density", "no material is named `4130`"),
        (
            "materials.4340.strength.johnson_cook.a",
            "`4340` has the strength law `perfectly_plastic`, not `johnson_cook`",
        ),
    ] {
        assert_eq!(said(key), message, "{key}");
    }
}

#[test]
fn a_key_may_name_the_material_by_its_family_or_an_alias() {
    let text = "projectile = { material = 'copper', length = '20 mm', diameter = '5 mm', impact_velocity = '300 m/s' }\n\
                target = { material = 'aluminium-2024-t351', thickness = '25 mm' }\n";
    let template = Template::of(&Document::new("names", text)).unwrap();
    for name in ["copper", "cu", "copper-woodward"] {
        let key = format!("materials.{name}.density");
        let denser = template.scenario(&[(&key, "9 g/cm3".into())]).unwrap();
        assert_eq!(denser.projectile.material.density.si(), 9000.0, "{name}");
        let record = template.material(name, &[(&key, "9 g/cm3".into())]);
        assert_eq!(record.unwrap().unwrap().density.si(), 9000.0, "{name}");
        assert_eq!(template.unused_material(&key), None);
    }
    let other = "materials.4340.density";
    assert_eq!(template.unused_material(other), Some("4340"));
    assert_eq!(template.unused_material("target.thickness"), None);
}
