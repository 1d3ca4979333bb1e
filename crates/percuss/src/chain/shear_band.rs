//! Border shear law `shear-band`: every target node is held to the plate around it by a band that flows, heats and fails.
//!
//! The band of a node is as long as the plug that belongs to it and as wide as a stated length w, so that it does not depend on the mesh.
//! Displacement u relative to the plate gives the shear strain `γ = u/w`, the equivalent strain `γ/√3` and the stress
//! `τ = σ(ε, ε̇, T)/√3`. A part of the plug that has left the plate behind is held no longer.

use std::ops::RangeInclusive;

use crate::{
    case::{BandFailure, ChainOptions},
    material::{
        DamageState, FlowState, Material, PreparedDamage, PreparedStrength, Trial, YieldPoint,
        perfectly_plastic,
    },
    scenario::Plate,
};

use super::{
    part,
    shear_zone::{ShearZone, Sheared},
    state::Node,
};

const SQRT_3: f64 = 1.732_050_807_568_877_2;

/// When a band fails.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Failure {
    /// At an equivalent plastic strain.
    Strain(f64),
    Damage(PreparedDamage),
    Never,
}

/// What the bands of a layer have in common.
#[derive(Debug)]
pub(super) struct BandLaw {
    pub(super) width: f64,
    shear_modulus: f64,
    strength: Box<dyn PreparedStrength>,
    heating: f64,
    start_temperature: f64,
    rate_effects: bool,
    failure: Failure,
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
    ) -> Result<Self, String> {
        let material = &*plate.material;
        let band = options.shear_band.unwrap_or_default();
        if material
            .strength
            .law()
            .initial_yield_stress(material)
            .is_none()
            && band.shear_strength.is_none()
        {
            return Err(format!(
                "`{}` never yields: give `chain.shear_band.shear_strength`, or a material that flows",
                plate.material_id
            ));
        }
        let strength = match band.shear_strength {
            Some(stress) => perfectly_plastic(SQRT_3 * stress.si()),
            None => material.strength.law().prepare(material, 1.0),
        };
        let heating = part::heating(material, options, 1.0);
        let sheared = Sheared {
            strength: &*strength,
            heating,
            temperature: material.room_temperature.si(),
            rate_effects: options.rate_effects.unwrap_or(true),
        };
        let (width, instability) = match band.width {
            Some(width) => (width.si(), sheared.instability(width.si(), speed)),
            None => {
                let ShearZone { width, strain } =
                    sheared.zone(radius, speed).ok_or_else(|| no_width(plate))?;
                (width, Some(strain))
            }
        };
        let failure = failure(plate, options, instability)?;
        Ok(Self {
            width,
            shear_modulus: material.shear_modulus(),
            heating,
            start_temperature: material.room_temperature.si(),
            rate_effects: sheared.rate_effects,
            failure,
            strength,
        })
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

fn no_width(plate: &Plate) -> String {
    format!(
        "the shear stress of `{}` has no adiabatic maximum after hardening (it takes a strength law that hardens and softens with \
         heat, and a specific heat), so that the width of the shear band does not follow from it: give `chain.shear_band.width`",
        plate.material_id
    )
}

fn failure(
    plate: &Plate,
    options: &ChainOptions,
    instability: Option<f64>,
) -> Result<Failure, String> {
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
        (BandFailure::Damage, None, _) => Err(format!(
            "`{}` has no damage: give another `chain.shear_band.failure`, or its damage constants",
            plate.material_id
        )),
        (BandFailure::Instability, _, Some(strain)) => Ok(Failure::Strain(strain)),
        (BandFailure::Instability, _, None) => Err(format!(
            "the shear stress of `{}` has no adiabatic maximum, at which the shear band would fail: give \
             `chain.shear_band.failure_strain`, or failure = \"never\"",
            plate.material_id
        )),
    }
}

/// Band of one target node.
#[derive(Debug, Clone, Copy)]
pub(super) struct Band {
    pub(super) node: usize,
    law: usize,
    rest_position: f64,
    /// Middle of the plug that belongs to the node, from the node [m], and how much there is of it.
    offset: f64,
    length: f64,
    /// Length that is still inside the plate [m]; 0 when the band has ended.
    held: f64,
    shear_modulus_force: f64,
    stress: f64,
    stress_before: f64,
    plastic_shear: f64,
    plastic_step: f64,
    plastic_strain: f64,
    temperature: f64,
    damage: f64,
    yield_point: YieldPoint,
}

