//! Convergence of a result with the mesh: observed order, Richardson's value and the grid-convergence index.

use serde::Serialize;

use crate::{
    Error, Scenario,
    model::{Control, Model, run},
    outcome::RunResult,
};

/// Factor between the numbers of elements of two meshes.
pub const REFINEMENT: u32 = 2;
/// Factor of safety of a grid-convergence index over three or more meshes \[roache1994\].
const SAFETY: f64 = 1.25;
/// Spread of the finest meshes, as a part of the value, below which nobody asks for an order.
const AGREEMENT: f64 = 1e-3;
/// The schemes are of second order at best.
const LARGEST_CREDIBLE_ORDER: f64 = 2.2;
/// Differences between meshes below this part of the value are rounding, not convergence.
const NEGLIGIBLE: f64 = 1e-9;

/// A case on successively finer meshes.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Study {
    /// The meshes, from coarse to fine.
    pub meshes: Vec<Mesh>,
    /// One entry a quantity that every mesh gives.
    pub quantities: Vec<Quantity>,
}

/// One mesh of a study.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Mesh {
    /// Elements along the projectile.
    pub projectile_elements: usize,
    /// Elements through the target.
    pub target_elements: usize,
    /// Time steps taken.
    pub steps: u64,
}

/// A result on all meshes and what follows from it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Quantity {
    /// Name as in the result record, without the unit.
    pub name: &'static str,
    /// Unit of the values.
    pub unit: &'static str,
    /// Value on each mesh.
    pub values: Vec<f64>,
    /// What the three finest meshes say.
    pub verdict: Verdict,
}

/// What the three finest meshes say of a quantity.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case", tag = "kind")]
pub enum Verdict {
    /// The differences between meshes shrink with one sign.
    Converging {
        /// Observed order of convergence in the element length.
        order: f64,
        /// Value extrapolated to zero element length \[richardson1911\].
        richardson: f64,
        /// Grid-convergence index of the finest mesh, as a fraction of its value.
        index: f64,
    },
    /// The finest meshes agree to rounding.
    Exact,
    /// The differences shrink but change their sign.
    Oscillating {
        /// Largest difference among the three finest meshes, as a fraction of the finest value.
        spread: f64,
    },
    /// The differences grow.
    Diverging {
        /// Largest difference among the three finest meshes, as a fraction of the finest value.
        spread: f64,
    },
}

impl Verdict {
    /// The verdict on values of three or more meshes, coarse to fine, each [`REFINEMENT`] times finer than the last.
    pub fn of(values: &[f64]) -> Option<Self> {
        let [.., coarse, medium, fine] = *values else {
            return None;
        };
        let (first, second) = (coarse - medium, medium - fine);
        let scale = fine.abs().max(coarse.abs());
        if second.abs() <= NEGLIGIBLE * scale {
            return Some(Self::Exact);
        }
        let spread = first.abs().max(second.abs()).max((coarse - fine).abs()) / scale;
        let ratio = first / second;
        if ratio.abs() <= 1.0 {
            return Some(Self::Diverging { spread });
        }
        if ratio < 0.0 {
            return Some(Self::Oscillating { spread });
        }
        let order = ratio.ln() / f64::from(REFINEMENT).ln();
        let richardson = fine - second / (ratio - 1.0);
        let index = SAFETY * (second / fine).abs() / (ratio - 1.0);
        Some(Self::Converging {
            order,
            richardson,
            index,
        })
    }

    /// The verdict in words.
    pub fn in_words(&self, fine: f64) -> String {
        match *self {
            Self::Exact => "the finest meshes agree to rounding".to_owned(),
            Self::Converging { richardson, .. } if richardson.abs() < 0.1 * fine.abs() => format!(
                "does not converge to a result: its limit is {:.1} % of the finest value, so it measures the mesh",
                100.0 * richardson / fine
            ),
            Self::Converging { order, .. } if order < 0.5 => {
                "converges too slowly to trust an extrapolation: refine further".to_owned()
            }
            Self::Converging { order, index, .. } if order > LARGEST_CREDIBLE_ORDER => format!(
                "converges, faster than the scheme can: its differences do not follow a power law yet; the index of ±{:.2} % \
                 is too small",
                100.0 * index
            ),
            Self::Converging { index, .. } => {
                format!(
                    "converges; uncertainty of the finest mesh ±{:.2} %",
                    100.0 * index
                )
            }
            Self::Oscillating { spread } | Self::Diverging { spread } if spread < AGREEMENT => {
                format!("the finest meshes agree within {:.3} %", 100.0 * spread)
            }
            Self::Oscillating { spread } => {
                format!(
                    "oscillates within {:.2} % of the finest value",
                    100.0 * spread
                )
            }
            Self::Diverging { spread } => format!(
                "does not converge on these meshes: the last difference is the larger one, spread {:.2} %",
                100.0 * spread
            ),
        }
    }
}

