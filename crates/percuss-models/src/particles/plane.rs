//! The hexagonal lattice as a body of a run.

use std::f64::consts::PI;

use super::{
    body::Body,
    bonded::{At, Bond, Bonded, Load},
    bonds::BondDamage,
    cracks::Notches,
    debris::ContactLaw,
    energy::BodySums,
    fields,
    flight::Inertia,
    fracture::{Softening, Softenings},
    run::Impact,
    setup,
    shape::{Rigid, Shape},
    survey,
};
use crate::{
    Error, Scenario,
    history::ElementState,
    options::Space,
    outcome::Detail,
    solver::{Control, Particle, archive::Archive},
    units::significant,
};

impl Bonded<2> for Body {
    const LATTICE: &'static str = "hexagonal";
    const KINDS: usize = 3;

    fn build(scenario: &Scenario, control: &mut Control<'_>) -> Result<(Self, Rigid), Error> {
        setup::build(scenario, control)
    }

    fn row_count(&self) -> usize {
        self.rows.len()
    }

    fn row_places(&self) -> usize {
        self.stride
    }

    fn spacing(&self) -> f64 {
        self.lattice.spacing
    }

    fn wave_speed(&self) -> f64 {
        self.lattice.wave_speed
    }

    fn inner_mass(&self) -> f64 {
        self.lattice.mass
    }

    /// That of a row of bonds [N/m per m].
    fn contact_stiffness(&self) -> f64 {
        1.5 * self.lattice.normal + 0.5 * self.lattice.shear
    }

    fn frequency(&mut self, control: &mut Control<'_>) -> Result<f64, Error> {
        match self.rows[0].is_moved() {
            true => self.measured_frequency(control),
            false => Ok(self.lattice.largest_frequency()),
        }
    }

    fn softening(&self) -> Option<&Softening> {
        self.softening.as_ref()
    }

    fn contact_law(&self, scenario: &Scenario) -> ContactLaw {
        let options = &scenario.options.particles;
        ContactLaw::new(
            (self.lattice.spacing, self.lattice.normal),
            setup::material(scenario).0.poissons_ratio,
            options.restitution(),
            options.friction(),
        )
    }

    fn moments(shape: &Shape) -> (f64, f64, f64) {
        let (centre, second) = shape.moments();
        (shape.area(), centre, second)
    }

    fn mass_of(&self, row: usize, place: usize) -> f64 {
        self.rows[row].mass[place]
    }

    fn inverse_mass_of(&self, row: usize, place: usize) -> f64 {
        self.rows[row].inverse_mass[place]
    }

    fn reference(&self, row: usize, place: usize) -> [f64; 2] {
        self.rest_place(row, place)
    }

    fn position(&self, row: usize, place: usize) -> [f64; 2] {
        let [x, z] = self.rest_place(row, place);
        let state = &self.state[row];
        [x + state.x[place], z + state.z[place]]
    }

    fn displacement(&self, row: usize, place: usize) -> [f64; 2] {
        let state = &self.state[row];
        [state.x[place], state.z[place]]
    }

    fn velocity(&self, row: usize, place: usize) -> [f64; 2] {
        let motion = &self.motion[row];
        [motion.x[place], motion.z[place]]
    }

    fn spin(&self, row: usize, place: usize) -> f64 {
        self.motion[row].spin[place]
    }

    fn weight(&self, (row, place, kind): Bond) -> f64 {
        self.rows[row].weights[kind][place]
    }

    fn other_end(&self, row: usize, place: usize, kind: usize) -> At {
        self.end_of(row, place, kind)
    }

    fn bonds_of(&self, row: usize, place: usize) -> impl Iterator<Item = Bond> {
        let own = |kind| Some((row, place, kind));
        let above = row.checked_sub(1).map(|above| (above, place - above % 2));
        let bonds = [
            own(0),
            own(1),
            own(2),
            Some((row, place - 1, 0)),
            above.map(|(above, before)| (above, before, 1)),
            above.map(|(above, before)| (above, before + 1, 2)),
        ];
        bonds.into_iter().flatten()
    }

    fn spring_of(&self, (row, place, kind): Bond) -> (f64, f64) {
        let rest = self.rest(row, place, kind);
        (rest.length, rest.weight * self.lattice.normal)
    }

