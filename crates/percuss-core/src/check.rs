//! Range checks that remember which key they looked at.

use std::fmt::Display;

use crate::{
    error::{InputError, Subject},
    units::{Dimension, Quantity, display, significant},
};

/// Smallest and largest value allowed, in SI units, both included.
#[derive(Debug, Clone, Copy)]
pub struct Limits {
    /// Smallest value allowed.
    pub min: f64,
    /// Largest value allowed.
    pub max: f64,
}

/// Rounding of a conversion of units, relative: `10 um` is a little less than 1e-5 m.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

impl Limits {
    /// Whether a value is allowed; a limit in another unit is, NaN is not.
    pub fn allow(&self, value: f64) -> bool {
        let slack = ROUNDING * value.abs();
        value + slack >= self.min && value - slack <= self.max
    }
}

/// A diagnostic of a check, before it is tied to a place in a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Diagnostic {
    /// What it is about.
    pub subject: Subject,
    /// Key in dotted form.
    pub key: String,
    /// What is wrong.
    pub message: String,
    /// What is allowed and what to do.
    pub help: String,
    /// Whether a value is outside its range, wherever it stands; otherwise it does not fit what else is given.
    pub out_of_range: bool,
}

impl Diagnostic {
    /// The same of a file of materials that cannot be read.
    pub fn of_material_file(self) -> Self {
        Self {
            subject: Subject::MaterialFile,
            ..self
        }
    }

    /// The same of a case file that cannot be read.
    pub fn of_case_file(self) -> Self {
        Self {
            subject: Subject::CaseFile,
            ..self
        }
    }

    /// What is wrong in a file as a whole.
    pub fn whole(message: impl Into<String>, help: impl Into<String>) -> Self {
        Self::at("", message, help)
    }

    /// What is wrong at a key.
    pub fn at(key: &str, message: impl Into<String>, help: impl Into<String>) -> Self {
        Self {
            subject: Subject::Case,
            key: key.to_owned(),
            message: message.into(),
            help: help.into(),
            out_of_range: false,
        }
    }

    /// The same of a material.
    pub fn of_material(self) -> Self {
        Self {
            subject: Subject::Material,
            ..self
        }
    }

    /// The error of something that comes from no file; `name` stands for it.
    pub fn in_no_file(self, name: &str) -> InputError {
        InputError {
            subject: self.subject,
            file: name.to_owned(),
            text: String::new(),
            span: 0..0,
            key: self.key,
            message: self.message,
            help: self.help,
        }
    }

    /// The same at a key within a table.
    pub fn within(self, table: &str) -> Self {
        Self {
            key: format!("{table}.{}", self.key),
            ..self
        }
    }
}

/// Collects diagnostics; keys are relative to the table it stands in.
#[derive(Debug)]
pub struct Check<'a> {
    subject: Subject,
    prefix: String,
    diagnostics: &'a mut Vec<Diagnostic>,
}

impl<'a> Check<'a> {
    /// A check at the root of a file.
    pub fn new(diagnostics: &'a mut Vec<Diagnostic>) -> Self {
        Self {
            subject: Subject::Case,
            prefix: String::new(),
            diagnostics,
        }
    }

