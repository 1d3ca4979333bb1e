//! Cases that are built in code, and tables of models that are not part of percuss.

use percuss::{
    Error, case,
    case::{Case, Layer, Nose, Projectile, RearFaceCondition, Target, Thickness},
    units::{Length, Pressure, Velocity},
};
use serde::{Deserialize, Serialize};

fn mm(value: f64) -> Length {
    Length::new(1e-3 * value)
}

fn rod() -> Projectile {
    Projectile::rod("copper", mm(12.74), mm(4.8), Velocity::new(230.0))
}

#[test]
fn a_case_built_in_code_is_that_of_the_same_text() {
    let text = r#"
        [projectile]
        material = "copper"
        length = "12.74 mm"
        diameter = "4.8 mm"
        impact_velocity = "230 m/s"
        nose = "hemisphere"
        [target]
        back_face = "free"
        [[target.layers]]
        material = "aluminium-2024-t351"
        thickness = "10 mm"
        [[target.layers]]
        material = "weldox-460-e"
        thickness = "semi-infinite"
        "#;
    let text = text.replace("back_face = \"free\"", "");
    let layers = [
        Layer::new("aluminium-2024-t351", mm(10.0)),
        Layer::new("weldox-460-e", Thickness::SemiInfinite),
    ];
    let built = Case::new(rod().with_nose(Nose::Hemisphere), Target::layers(layers));
    assert_eq!(
        built.scenario("same").unwrap(),
        case::load_str("same", &text).unwrap()
    );
    let plate =
        Target::plate("aluminium-2024-t351", mm(25.0)).with_back_face(RearFaceCondition::Free);
    let scenario = Case::new(rod(), plate).scenario("plate").unwrap();
    assert_eq!(scenario.target_thickness(), Some(0.025));
    for target in [
        Target::rigid_wall(),
        Target::constant_pressure(Pressure::new(1e9)),
    ] {
        assert!(Case::new(rod(), target).scenario("body").is_ok());
    }
}

#[test]
fn what_is_wrong_with_a_case_built_in_code_is_named_by_its_key() {
    let error = |case: Case| match case.scenario("built") {
        Err(Error::Input(error)) => (error.key.clone(), error.to_string()),
        other => panic!("{other:?}"),
    };
    let thin = Target::plate("aluminium-2024-t351", mm(-1.0));
    let (key, message) = error(Case::new(rod(), thin));
    assert_eq!(key, "target.thickness");
    assert!(
        message.starts_with("built: `target.thickness`"),
        "{message}"
    );
    let unknown = Target::plate("unobtainium", mm(1.0));
    assert_eq!(error(Case::new(rod(), unknown)).0, "target.material");
    let mut files = Case::new(rod(), Target::rigid_wall());
    files.material_files.push("steel.toml".into());
    assert_eq!(error(files).0, "material_files");
}

#[derive(Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct Options {
    factor: f64,
}

#[test]
fn a_table_of_another_model_is_read_and_written() {
    let text = r#"
        projectile = { material = "copper", length = "12.74 mm", diameter = "4.8 mm", impact_velocity = "230 m/s" }
        target = { rigid_wall = true }
        extensions.mine = { factor = 2.5 }
        "#;
    let scenario = case::load_str("extended", text).unwrap();
    let mine: Options = scenario.extensions.read("mine").unwrap();
    assert_eq!(mine, Options { factor: 2.5 });
    let other: Options = scenario.extensions.read("other").unwrap();
    assert_eq!(other, Options::default());
    let mut built = Case::new(rod(), Target::rigid_wall());
    built.extensions.set("mine", &mine).unwrap();
    assert_eq!(built.scenario("extended").unwrap(), scenario);

    let slip = case::load_str("extended", &text.replace("factor", "fector")).unwrap();
    let error = slip.extensions.read::<Options>("mine").unwrap_err();
    let said = error.to_string();
    assert!(
        said.contains("`extensions.mine`") && said.contains("fector"),
        "{said}"
    );
}
