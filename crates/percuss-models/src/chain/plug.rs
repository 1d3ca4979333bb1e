//! The plug and the plate around it in the chain: where shear bands and dishing meet nodes, balances and steps.

use std::f64::consts::PI;

use super::{band_law::BandLaw, dishing::Dishing, part::Role, shear_band::Bands, state::State};
use crate::{
    Error, Refusal,
    options::BorderShearLaw,
    outcome::Detail,
    scenario::{Scenario, TargetBody},
    solver::archive::Archive,
};

/// Names of two numbers of a result.
pub(super) const WIDTH: &str = "width of shear band";
pub(super) const DISHING: &str = "largest dishing of plate";

/// What holds a plug.
#[derive(Debug)]
pub(super) struct PlugConstraint {
    pub(super) bands: Bands,
    /// The plate around it; `None` where it does not move.
    pub(super) plate: Option<Dishing>,
    /// Force of the bands on the plate [N].
    force: f64,
}

impl PlugConstraint {
    /// Everything that a step changes.
    pub(super) fn archive(&mut self, archive: &mut Archive<'_>) -> Result<(), Error> {
        self.bands.archive(archive)?;
        if let Some(plate) = &mut self.plate {
            plate.archive(archive)?;
        }
        archive.item(&mut self.force)
    }
}

/// The laws of the bands of every layer; `None` where border shear is friction.
///
/// # Errors
/// Why a material does not give what the options leave to it.
pub(super) fn band_laws(scenario: &Scenario) -> Result<Option<Vec<BandLaw>>, Refusal> {
    let options = &scenario.options.chain;
    let TargetBody::Layers {
        layers,
        column_diameter,
        ..
    } = &scenario.target
    else {
        return Ok(None);
    };
    if options.border_shear_law() == BorderShearLaw::Friction {
        return Ok(None);
    }
    let radius = 0.5 * column_diameter;
    let laws: Result<_, _> = layers
        .iter()
        .map(|plate| BandLaw::new(plate, radius, scenario.impact_velocity, options))
        .collect();
    laws.map(Some)
}

impl State {
    /// Puts bands instead of friction, and the plate around them.
    pub(super) fn constrain_plug(&mut self, scenario: &Scenario) {
        let (
            Ok(Some(laws)),
            TargetBody::Layers {
                layers,
                column_diameter,
                edge,
                ..
            },
        ) = (band_laws(scenario), &scenario.target)
        else {
            return;
        };
        let mut bands = Bands::new(laws, PI * column_diameter, self.back_position);
        let first_layer = self.parts.iter().position(|part| part.role == Role::Target);
        for segment in &self.segments {
            let part = &self.parts[segment.part];
            if part.role != Role::Target {
                continue;
            }
            for i in segment.first_node..=segment.last_node {
                self.nodes.friction[i] = 0.0;
                let position = self.nodes.position[i];
                let middle = |j: usize| 0.5 * (position + self.nodes.position[j]);
                let from = if i > segment.first_node {
                    middle(i - 1)
                } else {
                    position
                };
                let to = if i < segment.last_node {
                    middle(i + 1)
                } else {
                    position
                };
                bands.hold(
                    i,
                    position,
                    [from, to],
                    segment.part - first_layer.unwrap_or(0),
                );
            }
        }
        let plate = match (layers.first(), bands.laws.first(), edge) {
            (Some(layer), Some(law), Some(edge)) if scenario.options.chain.dishing() => {
                Some(Dishing::new(
                    &layer.material,
                    layer.thickness.unwrap_or(self.back_position),
                    layer.start_temperature(),
                    0.5 * column_diameter,
                    *edge,
                    law.failure,
                    &scenario.options.chain,
                ))
            }
            _ => None,
        };
        self.hold = Some(PlugConstraint {
            bands,
            plate,
            force: 0.0,
        });
        self.stable_step = self.shorten_for_bands(self.stable_step);
    }

    /// Whether a plug is still held by the plate around it.
    pub(super) fn plug_is_held(&self) -> bool {
        self.hold.as_ref().is_some_and(|hold| hold.bands.hold_any())
    }

    /// Work that bands took, and the bending of a plate that still holds the plug: what goes on in it afterwards changes nothing [J].
    pub(super) fn plug_dissipation(&self) -> f64 {
        let Some(hold) = &self.hold else { return 0.0 };
        let bending = match &hold.plate {
            Some(plate) if hold.bands.hold_any() => plate.plastic_work,
            _ => 0.0,
        };
        hold.bands.accumulated.work + bending
    }

