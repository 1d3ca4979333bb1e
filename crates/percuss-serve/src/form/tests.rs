use super::*;

fn field(key: &str) -> Field {
    let fields = fields();
    let found = fields.into_iter().find(|field| field.key == key);
    found.unwrap_or_else(|| panic!("no field {key}"))
}

#[test]
fn fields_follow_from_the_schema() {
    for (key, _) in COMMON {
        assert!(field(key).common, "{key}");
    }
    let Kind::Quantity {
        units,
        usual,
        words,
    } = field("target.thickness").kind
    else {
        panic!("no quantity");
    };
    assert!(
        units
            .iter()
            .any(|unit| unit.symbol == "mm" && unit.factor == 1e-3)
    );
    assert_eq!(
        (usual.as_str(), words),
        ("mm", vec!["semi-infinite".to_owned()])
    );
    let Kind::Choice { choices } = field("projectile.nose").kind else {
        panic!("no choice");
    };
    assert!(choices.contains(&"\"flat\"".to_owned()), "{choices:?}");
    assert!(
        choices.contains(&"{ ogive = { crh = 1.0 } }".to_owned()),
        "{choices:?}"
    );
    assert!(
        choices.contains(&"{ cone = { length_to_diameter = 1.0 } }".to_owned()),
        "{choices:?}"
    );
    let Kind::Choice { choices } = field("projectile.nose.cone").kind else {
        panic!("no choice");
    };
    assert!(choices.contains(&"{ angle = \"30 deg\" }".to_owned()));
    assert!(matches!(
        field("projectile.nose.cone.half_angle"),
        Field {
            kind: Kind::Quantity { .. },
            alternative: true,
            ..
        }
    ));
    let Kind::Choice { choices } = field("chain.target_resistance").kind else {
        panic!("no choice");
    };
    assert!(choices.contains(&"\"expanding-cavity\"".to_owned()));
    assert!(field("projectile.nose.ogive.crh").nested);
    assert_eq!(field("projectile.material").kind, Kind::Material);
    assert_eq!(field("chain.rate_effects").kind, Kind::Boolean);
    assert!(matches!(
        field("chain.projectile_elements").kind,
        Kind::Number { integer: true, .. }
    ));
}

#[test]
fn defaults_are_those_of_the_schema() {
    let schema = case::schema();
    let chain = &schema["$defs"]["ChainOptions"]["properties"];
    let fields: Vec<Field> = fields().into_iter().collect();
    let mut shown = 0;
    for (name, property) in object(chain) {
        let key = format!("chain.{name}");
        let Some(field) = fields.iter().find(|field| field.key == key) else {
            continue;
        };
        let default = field.default.as_ref().map(|default| {
            let text = format!("x = {default}");
            let table: toml::Table = text.parse().unwrap();
            serde_json::to_value(&table["x"]).unwrap()
        });
        assert_eq!(default.as_ref(), property.get("default"), "{key}");
        if let Some(default) = &field.default {
            assert!(
                field.help.ends_with(&format!(" Default: {default}.")),
                "{key}"
            );
            shown += 1;
        }
    }
    assert!(shown > 10, "{shown}");
    assert_eq!(field("chain.heat_fraction").default.unwrap(), "0.9");
    assert_eq!(field("chain.courant").default.unwrap(), "0.8");
}

#[test]
fn every_choice_is_toml() {
    for field in fields() {
        if let Kind::Choice { choices } = field.kind {
            for choice in choices {
                let text = format!("x = {choice}");
                assert!(
                    text.parse::<toml::Table>().is_ok(),
                    "{}: {choice}",
                    field.key
                );
            }
        }
    }
}

#[test]
fn values_stand_under_their_keys() {
    let values = values("a.b = \"1 mm\"\nc = [{ d = 2 }, { d = nan }]\ne = true");
    assert_eq!(values["a.b"], "1 mm");
    assert_eq!(values["c.0.d"], json!({ "number": "2" }));
    assert_eq!(values["c.1.d"], json!({ "number": "nan" }));
    assert_eq!(values["e"], true);
    assert!(super::values("a = [").is_empty());
    let long = "k".repeat(10_000);
    let values = super::values(&format!("a = 1\n[{long}]\nb = 1\nc = 2"));
    assert_eq!(values.keys().collect::<Vec<_>>(), ["a"]);
}
