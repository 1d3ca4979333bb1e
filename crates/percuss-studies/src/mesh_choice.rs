//! The coarsest mesh on which the main number of a case is within a tolerance.

use crate::{
    Error, Scenario,
    axisymmetric::main_number,
    check::Diagnostic,
    model::{Control, Model, run},
    outcome::{BandQuantity, Detail, RunResult},
    richardson::{CREDIBLE_ORDERS, OnMesh, SAFETY, Trend, extrapolate, trend},
    units::significant,
};

/// Number of elements of the coarsest mesh over that of the case.
const COARSEST: f64 = 0.5;
/// Factor between the numbers of elements of two meshes.
const REFINEMENT: f64 = 2.0;
/// Meshes that are tried at most: the finest has eight times the elements of the case.
const MESHES: i32 = 5;
/// Meshes that an estimate takes.
const FEWEST: usize = 3;
/// Order where differences shrink faster than the schemes can: that of a front.
const CAUTIOUS_ORDER: f64 = 1.0;

/// A mesh with the estimated error of its number.
#[derive(Debug, Clone)]
pub struct MeshChoice {
    /// The case on this mesh.
    pub scenario: Scenario,
    /// Number whose error it is.
    pub quantity: BandQuantity,
    /// Estimated error by the mesh, as a part of the number; infinite where there is no estimate.
    pub error: f64,
    /// Why there is no estimate.
    pub doubt: Option<&'static str>,
    /// Largest error that was asked for.
    pub tolerance: f64,
    /// Numbers of elements by their options; a wall has none.
    pub elements: Vec<(&'static str, usize)>,
}

/// Tries meshes from half the elements of the case up to eight times them, each with twice those of the last, until the error of one is
/// estimated to be below `tolerance`; takes the coarsest such mesh, and the finest where there is none.
///
/// The estimate is that of three successive meshes: Richardson's, with a factor of safety of 1.25, where their order is credible; the
/// largest difference of the three where they approach no limit, and twice it for those before the finest. Meshes on which the numerical
/// solution fails are left out: the coarsest ones, or all from a finer one on.
///
/// # Errors
/// [`Error::Input`] for a tolerance that is not positive; [`Error::NotApplicable`] to a model without a mesh or without such a number;
/// those of [`run`].
pub fn choose_mesh(
    model: &dyn Model,
    scenario: &Scenario,
    tolerance: f64,
    control: &mut Control<'_>,
) -> Result<MeshChoice, Error> {
    if !(tolerance > 0.0 && tolerance.is_finite()) {
        let message = format!("a tolerance of {tolerance} is met by no mesh");
        let wrong = Diagnostic::at(
            "tolerance",
            message,
            "allowed: above 0, such as 0.01 for 1 %",
        );
        return Err(wrong.in_no_file(&scenario.name).into());
    }
    let mut tried: Vec<(Scenario, RunResult)> = Vec::new();
    let mut best = None;
    for level in 0..MESHES {
        let factor = COARSEST * REFINEMENT.powi(level);
        let refined = model.refined(scenario, factor);
        let Some(refined) = refined.filter(|_| !model.is_two_dimensional()) else {
            let reason = "it has no elements along a line whose number could be chosen";
            return Err(Error::not_applicable(model.name(), reason));
        };
        let result = match run(model, &refined.clone().ended_at_rest(), control) {
            Ok(result) => result,
            // On the meshes that carry the case to its end.
            Err(Error::Numerical(_)) if !tried.is_empty() => break,
            Err(Error::Numerical(_)) if level + 1 < MESHES => continue,
            Err(error) => return Err(error),
        };
        if number(scenario, &result).1.is_none() {
            let reason = "it gives no depth, final length or residual velocity to choose a mesh by";
            return Err(Error::not_applicable(model.name(), reason));
        }
        tried.push((refined, result));
        best = coarsest(scenario, &tried, tolerance);
        if best.is_some_and(|(_, _, error)| error <= tolerance) {
            break;
        }
    }
    let doubt = match best {
        Some(_) => None,
        None if tried.len() < FEWEST => Some("too few meshes have a result"),
        None => Some("the meshes differ in their outcome"),
    };
    let (place, quantity, error) = best.unwrap_or_else(|| {
        let finest = tried.len() - 1;
        (finest, number(scenario, &tried[finest].1).0, f64::INFINITY)
    });
    let (scenario, result) = tried.swap_remove(place);
    let Some(numerics) = &result.numerics else {
        return Err(Error::not_applicable(model.name(), "it has no mesh"));
    };
    let (projectile, target) = numerics.elements;
    let mut elements = vec![("projectile_elements", projectile)];
    if !scenario.layers().is_empty() {
        elements.push(("target_elements", target));
    }
    Ok(MeshChoice {
        scenario,
        quantity,
        error,
        doubt,
        tolerance,
        elements,
    })
}

/// The coarsest of the three finest meshes that is within the tolerance, or the finest, with its error; `None` of meshes that differ in
/// their outcome.
fn coarsest(
    scenario: &Scenario,
    tried: &[(Scenario, RunResult)],
    tolerance: f64,
) -> Option<(usize, BandQuantity, f64)> {
    let first = tried.len().checked_sub(FEWEST)?;
    let of = |place: usize| number(scenario, &tried[first + place].1);
    let (quantity, _) = of(0);
    if (1..FEWEST).any(|place| of(place).0 != quantity) {
        return None;
    }
    let [coarse, medium, fine] = [of(0).1?, of(1).1?, of(2).1?];
    let errors = errors([coarse, medium, fine]);
    let place = errors.iter().position(|error| *error <= tolerance);
    let place = place.unwrap_or(FEWEST - 1);
    Some((first + place, quantity, errors[place]))
}

/// Main number of a run.
fn number(scenario: &Scenario, result: &RunResult) -> (BandQuantity, Option<f64>) {
    let quantity = main_number(scenario, result.outcome);
    (quantity, result.measurable(quantity))
}

/// Estimated errors of values on three meshes, from coarse to fine, as parts of the finest value.
fn errors(values: [f64; 3]) -> [f64; 3] {
    let mut cells = 1.0;
    let meshes = values.map(|value| {
        cells *= REFINEMENT;
        OnMesh { cells, value }
    });
    let [coarse, medium, fine] = values;
    let part = |difference: f64| match difference == 0.0 {
        true => 0.0,
        false => difference.abs() / fine.abs(),
    };
    let order = match trend(meshes) {
        Trend::Exact => return [part(coarse - fine), part(medium - fine), 0.0],
        Trend::Monotone { order } if order > *CREDIBLE_ORDERS.end() => CAUTIOUS_ORDER,
        Trend::Monotone { order } if CREDIBLE_ORDERS.contains(&order) => order,
        _ => {
            let differences = [coarse - medium, medium - fine, coarse - fine].map(part);
            let spread = differences.into_iter().fold(0.0, f64::max);
            // The finest lies this far from a limit, and the others as far from it.
            return [2.0 * spread, 2.0 * spread, spread];
        }
    };
    let limit = extrapolate(meshes[1], meshes[2], order);
    values.map(|value| SAFETY * part(value - limit))
}

impl MeshChoice {
    /// Whether the error is within the tolerance.
    pub fn is_within(&self) -> bool {
        self.error <= self.tolerance
    }