    /// Time since which the plug has been free [s].
    pub(super) fn plug_free_since(&self) -> Option<f64> {
        let bands = &self.hold.as_ref()?.bands;
        bands.accumulated.last_end.filter(|_| !bands.hold_any())
    }

    /// Mass and velocity of what is left of the target.
    pub(super) fn plug_motion(&self) -> (f64, f64) {
        let (mut mass, mut momentum) = (0.0, 0.0);
        for segment in &self.segments {
            if self.parts[segment.part].role == Role::Target {
                for i in segment.first_node..=segment.last_node {
                    mass += self.nodes.mass[i];
                    momentum += self.nodes.mass[i] * self.nodes.velocity[i];
                }
            }
        }
        (mass, if mass > 0.0 { momentum / mass } else { 0.0 })
    }

    /// Numbers of bands and plate for a result.
    pub(super) fn plug_details(&self) -> Vec<Detail> {
        let Some(hold) = &self.hold else {
            return Vec::new();
        };
        let detail = |name, unit, value| Some(Detail { name, unit, value });
        let (bands, so_far) = (&hold.bands, &hold.bands.accumulated);
        let law = bands.laws.first();
        let plate = hold.plate.as_ref();
        let details = [
            law.and_then(|law| detail(WIDTH, "mm", law.spread.mean_width() * 1e3)),
            law.and_then(BandLaw::failure_strain).and_then(|strain| {
                detail(
                    "failure shear strain of shear band, slow and cold",
                    "",
                    strain,
                )
            }),
            detail(
                "largest slip of shear band",
                "mm",
                so_far.largest_slip * 1e3,
            ),
            detail("work of shear band", "J", so_far.work),
            detail(
                "largest temperature of shear band",
                "K",
                so_far.largest_temperature,
            ),
            so_far
                .last_end
                .filter(|_| !bands.hold_any())
                .and_then(|time| detail("plug free", "us", time * 1e6)),
            plate.and_then(|plate| {
                detail(
                    "largest dishing of plate",
                    "mm",
                    plate.largest_deflection * 1e3,
                )
            }),
            plate.and_then(|plate| detail("plastic work of dishing", "J", plate.plastic_work)),
        ];
        details.into_iter().flatten().collect()
    }

    /// Adds the forces of the bands to those of the elements.
    pub(super) fn collect_band_forces(&mut self) {
        if let Some(hold) = &mut self.hold {
            hold.force = hold.bands.pull(&mut self.nodes);
        }
    }

    /// Hands the plate what the bands took.
    pub(super) fn kick_plate(&mut self, kick: f64) {
        if let Some(hold) = &mut self.hold {
            hold.bands.accumulated.impulse += hold.force * kick;
            if let Some(plate) = &mut hold.plate {
                plate.kick(hold.force, kick);
            }
        }
    }

    /// Moves the plate and updates the bands.
    pub(super) fn drift_plate(&mut self, time_step: f64) {
        let Some(hold) = &mut self.hold else { return };
        let mut deflection = 0.0;
        if let Some(plate) = &mut hold.plate {
            plate.drift(time_step);
            deflection = plate.deflection();
        }
        let time = self.time + time_step;
        hold.bands.update(&self.nodes, deflection, time_step, time);
        if hold.plate.as_ref().is_some_and(Dishing::has_failed) {
            hold.bands.end(time);
        }
        if let Some(plate) = &mut hold.plate {
            // The edge of a hole turns freely.
            plate.edge_held = hold.bands.hold_any();
        }
        self.stable_step = self.shorten_for_bands(self.stable_step);
    }

    /// A stable step of the elements, shortened for bands and plate: squares of frequencies of systems that share their masses add up.
    fn shorten_for_bands(&self, step: f64) -> f64 {
        let Some(hold) = &self.hold else { return step };
        let (mass, plate_step) = match &hold.plate {
            Some(plate) => (plate.edge_mass(), plate.stable_step()),
            None => (f64::INFINITY, f64::INFINITY),
        };
        let bands = hold.bands.largest_frequency_squared(&self.nodes, mass);
        let step = step.min(plate_step);
        step / (1.0 + 0.25 * bands * step * step).sqrt()
    }
}