    /// A check one table further in.
    pub fn within(&mut self, table: &str) -> Check<'_> {
        Check {
            subject: self.subject,
            prefix: self.key(table),
            diagnostics: self.diagnostics,
        }
    }

    /// The same check, of a material.
    pub fn of_material(&mut self) -> Check<'_> {
        Check {
            subject: Subject::Material,
            prefix: self.prefix.clone(),
            diagnostics: self.diagnostics,
        }
    }

    fn key(&self, key: &str) -> String {
        match (self.prefix.is_empty(), key.is_empty()) {
            (true, _) => key.to_owned(),
            (false, true) => self.prefix.clone(),
            (false, false) => format!("{}.{key}", self.prefix),
        }
    }

    /// Reports a diagnostic at a key; an empty key is the table itself.
    pub fn fail(&mut self, key: &str, message: impl Into<String>, help: impl Into<String>) {
        let diagnostic = Diagnostic::at(&self.key(key), message, help);
        self.diagnostics.push(Diagnostic {
            subject: self.subject,
            ..diagnostic
        });
    }

    /// Reports a value that is out of range at a key; `help` says what is allowed.
    pub fn out_of_range(&mut self, key: &str, value: impl Display, help: impl Into<String>) {
        let message = format!("{value} is out of range");
        self.diagnostics.push(Diagnostic {
            subject: self.subject,
            out_of_range: true,
            ..Diagnostic::at(&self.key(key), message, help)
        });
    }

    /// Reports each key that is given where it may not be.
    pub fn refuse(&mut self, keys: &[(&str, bool)], message: impl Fn(&str) -> String, help: &str) {
        for (key, _) in keys.iter().filter(|(_, given)| *given) {
            self.fail(key, message(key), help);
        }
    }

    /// Reports a quantity outside its limits, where one is given.
    pub fn quantity<D: Dimension>(
        &mut self,
        key: &str,
        value: impl Into<Option<Quantity<D>>>,
        limits: Limits,
    ) {
        if let Some(value) = value.into().filter(|value| !limits.allow(value.si())) {
            self.out_of_range(
                key,
                value,
                format!(
                    "allowed: {} to {}{}",
                    display::<D>(limits.min),
                    display::<D>(limits.max),
                    unit_error(value.si(), limits)
                ),
            );
        }
    }

    /// Reports a plain number outside its limits, where one is given.
    pub fn number(&mut self, key: &str, value: impl Into<Option<f64>>, limits: Limits) {
        if let Some(value) = value.into().filter(|value| !limits.allow(*value)) {
            self.out_of_range(
                key,
                significant(value, 6),
                format!(
                    "allowed: {} to {}",
                    significant(limits.min, 6),
                    significant(limits.max, 6)
                ),
            );
        }
    }
}

/// Says that a value would fit with another prefix of its unit, if it would.
fn unit_error(value: f64, limits: Limits) -> &'static str {
    let fits = |value: f64| value > 0.0 && (limits.min..=limits.max).contains(&value);
    if fits(value * 1000.0) || fits(value / 1000.0) {
        "; is it off by a factor of 1000?"
    } else {
        ""
    }
}

/// Limits of what a case or a material may hold: wide enough for any real one, narrow enough to detect a unit error.
pub mod limits {
    use super::Limits;

    /// Most elements that one body may have: beyond it a run takes hours and its histories gigabytes.
    pub const MAX_ELEMENTS: u32 = 100_000;

    const fn limits(min: f64, max: f64) -> Limits {
        Limits { min, max }
    }

