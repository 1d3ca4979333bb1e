//! A body of stresses as a body of a run.

use rayon::prelude::*;

use super::{body::StressBody, setup};
use crate::{
    Error, Scenario,
    history::ElementState,
    outcome::Detail,
    particles::{
        body::Body,
        bonded::{At, Bond, Bonded, Flow, Load},
        bonds::BondDamage,
        debris::ContactLaw,
        energy::BodySums,
        fields,
        flight::Inertia,
        fracture::{Softening, Softenings},
        lattice::ROW,
        run::Impact,
        shape::{Rigid, Shape},
    },
    solver::{Control, Particle, archive::Archive},
    units::significant,
};

/// Stretch or ratio of areas of a triangle below which gradients of the body at rest no longer describe it.
const LEAST_STRETCH: f64 = 0.2;
/// Stretch of a particle below which a run cannot go on.
const COLLAPSED: f64 = 0.05;

impl Bonded<2> for StressBody {
    const LATTICE: &'static str = "hexagonal, particle stress";
    const KINDS: usize = <Body as Bonded<2>>::KINDS;

    fn build(scenario: &Scenario, control: &mut Control<'_>) -> Result<(Self, Rigid), Error> {
        setup::build(scenario, control)
    }

    fn row_count(&self) -> usize {
        self.frame.row_count()
    }

    fn row_places(&self) -> usize {
        self.frame.row_places()
    }

    fn spacing(&self) -> f64 {
        self.frame.spacing()
    }

    fn wave_speed(&self) -> f64 {
        self.wave_squared.sqrt()
    }

    fn inner_mass(&self) -> f64 {
        self.frame.inner_mass()
    }

    fn contact_stiffness(&self) -> f64 {
        self.stiffness_of_contact()
    }

    fn frequency(&mut self, control: &mut Control<'_>) -> Result<f64, Error> {
        self.largest_frequency(control)
    }

    fn softening(&self) -> Option<&Softening> {
        None
    }

    fn begins_within_steps(&self) -> bool {
        true
    }

    fn contact_law(&self, scenario: &Scenario) -> ContactLaw {
        self.frame.contact_law(scenario)
    }

    fn moments(shape: &Shape) -> (f64, f64, f64) {
        <Body as Bonded<2>>::moments(shape)
    }

    fn mass_of(&self, row: usize, place: usize) -> f64 {
        self.frame.mass_of(row, place)
    }

    fn inverse_mass_of(&self, row: usize, place: usize) -> f64 {
        self.frame.inverse_mass_of(row, place)
    }

    fn reference(&self, row: usize, place: usize) -> [f64; 2] {
        self.frame.reference(row, place)
    }

    fn position(&self, row: usize, place: usize) -> [f64; 2] {
        self.frame.position(row, place)
    }

    fn displacement(&self, row: usize, place: usize) -> [f64; 2] {
        self.frame.displacement(row, place)
    }

    fn velocity(&self, row: usize, place: usize) -> [f64; 2] {
        self.frame.velocity(row, place)
    }

    fn spin(&self, _: usize, _: usize) -> f64 {
        0.0
    }

    fn weight(&self, bond: Bond) -> f64 {
        self.frame.weight(bond)
    }

    fn other_end(&self, row: usize, place: usize, kind: usize) -> At {
        self.frame.other_end(row, place, kind)
    }

    fn bonds_of(&self, row: usize, place: usize) -> impl Iterator<Item = Bond> {
        self.frame.bonds_of(row, place)
    }

    fn spring_of(&self, (row, place, kind): Bond) -> (f64, f64) {
        let (other, at) = self.other_end(row, place, kind);
        let (from, to) = (self.reference(row, place), self.reference(other, at));
        ((to[0] - from[0]).hypot(to[1] - from[1]), self.stiffness)
    }

    fn damage_of(&self, _: Bond) -> BondDamage {
        BondDamage::default()
    }

    /// Nothing breaks.
    fn crack_of(&self, _: Bond) -> f64 {
        0.0
    }

    fn advance(&mut self, step: f64, loads: &[Load<2>]) -> f64 {
        self.advance_particles(step, loads)
    }

    fn sums(&self, step: f64, loads: &[Load<2>]) -> BodySums {
        self.energies(step, loads)
    }

    fn momentum(&self) -> f64 {
        self.frame.momentum()
    }

    fn mass(&self) -> f64 {
        self.frame.mass()
    }

    fn archive(&mut self, archive: &mut Archive<'_>) -> Result<(), Error> {
        self.frame.archive(archive)?;
        for row in &mut self.rows {
            row.archive(archive)?;
        }
        if archive.is_read() {
            self.find_depths();
        }
        Ok(())
    }

