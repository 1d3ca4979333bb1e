//! Convergence of a result with the mesh: observed order, Richardson's value and the grid-convergence index.

use serde::Serialize;

use crate::{
    Error, Scenario, axisymmetric,
    model::{Control, Model, run},
    outcome::RunResult,
    richardson::{CREDIBLE_ORDERS, OnMesh, SAFETY, Trend, extrapolate, trend},
    summary::result_number,
    units::{ResultUnit, significant},
};

/// Factor between the numbers of elements of two meshes.
pub const REFINEMENT: u32 = 2;
/// Spread of the finest meshes, as a part of the value, below which nobody asks for an order.
const AGREEMENT: f64 = 1e-3;
/// Part of the finest value below which an extrapolated one is no result but the mesh.
const VANISHING: f64 = 0.1;
/// Cells per radius of the coarsest mesh that is advised.
const COARSE_CELLS: u32 = 3;
/// Largest difference of the orders of two successive triples of meshes in the asymptotic range.
const SAME_ORDER: f64 = 0.5;

/// A case on successively finer meshes.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MeshStudy {
    /// The meshes, from coarse to fine.
    pub meshes: Vec<Mesh>,
    /// One entry per quantity that every mesh gives.
    pub quantities: Vec<Quantity>,
}

/// One mesh of a study.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Mesh {
    /// Elements along the projectile.
    pub projectile_elements: usize,
    /// Elements through the target.
    pub target_elements: usize,
    /// Cells per radius of the projectile, which the axisymmetric model refines.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cells_per_radius: Option<u32>,
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
    /// Convergence over the meshes.
    pub status: ConvergenceStatus,
}

/// Convergence of a quantity over the meshes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case", tag = "kind")]
pub enum ConvergenceStatus {
    /// Two successive triples of meshes show the same credible order: the asymptotic range is confirmed.
    Converging {
        /// Observed order of convergence in the element length.
        order: f64,
        /// Value extrapolated to zero element length \[richardson1911\].
        richardson: f64,
        /// Grid-convergence index of the finest mesh, as a fraction of its value.
        index: f64,
    },
    /// The differences shrink with one sign, but nothing confirms that they follow a power law: no uncertainty is claimed.
    Unconfirmed {
        /// Observed order of the three finest meshes.
        order: f64,
        /// Observed order of the three meshes before; none with three meshes, or where they have none.
        earlier_order: Option<f64>,
        /// Number of meshes.
        meshes: usize,
        /// Largest difference among the three finest meshes, as a fraction of the finest value.
        spread: f64,
    },
    /// The differences shrink towards a limit that is next to nothing of the value: it measures the mesh.
    Vanishing {
        /// Observed order of the three finest meshes.
        order: f64,
        /// The limit as a fraction of the finest value.
        limit: f64,
    },
    /// The finest meshes agree to rounding.
    Exact,
    /// Less than three meshes, of a study that was stopped.
    TooFew,
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

impl ConvergenceStatus {
    /// The status on values of three or more meshes, coarse to fine, each [`REFINEMENT`] times finer than the last.
    pub fn of(values: &[f64]) -> Option<Self> {
        let meshes: Vec<OnMesh> = values
            .iter()
            .zip(0..)
            .map(|(&value, level)| OnMesh {
                cells: f64::from(REFINEMENT).powi(level),
                value,
            })
            .collect();
        let [before @ .., coarse, medium, fine] = meshes.as_slice() else {
            return None;
        };
        let differences = [
            coarse.value - medium.value,
            medium.value - fine.value,
            coarse.value - fine.value,
        ];
        let largest = differences.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
        // A value of 0 on the finest mesh has no fractions: the larger of the other two then.
        let whole = match fine.value == 0.0 {
            true => coarse.value.abs().max(medium.value.abs()),
            false => fine.value.abs(),
        };
        let spread = largest / whole;
        let order = match trend([*coarse, *medium, *fine]) {
            Trend::Exact => return Some(Self::Exact),
            Trend::Diverging => return Some(Self::Diverging { spread }),
            Trend::Oscillating => return Some(Self::Oscillating { spread }),
            Trend::Monotone { order } => order,
        };
        let richardson = extrapolate(*medium, *fine, order);
        let limit = match fine.value == 0.0 {
            true => 0.0,
            false => richardson / fine.value,
        };
        if limit.abs() < VANISHING {
            return Some(Self::Vanishing { order, limit });
        }
        let earlier_order =
            before
                .last()
                .and_then(|coarser| match trend([*coarser, *coarse, *medium]) {
                    Trend::Monotone { order } => Some(order),
                    _ => None,
                });
        let credible = |order: f64| CREDIBLE_ORDERS.contains(&order);
        let confirmed = earlier_order
            .is_some_and(|earlier| credible(earlier) && (order - earlier).abs() <= SAME_ORDER);
        if !confirmed || !credible(order) {
            return Some(Self::Unconfirmed {
                order,
                earlier_order,
                meshes: meshes.len(),
                spread,
            });
        }
        Some(Self::Converging {
            order,
            richardson,
            index: SAFETY * (1.0 - limit).abs(),
        })
    }

