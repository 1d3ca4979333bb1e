//! The result of a run as one flat record in the field's units: what `--json` prints and tables show.

use serde::Serialize;

use crate::{
    Error,
    chain::closure_in_use,
    fragments::FragmentRecord,
    model_error::{Expectation, expected_error},
    options::TargetClosure,
    outcome::{Band, Detail, Outcome, RunResult, Termination},
    regime::Regime,
    scenario::Scenario,
};

/// One case and the results of one or more models. The names are stable.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CaseResults {
    /// Name of the case.
    pub case: String,
    /// Version of the program.
    pub percuss_version: &'static str,
    /// One entry a model.
    pub results: Vec<ResultRecord>,
}

/// Scalar results of one model. The names are stable; a number that the model cannot give is null.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ResultRecord {
    /// Name of the model.
    pub model: &'static str,
    /// Scheme of the model.
    pub scheme: &'static str,
    /// Why it is this model and not the default one, of a run that names none; null otherwise.
    pub model_choice: Option<String>,
    /// What stood for the target: `chain.target_closure`, where there is a choice of it.
    pub target_closure: Option<&'static str>,
    /// Why that is not the usual one, of a case that names none, with the depth by the usual one if it differs by more than a tenth; null
    /// otherwise.
    pub target_closure_choice: Option<String>,
    /// How the shot ended.
    pub outcome: Outcome,
    /// What the outcome was told by, in words; null where the model names nothing beyond its termination.
    pub criterion: Option<String>,
    /// Why the run was ended.
    pub termination: Option<Termination>,
    /// Why there is no result, if there is none.
    pub reason: Option<String>,
    /// Impact speed [m/s].
    pub impact_velocity_m_s: f64,
    /// Depth of the crater floor when the projectile's momentum is used up [mm].
    pub depth_of_penetration_mm: Option<f64>,
    /// Error to expect of that depth against the axisymmetric reference, where shots like this one were judged.
    pub expected_error: Option<Expectation>,
    /// Largest depth at any time, elastic deflection included [mm].
    pub largest_depth_mm: Option<f64>,
    /// Depth left once the load is gone [mm].
    pub permanent_depth_mm: Option<f64>,
    /// Mean speed of what is left of the projectile at the end, forward positive [m/s].
    pub residual_velocity_m_s: Option<f64>,
    /// Impact speed above which the target is perforated [m/s].
    pub ballistic_limit_m_s: Option<f64>,
    /// Range that the model gives its main number.
    pub band: Option<Band>,
    /// Unloaded length of what is left of the projectile [mm].
    pub projectile_final_length_mm: Option<f64>,
    /// Largest unloaded diameter of what is left of the projectile [mm].
    pub projectile_final_diameter_mm: Option<f64>,
    /// Mass left of the projectile [g].
    pub projectile_final_mass_g: Option<f64>,
    /// Mass of the plug that a plate let go [g].
    pub plug_mass_g: Option<f64>,
    /// Its speed [m/s].
    pub plug_velocity_m_s: Option<f64>,
    /// Time at which the projectile's momentum was used up [us].
    pub time_to_rest_us: Option<f64>,
    /// Largest force between projectile and target [kN].
    pub peak_force_kn: Option<f64>,
    /// Total time during which projectile and target touch, pauses left out [us]; to the end of a run that ends before they part.
    pub contact_time_us: Option<f64>,
    /// Time at the end of the run [us].
    pub end_time_us: Option<f64>,
    /// Time steps taken.
    pub steps: Option<u64>,
    /// First time step [ns].
    pub time_step_ns: Option<f64>,
    /// Smallest time step [ns].
    pub smallest_time_step_ns: Option<f64>,
    /// Elements of the projectile that eroded.
    pub eroded_projectile_elements: Option<usize>,
    /// Elements of the target that eroded.
    pub eroded_target_elements: Option<usize>,
    /// Largest plastic strain in the projectile.
    pub projectile_plastic_strain: Option<f64>,
    /// Largest plastic strain in the target.
    pub target_plastic_strain: Option<f64>,
    /// Largest temperature in the projectile [K].
    pub projectile_temperature_k: Option<f64>,
    /// Largest temperature in the target [K].
    pub target_temperature_k: Option<f64>,
    /// Kinetic energy at impact [J].
    pub impact_energy_j: f64,
    /// Largest part of the initial energy that no line of the book accounted for.
    pub energy_residual: Option<f64>,
    /// Largest part of the initial momentum that no line of the book accounted for.
    pub momentum_residual: Option<f64>,
    /// Pieces that fly free at the end, from the projectile's tail to the target's back.
    pub fragments: Vec<FragmentRecord>,
    /// Numbers that this model alone has.
    pub details: Vec<Detail>,
    /// What a user should know before relying on the numbers.
    pub warnings: Vec<String>,
}

impl ResultRecord {
    /// The record of a result, with the error to expect of its depth.
    pub fn new(scenario: &Scenario, result: &RunResult) -> Self {
        Self::in_regime(scenario, &Regime::of(scenario), result)
    }

