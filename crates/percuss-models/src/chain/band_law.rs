//! Law of the shear bands of a layer: strength, spread and failure, from its material and the options.

use crate::{
    Refusal,
    material::{DamageState, Material, PreparedDamage, PreparedStrength, perfectly_plastic},
    options::{BandFailure, ChainOptions},
    scenario::Plate,
    units::Length,
};

use super::{
    adiabatic::Sheared,
    dishing_mesh::rim_width,
    part,
    shear_zone::{SQRT_3, Spread},
};

/// When a band fails.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Failure {
    /// At an equivalent plastic strain.
    Strain(f64),
    Damage(PreparedDamage),
    Never,
}

impl Failure {
    /// Damage after a further strain in pure shear at a rate [1/s].
    pub(super) fn grow(
        self,
        damage: f64,
        increment: f64,
        strain_rate: f64,
        temperature: f64,
    ) -> f64 {
        match self {
            Self::Damage(law) => {
                let state = DamageState {
                    triaxiality: 0.0,
                    strain_rate,
                    temperature,
                };
                law.grow(damage, &state, increment)
            }
            _ => damage,
        }
    }

    /// Whether a plastic strain, or the damage that it did, is that of failure.
    pub(super) fn is_reached(self, plastic_strain: f64, damage: f64) -> bool {
        match self {
            Self::Strain(strain) => plastic_strain >= strain,
            Self::Damage(_) => damage >= 1.0,
            Self::Never => false,
        }
    }
}

/// What the bands of a layer have in common.
#[derive(Debug)]
pub(super) struct BandLaw {
    pub(super) spread: Spread,
    pub(super) shear_modulus: f64,
    pub(super) strength: Box<dyn PreparedStrength>,
    pub(super) heating: f64,
    pub(super) start_temperature: f64,
    pub(super) rate_effects: bool,
    pub(super) failure: Failure,
}

impl BandLaw {
    /// The law of a layer around a plug of a radius that starts with a speed.
    ///
    /// # Errors
    /// In words, why the material does not give what the options leave to it.
    pub(super) fn new(
        plate: &Plate,
        radius: f64,
        speed: f64,
        options: &ChainOptions,
    ) -> Result<Self, Refusal> {
        let material = &*plate.material;
        let band = options.shear_band.unwrap_or_default();
        if material
            .strength
            .law()
            .initial_yield_stress(material)
            .is_none()
            && band.shear_strength.is_none()
        {
            return Err(
                Refusal::new(format!("`{}` never yields", plate.material_id)).with_remedy(
                    "give `chain.shear_band.shear_strength`, or a material that flows",
                ),
            );
        }
        let strength = match band.shear_strength {
            Some(stress) => perfectly_plastic(SQRT_3 * stress.si()),
            None => material.strength.law().prepare(material, 1.0),
        };
        let heating = part::heating(material, options, 1.0);
        let sheared = Sheared {
            strength: &*strength,
            heating,
            temperature: plate.start_temperature(),
            rate_effects: options.rate_effects(),
        };
        // Plug and plate that dish shear for themselves, and the band is what is left between them.
        let rim = plate.thickness.filter(|_| options.dishing()).map(rim_width);
        let (spread, instability) = match band.width.map(Length::si).or(rim) {
            Some(width) => (Spread::Even(width), sheared.instability(width, speed)),
            None => {
                let (zone, instability) =
                    sheared.zone(radius, speed).ok_or_else(|| no_width(plate))?;
                (Spread::Zone(zone), instability)
            }
        };
        let failure = failure(plate, options, instability)?;
        Ok(Self {
            spread,
            shear_modulus: material.shear_modulus(),
            heating,
            start_temperature: plate.start_temperature(),
            rate_effects: sheared.rate_effects,
            failure,
            strength,
        })
    }

    /// Shear stress for an elastic slip [Pa/m].
    pub(super) fn stiffness(&self) -> f64 {
        self.shear_modulus / self.spread.elastic_width()
    }

    /// Plastic shear strain at which the band fails when its stress never changes sign, rate and temperature left out; `None` when it
    /// never does.
    pub(super) fn failure_strain(&self) -> Option<f64> {
        match self.failure {
            Failure::Strain(strain) => Some(SQRT_3 * strain),
            Failure::Damage(damage) => Some(
                SQRT_3
                    * damage.failure_strain(&DamageState {
                        triaxiality: 0.0,
                        strain_rate: 0.0,
                        temperature: self.start_temperature,
                    }),
            ),
            Failure::Never => None,
        }
    }
}

fn no_width(plate: &Plate) -> Refusal {
    Refusal::new(format!(
        "`{}` neither hardens nor resists faster shear more, so that nothing spreads its shear around the plug",
        plate.material_id
    ))
    .with_remedy(
        "give `chain.shear_band.width`, or a strength law that does one or the other",
    )
}

fn failure(
    plate: &Plate,
    options: &ChainOptions,
    instability: Option<f64>,
) -> Result<Failure, Refusal> {
    let band = options.shear_band.unwrap_or_default();
    if let Some(strain) = band.failure_strain {
        return Ok(Failure::Strain(strain / SQRT_3));
    }
    let material: &Material = &plate.material;
    let damage = material.damage.as_ref();
    let natural = match damage {
        Some(_) => BandFailure::Damage,
        None => BandFailure::Instability,
    };
    match (band.failure.unwrap_or(natural), damage, instability) {
        (BandFailure::Never, ..) => Ok(Failure::Never),
        (BandFailure::Damage, Some(damage), _) => Ok(Failure::Damage(damage.prepare(material))),
        (BandFailure::Damage, None, _) => Err(Refusal::new(format!(
            "`{}` has no damage",
            plate.material_id
        ))
        .with_remedy("give another `chain.shear_band.failure`, or its damage constants")),
        (BandFailure::Instability, _, Some(strain)) => Ok(Failure::Strain(strain)),
        (BandFailure::Instability, _, None) => Err(Refusal::new(format!(
            "the shear stress of `{}` has no adiabatic maximum, at which the shear band would fail",
            plate.material_id
        ))
        .with_remedy("give `chain.shear_band.failure_strain`, or failure = \"never\"")),
    }
}
