//! Input for LAMMPS: the particles, bonds and rigid body of a case, for runs over many processors.

use std::{collections::BTreeMap, fmt::Write as _};

use super::{ball, body::Body, bonded::Bonded, run::Impact, setup, shape::Rigid, stress};
use crate::{
    Error, Refusal, Scenario,
    options::Space,
    problem::Nose,
    solver::{Control, applicability, interface::Solver},
};

/// The run that the input is of.
type PlaneRun<'a> = Impact<'a, Body, 2>;

/// Types of the atoms in the data.
const FREE: u8 = 1;
const HELD: u8 = 2;
const PROJECTILE: u8 = 3;
/// Distance of the wall of LAMMPS behind the face of the rigid wall, in spacings: particles must not come to it.
const WALL: f64 = 1.0;
/// Volume of a sphere over the cube of its diameter: LAMMPS makes masses of densities with it, those of discs, too.
const SPHERE: f64 = std::f64::consts::PI / 6.0;
/// Frames of the trajectory and lines of the log, unless the user of the input asks for others.
const FRAMES: f64 = 100.0;
/// Part of the room around the body that is left to its pieces.
const ROOM: f64 = 0.5;

/// Input for LAMMPS.
#[derive(Debug, Clone, PartialEq)]
pub struct LammpsInput {
    /// Commands.
    pub input: String,
    /// Particles and bonds before the impact.
    pub data: String,
    /// Number of particles of the lattice.
    pub particles: usize,
    /// Number of whole bonds.
    pub bonds: usize,
    /// Time step [s].
    pub time_step: f64,
    /// Time steps of the run.
    pub steps: u64,
    /// What differs from a run of percuss, in sentences.
    pub differences: Vec<String>,
}

/// A bond of the data: its type and both atoms.
struct DataBond {
    kind: usize,
    atoms: [usize; 2],
}

/// Why a case that the model takes has no input for LAMMPS, if it has none.
fn not_exported(scenario: &Scenario) -> Option<Refusal> {
    if ball::is_meant(scenario) {
        let reason = "the input for LAMMPS is that of a lattice, and `particles.contact = \"hertz\"` has none";
        return Some(Refusal::new(reason).with_remedy("remove `particles.contact`"));
    }
    if stress::is_meant(scenario) {
        let reason = "the input for LAMMPS has springs alone: it lacks the stresses of `particles.formulation = \"particle-stress\"`";
        return Some(
            Refusal::new(reason).with_remedy("give `particles.formulation = \"springs\"`"),
        );
    }
    if setup::toughness(scenario).is_some() {
        let reason = "LAMMPS has no bonds that soften: its bonds break at once, under pressure, too, and the answer would be another one";
        let remedy = "give `particles.fracture = false` for a body that does not break, and remove `particles.notches`";
        return Some(Refusal::new(reason).with_remedy(remedy));
    }
    if scenario.options.particles.space() == Space::ThreeDimensional {
        let reason = "the input for LAMMPS has plane bodies alone: LAMMPS has no stiffness of a particle's volume like that of the model";
        return Some(Refusal::new(reason).with_remedy("give another `particles.space`"));
    }
    if scenario.obliquity != 0.0 {
        let reason = "the input for LAMMPS has normal impact alone";
        return Some(Refusal::new(reason).with_remedy("remove `projectile.obliquity`"));
    }
    let is_round = scenario.projectile.nose == Nose::Hemisphere;
    (setup::is_plate(scenario) && !is_round).then(|| {
        let reason = "LAMMPS has no rigid body of this nose with a mass of its own: a round nose is one large particle";
        Refusal::new(reason).with_remedy("give `projectile.nose = \"hemisphere\"`, or a rigid wall as the target")
    })
}

/// Input for LAMMPS, with the particles and bonds that a run of the model `particles` starts from.
///
/// # Errors
/// [`Error::NotApplicable`] where the model does not apply to the case, or LAMMPS has no such rigid body; [`Error::Cancelled`].
pub fn lammps(scenario: &Scenario, control: &mut Control<'_>) -> Result<LammpsInput, Error> {
    let refused = |refusal| Error::not_applicable("particles", refusal);
    applicability(&super::Particles, scenario).map_err(refused)?;
    if let Some(refusal) = not_exported(scenario) {
        return Err(refused(refusal));
    }
    let (_, courant) = PlaneRun::courant(scenario);
    let courant = scenario.options.particles.courant.unwrap_or(courant);
    let impact = PlaneRun::build(scenario, courant, control)?;
    let (_, end, limits) = setup::expected(scenario);
    let time = end.min(limits.end_time);
    let steps = (time / impact.time_step).ceil() as u64;
    let deck = Deck::of(&impact);
    Ok(LammpsInput {
        input: deck.input(steps),
        data: deck.data(),
        particles: deck.atoms.len(),
        bonds: deck.bonds.len(),
        time_step: impact.time_step,
        steps,
        differences: differences(&impact),
    })
}

