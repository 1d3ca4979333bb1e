//! The cubic lattice as a body of a run.

use rayon::prelude::*;

use super::{
    super::{
        bonded::{At, Bond, Bonded, Load},
        bonds::BondDamage,
        debris::ContactLaw,
        energy::BodySums,
        fields,
        flight::Inertia,
        fracture::{Softening, Softenings},
        lattice::eigenvalues,
        run::Impact,
        shape::{Rigid, Shape},
    },
    body::CubicBody,
    lattice::{KINDS, SIDE},
    setup,
};
use crate::{
    Error, Scenario,
    history::ElementState,
    outcome::Detail,
    solver::{Control, Particle, archive::Archive},
};

/// Stiffness of the contact with a rigid body over that of a spring: the springs of a particle along the normal.
const CONTACT: f64 = 2.0;
/// Poisson's ratio has no part in contacts without friction.
const NO_RATIO: f64 = 0.0;

impl Bonded<3> for CubicBody {
    const LATTICE: &'static str = "body-centred cubic";
    const KINDS: usize = KINDS;

    fn build(scenario: &Scenario, control: &mut Control<'_>) -> Result<(Self, Rigid), Error> {
        setup::build(scenario, control)
    }

    fn row_count(&self) -> usize {
        self.layers.len()
    }

    fn row_places(&self) -> usize {
        self.grid.places()
    }

    fn spacing(&self) -> f64 {
        self.lattice.spacing()
    }

    fn wave_speed(&self) -> f64 {
        self.lattice.wave_speed
    }

    fn inner_mass(&self) -> f64 {
        self.lattice.mass
    }

    fn contact_stiffness(&self) -> f64 {
        CONTACT * self.lattice.normal
    }

    fn frequency(&mut self, control: &mut Control<'_>) -> Result<f64, Error> {
        self.measured_frequency(control)
    }

    fn softening(&self) -> Option<&Softening> {
        self.softening.as_ref().map(|laws| &laws[0])
    }

    fn contact_law(&self, scenario: &Scenario) -> ContactLaw {
        let spring = (self.spacing(), self.lattice.normal);
        ContactLaw::new(
            spring,
            NO_RATIO,
            scenario.options.particles.restitution(),
            0.0,
        )
    }

    fn moments(shape: &Shape) -> (f64, f64, f64) {
        shape.round_moments()
    }

    fn mass_of(&self, layer: usize, place: usize) -> f64 {
        self.layers[layer].mass[place]
    }

    fn inverse_mass_of(&self, layer: usize, place: usize) -> f64 {
        self.layers[layer].inverse_mass[place]
    }

    fn reference(&self, layer: usize, place: usize) -> [f64; 3] {
        self.rest_place(layer, place)
    }

    fn position(&self, layer: usize, place: usize) -> [f64; 3] {
        self.now(layer, place)
    }

    fn displacement(&self, layer: usize, place: usize) -> [f64; 3] {
        self.state[layer].each_ref().map(|part| part[place])
    }

    /// Without its other coordinates.
    fn depth(&self, layer: usize, place: usize) -> f64 {
        let moved = if self.is_moved() {
            self.layers[layer].shift[2][place]
        } else {
            0.0
        };
        let start = self.origin[2] + 0.5 * layer as f64 * self.lattice.side();
        start + moved + self.state[layer][2][place]
    }

    fn velocity(&self, layer: usize, place: usize) -> [f64; 3] {
        self.motion[layer].each_ref().map(|part| part[place])
    }

    fn spin(&self, _: usize, _: usize) -> f64 {
        0.0
    }

    fn weight(&self, (layer, place, kind): Bond) -> f64 {
        self.layers[layer].weights[kind][place]
    }

    fn other_end(&self, layer: usize, place: usize, kind: usize) -> At {
        self.end_of(layer, place, kind)
    }

    fn bonds_of(&self, layer: usize, place: usize) -> impl Iterator<Item = Bond> {
        self.around(layer, place)
    }

    fn spring_of(&self, bond: Bond) -> (f64, f64) {
        let (layer, place, kind) = bond;
        let stiffness = self.weight(bond) * self.lattice.stiffness(kind);
        (self.measured(layer, place, kind), stiffness)
    }

    fn damage_of(&self, (layer, place, kind): Bond) -> BondDamage {
        BondDamage {
            worst: self.damage[layer].worst[kind][place],
            measure: 0.0,
            start: 1.0,
        }
    }

    /// Its share of the energy of a cut.
    fn crack_of(&self, bond: Bond) -> f64 {
        let (length, stiffness) = self.spring_of(bond);
        let spacing = match bond.2 < 3 {
            true => SIDE * self.spacing(),
            false => self.spacing(),
        };
        self.lattice.area_of(length * spacing * stiffness)
    }

    fn advance(&mut self, step: f64, loads: &[Load<3>]) -> f64 {
        self.advance_layers(step, loads)
    }

