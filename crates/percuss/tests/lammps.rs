//! Input for LAMMPS: it has the masses and bonds of the run, and refuses what LAMMPS has not. That LAMMPS runs it to the same motion is a test of
//! the Python package, which installs LAMMPS.

use std::f64::consts::PI;

use percuss::{
    Error, Scenario, case,
    model::Control,
    particles::{self, LammpsInput},
};

fn ready(name: &str) -> Scenario {
    let path = format!(
        "{}/../../cases/{name}/scenario.toml",
        env!("CARGO_MANIFEST_DIR")
    );
    case::load(path).unwrap_or_else(|error| panic!("{error}"))
}

fn input(scenario: &Scenario) -> Result<LammpsInput, Error> {
    particles::lammps(scenario, &mut Control::default())
}

/// Numbers of a section of the data, line by line.
fn section(data: &str, name: &str) -> Vec<Vec<f64>> {
    let start = data.find(&format!("{name}\n\n")).unwrap() + name.len() + 2;
    let lines = data[start..].lines().take_while(|line| !line.is_empty());
    let numbers = |line: &str| line.split(' ').map(|word| word.parse().unwrap()).collect();
    lines.map(numbers).collect()
}

/// LAMMPS takes the mass of a sphere of a density, and the moment of inertia of a disc.
#[test]
fn atoms_have_the_mass_and_the_inertia_of_the_particles() {
    let found = input(&ready("rigid-on-glass-plane")).unwrap();
    let atoms = section(&found.data, "Atoms # bpm/sphere");
    assert_eq!(atoms.len(), found.particles + 1);
    let mass = |atom: &[f64]| PI / 6.0 * atom[3].powi(3) * atom[4];
    let (projectile, plate) = atoms.split_last().unwrap();
    // The projectile: 7850 kg/m3 on 10 mm, of which the nose is half a circle of 5 mm.
    let area = 10e-3 * 5e-3 + 0.5 * PI * 25e-6;
    assert!((mass(projectile) / (7850.0 * area) - 1.0).abs() < 1e-12);
    let of_plate: f64 = plate.iter().map(|atom| mass(atom)).sum();
    let (left, right) = plate.iter().fold((0.0_f64, 0.0_f64), |(low, high), atom| {
        (low.min(atom[5]), high.max(atom[5]))
    });
    // The ends of even rows are half a spacing further out than those of odd ones.
    let width = right - left - 0.5 * 10e-3 / 24.0 * 2.0 / 3.0_f64.sqrt();
    let ratio = of_plate / (2440.0 * 10e-3 * width);
    assert!((ratio - 1.0).abs() < 1e-9, "{ratio}");
    let inertia = plate[0][3].powi(2) / 8.0;
    assert!(inertia > 0.0 && plate.iter().all(|atom| atom[3] == plate[0][3]));
    // Each bond once, between two particles of the plate.
    let bonds = section(&found.data, "Bonds");
    assert_eq!(bonds.len(), found.bonds);
    let mut ends: Vec<_> = bonds
        .iter()
        .map(|bond| [bond[2].min(bond[3]) as usize, bond[2].max(bond[3]) as usize])
        .collect();
    ends.sort_unstable();
    ends.dedup();
    assert_eq!(ends.len(), found.bonds);
    assert!(
        ends.iter()
            .flatten()
            .all(|end| (1..=found.particles).contains(end))
    );
}

#[test]
fn every_bond_of_an_irregular_packing_has_its_own_stiffness() {
    let mut scenario = ready("rigid-on-glass-plane");
    let regular = input(&scenario).unwrap();
    assert!(regular.data.contains("\n2 bond types\n"));
    scenario.options.particles.packing = Some(particles::PackingKind::Irregular);
    let moved = input(&scenario).unwrap();
    assert_eq!(moved.bonds, regular.bonds);
    let coefficients = moved
        .input
        .lines()
        .filter(|line| line.starts_with("bond_coeff "));
    assert!(coefficients.count() > moved.bonds / 2);
}

#[test]
fn what_lammps_has_not_is_refused_with_a_remedy() {
    let cracks = ready("cracks-in-glass-plate");
    let (message, help) = input(&cracks).unwrap_err().message_and_help();
    assert!(message.contains("bonds that soften"), "{message}");
    assert!(help.contains("particles.fracture = false"), "{help}");
    let mut whole = cracks;
    whole.options.particles.fracture = Some(false);
    assert!(input(&whole).is_ok());
    let mut oblique = whole.clone();
    oblique.obliquity = 0.5;
    let (message, help) = input(&oblique).unwrap_err().message_and_help();
    assert!(message.contains("normal impact alone"), "{message}");
    assert!(help.contains("projectile.obliquity"), "{help}");
    whole.projectile.nose = percuss::problem::Nose::Flat;
    let (message, help) = input(&whole).unwrap_err().message_and_help();
    assert!(message.contains("this nose"), "{message}");
    assert!(help.contains("hemisphere"), "{help}");
    // What the model itself does not take.
    let rod = ready("copper-on-aluminium-800");
    assert!(matches!(input(&rod), Err(Error::NotApplicable { .. })));
}