    /// Observed order of the three finest meshes, where they have one.
    pub fn order(&self) -> Option<f64> {
        match *self {
            Self::Converging { order, .. }
            | Self::Unconfirmed { order, .. }
            | Self::Vanishing { order, .. } => Some(order),
            Self::Exact | Self::TooFew | Self::Oscillating { .. } | Self::Diverging { .. } => None,
        }
    }

    /// The status in words.
    pub fn describe(&self) -> String {
        self.in_words("")
    }

    /// The same; `from` says where a fourth mesh should start, if not where the three do.
    fn in_words(&self, from: &str) -> String {
        match *self {
            Self::Exact => "the finest meshes agree to rounding".to_owned(),
            Self::TooFew => "less than three meshes show no convergence".to_owned(),
            Self::Vanishing { limit, .. } => format!(
                "does not converge to a result: its limit is {:.1} % of the finest value, so it measures the mesh",
                100.0 * limit
            ),
            Self::Converging { index, .. } => {
                format!(
                    "converges; uncertainty of the finest mesh ±{} %",
                    significant(100.0 * index, 2)
                )
            }
            Self::Unconfirmed { spread, .. }
            | Self::Oscillating { spread }
            | Self::Diverging { spread }
                if spread < AGREEMENT =>
            {
                format!(
                    "the three finest meshes agree within {:.3} %",
                    100.0 * spread
                )
            }
            Self::Unconfirmed {
                order,
                earlier_order,
                meshes,
                spread,
            } => format!(
                "convergence is not confirmed: {}; the three finest meshes differ by up to {:.2} %",
                doubt(order, earlier_order, meshes, from),
                100.0 * spread
            ),
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

/// Why an observed order confirms nothing, and what to do.
fn doubt(order: f64, earlier: Option<f64>, meshes: usize, from: &str) -> String {
    if order < *CREDIBLE_ORDERS.start() {
        return format!("order {order:.2} is too slow for an extrapolation, refine further");
    }
    if order > *CREDIBLE_ORDERS.end() {
        return format!(
            "order {order:.2} is more than the scheme has, so the differences do not follow a power law yet; refine further"
        );
    }
    match earlier {
        None if meshes <= 3 => {
            format!("three meshes give one order ({order:.2}); run `--levels 4`{from}")
        }
        None => format!(
            "order {order:.2} on the finest meshes, none on the coarser ones; refine further"
        ),
        Some(earlier) => {
            format!("the order changes from {earlier:.2} to {order:.2}; refine further")
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
) -> Result<(MeshStudy, Vec<RunResult>), Error> {
    let mut results = Vec::new();
    run_meshes(model, scenario, levels, control, &mut results)?;
    Ok((MeshStudy::new(scenario, &results), results))
}

/// Adds the results on `levels` meshes, as [`study`] runs them, to a list: of a run that fails or is stopped it has those before.
///
/// # Errors
/// Those of [`run`].
pub fn run_meshes(
    model: &dyn Model,
    scenario: &Scenario,
    levels: u32,
    control: &mut Control<'_>,
    results: &mut Vec<RunResult>,
) -> Result<(), Error> {
    for level in 0..levels {
        let refined = model.refined(scenario, f64::from(REFINEMENT).powi(level as i32));
        let result = run(model, refined.as_ref().unwrap_or(scenario), control)?;
        if refined.is_none() || result.numerics.is_none() {
            let reason = "it has no mesh to refine";
            return Err(Error::not_applicable(model.name(), reason));
        }
        results.push(result);
    }
    Ok(())
}

/// The result numbers whose convergence is evaluated.
const QUANTITIES: [&str; 5] = [
    "depth_of_penetration_mm",
    "permanent_depth_mm",
    "projectile_final_length_mm",
    "time_to_rest_us",
    "residual_velocity_m_s",
];

impl MeshStudy {
    /// The study of a case's results on meshes from coarse to fine; results without a mesh are left out.
    pub fn new(scenario: &Scenario, results: &[RunResult]) -> Self {
        let mut factor: u32 = 1;
        let meshes = results.iter().filter_map(|result| {
            let cells = scenario.options.axi.cells_per_radius();
            let cells = cells.saturating_mul(factor);
            factor = factor.saturating_mul(REFINEMENT);
            let numerics = result.numerics.as_ref()?;
            Some(Mesh {
                cells_per_radius: (result.model == axisymmetric::MODEL).then_some(cells),
                projectile_elements: numerics.elements.0,
                target_elements: numerics.elements.1,
                steps: numerics.steps,
            })
        });
        let quantities = QUANTITIES
            .iter()
            .filter_map(|name| {
                let number = result_number(name)?;
                let values = results.iter().map(|run| number.of_run(scenario, run));
                let values: Vec<f64> = values.collect::<Option<_>>()?;
                Some(Quantity {
                    name: ResultUnit::split(number.name).0,
                    unit: number.unit.symbol,
                    status: ConvergenceStatus::of(&values).unwrap_or(ConvergenceStatus::TooFew),
                    values,
                })
            })
            .collect();
        Self {
            meshes: meshes.collect(),
            quantities,
        }
    }

    /// The status of a quantity in words, with the advice that fits the cost of its model.
    pub fn describe(&self, quantity: &Quantity) -> String {
        let cells = |mesh: Option<&Mesh>| mesh.and_then(|mesh| mesh.cells_per_radius);
        let ends = cells(self.meshes.first()).zip(cells(self.meshes.last()));
        let from = ends.and_then(|(coarsest, finest)| {
            // Four meshes up to the finest one cost what these did.
            let start = (finest / REFINEMENT.pow(3)).max(COARSE_CELLS);
            (start < coarsest).then(|| format!(" from `axi.cells_per_radius = {start}` on"))
        });
        quantity.status.in_words(&from.unwrap_or_default())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn second_order(meshes: i32) -> Vec<f64> {
        (0..meshes).map(|i| 3.0 + 0.1 * 0.25_f64.powi(i)).collect()
    }

    #[test]
    fn a_second_order_result_on_four_meshes_converges() {
        let values = second_order(4);
        let Some(ConvergenceStatus::Converging {
            order,
            richardson,
            index,
        }) = ConvergenceStatus::of(&values)
        else {
            panic!("not converging");
        };
        assert!((order - 2.0).abs() < 1e-9, "{order}");
        assert!((richardson - 3.0).abs() < 1e-12);
        let error = (values[3] - 3.0) / values[3];
        assert!((index / error - 1.25).abs() < 1e-6);
    }

    #[test]
    fn three_meshes_confirm_no_order() {
        let status = ConvergenceStatus::of(&second_order(3)).unwrap();
        let ConvergenceStatus::Unconfirmed {
            order,
            earlier_order: None,
            meshes: 3,
            ..
        } = status
        else {
            panic!("{status:?}");
        };
        assert!((order - 2.0).abs() < 1e-9);
        let words = status.describe();
        assert!(
            words.contains("not confirmed: three meshes give one order (2.00); run `--levels 4`"),
            "{words}"
        );
    }

    #[test]
    fn a_fourth_axisymmetric_mesh_is_coarser() {
        let words = |coarsest: Option<u32>| {
            let values = second_order(3);
            let mesh = |level: u32| Mesh {
                projectile_elements: 8 << level,
                target_elements: 8 << level,
                cells_per_radius: coarsest.map(|cells| cells << level),
                steps: 1,
            };
            let quantity = Quantity {
                name: "depth_of_penetration",
                unit: "mm",
                status: ConvergenceStatus::of(&values).unwrap(),
                values,
            };
            let study = MeshStudy {
                meshes: (0..3).map(mesh).collect(),
                quantities: vec![quantity],
            };
            study.describe(&study.quantities[0])
        };
        for (coarsest, advice) in [
            (None, "run `--levels 4`"),
            (
                Some(8),
                "run `--levels 4` from `axi.cells_per_radius = 4` on",
            ),
            (
                Some(4),
                "run `--levels 4` from `axi.cells_per_radius = 3` on",
            ),
            (Some(3), "run `--levels 4`"),
        ] {
            let words = words(coarsest);
            assert!(words.contains(advice), "{coarsest:?}: {words}");
            let is_plain = !words.contains("cells_per_radius");
            assert_eq!(is_plain, !advice.contains("cells_per_radius"), "{words}");
        }
    }

    #[test]
    fn an_order_that_changes_is_not_confirmed() {
        // The fourth mesh shows what three cannot: orders of 2 and then 1.
        let changes = ConvergenceStatus::of(&[1.0, 0.6, 0.5, 0.45]).unwrap();
        assert_eq!(changes.order().map(f64::round), Some(1.0));
        let words = changes.describe();
        assert!(words.contains("from 2.00 to 1.00"), "{words}");
        let first = ConvergenceStatus::of(&[1.0, 1.3, 0.9, 0.7])
            .unwrap()
            .describe();
        assert!(first.contains("none on the coarser ones"), "{first}");
        for (ratio, words) in [(1.2, "too slow"), (8.0, "more than the scheme has")] {
            let values: Vec<f64> = (0..4).map(|i| 3.0 + f64::powi(1.0 / ratio, i)).collect();
            let status = ConvergenceStatus::of(&values).unwrap();
            assert!(
                matches!(status, ConvergenceStatus::Unconfirmed { .. }),
                "{status:?}"
            );
            assert!(status.describe().contains(words), "{}", status.describe());
        }
    }

    #[test]
    fn a_result_that_follows_the_mesh_is_not_called_converged() {
        for values in [&[2.6, 1.3, 0.65][..], &[5.2, 2.6, 1.3, 0.65]] {
            let words = ConvergenceStatus::of(values).unwrap().describe();
            assert!(words.starts_with("does not converge to a result"));
        }
        assert!(matches!(
            ConvergenceStatus::of(&[1.0, 1.1, 1.3]),
            Some(ConvergenceStatus::Diverging { .. })
        ));
        assert!(matches!(
            ConvergenceStatus::of(&[1.0, 1.2, 1.1]),
            Some(ConvergenceStatus::Oscillating { .. })
        ));
        assert_eq!(
            ConvergenceStatus::of(&[1.0, 1.0, 1.0]),
            Some(ConvergenceStatus::Exact)
        );
        assert_eq!(ConvergenceStatus::of(&[1.0, 1.0]), None);
    }
}