    /// The result on the mesh, with the mesh and its error among the details, and a warning where that exceeds the tolerance.
    #[must_use]
    pub fn told(&self, mut result: RunResult) -> RunResult {
        let of_body = |&(key, count): &(&str, usize)| {
            let name = match key {
                "target_elements" => "target elements of the chosen mesh",
                _ => "projectile elements of the chosen mesh",
            };
            Detail::new(name, "", count as f64)
        };
        let mut details: Vec<Detail> = self.elements.iter().map(of_body).collect();
        details.push(Detail::new(
            "tolerance of the mesh error",
            "%",
            100.0 * self.tolerance,
        ));
        if self.error.is_finite() {
            details.push(Detail::new(
                "estimated mesh error of the main number",
                "%",
                100.0 * self.error,
            ));
        }
        result.details.extend(details);
        if !self.is_within() {
            let counts = self.elements.iter().map(|(_, count)| count.to_string());
            let counts: Vec<String> = counts.collect();
            result.warnings.push(format!(
                "no mesh up to {} elements is within the tolerance of {} %: {}",
                counts.join(" + "),
                significant(100.0 * self.tolerance, 2),
                match self.doubt {
                    Some(doubt) => doubt.to_owned(),
                    None => format!(
                        "the {} on the finest one has an estimated error of {} %",
                        self.quantity.describe(),
                        significant(100.0 * self.error, 2)
                    ),
                }
            ));
        }
        result
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{NumericalError, case, chain::Chain, validity::ValidityDomain};

    /// The chain, which fails on some meshes.
    struct FailsOn(fn(usize) -> bool);

    impl Model for FailsOn {
        fn name(&self) -> &'static str {
            "chain"
        }

        fn summary(&self) -> &'static str {
            Chain.summary()
        }