/// Extremes and sums of all bands, for results.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct BandBooks {
    /// Plastic work and what was stored in bands that ended [J].
    pub(super) work: f64,
    /// Impulse on the plate around the plug [N s].
    pub(super) impulse: f64,
    /// Time at which the last band ended [s].
    pub(super) last_end: Option<f64>,
    pub(super) largest_temperature: f64,
    pub(super) largest_slip: f64,
}

/// The bands around a plug.
#[derive(Debug)]
pub(super) struct Bands {
    pub(super) laws: Vec<BandLaw>,
    bands: Vec<Band>,
    /// Circumference of the plug [m].
    perimeter: f64,
    /// Position of the back of the plate before the impact [m].
    back: f64,
    pub(super) books: BandBooks,
}

impl Bands {
    pub(super) fn new(laws: Vec<BandLaw>, perimeter: f64, back: f64) -> Self {
        Self {
            laws,
            bands: Vec::new(),
            perimeter,
            back,
            books: BandBooks::default(),
        }
    }

    /// Adds the band of a node: the plug between two positions belongs to it.
    pub(super) fn hold(&mut self, node: usize, position: f64, span: [f64; 2], law: usize) {
        let layer = &self.laws[law];
        let state = FlowState {
            plastic_strain: 0.0,
            strain_rate: 0.0,
            temperature: layer.start_temperature,
            pressure: 0.0,
        };
        self.bands.push(Band {
            node,
            law,
            rest_position: position,
            offset: 0.5 * (span[0] + span[1]) - position,
            length: span[1] - span[0],
            held: span[1] - span[0],
            shear_modulus_force: layer.shear_modulus / layer.width,
            stress: 0.0,
            stress_before: 0.0,
            plastic_shear: 0.0,
            plastic_step: 0.0,
            plastic_strain: 0.0,
            temperature: layer.start_temperature,
            damage: 0.0,
            yield_point: YieldPoint::slow(&*layer.strength, &state),
        });
    }

    /// Whether any band still holds.
    pub(super) fn hold_any(&self) -> bool {
        self.bands.iter().any(|band| band.held > 0.0)
    }

    /// Whether any band holds one of some nodes.
    pub(super) fn hold_among(&self, nodes: RangeInclusive<usize>) -> bool {
        let mut held = self.bands.iter().filter(|band| band.held > 0.0);
        held.any(|band| nodes.contains(&band.node))
    }

    /// Pulls on the nodes; returns the force on the plate around them [N].
    pub(super) fn pull(&self, nodes: &mut [Node]) -> f64 {
        let mut total = 0.0;
        for band in &self.bands {
            let force = band.stress * band.held * self.perimeter;
            nodes[band.node].force -= force;
            nodes[band.node].spring_force -= force;
            total += force;
        }
        total
    }

    /// Updates every band after a drift to a time, the plate around it being displaced by `deflection`.
    pub(super) fn update(&mut self, nodes: &[Node], deflection: f64, time_step: f64, time: f64) {
        for band in &mut self.bands {
            if band.held == 0.0 {
                continue;
            }
            let law = &self.laws[band.law];
            let node = &nodes[band.node];
            let slip = node.position - band.rest_position - deflection;
            let volume = self.perimeter * law.width;
            self.books.work += volume * band.held * band.deform(law, slip / law.width, time_step);
            let books = &mut self.books;
            books.largest_temperature = books.largest_temperature.max(band.temperature);
            books.largest_slip = books.largest_slip.max(slip.abs());
            let middle = node.position + band.offset - deflection;
            let inside = (self.back - middle + 0.5 * band.length).clamp(0.0, band.length);
            let held = match band.has_failed(law) {
                true => 0.0,
                false => inside.min(band.held),
            };
            if held < band.held {
                books.work += band.release(held, volume, law.shear_modulus);
                if held == 0.0 {
                    books.last_end = Some(time);
                }
            }
        }
    }

    /// Shares the band of a node at which the plug parts: the end ahead becomes the node after it.
    ///
    /// Such a node has lost nothing to erosion: what its band does not hold has left through the back, the end ahead first.
    pub(super) fn part(&mut self, node: usize) {
        for band in &mut self.bands {
            band.node += usize::from(band.node > node);
        }
        let Some(found) = self.bands.iter().position(|band| band.node == node) else {
            return;
        };
        let behind = &mut self.bands[found];
        let mut ahead = *behind;
        let (from, to) = (
            behind.offset - 0.5 * behind.length,
            behind.offset + 0.5 * behind.length,
        );
        (behind.offset, behind.length) = (0.5 * from, -from);
        behind.held = behind.held.min(behind.length);
        ahead.node = node + 1;
        (ahead.offset, ahead.length) = (0.5 * to, to);
        ahead.held -= behind.held;
        self.bands.insert(found + 1, ahead);
    }

