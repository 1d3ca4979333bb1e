//! Field quantities of pictures.

use percuss::{Scenario, axi::Particle, model::Model, particles};

/// A field over the material points.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum FieldQuantity {
    /// Equivalent plastic strain.
    #[default]
    PlasticStrain,
    /// Temperature.
    Temperature,
    /// Equivalent stress of von Mises.
    VonMisesStress,
    /// Pressure, compression positive.
    Pressure,
    /// Magnitude of the velocity.
    Speed,
    /// Density.
    Density,
    /// Damage.
    Damage,
}

impl FieldQuantity {
    /// All quantities.
    pub const ALL: [Self; 7] = [
        Self::PlasticStrain,
        Self::Temperature,
        Self::VonMisesStress,
        Self::Pressure,
        Self::Speed,
        Self::Density,
        Self::Damage,
    ];

    /// The one that shows most of a case: the damage or the stress of an elastic lattice, otherwise the plastic strain.
    pub fn of_case(model: &dyn Model, scenario: &Scenario) -> Self {
        match model.name() {
            "particles" if particles::breaks(scenario) => Self::Damage,
            "particles" => Self::VonMisesStress,
            _ => Self::PlasticStrain,
        }
    }

    /// Its name on a command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::PlasticStrain => "plastic-strain",
            Self::Temperature => "temperature",
            Self::VonMisesStress => "von-mises-stress",
            Self::Pressure => "pressure",
            Self::Speed => "speed",
            Self::Density => "density",
            Self::Damage => "damage",
        }
    }

    /// The one with this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL
            .into_iter()
            .find(|quantity| quantity.name() == name)
    }

    /// Name with the unit in parentheses.
    pub fn label(self) -> &'static str {
        match self {
            Self::PlasticStrain => "Equivalent plastic strain",
            Self::Temperature => "Temperature (K)",
            Self::VonMisesStress => "Von Mises stress (MPa)",
            Self::Pressure => "Pressure (MPa)",
            Self::Speed => "Speed (m/s)",
            Self::Density => "Density (kg/m³)",
            Self::Damage => "Damage",
        }
    }

    /// Its value in a particle, in the unit of the label.
    pub fn value(self, particle: &Particle) -> f64 {
        let (_, _, unit) = self.source();
        self.si_value(particle) / unit
    }

    /// Its value in a particle, in SI units.
    pub(crate) fn si_value(self, particle: &Particle) -> f64 {
        match self {
            Self::PlasticStrain => particle.plastic_strain,
            Self::Temperature => particle.temperature,
            Self::VonMisesStress => particle.equivalent_stress(),
            Self::Pressure => particle.pressure + particle.viscous_pressure,
            Self::Speed => particle.velocity[0].hypot(particle.velocity[1]),
            Self::Density => particle.mass / particle.volume,
            Self::Damage => particle.damage,
        }
    }

    /// The array of a VTK file that it comes from, how many components that has, and SI units in one of the label's.
    pub(crate) fn source(self) -> (&'static str, usize, f64) {
        match self {
            Self::PlasticStrain => ("plastic_strain", 1, 1.0),
            Self::Temperature => ("temperature", 1, 1.0),
            Self::VonMisesStress => ("von_mises_stress", 1, 1e6),
            Self::Pressure => ("pressure", 1, 1e6),
            Self::Speed => ("velocity", 3, 1.0),
            Self::Density => ("density", 1, 1.0),
            Self::Damage => ("damage", 1, 1.0),
        }
    }

    /// Whether colours start at zero: those of the others start at the smallest value.
    pub(crate) fn starts_at_zero(self) -> bool {
        !matches!(self, Self::Temperature | Self::Density | Self::Pressure)
    }
}
