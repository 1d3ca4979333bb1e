//! Rear face of the target whose ballistic limit is asked for.

use serde::Serialize;

use crate::{
    problem::RearFaceCondition,
    scenario::{Scenario, TargetBody},
};

/// Rear face of a target. The names are stable.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct RearFace {
    /// What holds it.
    pub condition: RearFaceCondition,
    /// Whether it is assumed because the case gives none.
    pub assumed: bool,
}

impl RearFace {
    /// The rear face of a case; `None` where nothing can come out behind the target.
    pub(super) fn of(scenario: &Scenario) -> Option<Self> {
        scenario.target_thickness()?;
        match scenario.target {
            TargetBody::Layers { back_face, .. } => Some(Self {
                condition: back_face,
                assumed: !scenario.given.rear_face,
            }),
            _ => None,
        }
    }

    /// Why nothing can leave through it, if so.
    pub(super) fn impossible(self) -> Option<String> {
        (self.condition == RearFaceCondition::Fixed).then(|| {
            "perforation is impossible: the case fixes the rear face (`target.back_face = \"fixed\"`). Give \"free\", or remove the key"
                .to_owned()
        })
    }

    /// Remark on the limit; `None` where the case gives a free one.
    pub fn describe(self) -> Option<String> {
        match (self.assumed, self.impossible()) {
            (_, Some(impossible)) => Some(impossible),
            (true, None) => Some(
                "the rear face of the plate is taken as free: the case gives no `target.back_face`"
                    .to_owned(),
            ),
            (false, None) => None,
        }
    }
}