    /// How much of the stretch of a triangle is lost at most, 1 and more where it is turned over; and the largest tension.
    fn extremes(&self) -> (f64, f64) {
        let of_row = |row: usize| {
            let present = |place: &usize| self.mass_of(row, *place) > 0.0;
            let tensions = (1..self.row_places() - 1)
                .filter(present)
                .map(|place| self.rows[row].point(place).largest_tension());
            (1.0 - self.least_stretch(row), tensions.fold(0.0, f64::max))
        };
        (0..self.row_count())
            .into_par_iter()
            .map(of_row)
            .reduce(|| (0.0, 0.0), |a, b| (a.0.max(b.0), a.1.max(b.1)))
    }

    fn unbearable(&self, _: f64) -> Option<(String, String)> {
        let part = self.stable_part();
        // What is no number is not enough either.
        let holds = part > COLLAPSED;
        (!holds).then(|| {
            (
                format!(
                    "a particle is compressed to {} of its size: gradients of the body at rest no longer describe it,",
                    significant(part, 2)
                ),
                "use the model `axi` for bodies of revolution, lower `projectile.impact_velocity`, or blunt the nose".to_owned(),
            )
        })
    }

    fn stable_part(&self) -> f64 {
        StressBody::stable_part(self)
    }

    fn flow(&self) -> Flow {
        let mut flow = Flow::default();
        for (row, place) in self.particles() {
            let point = self.rows[row].point(place);
            flow.plastic_strain = flow.plastic_strain.max(point.plastic_strain);
            flow.temperature = flow.temperature.max(point.temperature);
        }
        flow
    }

    fn middle_place(&self, row: usize) -> usize {
        self.frame.middle_place(row)
    }

    fn on_axis(&self, (row, place): At, part: usize) -> ElementState {
        let point = self.rows[row].point(place);
        let [start, now] = [self.reference(row, place)[1], self.position(row, place)[1]];
        ElementState {
            part,
            initial_position: start,
            position: now,
            displacement: now - start,
            length: ROW * self.spacing(),
            stress: point.pressure + point.viscous_pressure - point.deviator[1],
            strain: -fields::axial_strain(self, (row, place)),
            plastic_strain: point.plastic_strain,
            diameter: self.frame.width(),
            temperature: point.temperature,
            velocity: self.frame.motion[row].z[place],
        }
    }

    fn particle(&self, row: usize, place: usize) -> Particle {
        let (volume, _) = super::state::volume_and_stretch(self.rows[row].gradient_at(place));
        let mass = self.mass_of(row, place);
        let spacing = self.spacing();
        Particle {
            position: self.position(row, place),
            velocity: self.velocity(row, place),
            mass,
            volume: volume * mass / self.law.density,
            sides: [spacing, ROW * spacing],
            ..self.rows[row].point(place)
        }
    }

    fn between(&self, row: usize, depths: &std::ops::Range<f64>) -> impl Iterator<Item = usize> {
        let (start, end) = (depths.start, depths.end);
        let [least, largest] = self.depths[row];
        let may = largest > start && least < end;
        let places = if may { 0..self.row_places() } else { 0..0 };
        places.filter(move |&place| {
            let depth = self.depth(row, place);
            depth > start && depth < end && self.mass_of(row, place) > 0.0
        })
    }

    fn show_rigid(&self, run: &Impact<'_, Self, 2>) -> (Vec<Particle>, Vec<[f64; 2]>) {
        (fields::rigid(run), Vec::new())
    }

    fn details(&self, scenario: &Scenario, inertia: &Inertia) -> Vec<Detail> {
        self.frame.details(scenario, inertia)
    }

    fn extremes_in_words(&self, stretch: f64, tension: f64) -> Vec<Detail> {
        vec![
            Detail::new("largest tension", "MPa", tension * 1e-6),
            Detail::new("smallest stretch of a triangle", "", 1.0 - stretch),
        ]
    }

    fn limits_in_words(&self, stretch: f64, tension: f64) -> Vec<String> {
        let mut warnings = vec![format!(
            "nothing breaks or fails with `particles.formulation = \"particle-stress\"`: the largest tension is {} MPa, and beyond the strength of \
             the material the answer does not hold",
            significant(tension * 1e-6, 3)
        )];
        let least = 1.0 - stretch;
        if least < LEAST_STRETCH {
            let what = match least > 0.0 {
                true => format!(
                    "compressed or sheared to {} of its size, less than {LEAST_STRETCH}",
                    significant(least, 2)
                ),
                false => "turned over".to_owned(),
            };
            warnings.push(format!(
                "the answer is uncertain: a triangle of particles is {what}; use `axi` for bodies of revolution, or a lower \
                 `projectile.impact_velocity`"
            ));
        }
        warnings
    }

    fn notes(&self, scenario: &Scenario) -> Vec<String> {
        self.frame.notes(scenario)
    }

    fn softenings(&self, _: &Scenario) -> Option<Softenings> {
        None
    }
}
