//! Statistics by model, kind of test and one more property.

use std::collections::BTreeMap;

use serde::Serialize;

use super::{Errors, Prediction, Standing, Validation};
use crate::experiments::Kind;

/// What stands between the parts of a group's value.
pub const SEPARATOR: &str = "; ";
/// Value of [`Grouping::All`] for tests with hot projectiles.
pub const HOT: &str = "hot";

/// What predictions are grouped by, beside model and kind.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Grouping {
    /// Nothing, but that hot projectiles stand apart: few models take them.
    All,
    /// Source.
    Source,
    /// Class and material record of the projectile.
    Record,
    /// Class and material record of the projectile, and source.
    RecordAndSource,
    /// Material of the target.
    Target,
    /// Class of the projectile.
    Projectile,
    /// Regime of the case.
    Regime,
    /// Blind or not.
    Split,
}

impl Group {
    /// The model, with what sets the group apart in a table of all tests.
    pub fn model_in_words(&self) -> String {
        if self.grouping == Grouping::All && self.value == HOT {
            format!("{}, {HOT} projectiles", self.model)
        } else {
            self.model.to_owned()
        }
    }
}

impl Grouping {
    /// All of them.
    pub const ALL: [Self; 8] = [
        Self::All,
        Self::Source,
        Self::Record,
        Self::RecordAndSource,
        Self::Target,
        Self::Projectile,
        Self::Regime,
        Self::Split,
    ];

    /// What the groups are, in words.
    pub fn describe(self) -> &'static str {
        match self {
            Self::All => "all",
            Self::Source => "source",
            Self::Record => "projectile and material record",
            Self::RecordAndSource => "projectile, material record and source",
            Self::Target => "target",
            Self::Projectile => "projectile",
            Self::Regime => "regime",
            Self::Split => "split",
        }
    }

    /// What the parts of a group's value are.
    pub fn parts(self) -> &'static [&'static str] {
        match self {
            Self::All => &["all"],
            Self::Source => &["source"],
            Self::Record => &["projectile", "material record"],
            Self::RecordAndSource => &["projectile", "material record", "source"],
            Self::Target => &["target"],
            Self::Projectile => &["projectile"],
            Self::Regime => &["regime"],
            Self::Split => &["split"],
        }
    }

    /// A stable name.
    pub fn name(self) -> &'static str {
        match self {
            Self::All => "all",
            Self::Source => "source",
            Self::Record => "record",
            Self::RecordAndSource => "record_and_source",
            Self::Target => "target",
            Self::Projectile => "projectile",
            Self::Regime => "regime",
            Self::Split => "split",
        }
    }

    /// Whether rival material records have groups of their own; elsewhere a test counts once, with its main record.
    fn tells_records_apart(self) -> bool {
        matches!(self, Self::Record | Self::RecordAndSource)
    }

    fn value(self, validation: &Validation, prediction: &Prediction) -> String {
        let test = validation.test(prediction);
        match self {
            Self::All if test.is_hot() => HOT.to_owned(),
            Self::All => "all".to_owned(),
            Self::Source => test.source.clone(),
            Self::Record => [&*test.projectile_class, &prediction.record].join(SEPARATOR),
            Self::RecordAndSource => {
                [&*test.projectile_class, &prediction.record, &test.source].join(SEPARATOR)
            }
            Self::Target => test.target.name().to_owned(),
            Self::Projectile => test.projectile_class.clone(),
            Self::Regime => prediction.regime.clone(),
            Self::Split => prediction.split.name().to_owned(),
        }
    }
}

/// Statistics of one group.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Group {
    /// Name of the model.
    pub model: &'static str,
    /// Kind of test.
    pub kind: Kind,
    /// What the group is made by.
    pub grouping: Grouping,
    /// What its members have in common.
    pub value: String,
    /// Statistics of their errors.
    #[serde(flatten)]
    pub errors: Errors,
}

/// Statistics of all groups that have counted predictions, in the order of kinds, models and values.
pub fn statistics(validation: &Validation, grouping: Grouping) -> Vec<Group> {
    type Key = (Kind, usize, String);
    let mut groups: BTreeMap<Key, Vec<(f64, &str)>> = BTreeMap::new();
    for prediction in &validation.predictions {
        let counted = prediction.standing == Standing::Counted
            && (prediction.main_record || grouping.tells_records_apart());
        let (true, Some(error)) = (counted, prediction.relative_error) else {
            continue;
        };
        let test = validation.test(prediction);
        let model = place(validation, prediction.model);
        groups
            .entry((test.kind, model, grouping.value(validation, prediction)))
            .or_default()
            .push((error, &test.id));
    }
    groups
        .into_iter()
        .filter_map(|((kind, model, value), errors)| {
            Some(Group {
                model: validation.models[model],
                kind,
                grouping,
                value,
                errors: Errors::of(errors)?,
            })
        })
        .collect()
}

/// What became of the tests of one kind with one model: how many stand where, and why the rest is not counted.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Coverage {
    /// Name of the model.
    pub model: &'static str,
    /// Kind of test.
    pub kind: Kind,
    /// How many tests stand where, with their main record, in the order of [`Standing::ALL`].
    pub standings: [usize; Standing::ALL.len()],
    /// The commonest reason for no prediction, and how many tests it holds for.
    pub reason: Option<(String, usize)>,
}

impl Coverage {
    /// How many tests stand there.
    pub fn count(&self, standing: Standing) -> usize {
        self.standings[standing as usize]
    }

    /// Whether the model gives the quantity that this kind of test measures.
    pub fn is_given(&self) -> bool {
        self.count(Standing::NotGiven) == 0
    }

    /// How many tests there are.
    pub fn total(&self) -> usize {
        self.standings.iter().sum()
    }
}

/// What became of the tests, for each kind and model.
pub fn coverage(validation: &Validation) -> Vec<Coverage> {
    type Reasons<'a> = BTreeMap<&'a str, usize>;
    let mut groups: BTreeMap<(Kind, usize), ([usize; Standing::ALL.len()], Reasons<'_>)> =
        BTreeMap::new();
    for prediction in validation.predictions.iter().filter(|p| p.main_record) {
        let kind = validation.test(prediction).kind;
        let key = (kind, place(validation, prediction.model));
        let (standings, reasons) = groups.entry(key).or_default();
        standings[prediction.standing as usize] += 1;
        if let Some(reason) = &prediction.reason {
            *reasons.entry(reason).or_default() += 1;
        }
    }
    groups
        .into_iter()
        .map(|((kind, model), (standings, reasons))| Coverage {
            model: validation.models[model],
            kind,
            standings,
            reason: reasons
                .into_iter()
                .max_by_key(|(_, count)| *count)
                .map(|(reason, count)| (reason.to_owned(), count)),
        })
        .collect()
}

/// Models of which no prediction is counted.
pub fn without_tests(validation: &Validation) -> Vec<&'static str> {
    let counted = |model: &str| {
        validation
            .predictions
            .iter()
            .any(|p| p.model == model && p.standing == Standing::Counted && p.main_record)
    };
    let models = validation.models.iter().copied();
    models.filter(|model| !counted(model)).collect()
}

fn place(validation: &Validation, model: &str) -> usize {
    let mut models = validation.models.iter();
    models.position(|name| *name == model).unwrap_or(0)
}
