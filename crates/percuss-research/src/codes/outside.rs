//! Results of other codes, stored as data, and the cases that they are of.

use percuss::{Error, Scenario, case};
use serde::{Deserialize, Serialize};

use super::quantity::Quantity;

/// Stored results.
const BUILT_IN: &str = include_str!("../../data/codes/results.csv");

/// Reads the case files of the folder `data/codes` into [`CASES`].
macro_rules! cases {
    ($($name:literal),* $(,)?) => {
        &[$(($name, include_str!(concat!("../../data/codes/", $name, ".toml")))),*]
    };
}

/// Names and texts of the compared cases, in the order of the page.
pub const CASES: &[(&str, &str)] = cases![
    "copper-on-wall",
    "johnson-cook-rod-on-wall",
    "johnson-cook-rate-rod-on-wall",
    "copper-on-2024",
    "copper-plate-on-aluminium",
    "copper-plate-on-aluminium-spall",
    "blunt-on-weldox",
];

/// One number of another code, with the run of percuss that it is compared with.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct OutsideResult {
    /// Name of the case: one of [`CASES`].
    pub case: String,
    /// Impact velocity [m/s].
    pub impact_velocity_m_s: f64,
    /// Name of the code.
    pub code: String,
    /// Commit of its repository.
    pub commit: String,
    /// Method and mesh of the code.
    pub resolution: String,
    /// Quantity.
    pub quantity: Quantity,
    /// Value in `unit`.
    pub value: f64,
    /// Unit.
    pub unit: String,
    /// Error of the code's own energy balance, relative to the impact energy [%]; `None` where it was not recorded.
    pub energy_error_percent: Option<f64>,
    /// Model of percuss that it is compared with.
    pub model: String,
    /// Cells along the radius (`axi`) or elements along the projectile.
    pub mesh: u32,
    /// Known relative difference of percuss from the value [%]; of a quantity in per cent, the difference.
    pub difference_percent: f64,
    /// Largest distance of the difference from the known one that passes the test [%].
    pub tolerance_percent: f64,
    /// Reason of the tolerance, and what else a reader needs.
    pub note: String,
}

/// Stored results.
///
/// # Panics
/// Never: a test reads them.
pub fn built_in() -> Vec<OutsideResult> {
    csv::Reader::from_reader(BUILT_IN.as_bytes())
        .deserialize()
        .collect::<Result<_, _>>()
        .expect("the stored results are valid")
}

/// Case of a name, at an impact velocity [m/s].
///
/// # Errors
/// [`Error::Input`]; the test of the stored results reads every case.
pub fn scenario(name: &str, impact_velocity: f64) -> Result<Scenario, Error> {
    let text = CASES
        .iter()
        .find(|(case, _)| *case == name)
        .map_or("", |(_, text)| text);
    let mut scenario = case::load_str(name, text)?;
    scenario.impact_velocity = impact_velocity;
    Ok(scenario)
}

/// Number of elements or cells of a run in its options.
pub(super) fn set_mesh(scenario: &mut Scenario, model: &str, mesh: u32) {
    let options = &mut scenario.options;
    match model {
        "axi" => options.axi.cells_per_radius = Some(mesh),
        "fdm" => options.fdm.projectile_elements = Some(mesh),
        _ => options.chain.projectile_elements = Some(mesh),
    }
}
