use std::{borrow::Cow, fmt};

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::{
    check::{Check, limits},
    units::{Length, Pressure, Temperature},
};

/// What is struck: one plate, several layers, a rigid wall or a constant pressure.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Target {
    /// Material of a target of one layer.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub material: Option<String>,
    /// Thickness of a target of one layer, or `"semi-infinite"`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub thickness: Option<Thickness>,
    /// Temperature before the impact [K], of all layers without their own; `room_temperature` of the material when not given. A difference of up to 5 K counts as none where the model or the strength law has no temperature.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub temperature: Option<Temperature>,
    /// Layers from the struck face to the back, instead of `material` and `thickness`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub layers: Vec<Layer>,
    /// Boundary condition of the rear face; `fixed` when not given, `non-reflecting` behind a semi-infinite layer.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub back_face: Option<RearFaceCondition>,
    /// Diameter of the column of target that is modelled [m]; the projectile's when not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub column_diameter: Option<Length>,
    /// Diameter of the plate inside its support [m]: how far it can dish.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub plate_diameter: Option<Length>,
    /// How the plate is held there; `clamped` when not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub support: Option<EdgeSupport>,
    /// `true` for a rigid, frictionless wall: a Taylor test.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub rigid_wall: bool,
    /// A target that resists with a constant pressure on the projectile's face [Pa], and nothing else.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub constant_pressure: Option<Pressure>,
}

/// One layer of a target.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Layer {
    /// Id or family of a material of the library, or id of one of the case's own.
    pub material: String,
    /// Thickness, or `"semi-infinite"` for the last layer.
    pub thickness: Thickness,
    /// Distance to the layer before it [m]; 0 when not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gap: Option<Length>,
    /// How it is joined to the layer before it; `sliding` when not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub interface: Option<LayerInterface>,
    /// Diameter of the column that is modelled [m]; `column_diameter` of the target when not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub column_diameter: Option<Length>,
    /// Temperature before the impact [K]; `temperature` of the target when not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub temperature: Option<Temperature>,
}

/// How a layer is joined to the one before it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum LayerInterface {
    /// Carries compression only: it opens in tension and may close again.
    #[default]
    Sliding,
    /// Carries tension too, until the material on either side fails.
    Bonded,
}

/// Boundary condition of the rear face of a target.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default, Serialize, Deserialize, JsonSchema,
)]
#[serde(rename_all = "kebab-case")]
pub enum RearFaceCondition {
    /// Does not move; waves come back.
    #[default]
    Fixed,
    /// Moves freely; waves come back with the other sign.
    Free,
    /// Lets elastic waves leave, as if the column went on.
    NonReflecting,
}

impl RearFaceCondition {
    /// Name as the file has it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Fixed => "fixed",
            Self::Free => "free",
            Self::NonReflecting => "non-reflecting",
        }
    }
}

/// How the edge of a plate is held.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum EdgeSupport {
    /// It neither moves nor turns.
    #[default]
    Clamped,
    /// It turns freely.
    SimplySupported,
}

/// Thickness of a layer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Thickness {
    /// A plate [m].
    Finite(Length),
    /// So thick that its rear face does not matter.
    SemiInfinite,
}

const SEMI_INFINITE: &str = "semi-infinite";

impl<'de> Deserialize<'de> for Thickness {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Visitor;

        impl serde::de::Visitor<'_> for Visitor {
            type Value = Thickness;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, "a thickness such as \"25 mm\", or \"{SEMI_INFINITE}\"")
            }

            fn visit_str<E: serde::de::Error>(self, text: &str) -> Result<Thickness, E> {
                if text.trim() == SEMI_INFINITE {
                    return Ok(Thickness::SemiInfinite);
                }
                if !text.contains(|c: char| c.is_ascii_digit()) {
                    return Err(E::custom(format!(
                        "`{}` is no thickness\nallowed: a thickness such as \"25 mm\", or \"{SEMI_INFINITE}\"",
                        crate::units::shorten(text)
                    )));
                }
                text.parse()
                    .map(Thickness::Finite)
                    .map_err(|error| E::custom(format!("{error}; or write \"{SEMI_INFINITE}\"")))
            }

            // A number without its unit is answered as it is everywhere else.
            fn visit_i64<E: serde::de::Error>(self, number: i64) -> Result<Thickness, E> {
                self.visit_str(&number.to_string())
            }

            fn visit_f64<E: serde::de::Error>(self, number: f64) -> Result<Thickness, E> {
                self.visit_str(&number.to_string())
            }
        }

        deserializer.deserialize_any(Visitor)
    }
}