/// What LAMMPS computes otherwise.
fn differences(impact: &PlaneRun<'_>) -> Vec<String> {
    let mut all = Vec::new();
    if impact.body.lattice.shear > 0.0 {
        all.push(
            "Shear springs turn with both particles by another formula, equal for small rotations."
                .to_owned(),
        );
    }
    if impact.rigid != Rigid::Wall {
        all.push(
            "The projectile is a disc, as deep as its nose: its shank meets nothing.".to_owned(),
        );
    }
    all.push("The run ends after a number of steps, not when the bodies have parted.".to_owned());
    all
}

/// Particles and bonds with their numbers in the data.
struct Deck<'a> {
    impact: &'a PlaneRun<'a>,
    atoms: Vec<(usize, usize)>,
    bonds: Vec<DataBond>,
    /// Shares of the springs of each type of bonds.
    types: Vec<f64>,
}

impl<'a> Deck<'a> {
    fn of(impact: &'a PlaneRun<'a>) -> Self {
        let body = &impact.body;
        let atoms: Vec<_> = body.particles().collect();
        let number: BTreeMap<(usize, usize), usize> = atoms
            .iter()
            .enumerate()
            .map(|(i, at)| (*at, i + 1))
            .collect();
        let (mut bonds, mut types) = (Vec::new(), Vec::new());
        let mut known: BTreeMap<u64, usize> = BTreeMap::new();
        for &(row, place) in &atoms {
            for kind in 0..3 {
                let rest = body.rest(row, place, kind);
                if rest.weight == 0.0 {
                    continue;
                }
                let kind_of_bond = *known.entry(rest.weight.to_bits()).or_insert_with(|| {
                    types.push(rest.weight);
                    types.len()
                });
                let ends = [(row, place), body.other_end(row, place, kind)];
                bonds.push(DataBond {
                    kind: kind_of_bond,
                    atoms: ends.map(|end| number[&end]),
                });
            }
        }
        Self {
            impact,
            atoms,
            bonds,
            types,
        }
    }

    fn body(&self) -> &Body {
        &self.impact.body
    }

    /// Diameter of the discs with the moment of inertia of the particles [m].
    fn diameter(&self) -> f64 {
        let lattice = &self.body().lattice;
        (8.0 * lattice.inertia / lattice.mass).sqrt()
    }

    fn data(&self) -> String {
        let body = self.body();
        let is_wall = self.impact.rigid == Rigid::Wall;
        let number = self.atoms.len() + usize::from(!is_wall);
        let mut low = [f64::INFINITY; 2];
        let mut high = [f64::NEG_INFINITY; 2];
        let mut lines = String::new();
        let diameter = self.diameter();
        for (index, &(row, place)) in self.atoms.iter().enumerate() {
            let at = body.reference(row, place);
            for axis in 0..2 {
                low[axis] = low[axis].min(at[axis]);
                high[axis] = high[axis].max(at[axis]);
            }
            let is_held = body
                .held_places(row)
                .is_some_and(|held| held.contains(&place));
            let density = body.rows[row].mass[place] / (SPHERE * diameter.powi(3));
            line(
                &mut lines,
                format_args!(
                    "{} 1 {} {diameter} {density} {} {} 0",
                    index + 1,
                    if is_held { HELD } else { FREE },
                    at[0],
                    at[1]
                ),
            );
        }
        if let Rigid::Projectile(shape) = self.impact.rigid {
            let size = 2.0 * shape.radius;
            let density = self.impact.inertia.mass / (SPHERE * size.powi(3));
            line(
                &mut lines,
                format_args!(
                    "{number} 2 {PROJECTILE} {size} {density} 0 {} 0",
                    -shape.radius
                ),
            );
            low[1] = low[1].min(-size);
        }
        let room = ROOM * (high[0] - low[0]).max(high[1] - low[1]);
        let half = 0.5 * body.lattice.spacing;
        let mut text = String::from(
            "Particles and bonds by percuss, undeformed [kg, m, s; per metre of width]\n\n",
        );
        line(
            &mut text,
            format_args!("{number} atoms\n{} bonds", self.bonds.len()),
        );
        line(
            &mut text,
            format_args!("3 atom types\n{} bond types\n", self.types.len()),
        );
        for (axis, name) in [(0, "x"), (1, "y")] {
            line(
                &mut text,
                format_args!(
                    "{} {} {name}lo {name}hi",
                    low[axis] - room,
                    high[axis] + room
                ),
            );
        }
        line(&mut text, format_args!("{} {half} zlo zhi\n", -half));
        text += "Atoms # bpm/sphere\n\n";
        text += &lines;
        text += "\nBonds\n\n";
        for (index, bond) in self.bonds.iter().enumerate() {
            let [a, b] = bond.atoms;
            line(
                &mut text,
                format_args!("{} {} {a} {b}", index + 1, bond.kind),
            );
        }
        text
    }

