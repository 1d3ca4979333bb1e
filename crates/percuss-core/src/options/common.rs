//! Checks of options that several models have.

use super::ArtificialViscosity;
use crate::{
    check::{Check, limits},
    units::Time,
};

/// Remedy where one key takes the effect of another.
pub(super) const OF_TWO: &str = "remove one of the two keys";

pub(super) fn check_viscosity(check: &mut Check<'_>, viscosity: Option<ArtificialViscosity>) {
    let mut check = check.within("artificial_viscosity");
    check.number("linear", viscosity.map(|v| v.linear), limits::VISCOSITY);
    check.number(
        "quadratic",
        viscosity.map(|v| v.quadratic),
        limits::VISCOSITY,
    );
}

/// Checks what ends a run.
pub(super) fn check_end(check: &mut Check<'_>, end_time: Option<Time>, max_steps: Option<u64>) {
    check.quantity("end_time", end_time, limits::TIME);
    if max_steps == Some(0) {
        check.out_of_range("max_steps", "0 steps", "allowed: 1 or more");
    }
}

/// Reports keys of a solid target that are given of another.
pub(super) fn refuse_without_target(check: &mut Check<'_>, keys: &[(&str, bool)]) {
    let message = |key: &str| format!("a rigid wall or a constant pressure has no `{key}`");
    check.refuse(keys, message, "remove the key");
}

/// Reports a fraction of heat where there is none.
pub(super) fn refuse_without_heating(
    check: &mut Check<'_>,
    fraction: Option<f64>,
    heating: Option<bool>,
) {
    if fraction.is_some() && heating == Some(false) {
        let message = "`heat_fraction` has no effect without `adiabatic_heating`";
        check.fail("heat_fraction", message, OF_TWO);
    }
}