impl Serialize for Thickness {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Finite(length) => length.serialize(serializer),
            Self::SemiInfinite => serializer.serialize_str(SEMI_INFINITE),
        }
    }
}

impl JsonSchema for Thickness {
    fn schema_name() -> Cow<'static, str> {
        "Thickness".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "anyOf": [generator.subschema_for::<Length>(), { "const": SEMI_INFINITE }],
        })
    }
}

impl From<Length> for Thickness {
    fn from(length: Length) -> Self {
        Self::Finite(length)
    }
}

impl Target {
    /// One plate, or one semi-infinite target.
    pub fn plate(material: impl Into<String>, thickness: impl Into<Thickness>) -> Self {
        Self {
            material: Some(material.into()),
            thickness: Some(thickness.into()),
            ..Self::default()
        }
    }

    /// Layers from the struck face to the rear face.
    pub fn layers(layers: impl IntoIterator<Item = Layer>) -> Self {
        Self {
            layers: layers.into_iter().collect(),
            ..Self::default()
        }
    }

    /// A rigid, frictionless wall: a Taylor test.
    pub fn rigid_wall() -> Self {
        Self {
            rigid_wall: true,
            ..Self::default()
        }
    }

    /// A constant pressure on the projectile's face.
    pub fn constant_pressure(pressure: Pressure) -> Self {
        Self {
            constant_pressure: Some(pressure),
            ..Self::default()
        }
    }

    /// The same with a boundary condition at the rear face.
    #[must_use]
    pub fn with_back_face(self, back_face: RearFaceCondition) -> Self {
        Self {
            back_face: Some(back_face),
            ..self
        }
    }

    /// The same at a temperature before the impact.
    #[must_use]
    pub fn with_temperature(self, temperature: Temperature) -> Self {
        Self {
            temperature: Some(temperature),
            ..self
        }
    }
}

impl Layer {
    /// A layer that lies on the one before it.
    pub fn new(material: impl Into<String>, thickness: impl Into<Thickness>) -> Self {
        Self {
            material: material.into(),
            thickness: thickness.into(),
            gap: None,
            interface: None,
            column_diameter: None,
            temperature: None,
        }
    }

    /// The same at a temperature before the impact.
    #[must_use]
    pub fn with_temperature(self, temperature: Temperature) -> Self {
        Self {
            temperature: Some(temperature),
            ..self
        }
    }

    /// Whether anything is given that only a model with separate layers can take.
    fn is_separate(&self) -> bool {
        self.gap.is_some_and(|gap| gap.si() > 0.0)
            || self.interface == Some(LayerInterface::Bonded)
            || self.column_diameter.is_some()
    }

    fn check_joint(&self, is_first: bool, check: &mut Check<'_>) {
        if is_first {
            for (key, given) in [
                ("gap", self.gap.is_some()),
                ("interface", self.interface.is_some()),
            ] {
                if given {
                    check.fail(
                        key,
                        format!("the first layer has no layer before it: `{key}` has no effect"),
                        "remove the key, or move it to the layer behind the gap or interface",
                    );
                }
            }
        }
        if let Some(gap) = self.gap {
            check.quantity("gap", gap, limits::GAP);
            if self.interface == Some(LayerInterface::Bonded) && gap.si() > 0.0 {
                check.fail(
                    "interface",
                    "a layer behind a gap is bonded to nothing",
                    "remove `gap`, or use interface = \"sliding\"",
                );
            }
        }
        check.quantity("column_diameter", self.column_diameter, limits::DIAMETER);
    }
}

impl Target {
    /// The layers, whether the target is written as one plate or as several layers, with the keys they stand under.
    pub fn layers_with_keys(&self) -> Vec<(String, Layer)> {
        match (&self.material, self.thickness) {
            (Some(material), Some(thickness)) if self.layers.is_empty() => {
                let layer = Layer::new(material.clone(), thickness);
                vec![("target".to_owned(), layer)]
            }
            _ => self
                .layers
                .iter()
                .enumerate()
                .map(|(i, layer)| (format!("target.layers.{i}"), layer.clone()))
                .collect(),
        }
    }

    /// Whether a layer has a gap, is bonded or has a diameter of its own.
    pub fn has_separate_layers(&self) -> bool {
        self.layers.iter().any(Layer::is_separate)
    }

    /// Whether there is a column of material, rather than a wall or a pressure.
    pub fn is_solid(&self) -> bool {
        self.material.is_some() || self.thickness.is_some() || !self.layers.is_empty()
    }

