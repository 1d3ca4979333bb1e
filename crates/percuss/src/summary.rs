//! The result of a run as one flat record in the field's units: what `--json` prints and tables show.

use serde::Serialize;

use crate::{
    outcome::{Outcome, RunResult, Termination},
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
    /// How the shot ended.
    pub outcome: Outcome,
    /// Why the run was ended.
    pub termination: Termination,
    /// Why the model does not apply, if it does not.
    pub reason: Option<String>,
    /// Impact speed [m/s].
    pub impact_velocity_m_s: f64,
    /// Depth of the crater floor when the projectile's momentum is used up [mm].
    pub depth_of_penetration_mm: Option<f64>,
    /// Largest depth at any time, elastic deflection included [mm].
    pub largest_depth_mm: Option<f64>,
    /// Depth left once the load is gone [mm].
    pub permanent_depth_mm: Option<f64>,
    /// Mean speed of what is left of the projectile at the end, forward positive [m/s].
    pub residual_velocity_m_s: f64,
    /// Unloaded length of what is left of the projectile [mm].
    pub projectile_final_length_mm: f64,
    /// Largest unloaded diameter of what is left of the projectile [mm].
    pub projectile_final_diameter_mm: Option<f64>,
    /// Mass left of the projectile [g].
    pub projectile_final_mass_g: f64,
    /// Time at which the projectile's momentum was used up [us].
    pub time_to_rest_us: Option<f64>,
    /// Largest force between projectile and target [kN].
    pub peak_force_kn: f64,
    /// Time at the end of the run [us].
    pub end_time_us: f64,
    /// Time steps taken.
    pub steps: u64,
    /// First time step [ns].
    pub time_step_ns: f64,
    /// Smallest time step [ns].
    pub smallest_time_step_ns: f64,
    /// Elements of the projectile that eroded.
    pub eroded_projectile_elements: usize,
    /// Elements of the target that eroded.
    pub eroded_target_elements: usize,
    /// Largest plastic strain in the projectile.
    pub projectile_plastic_strain: f64,
    /// Largest plastic strain in the target.
    pub target_plastic_strain: f64,
    /// Largest temperature in the projectile [K].
    pub projectile_temperature_k: f64,
    /// Largest temperature in the target [K].
    pub target_temperature_k: f64,
    /// Kinetic energy at impact [J].
    pub impact_energy_j: f64,
    /// Largest part of the initial energy that no line of the book accounted for.
    pub energy_residual: f64,
    /// Largest part of the initial momentum that no line of the book accounted for.
    pub momentum_residual: f64,
    /// What a user should know before relying on the numbers.
    pub warnings: Vec<String>,
}

impl ResultRecord {
    /// The record of a result.
    pub fn new(scenario: &Scenario, result: &RunResult) -> Self {
        let mm = |length: Option<f64>| length.map(|length| length * 1e3);
        Self {
            model: result.model,
            scheme: result.scheme,
            outcome: result.outcome,
            termination: result.termination,
            reason: None,
            impact_velocity_m_s: scenario.impact_speed,
            depth_of_penetration_mm: mm(result.depth_of_penetration),
            largest_depth_mm: mm(result.largest_depth),
            permanent_depth_mm: mm(result.permanent_depth),
            residual_velocity_m_s: result.residual_velocity,
            projectile_final_length_mm: result.projectile_final_length * 1e3,
            projectile_final_diameter_mm: mm(result.projectile_final_diameter),
            projectile_final_mass_g: result.projectile_final_mass * 1e3,
            time_to_rest_us: result.time_to_rest.map(|time| time * 1e6),
            peak_force_kn: result.peak_force * 1e-3,
            end_time_us: result.end_time * 1e6,
            steps: result.steps,
            time_step_ns: result.first_time_step * 1e9,
            smallest_time_step_ns: result.smallest_time_step * 1e9,
            eroded_projectile_elements: result.eroded_elements.0,
            eroded_target_elements: result.eroded_elements.1,
            projectile_plastic_strain: result.largest_plastic_strain.0,
            target_plastic_strain: result.largest_plastic_strain.1,
            projectile_temperature_k: result.largest_temperature.0,
            target_temperature_k: result.largest_temperature.1,
            impact_energy_j: result.energy.initial,
            energy_residual: result.energy_residual,
            momentum_residual: result.momentum_residual,
            warnings: result.warnings.clone(),
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
