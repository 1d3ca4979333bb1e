//! The ballistic limit that the models of residual velocity start from: given, or computed by another model.

use super::{
    plate_cavity::{Passage, PlateCavity},
    plate_impact::PLATE_NEVER_FLOWS,
    plugging::{Plugging, ballistic_limit},
};
use crate::{
    Refusal, Scenario,
    outcome::Detail,
    solver::{InputLimit, Model, applicability},
    units::{Velocity, significant},
    validity::NoseKind,
};

/// The limit that a case gives or another model computes; `None` when there is none.
pub(super) fn input_limit(
    scenario: &Scenario,
    given: Option<Velocity>,
    table: &str,
) -> Option<InputLimit> {
    let limit = limit(scenario, given, table).ok()?;
    Some(InputLimit {
        ballistic_limit_m_s: limit.speed,
        computed_by: limit.computed_by,
    })
}

/// A ballistic limit and where it comes from.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Limit {
    /// Impact velocity above which the plate is perforated [m/s].
    pub speed: f64,
    /// Model that computes it; `None` where the case gives it.
    pub computed_by: Option<&'static str>,
    /// The limit with its origin in the name.
    pub detail: Detail,
    /// Remarks on a limit that the case does not give.
    pub warnings: Vec<String>,
}

/// The ballistic limit of a case; the refusal when there is none. `table` is the option table to add one to.
pub(super) fn limit(
    scenario: &Scenario,
    given: Option<Velocity>,
    table: &str,
) -> Result<Limit, Refusal> {
    if let Some(given) = given {
        return Ok(Limit {
            speed: given.si(),
            computed_by: None,
            detail: detail("ballistic limit, given", given.si()),
            warnings: Vec::new(),
        });
    }
    let (model, name, speed): (&dyn Model, _, _) = match NoseKind::of(scenario.projectile.nose) {
        NoseKind::Flat => (
            &Plugging,
            "ballistic limit by plugging",
            ballistic_limit(scenario),
        ),
        _ => (
            &PlateCavity,
            "ballistic limit by plate_cavity",
            Passage::of(scenario).map(|passage| passage.ballistic_limit()),
        ),
    };
    let refuse = |reason: &str| {
        let reason = format!(
            "no ballistic limit is given, and model `{}` gives none: {reason}",
            model.name()
        );
        Refusal::new(reason).with_remedy(format!("add `{table}.ballistic_limit`"))
    };
    let mut warnings = applicability(model, scenario).map_err(|refusal| refuse(&refusal.reason))?;
    let speed = speed.ok_or_else(|| refuse(PLATE_NEVER_FLOWS))?;
    warnings.push(format!(
        "no ballistic limit is given: that of model `{}`, {}, is used; `{table}.ballistic_limit` sets a measured one",
        model.name(),
        Velocity::new(significant(speed, 4).parse().unwrap_or(speed))
    ));
    Ok(Limit {
        speed,
        computed_by: Some(model.name()),
        detail: detail(name, speed),
        warnings,
    })
}

fn detail(name: &'static str, speed: f64) -> Detail {
    Detail {
        name,
        unit: "m/s",
        value: speed,
    }
}
