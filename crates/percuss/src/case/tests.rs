use super::*;
use crate::error::{Error, Subject};

const SHORT: &str = r#"
projectile = { material = "copper", length = "12.74 mm", diameter = "4.8 mm", velocity = "230 m/s" }
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
        ("\"aluminium-2024-t351\"", "\"tin\"", Subject::Material),
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
    let read = Document::new("short", files).in_folder(&folder).scenario();
    std::fs::remove_dir_all(&folder).unwrap();
    let Err(Error::Input(error)) = read else {
        panic!("a file of materials with an error");
    };
    assert_eq!(error.subject, Subject::Material);
    assert!(error.file.ends_with("mine.toml"), "{}", error.file);
}
