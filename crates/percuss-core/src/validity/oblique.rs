//! Impacts at an angle to the normal of the struck face.

use super::{NoseKind, ValidityDomain, list};
use crate::{scenario::Scenario, units::Angle};

/// Why a model cannot take an impact at its angle, if it cannot.
pub(super) fn reason(
    validity: &ValidityDomain,
    scenario: &Scenario,
    nose: NoseKind,
) -> Option<String> {
    if scenario.obliquity == 0.0 || validity.oblique_noses.contains(&nose) {
        return None;
    }
    let angle = Angle::new(scenario.obliquity);
    let takes = match validity.oblique_noses {
        [] => "it takes normal impact".to_owned(),
        noses => format!(
            "it takes oblique impact of {} noses",
            list(noses.iter().map(|nose| nose.name()))
        ),
    };
    let nose = nose.name();
    Some(format!(
        "{takes}, and this {nose} nose strikes at {angle} to the normal"
    ))
}

/// Which impacts it takes, in words.
pub(super) fn describe(validity: &ValidityDomain) -> String {
    match validity.oblique_noses {
        [] => "impact along the normal of the struck face".to_owned(),
        noses => format!(
            "oblique impact too, with {} noses",
            list(noses.iter().map(|nose| nose.name()))
        ),
    }
}