    /// Lets go a part of the plug that eroded from a node.
    pub(super) fn erode(&mut self, node: usize, length: f64) {
        let found = self.bands.iter_mut().find(|band| band.node == node);
        if let Some(band) = found.filter(|band| band.held > 0.0) {
            let law = &self.laws[band.law];
            let left = (band.held - length).max(0.0);
            // What is less than rounding of a length is none.
            let left = if left < 1e-9 * band.length { 0.0 } else { left };
            self.books.work += band.release(left, self.perimeter * law.width, law.shear_modulus);
        }
    }

    /// Square of a frequency that no motion of nodes and plate against each other by the bands exceeds [1/s2].
    pub(super) fn largest_frequency_squared(&self, nodes: &[Node], plate_mass: f64) -> f64 {
        let (mut of_a_node, mut total) = (0.0_f64, 0.0);
        for band in self.bands.iter().filter(|band| band.held > 0.0) {
            let stiffness = band.shear_modulus_force * band.held * self.perimeter;
            of_a_node = of_a_node.max(stiffness / nodes[band.node].mass);
            total += stiffness;
        }
        of_a_node + total / plate_mass
    }

    /// Elastic energy between two steps [J].
    pub(super) fn elastic_energy(&self) -> f64 {
        let energy = |band: &Band| {
            let law = &self.laws[band.law];
            band.held * self.perimeter * law.width * band.stored(law.shear_modulus)
        };
        self.bands.iter().map(energy).sum()
    }
}

impl Band {
    /// Elastic energy per volume between two steps [J/m3].
    fn stored(&self, shear_modulus: f64) -> f64 {
        self.stress_before * self.stress / (2.0 * shear_modulus)
    }

    /// Shortens what is held; returns the energy that was stored in the rest.
    fn release(&mut self, held: f64, area: f64, shear_modulus: f64) -> f64 {
        let freed = (self.held - held) * area * self.stored(shear_modulus);
        self.held = held;
        freed
    }

    fn has_failed(&self, law: &BandLaw) -> bool {
        match law.failure {
            Failure::Strain(strain) => self.plastic_strain >= strain,
            Failure::Damage(_) => self.damage >= 1.0,
            Failure::Never => false,
        }
    }

    /// Brings the band to a shear strain; returns the plastic work per volume between the half steps around the current time.
    fn deform(&mut self, law: &BandLaw, shear: f64, time_step: f64) -> f64 {
        let modulus = law.shear_modulus;
        let trial = modulus * (shear - self.plastic_shear);
        self.stress_before = self.stress;
        self.stress = trial;
        let before = self.plastic_step;
        self.plastic_step = 0.0;
        if !self.yield_point.holds(SQRT_3 * trial.abs()) {
            let state = FlowState {
                plastic_strain: self.plastic_strain,
                strain_rate: 0.0,
                temperature: self.temperature,
                pressure: 0.0,
            };
            // With q = √3 τ and Δγ = √3 Δε the stress falls by 3G a strain.
            let increment = self.yield_point.plastic_increment(
                &*law.strength,
                &state,
                &Trial {
                    stress: SQRT_3 * trial.abs(),
                    modulus: 3.0 * modulus,
                    pressure_fall: 0.0,
                    elapsed: law.rate_effects.then_some(time_step),
                },
            );
            if increment > 0.0 {
                self.flow(law, trial, increment, time_step);
            }
        }
        0.5 * self.stress_before * (before + self.plastic_step)
    }

    fn flow(&mut self, law: &BandLaw, trial: f64, increment: f64, time_step: f64) {
        if let Failure::Damage(damage) = law.failure {
            let state = DamageState {
                triaxiality: 0.0,
                strain_rate: increment / time_step,
                temperature: self.temperature,
            };
            self.damage = damage.grow(self.damage, &state, increment);
        }
        self.plastic_step = (SQRT_3 * increment).copysign(trial);
        self.plastic_shear += self.plastic_step;
        self.stress = trial - law.shear_modulus * self.plastic_step;
        self.plastic_strain += increment;
        let mean = 0.5 * SQRT_3 * (self.stress_before + self.stress).abs();
        self.temperature += law.heating * mean * increment;
    }
}

#[cfg(test)]
#[path = "shear_band_tests.rs"]
mod tests;