    fn damage_of(&self, (row, place, kind): Bond) -> BondDamage {
        let damage = &self.state[row].damage;
        BondDamage {
            worst: damage.worst[kind][place],
            measure: damage.measure[kind][place],
            start: damage.start_of(kind, place),
        }
    }

    /// Its share of the energy of the cut.
    fn crack_of(&self, (row, place, kind): Bond) -> f64 {
        let rest = self.rest(row, place, kind);
        0.5 * rest.weight * rest.length
    }

    fn notches(&self, scenario: &Scenario) -> Notches<2> {
        let notches = scenario.options.particles.notches.iter().flatten();
        let notches: Vec<_> = notches
            .map(|notch| (notch.ends(), notch.width.is_some()))
            .collect();
        Notches::of(self, &notches)
    }

    fn idle(&self, notches: &Notches<2>) -> Vec<usize> {
        notches.idle(self)
    }

    fn advance(&mut self, step: f64, loads: &[Load<2>]) -> f64 {
        self.advance_rows(step, loads)
    }

    fn sums(&self, step: f64, loads: &[Load<2>]) -> BodySums {
        self.energies(step, loads)
    }

    fn momentum(&self) -> f64 {
        let rows = self.rows.iter().zip(&self.motion);
        rows.flat_map(|(make, motion)| make.mass.iter().zip(&motion.z))
            .map(|(mass, velocity)| mass * velocity)
            .sum()
    }

    fn mass(&self) -> f64 {
        self.rows.iter().flat_map(|row| &row.mass).sum()
    }

    fn archive(&mut self, archive: &mut Archive<'_>) -> Result<(), Error> {
        archive.item(&mut self.state)?;
        archive.item(&mut self.motion)
    }

    fn extremes(&self) -> (f64, f64) {
        survey::extremes(self)
    }

    fn middle_place(&self, row: usize) -> usize {
        let column = -self.origin[0] / self.lattice.spacing - 0.5 * (row % 2) as f64;
        1 + column.round().max(0.0) as usize
    }

    fn on_axis(&self, at: At, part: usize) -> ElementState {
        fields::on_axis(self, at, part)
    }

    fn particle(&self, row: usize, place: usize) -> Particle {
        fields::particle(self, row, place)
    }

    fn show_rigid(&self, run: &Impact<'_, Self, 2>) -> (Vec<Particle>, Vec<[f64; 2]>) {
        (fields::rigid(run), Vec::new())
    }

    fn details(&self, scenario: &Scenario, inertia: &Inertia) -> Vec<Detail> {
        let extent = setup::extent(scenario);
        let mut details = vec![Detail::new(
            "mass of the projectile, a metre wide",
            "kg",
            inertia.mass,
        )];
        let area = match setup::is_disc(scenario) {
            true => 0.25 * PI * extent.length * extent.length,
            false => {
                details.push(Detail::new(
                    "width of the lattice",
                    "mm",
                    self.width() * 1e3,
                ));
                extent.length * extent.width
            }
        };
        details.push(Detail::new(
            "area of the lattice over that of the body",
            "",
            self.area / area,
        ));
        details
    }

    fn notes(&self, scenario: &Scenario) -> Vec<String> {
        let across = match scenario.options.particles.space() {
            Space::PlaneStress => "of thickness",
            _ => "across the plane",
        };
        let mut notes = vec![format!(
            "two-dimensional model: the projectile is a strip, and its mass, forces and energies are per metre {across}; do not \
             compare them with those of a body of revolution"
        )];
        let narrow = setup::narrow_slots(scenario, self.lattice.spacing);
        if !narrow.is_empty() {
            notes.push(format!(
                "`particles.notches`: the slot of number {} is narrower than the particles are apart, {} mm, so that its faces can touch: \
                 raise its `width` or reduce `particles.spacing`",
                super::results::numbered(&narrow),
                significant(self.lattice.spacing * 1e3, 3)
            ));
        }
        notes
    }

    fn softenings(&self, scenario: &Scenario) -> Option<Softenings> {
        setup::softenings(scenario, &self.lattice)
    }
}