    /// Whether the last layer goes on for ever.
    fn is_semi_infinite(&self) -> bool {
        self.thickness == Some(Thickness::SemiInfinite)
            || self
                .layers
                .last()
                .is_some_and(|layer| layer.thickness == Thickness::SemiInfinite)
    }

    /// The target in words if nothing can come out behind it.
    pub fn without_back_in_words(&self) -> Option<&'static str> {
        if self.rigid_wall {
            Some("a rigid wall")
        } else if self.constant_pressure.is_some() {
            Some("a constant pressure")
        } else {
            self.is_semi_infinite().then_some("a semi-infinite target")
        }
    }

    /// Reports values that are not allowed, each with its key, its allowed range and a remedy.
    pub fn check(&self, check: &mut Check<'_>) {
        let plate = self.material.is_some() || self.thickness.is_some();
        let kinds = [
            (plate, "material and thickness"),
            (!self.layers.is_empty(), "layers"),
            (self.rigid_wall, "rigid_wall"),
            (self.constant_pressure.is_some(), "constant_pressure"),
        ];
        let given: Vec<&str> = kinds
            .iter()
            .filter(|kind| kind.0)
            .map(|kind| kind.1)
            .collect();
        match given.as_slice() {
            [] => check.fail(
                "",
                "the target is not described",
                "give `material` and `thickness`, or `layers`, or `rigid_wall = true`, or `constant_pressure`",
            ),
            [_] => {}
            _ => check.fail(
                "",
                format!("the target is described in several ways: {}", given.join("; ")),
                "keep one of them",
            ),
        }
        if plate && self.material.is_none() {
            check.fail(
                "",
                "the target has a thickness but no material",
                "add `material`",
            );
        }
        if plate && self.thickness.is_none() {
            check.fail(
                "",
                "the target has a material but no thickness",
                "add `thickness`, for example thickness = \"25 mm\" or thickness = \"semi-infinite\"",
            );
        }
        if let Some(Thickness::Finite(thickness)) = self.thickness {
            check.quantity("thickness", thickness, limits::LENGTH);
        }
        for (i, layer) in self.layers.iter().enumerate() {
            let mut check = check.within(&format!("layers.{i}"));
            match layer.thickness {
                Thickness::Finite(thickness) => {
                    check.quantity("thickness", thickness, limits::LENGTH);
                }
                Thickness::SemiInfinite if i + 1 < self.layers.len() => check.fail(
                    "thickness",
                    "a semi-infinite layer has layers behind it",
                    "only the last layer can be semi-infinite",
                ),
                Thickness::SemiInfinite => {}
            }
            layer.check_joint(i == 0, &mut check);
            check.quantity("temperature", layer.temperature, limits::TEMPERATURE);
        }
        check.quantity("column_diameter", self.column_diameter, limits::DIAMETER);
        if let Some(diameter) = self.plate_diameter {
            check.quantity("plate_diameter", diameter, limits::DIAMETER);
        } else if self.support.is_some() {
            check.fail(
                "support",
                "a support has no effect without the diameter of the plate",
                "add `plate_diameter`, or remove `support`",
            );
        }
        check.quantity(
            "constant_pressure",
            self.constant_pressure,
            limits::CONTACT_PRESSURE,
        );
        if self.is_semi_infinite()
            && self
                .back_face
                .is_some_and(|face| face != RearFaceCondition::NonReflecting)
        {
            check.fail(
                "back_face",
                "a semi-infinite target has no rear face that is fixed or free",
                "remove `back_face`, or give a thickness",
            );
        }
        let solid = self.is_solid();
        if let Some(temperature) = self.temperature {
            check.quantity("temperature", temperature, limits::TEMPERATURE);
            if !solid {
                check.fail(
                    "temperature",
                    "a rigid wall or a constant pressure has no temperature",
                    "remove `temperature`",
                );
            }
        }
        if self.plate_diameter.is_some() && !solid {
            check.fail(
                "plate_diameter",
                "a rigid wall or a constant pressure is no plate",
                "remove `plate_diameter`",
            );
        }
        if self.back_face.is_some() && !solid {
            check.fail(
                "back_face",
                "a rigid wall or a constant pressure has no rear face",
                "remove `back_face`",
            );
        }
        if self.column_diameter.is_some() && !solid {
            check.fail(
                "column_diameter",
                "a rigid wall or a constant pressure has no column of material",
                "remove `column_diameter`",
            );
        }
    }
}