        fn validity(&self) -> &'static ValidityDomain {
            Chain.validity()
        }

        fn refined(&self, scenario: &Scenario, factor: f64) -> Option<Scenario> {
            Chain.refined(scenario, factor)
        }

        fn run(&self, scenario: &Scenario, control: &mut Control<'_>) -> Result<RunResult, Error> {
            if (self.0)(scenario.options.chain.projectile_elements()) {
                let failure = NumericalError {
                    what: "made up".to_owned(),
                    step: 1,
                    time_us: 0.0,
                    element: None,
                    remedy: String::new(),
                };
                return Err(Box::new(failure).into());
            }
            Chain.run(scenario, control)
        }
    }

    fn chosen(fails: fn(usize) -> bool, tolerance: f64) -> Result<MeshChoice, Error> {
        let text = "projectile = { material = 'copper', length = '14 mm', diameter = '4.8 mm', impact_velocity = '230 m/s' }\n\
                    target = { material = 'aluminium-2024-t351', thickness = '25 mm' }\n\
                    chain = { projectile_elements = 8, target_elements = 16 }\n";
        let scenario = case::load_str("case", text).unwrap();
        choose_mesh(
            &FailsOn(fails),
            &scenario,
            tolerance,
            &mut Control::default(),
        )
    }

    #[test]
    fn meshes_that_fail_are_left_out() {
        let all = chosen(|_| false, 1e-9).unwrap();
        assert_eq!(
            all.elements,
            [("projectile_elements", 64), ("target_elements", 128)]
        );
        // Too coarse: the estimate is that of the finer ones.
        let fine = chosen(|elements| elements < 16, 1e-9).unwrap();
        assert_eq!((fine.error, &fine.elements), (all.error, &all.elements));
        // From a finer one on, and too few.
        let coarse = chosen(|elements| elements > 16, 1e-9).unwrap();
        assert_eq!(coarse.elements[0].1, 16);
        assert!(coarse.error.is_finite());
        let few = chosen(|elements| elements > 8, 1e-9).unwrap();
        assert_eq!((few.elements[0].1, few.error), (8, f64::INFINITY));
        assert_eq!(few.doubt, Some("too few meshes have a result"));
        assert!(matches!(chosen(|_| true, 1e-9), Err(Error::Numerical(_))));
    }

    #[test]
    fn errors_are_those_of_a_power_of_the_cell_size_with_a_factor_of_safety() {
        for order in [0.7, 1.0, 2.0] {
            let values = [1.0, 0.5, 0.25].map(|h: f64| 3.0 * (1.0 + 0.1 * h.powf(order)));
            let found = errors(values);
            for (found, h) in found.into_iter().zip([1.0, 0.5, 0.25_f64]) {
                let exact = 0.1 * h.powf(order) * 3.0 / values[2];
                assert!((found / exact - 1.25).abs() < 1e-9, "{order} {h} {found}");
            }
        }
    }

    #[test]
    fn meshes_that_approach_no_limit_have_the_error_of_their_spread() {
        // Oscillating, diverging, and two equal values before a third.
        for values in [[1.0, 1.2, 1.1], [1.0, 1.1, 1.3], [1.0, 1.0, 1.1]] {
            let [coarse, medium, fine] = errors(values);
            assert_eq!([coarse, medium], [2.0 * fine; 2]);
            let spread = values.iter().fold(0.0_f64, |most, a| {
                most.max(values.iter().fold(0.0, |m, b| m.max((a - b).abs())))
            });
            assert!((fine - spread / values[2]).abs() < 1e-12, "{values:?}");
        }
        // An order of 3.3 is no more than a coincidence: the last difference counts.
        let [_, _, fine] = errors([1.0, 1.2, 1.22]);
        assert!((fine - 1.25 * 0.02 / 1.22).abs() < 1e-12, "{fine}");
        assert_eq!(errors([1.0, 1.0, 1.0]), [0.0; 3]);
        assert_eq!(errors([0.0; 3]), [0.0; 3]);
    }
}