    fn input(&self, steps: u64) -> String {
        let body = self.body();
        let lattice = &body.lattice;
        let turns = lattice.shear > 0.0;
        let reach = match self.impact.rigid {
            Rigid::Wall => 0.0,
            Rigid::Projectile(shape) => shape.radius,
        };
        let every = ((steps as f64 / FRAMES) as u64).max(1);
        let style = if turns {
            "bpm/rotational"
        } else {
            "bpm/spring"
        };
        let mut text = String::from(
            "# Bonded particles by percuss: x is across the direction of impact, y along it\n",
        );
        line(
            &mut text,
            format_args!("variable steps index {steps}\nvariable every index {every}\n"),
        );
        text += "units si\ndimension 2\nboundary f f p\natom_style bpm/sphere\nnewton on off\n";
        text += "special_bonds lj 0 1 1 coul 1 1 1\n";
        line(
            &mut text,
            format_args!(
                "comm_modify vel yes cutoff {}\nneighbor {} bin\nneigh_modify delay 0 every 1 check yes",
                (3.0 * lattice.spacing).max(reach + 2.0 * lattice.spacing),
                0.3 * lattice.spacing
            ),
        );
        text += "read_data particles.data\n\n";
        line(
            &mut text,
            format_args!("bond_style {style} smooth no break no"),
        );
        for (index, weight) in self.types.iter().enumerate() {
            line(
                &mut text,
                format_args!("bond_coeff {} {}", index + 1, self.coefficients(*weight)),
            );
        }
        text += "\npair_style bpm/spring\n";
        line(
            &mut text,
            format_args!("pair_coeff * * 0 {} 0", lattice.spacing),
        );
        if let Rigid::Projectile(shape) = self.impact.rigid {
            let of_contact = body.contact_stiffness();
            line(
                &mut text,
                format_args!("pair_coeff 1*2 3 {of_contact} {} 0", shape.radius),
            );
        }
        text += &self.motion();
        line(
            &mut text,
            format_args!("\ntimestep {}\nthermo ${{every}}", self.impact.time_step),
        );
        text += &self.output();
        text += "run ${steps}\n";
        text
    }

    /// Stiffness and strength of a type of bonds, as its style wants them.
    fn coefficients(&self, weight: f64) -> String {
        let body = self.body();
        let lattice = &body.lattice;
        let (normal, shear) = (weight * lattice.normal, weight * lattice.shear);
        // The strengths that the styles ask for have no effect on bonds that do not break.
        match shear > 0.0 {
            true => format!("{normal} {shear} 0 0 1 1 1 1 0 0 0 0"),
            false => format!("{normal} 1 0"),
        }
    }

    /// Velocities at the start, supports and the law of motion.
    fn motion(&self) -> String {
        let speed = self.impact.scenario.impact_velocity;
        let lattice = &self.body().lattice;
        let mut text =
            String::from("\ngroup lattice type 1 2\ngroup held type 2\ngroup projectile type 3\n");
        match self.impact.rigid {
            Rigid::Wall => {
                let away = WALL * lattice.spacing;
                line(&mut text, format_args!("velocity lattice set 0 {speed} 0"));
                text += "fix motion all nve/bpm/sphere disc\n";
                line(
                    &mut text,
                    format_args!(
                        "fix wall lattice wall/harmonic yhi {away} {} 0 {away}",
                        0.5 * self.body().contact_stiffness()
                    ),
                );
            }
            Rigid::Projectile(_) => {
                line(
                    &mut text,
                    format_args!("velocity projectile set 0 {speed} 0"),
                );
                text += "fix motion all nve/bpm/sphere disc\n";
                text += "fix guide projectile setforce 0 NULL 0\n";
                text += "fix support held setforce NULL 0 NULL\n";
            }
        }
        text + "fix plane all enforce2d\n"
    }

    fn output(&self) -> String {
        let group = match self.impact.rigid {
            Rigid::Wall => "lattice",
            Rigid::Projectile(_) => "projectile",
        };
        let mut text = String::new();
        line(
            &mut text,
            format_args!(
                "variable velocity equal vcm({group},y)\nvariable place equal xcm({group},y)"
            ),
        );
        text += "thermo_style custom step time v_velocity v_place ke\n";
        text += "thermo_modify format float %.17g lost warn\n";
        text += "dump frames all custom ${every} particles.dump id type x y vx vy\n";
        text += "dump_modify frames sort id format float %.10g\n\n";
        text
    }
}

/// Adds a line.
fn line(text: &mut String, words: std::fmt::Arguments<'_>) {
    // Writing to a text cannot fail.
    let _ = writeln!(text, "{words}");
}