    /// Length of a projectile or a layer [m].
    pub const LENGTH: Limits = limits(1e-5, 100.0);
    /// Distance between two layers [m].
    pub const GAP: Limits = limits(0.0, 100.0);
    /// Position of a gauge [m].
    pub const GAUGE_POSITION: Limits = limits(-100.0, 400.0);
    /// Diameter [m].
    pub const DIAMETER: Limits = limits(1e-5, 10.0);
    /// Mass [kg].
    pub const MASS: Limits = limits(1e-9, 1e5);
    /// Impact velocity [m/s].
    pub const IMPACT_VELOCITY: Limits = limits(0.0, 10_000.0);
    /// Impact velocity other than zero [m/s]: below the least one rounding may exceed the energy of the impact.
    pub const MOVING: Limits = limits(1e-6, IMPACT_VELOCITY.max);
    /// Angle of an impact to the normal [rad]: up to 85 degrees.
    pub const OBLIQUITY: Limits = limits(0.0, 85.0 * std::f64::consts::PI / 180.0);
    /// Density [kg/m3]; the lightest structural foams weigh about 15.
    pub const DENSITY: Limits = limits(15.0, 25_000.0);
    /// Young's modulus [Pa].
    pub const YOUNGS_MODULUS: Limits = limits(1e6, 1.5e12);
    /// Poisson's ratio.
    pub const POISSONS_RATIO: Limits = limits(0.0, 0.499);
    /// Flow stress [Pa].
    pub const FLOW_STRESS: Limits = limits(1e3, 2e10);
    /// Hardening coefficient of a Johnson–Cook law [Pa].
    pub const HARDENING_COEFFICIENT: Limits = limits(0.0, 1e11);
    /// Ratio B/A of a Johnson–Cook law that hardens.
    pub const HARDENING_TO_YIELD: Limits = limits(0.015, 300.0);
    /// Exponent of a power law; at 1 it would not meet the elastic line.
    pub const HARDENING_EXPONENT: Limits = limits(0.0, 0.95);
    /// Hardening exponent of a Johnson–Cook or Steinberg law.
    pub const JOHNSON_COOK_EXPONENT: Limits = limits(0.0, 2.0);
    /// Rate coefficient C.
    pub const RATE_COEFFICIENT: Limits = limits(0.0, 1.0);
    /// Thermal softening exponent m.
    pub const THERMAL_EXPONENT: Limits = limits(0.05, 10.0);
    /// Strain rate [1/s].
    pub const STRAIN_RATE: Limits = limits(1e-8, 1e9);
    /// Steinberg's β.
    pub const STEINBERG_BETA: Limits = limits(0.0, 1e6);
    /// Plastic strain.
    pub const PLASTIC_STRAIN: Limits = limits(0.0, 100.0);
    /// Pressure coefficient of the shear modulus [1/Pa], where it is not zero.
    pub const PRESSURE_COEFFICIENT: Limits = limits(1e-12, 1e-9);
    /// Temperature coefficient of the shear modulus [1/K], where it is not zero.
    pub const TEMPERATURE_COEFFICIENT: Limits = limits(1e-5, 1e-2);
    /// Specific heat [J/(kg K)].
    pub const SPECIFIC_HEAT: Limits = limits(50.0, 10_000.0);
    /// Temperature [K].
    pub const TEMPERATURE: Limits = limits(1.0, 6000.0);
    /// Ratio of yield stress to Young's modulus; a stronger solid than E/10 does not exist.
    pub const YIELD_TO_MODULUS: Limits = limits(5e-5, 0.1);
    /// Speed of a wave in a thin bar [m/s].
    pub const BAR_WAVE_SPEED: Limits = limits(250.0, 20_000.0);
    /// Factor on the flow stress of a target.
    pub const CONSTRAINT_FACTOR: Limits = limits(0.1, 20.0);
    /// Border-shear coefficient C.
    pub const BORDER_SHEAR: Limits = limits(0.0, 10.0);
    /// Width of a shear band [m].
    pub const BAND_WIDTH: Limits = limits(1e-6, 0.1);
    /// Plastic shear strain at which a band fails.
    pub const BAND_STRAIN: Limits = limits(0.01, 1000.0);
    /// Courant number.
    pub const COURANT: Limits = limits(1e-4, 1.0);
    /// Exponent of a cumulative failure law.
    pub const FAILURE_EXPONENT: Limits = limits(0.1, 20.0);
    /// Time to failure under a constant tension [s].
    pub const FAILURE_TIME: Limits = limits(1e-12, 1.0);
    /// Energy that opens a crack, per area [J/m2]; 0 parts at once.
    pub const FRACTURE_ENERGY: Limits = limits(0.0, 1e7);
    /// Fracture energy of a material, per area [J/m2].
    pub const BRITTLE_ENERGY: Limits = limits(1e-2, 1e6);
    /// Tensile strength of a brittle material [Pa].
    pub const TENSILE_STRENGTH: Limits = limits(1e4, 2e10);
    /// Largest tensile strength of a brittle material over its Young's modulus.
    pub const STRENGTH_OVER_MODULUS: f64 = 0.1;
    /// Length `E G/f²` of a brittle material [m].
    pub const CHARACTERISTIC_LENGTH: Limits = limits(1e-7, 100.0);
    /// Fraction of the unbalanced force; at 1 nothing would move.
    pub const LOCAL_DAMPING: Limits = limits(0.0, 0.95);
    /// Failure strains D₁ and D₂ of a Johnson–Cook damage law; D₁ alone may be negative.
    pub const DAMAGE_STRAIN: Limits = limits(-10.0, 100.0);
    /// Its exponent D₃ of the stress triaxiality; tension is positive, and makes the material fail earlier.
    pub const TRIAXIALITY_EXPONENT: Limits = limits(-20.0, 0.0);
    /// Its rate coefficient D₄.
    pub const DAMAGE_RATE_COEFFICIENT: Limits = limits(-1.0, 1.0);
    /// Its thermal coefficient D₅.
    pub const DAMAGE_THERMAL_COEFFICIENT: Limits = limits(-1.0, 20.0);
    /// Plastic strain at which a solid fails in shear.
    pub const FAILURE_STRAIN: Limits = limits(0.001, 100.0);
    /// Strain at which an element erodes.
    pub const EROSION_STRAIN: Limits = limits(0.05, 20.0);
    /// Coefficient of artificial viscosity.
    pub const VISCOSITY: Limits = limits(0.0, 10.0);
    /// Fraction of critical damping.
    pub const DAMPING: Limits = limits(0.0, 2.0);
    /// Fraction of plastic work that becomes heat.
    pub const HEAT_FRACTION: Limits = limits(0.0, 1.0);
    /// End of a run [s].
    pub const TIME: Limits = limits(1e-9, 10.0);
    /// Nose length in units of the body's diameter, cone.
    pub const CONE_RATIO: Limits = limits(0.1, 20.0);
    /// Half angle of a cone [rad], from 1.4321 to 78.69 degrees: that of a length in [`CONE_RATIO`], rounded inwards.
    pub const CONE_HALF_ANGLE: Limits = limits(
        1.4321 * std::f64::consts::PI / 180.0,
        78.69 * std::f64::consts::PI / 180.0,
    );
    /// Nose length in units of the body's diameter, ogive: that of [`CALIBER_RADIUS_HEAD`], rounded inwards.
    pub const OGIVE_RATIO: Limits = limits(0.5, 7.05);
    /// Caliber-radius-head of an ogive.
    pub const CALIBER_RADIUS_HEAD: Limits = limits(0.5, 50.0);
    /// Unconfined compressive strength of concrete [Pa].
    pub const CONCRETE_STRENGTH: Limits = limits(1e6, 3e8);
    /// Bulk sound speed [m/s].
    pub const SOUND_SPEED: Limits = limits(100.0, 15_000.0);
    /// Slope of shock speed against particle speed.
    pub const HUGONIOT_SLOPE: Limits = limits(0.5, 4.0);
    /// Grüneisen's parameter.
    pub const GRUNEISEN: Limits = limits(0.0, 5.0);
    /// Brinell hardness [kgf/mm2].
    pub const BRINELL_HARDNESS: Limits = limits(10.0, 900.0);
    /// Strength coefficient A of a cavity expansion.
    pub const CAVITY_STRENGTH: Limits = limits(0.5, 20.0);
    /// Inertia coefficient B of a cavity expansion.
    pub const CAVITY_INERTIA: Limits = limits(0.0, 5.0);
    /// Coefficient of friction.
    pub const FRICTION: Limits = limits(0.0, 1.0);
    /// Coefficient of a drag `C ρ V²`.
    pub const DRAG: Limits = limits(0.0, 5.0);
    /// Factor S on the compressive strength of concrete.
    pub const CONCRETE_FACTOR: Limits = limits(1.0, 100.0);
    /// Depth of a crater in projectile diameters.
    pub const CRATER_DEPTH: Limits = limits(0.0, 10.0);
    /// Diameter of a crater in projectile diameters.
    pub const CRATER_DIAMETER: Limits = limits(1.0, 20.0);
    /// Distance of a plastic front from a wall over the length of the rod.
    pub const FRONT: Limits = limits(0.0, 0.9);
    /// Contact pressure of a constant-pressure target [Pa].
    pub const CONTACT_PRESSURE: Limits = limits(1e3, 1e11);
    /// Coefficient B of the inertial pressure of a cavity.
    pub const INERTIA_COEFFICIENT: Limits = limits(0.0, 10.0);
    /// Factor a of a residual velocity.
    pub const RESIDUAL_FACTOR: Limits = limits(0.01, 1.0);
    /// Exponent p of a residual velocity.
    pub const RESIDUAL_EXPONENT: Limits = limits(1.0, 20.0);
}

#[cfg(test)]
mod tests {
    use super::limits;
    use crate::units::{Length, Velocity};

    #[test]
    fn limits_are_allowed_in_every_unit() {
        for text in ["10 um", "0.01 mm", "10 m", "10000 mm", "1e7 um"] {
            let length: Length = text.parse().unwrap();
            assert!(limits::DIAMETER.allow(length.si()), "{text}");
        }
        for text in ["9.9999 um", "10.0001 m"] {
            let length: Length = text.parse().unwrap();
            assert!(!limits::DIAMETER.allow(length.si()), "{text}");
        }
        let speed: Velocity = "0 m/s".parse().unwrap();
        let free = super::Limits { min: 0.0, max: 1.0 };
        assert!(free.allow(speed.si()) && !free.allow(-1e-300));
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert!(!free.allow(value), "{value}");
        }
    }
}