/// Runs a case on `levels` meshes, the first as the case has it, each of the others [`REFINEMENT`] times finer.
///
/// # Errors
/// Those of [`run`].
pub fn study(
    model: &dyn Model,
    scenario: &Scenario,
    levels: u32,
    control: &mut Control<'_>,
) -> Result<(Study, Vec<RunResult>), Error> {
    let mut meshes = Vec::new();
    let mut results = Vec::new();
    for level in 0..levels {
        let refined = scenario.refined(REFINEMENT.saturating_pow(level));
        let result = run(model, &refined, control)?;
        let Some(numerics) = &result.numerics else {
            return Err(Error::NotApplicable {
                model: model.name(),
                reason: "it has no mesh to refine".to_owned(),
            });
        };
        meshes.push(Mesh {
            projectile_elements: numerics.elements.0,
            target_elements: numerics.elements.1,
            steps: numerics.steps,
        });
        results.push(result);
    }
    Ok((Study::new(meshes, &results), results))
}

type Reader = fn(&RunResult) -> Option<f64>;

const QUANTITIES: &[(&str, &str, Reader)] = &[
    ("depth_of_penetration", "mm", |r| {
        r.depth_of_penetration.map(|x| x * 1e3)
    }),
    ("permanent_depth", "mm", |r| {
        r.permanent_depth.map(|x| x * 1e3)
    }),
    ("projectile_final_length", "mm", |r| {
        r.projectile_final_length.map(|x| x * 1e3)
    }),
    ("time_to_rest", "us", |r| r.time_to_rest.map(|t| t * 1e6)),
    ("residual_velocity", "m/s", |r| r.residual_velocity),
];

impl Study {
    /// The study of results on meshes from coarse to fine.
    pub fn new(meshes: Vec<Mesh>, results: &[RunResult]) -> Self {
        let quantities = QUANTITIES
            .iter()
            .filter_map(|&(name, unit, read)| {
                let values: Vec<f64> = results.iter().map(read).collect::<Option<_>>()?;
                Some(Quantity {
                    name,
                    unit,
                    verdict: Verdict::of(&values)?,
                    values,
                })
            })
            .collect();
        Self { meshes, quantities }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_made_up_second_order_result_is_seen_as_such() {
        let values: Vec<f64> = [1.0, 0.5, 0.25].iter().map(|h| 3.0 + 0.1 * h * h).collect();
        let Some(Verdict::Converging {
            order,
            richardson,
            index,
        }) = Verdict::of(&values)
        else {
            panic!("not converging");
        };
        assert!((order - 2.0).abs() < 1e-10);
        assert!((richardson - 3.0).abs() < 1e-12);
        let error = (values[2] - 3.0) / values[2];
        assert!((index / error - 1.25).abs() < 1e-6);
    }

    #[test]
    fn a_result_that_follows_the_mesh_is_not_called_converged() {
        let verdict = Verdict::of(&[2.6, 1.3, 0.65]).unwrap();
        assert!(
            verdict
                .in_words(0.65)
                .starts_with("does not converge to a result")
        );
        assert!(matches!(
            Verdict::of(&[1.0, 1.1, 1.3]),
            Some(Verdict::Diverging { .. })
        ));
        assert!(matches!(
            Verdict::of(&[1.0, 1.2, 1.1]),
            Some(Verdict::Oscillating { .. })
        ));
        assert_eq!(Verdict::of(&[1.0, 1.0, 1.0]), Some(Verdict::Exact));
        assert_eq!(Verdict::of(&[1.0, 1.0]), None);
    }
}