    /// The record of a result of a case whose regime is known already.
    pub(crate) fn in_regime(scenario: &Scenario, regime: &Regime, result: &RunResult) -> Self {
        let mm = |length: Option<f64>| length.map(|length| length * 1e3);
        let us = |time: Option<f64>| time.map(|time| time * 1e6);
        let numerics = result.numerics.as_ref();
        Self {
            model_choice: result.model_choice.clone(),
            target_closure_choice: result.target_closure_choice.clone(),
            criterion: (!result.criterion.is_empty()).then(|| result.criterion.clone()),
            termination: Some(result.termination),
            depth_of_penetration_mm: mm(result.depth_of_penetration),
            expected_error: expected_error(scenario, regime, result),
            largest_depth_mm: mm(result.largest_depth),
            permanent_depth_mm: mm(result.permanent_depth),
            residual_velocity_m_s: result.residual_velocity,
            ballistic_limit_m_s: result.ballistic_limit,
            band: result.band.clone(),
            projectile_final_length_mm: mm(result.projectile_final_length),
            projectile_final_diameter_mm: mm(result.projectile_final_diameter),
            projectile_final_mass_g: mm(result.projectile_final_mass),
            plug_mass_g: mm(result.plug_mass),
            plug_velocity_m_s: result.plug_velocity,
            time_to_rest_us: us(result.time_to_rest),
            peak_force_kn: result.peak_force.map(|force| force * 1e-3),
            contact_time_us: us(result.contact_time),
            end_time_us: us(result.end_time),
            steps: numerics.map(|n| n.steps),
            time_step_ns: numerics.map(|n| n.first_time_step * 1e9),
            smallest_time_step_ns: numerics.map(|n| n.smallest_time_step * 1e9),
            eroded_projectile_elements: numerics.map(|n| n.eroded_elements.0),
            eroded_target_elements: numerics.map(|n| n.eroded_elements.1),
            projectile_plastic_strain: numerics.map(|n| n.largest_plastic_strain.0),
            target_plastic_strain: numerics.map(|n| n.largest_plastic_strain.1),
            projectile_temperature_k: numerics.map(|n| n.largest_temperature.0),
            target_temperature_k: numerics.map(|n| n.largest_temperature.1),
            energy_residual: numerics.map(|n| n.energy_residual),
            momentum_residual: numerics.map(|n| n.momentum_residual),
            fragments: result.fragments.iter().map(FragmentRecord::from).collect(),
            details: result.details.clone(),
            warnings: result.warnings.clone(),
            ..Self::empty(scenario, result.model, result.scheme, result.outcome)
        }
    }

    /// The record of a model that gave no result on a case, with the reason.
    ///
    /// [`Error::NotApplicable`] becomes [`Outcome::NotApplicable`], any other error [`Outcome::Failed`].
    pub fn without_result(scenario: &Scenario, model: &'static str, error: &Error) -> Self {
        let (outcome, reason) = match error {
            Error::NotApplicable { reason, .. } => (Outcome::NotApplicable, reason.clone()),
            other => (Outcome::Failed, other.to_string()),
        };
        Self {
            reason: Some(reason),
            ..Self::empty(scenario, model, "", outcome)
        }
    }

    fn empty(
        scenario: &Scenario,
        model: &'static str,
        scheme: &'static str,
        outcome: Outcome,
    ) -> Self {
        let closure = closure_in_use(scenario).filter(|_| model == "chain");
        Self {
            model,
            scheme,
            model_choice: None,
            target_closure_choice: None,
            target_closure: closure.map(TargetClosure::name),
            outcome,
            criterion: None,
            termination: None,
            reason: None,
            impact_velocity_m_s: scenario.impact_speed,
            depth_of_penetration_mm: None,
            expected_error: None,
            largest_depth_mm: None,
            permanent_depth_mm: None,
            residual_velocity_m_s: None,
            ballistic_limit_m_s: None,
            band: None,
            projectile_final_length_mm: None,
            projectile_final_diameter_mm: None,
            projectile_final_mass_g: None,
            plug_mass_g: None,
            plug_velocity_m_s: None,
            time_to_rest_us: None,
            peak_force_kn: None,
            contact_time_us: None,
            end_time_us: None,
            steps: None,
            time_step_ns: None,
            smallest_time_step_ns: None,
            eroded_projectile_elements: None,
            eroded_target_elements: None,
            projectile_plastic_strain: None,
            target_plastic_strain: None,
            projectile_temperature_k: None,
            target_temperature_k: None,
            impact_energy_j: 0.5 * scenario.projectile.mass * scenario.impact_speed.powi(2),
            energy_residual: None,
            momentum_residual: None,
            fragments: Vec::new(),
            details: Vec::new(),
            warnings: Vec::new(),
        }
    }
}

impl CaseResults {
    /// The results of a case.
    pub fn new(scenario: &Scenario, results: &[RunResult]) -> Self {
        Self {
            case: scenario.name.clone(),
            percuss_version: env!("CARGO_PKG_VERSION"),
            results: results
                .iter()
                .map(|result| ResultRecord::new(scenario, result))
                .collect(),
        }
    }
}
