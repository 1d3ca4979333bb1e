//! Result numbers: name, unit, label, description and value of each.

use super::ResultRecord;
use crate::{
    fragments::FragmentRecord,
    measured_curves::CurveComparison,
    model_error::ModelErrorEstimate,
    outcome::{Band, Detail, Outcome, RunResult, Termination},
    scenario::Scenario,
    units::ResultUnit,
};

/// A field of [`ResultRecord`], as JSON has it.
#[derive(Debug)]
pub struct ResultField {
    /// Its name, which ends with the unit.
    pub name: &'static str,
    /// Its description: the documentation of the field, as lines.
    description: &'static str,
    /// What it holds.
    pub kind: FieldKind,
    /// What it is as a number; `None` for a text, a list or a table.
    pub number: Option<ResultNumber>,
}

impl ResultField {
    pub(super) const fn new(
        name: &'static str,
        description: &'static str,
        kind: FieldKind,
        number: Option<ResultNumber>,
    ) -> Self {
        Self {
            name,
            description,
            kind,
            number,
        }
    }

    /// What it is, in a sentence or two.
    pub fn description(&self) -> &'static str {
        self.description.trim()
    }
}

/// A scalar result, with what tables, sweeps, studies and Python need of it.
#[derive(Clone, Copy)]
pub struct ResultNumber {
    /// Its name, which ends with the unit.
    pub name: &'static str,
    /// Its name in words.
    pub label: &'static str,
    /// Its unit.
    pub unit: ResultUnit,
    /// Where it is shown and evaluated.
    pub role: Role,
    /// Which runs have a value in statistics.
    pub in_statistics: InStatistics,
    /// Whether a run that ends at rest has the same value ([`Scenario::ended_at_rest`]).
    pub known_at_rest: bool,
    pub(super) of_record: fn(&ResultRecord) -> Option<f64>,
    pub(super) of_run: fn(&Scenario, &RunResult) -> Option<f64>,
}

/// Where a number is shown and evaluated. JSON, the columns of sweeps and Python have every number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// The case gives it.
    Input,
    /// Tables show it, and studies evaluate it unless others are named.
    Main,
    /// Tables show it, and studies evaluate it where it is named.
    Result,
    /// Figures of sweeps draw it where it is named.
    Detail,
    /// Steps of the computation.
    Numerics,
}

impl Role {
    /// Whether tables show it and studies evaluate it.
    pub fn is_result(self) -> bool {
        matches!(self, Self::Main | Self::Result)
    }
}

/// Which runs have a value in statistics.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum InStatistics {
    /// Every run that gives one.
    Every,
    /// Runs that do not perforate: a perforated target has no depth.
    NotPerforated,
    /// Every run that gives one; 0 where the target stops the projectile.
    ZeroWhereStopped,
}

impl ResultNumber {
    /// A number of [`super::RESULT_FIELDS`]; the list completes its name and value.
    pub(super) const fn new(label: &'static str, unit: ResultUnit, role: Role) -> Self {
        Self {
            name: "",
            label,
            unit,
            role,
            in_statistics: InStatistics::Every,
            known_at_rest: false,
            of_record: |_| None,
            of_run: |_, _| None,
        }
    }

    /// This number with other values in statistics.
    pub(super) const fn in_statistics(self, in_statistics: InStatistics) -> Self {
        Self {
            in_statistics,
            ..self
        }
    }

    /// This number, which a run that ends at rest has, too.
    pub(super) const fn known_at_rest(self) -> Self {
        Self {
            known_at_rest: true,
            ..self
        }
    }

    /// Its value, if the run has one.
    pub fn of(&self, record: &ResultRecord) -> Option<f64> {
        (self.of_record)(record)
    }

    /// Its value, if the run has one, without a record of all numbers.
    pub fn of_run(&self, scenario: &Scenario, run: &RunResult) -> Option<f64> {
        (self.of_run)(scenario, run)
    }

    /// Its value for statistics over many runs; none where it is not finite.
    pub fn for_statistics(&self, record: &ResultRecord) -> Option<f64> {
        let outcome = record.outcome;
        let value = self.of(record)?;
        let value = match self.in_statistics {
            InStatistics::ZeroWhereStopped if outcome.perforated() == Some(false) => 0.0,
            _ => value,
        };
        value.is_finite().then_some(value)
    }
}

impl std::fmt::Debug for ResultNumber {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name)
    }
}

/// What a field holds in JSON; null where a result lacks it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FieldKind {
    /// A text.
    Text,
    /// A text or null.
    OptionalText,
    /// A list of texts.
    Texts,
    /// A number.
    Number,
    /// A number or null.
    OptionalNumber,
    /// A whole number or null.
    OptionalCount,
    /// A table or null.
    OptionalTable,
    /// A list of tables.
    Tables,
}

impl FieldKind {
    /// The kind in words.
    pub fn describe(self) -> &'static str {
        match self {
            Self::Text => "text",
            Self::OptionalText => "text or null",
            Self::Texts => "list of texts",
            Self::Number => "number",
            Self::OptionalNumber => "number or null",
            Self::OptionalCount => "whole number or null",
            Self::OptionalTable => "table or null",
            Self::Tables => "list of tables",
        }
    }
}

/// Type of a field in [`ResultRecord`].
pub(super) trait FieldType {
    /// What it holds.
    const KIND: FieldKind;
}

macro_rules! field_types {
    ($($type:ty => $kind:ident;)+) => {
        $( impl FieldType for $type {
            const KIND: FieldKind = FieldKind::$kind;
        } )+
    };
}

field_types! {
    &'static str => Text;
    Outcome => Text;
    Option<&'static str> => OptionalText;
    Option<String> => OptionalText;
    Option<Termination> => OptionalText;
    Vec<String> => Texts;
    f64 => Number;
    Option<f64> => OptionalNumber;
    Option<u64> => OptionalCount;
    Option<usize> => OptionalCount;
    Option<Band> => OptionalTable;
    Option<ModelErrorEstimate> => OptionalTable;
    Vec<Detail> => Tables;
    Vec<FragmentRecord> => Tables;
    Vec<CurveComparison> => Tables;
}

/// Type of a number in [`ResultRecord`].
pub(super) trait NumberType: Copy {
    /// A number in SI units as one in the unit of its field; a count has no unit.
    fn in_unit(self, unit: ResultUnit) -> Self;

    /// Its value.
    fn value(self) -> Option<f64>;
}

impl NumberType for f64 {
    fn in_unit(self, unit: ResultUnit) -> Self {
        unit.of_si(self)
    }

    fn value(self) -> Option<f64> {
        Some(self)
    }
}

impl NumberType for Option<f64> {
    fn in_unit(self, unit: ResultUnit) -> Self {
        self.map(|si| unit.of_si(si))
    }

    fn value(self) -> Option<f64> {
        self
    }
}

impl NumberType for Option<u64> {
    fn in_unit(self, _: ResultUnit) -> Self {
        self
    }

    fn value(self) -> Option<f64> {
        self.map(|count| count as f64)
    }
}

impl NumberType for Option<usize> {
    fn in_unit(self, _: ResultUnit) -> Self {
        self
    }

    fn value(self) -> Option<f64> {
        self.map(|count| count as f64)
    }
}