    fn sums(&self, step: f64, loads: &[Load<3>]) -> BodySums {
        self.energies(step, loads)
    }

    fn momentum(&self) -> f64 {
        let layers = self.layers.iter().zip(&self.motion);
        layers
            .flat_map(|(layer, motion)| layer.mass.iter().zip(&motion[2]))
            .map(|(mass, velocity)| mass * velocity)
            .sum()
    }

    fn mass(&self) -> f64 {
        self.layers.iter().flat_map(|layer| &layer.mass).sum()
    }

    fn archive(&mut self, archive: &mut Archive<'_>) -> Result<(), Error> {
        archive.item(&mut self.state)?;
        archive.item(&mut self.motion)?;
        archive.item(&mut self.damage)?;
        if archive.is_read() {
            self.refresh();
        }
        Ok(())
    }

    fn extremes(&self) -> (f64, f64) {
        let of_layer = |layer: usize| {
            let mut extremes = (0.0_f64, 0.0_f64);
            for place in 0..self.row_places() {
                if self.mass_of(layer, place) == 0.0 {
                    continue;
                }
                let [xx, yy, zz, yz, xz, xy] = self.stress(layer, place);
                let principal = eigenvalues(&[[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]);
                extremes.1 = extremes.1.max(principal[2]);
                for kind in 0..KINDS {
                    let bond = (layer, place, kind);
                    if self.weight(bond) > 0.0 && !self.is_broken(bond) {
                        let elongation = self.bonds[layer].elongation[kind][place];
                        let stretch = elongation.abs() / self.measured(layer, place, kind);
                        extremes.0 = extremes.0.max(stretch);
                    }
                }
            }
            extremes
        };
        (0..self.layers.len())
            .into_par_iter()
            .map(of_layer)
            .reduce(|| (0.0, 0.0), |a, b| (a.0.max(b.0), a.1.max(b.1)))
    }

    fn middle_place(&self, layer: usize) -> usize {
        let odd = 0.5 * (layer % 2) as f64;
        let [column, row] = [0, 1].map(|axis| {
            let number = -self.origin[axis] / self.lattice.side() - odd;
            number.round().max(0.0) as usize
        });
        (row + 1) * self.grid.stride() + column + 1
    }

    fn on_axis(&self, (layer, place): At, part: usize) -> ElementState {
        let [start, now] = [self.rest_place(layer, place)[2], self.now(layer, place)[2]];
        ElementState {
            part,
            initial_position: start,
            position: now,
            displacement: now - start,
            length: 0.5 * self.lattice.side(),
            stress: -self.stress(layer, place)[2],
            strain: -fields::axial_strain(self, (layer, place)),
            plastic_strain: 0.0,
            diameter: self.width(),
            temperature: f64::NAN,
            velocity: self.motion[layer][2][place],
        }
    }

    fn particle(&self, layer: usize, place: usize) -> Particle {
        let [xx, yy, zz, _, xz, _] = self.stress(layer, place);
        let pressure = -(xx + yy + zz) / 3.0;
        let [x, _, z] = self.now(layer, place);
        let [u, _, w] = self.velocity(layer, place);
        let mass = self.mass_of(layer, place);
        let side = self.spacing();
        Particle {
            position: [x, z],
            velocity: [u, w],
            deviator: [xx + pressure, zz + pressure, xz],
            pressure,
            mass,
            volume: mass / self.lattice.density,
            sides: [side, side],
            damage: self.damage(layer, place),
            ..Particle::default()
        }
    }

    fn across(&self, layer: usize, place: usize) -> Option<[f64; 2]> {
        Some([self.now(layer, place)[1], self.velocity(layer, place)[1]])
    }

    fn show_rigid(&self, run: &Impact<'_, Self, 3>) -> (Vec<Particle>, Vec<[f64; 2]>) {
        fields::round(run)
    }

    /// Three layers of particles: one that moved ones leave open is closed by another.
    fn section(&self) -> f64 {
        1.5 * self.lattice.side()
    }

    fn details(&self, scenario: &Scenario, inertia: &Inertia) -> Vec<Detail> {
        let extent = super::super::setup::extent(scenario);
        let section = match super::super::setup::is_plate(scenario) {
            true => extent.width * extent.width,
            false => std::f64::consts::FRAC_PI_4 * extent.width * extent.width,
        };
        vec![
            Detail::new("mass of the projectile", "kg", inertia.mass),
            Detail::new("width of the lattice", "mm", self.width() * 1e3),
            Detail::new(
                "volume of the lattice over that of the body",
                "",
                self.volume / (extent.length * section),
            ),
        ]
    }

    fn notes(&self, _: &Scenario) -> Vec<String> {
        match self.softening {
            Some(_) => {
                vec!["pieces meet without friction: particles in space have no rotation".to_owned()]
            }
            None => Vec::new(),
        }
    }

    fn softenings(&self, scenario: &Scenario) -> Option<Softenings> {
        setup::softenings(scenario, &self.lattice)
    }
}
