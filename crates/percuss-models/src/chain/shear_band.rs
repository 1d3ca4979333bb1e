//! Border shear law `shear-band`: every target node is held to the plate around it by a band that flows, heats and fails.
//!
//! The band of a node is as long as the plug that belongs to it; what slip belongs to its strain is no matter of the mesh (`shear_zone.rs`).
//! With the strain ε of the rim its stress is `τ = σ(ε, ε̇, T)/√3`. A part of the plug that has left the plate behind is held no longer.

use std::ops::RangeInclusive;

use serde::{Deserialize, Serialize};

use super::{band::Band, band_law::BandLaw, state::Nodes};
use crate::{Error, solver::archive::Archive};

/// Extremes and sums of all bands, for results.
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
pub(super) struct BandAccumulators {
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
    pub(super) accumulated: BandAccumulators,
}

impl Bands {
    /// Everything that a step changes.
    pub(super) fn archive(&mut self, archive: &mut Archive<'_>) -> Result<(), Error> {
        archive.item(&mut self.bands)?;
        archive.item(&mut self.accumulated)
    }

    pub(super) fn new(laws: Vec<BandLaw>, perimeter: f64, back: f64) -> Self {
        Self {
            laws,
            bands: Vec::new(),
            perimeter,
            back,
            accumulated: BandAccumulators::default(),
        }
    }

    /// Adds the band of a node: the plug between two positions belongs to it.
    pub(super) fn hold(&mut self, node: usize, position: f64, span: [f64; 2], law: usize) {
        let band = Band::new(node, position, span, law, &self.laws[law]);
        self.bands.push(band);
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
    pub(super) fn pull(&self, nodes: &mut Nodes) -> f64 {
        let mut total = 0.0;
        for band in &self.bands {
            let force = band.stress * band.held * self.perimeter;
            nodes.force[band.node] -= force;
            nodes.spring_force[band.node] -= force;
            total += force;
        }
        total
    }

    /// Updates every band after a drift to a time, the plate around it being displaced by `deflection`.
    pub(super) fn update(&mut self, nodes: &Nodes, deflection: f64, time_step: f64, time: f64) {
        for band in &mut self.bands {
            if band.held == 0.0 {
                continue;
            }
            let law = &self.laws[band.law];
            let position = nodes.position[band.node];
            let slip = position - band.rest_position - deflection;
            let work = band.deform(law, slip, time_step);
            self.accumulated.work += self.perimeter * band.held * work;
            let accumulated = &mut self.accumulated;
            accumulated.largest_temperature = accumulated.largest_temperature.max(band.temperature);
            accumulated.largest_slip = accumulated.largest_slip.max(slip.abs());
            let middle = position + band.offset - deflection;
            let inside = (self.back - middle + 0.5 * band.length).clamp(0.0, band.length);
            let held = match band.has_failed(law) {
                true => 0.0,
                false => inside.min(band.held),
            };
            if held < band.held {
                accumulated.work += band.release(held, self.perimeter);
                if held == 0.0 {
                    accumulated.last_end = Some(time);
                }
            }
        }
    }

    /// Ends every band that still holds.
    pub(super) fn end(&mut self, time: f64) {
        for band in self.bands.iter_mut().filter(|band| band.held > 0.0) {
            self.accumulated.work += band.release(0.0, self.perimeter);
            self.accumulated.last_end = Some(time);
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
            let left = (band.held - length).max(0.0);
            // What is less than rounding of a length is none.
            let left = if left < 1e-9 * band.length { 0.0 } else { left };
            self.accumulated.work += band.release(left, self.perimeter);
        }
    }

    /// Square of a frequency that no motion of nodes and plate against each other by the bands exceeds [1/s2].
    pub(super) fn largest_frequency_squared(&self, nodes: &Nodes, plate_mass: f64) -> f64 {
        let (mut of_a_node, mut total) = (0.0_f64, 0.0);
        for band in self.bands.iter().filter(|band| band.held > 0.0) {
            let stiffness = band.stiffness * band.held * self.perimeter;
            of_a_node = of_a_node.max(stiffness / nodes.mass[band.node]);
            total += stiffness;
        }
        of_a_node + total / plate_mass
    }

    /// Elastic energy between two steps [J].
    pub(super) fn elastic_energy(&self) -> f64 {
        let energy = |band: &Band| band.held * self.perimeter * band.stored();
        self.bands.iter().map(energy).sum()
    }
}

#[cfg(test)]
#[path = "shear_band_tests.rs"]
mod tests;
