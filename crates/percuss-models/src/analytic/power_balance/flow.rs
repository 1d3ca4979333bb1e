//! Flow stress of the plate along an adiabatic path, by the material's own strength law.

use crate::{
    material::{FlowState, Material, MaterialGroup, PreparedStrength},
    options::PowerBalanceOptions,
};

/// Strain up to which the temperature is tabulated; beyond it the temperature stays.
const LARGEST_STRAIN: f64 = 50.0;
const NODES: u32 = 400;
/// Nodes of a stress that depends on the strain alone: interpolation is right to 1e-5.
const STRESS_NODES: u32 = 4000;
/// Groups of metals by density [kg/m3] and Young's modulus [Pa], with the heat up to the melting point over the modulus: medians of the
/// records of the library that have thermal data.
pub(super) const METALS: [Metal; 4] = [
    Metal::new(MaterialGroup::Aluminium, 2740.0, 71e9, 0.0211),
    Metal::new(MaterialGroup::Titanium, 4430.0, 114e9, 0.0323),
    Metal::new(MaterialGroup::Steel, 7850.0, 205e9, 0.0262),
    Metal::new(MaterialGroup::Copper, 8800.0, 120e9, 0.0282),
];
/// The median of all 21 records with thermal data, for other metals.
pub(super) const OTHER_METALS: f64 = 0.0267;
/// Largest factors in density and in modulus between a metal and its group.
const ALIKE: [f64; 2] = [1.1, 1.25];

/// Strength law with the temperature of an adiabatic path.
#[derive(Debug)]
pub(super) struct Flow {
    law: Box<dyn PreparedStrength>,
    /// Temperatures at the strains `LARGEST_STRAIN (i/NODES)²` [K].
    temperatures: Vec<f64>,
    /// Parts of the strength that heat leaves at these strains; empty for a law that depends on temperature by itself.
    strengths: Vec<f64>,
    /// Flow stresses at the strains `LARGEST_STRAIN (i/STRESS_NODES)²` [Pa], where they depend on the strain alone.
    stresses: Vec<f64>,
}

impl Flow {
    /// The law of a material; its temperature follows from the plastic work at a nominal strain rate [1/s].
    ///
    /// A law that hardens, but does not depend on temperature, is that of a slow test. Its stress σ falls linearly to zero at the melting
    /// point: `dT*/dε = β σ (1 − T*)/H`, so that `1 − T* = exp(−β∫σ dε/H)`. A constant stress counts as a mean over the strains and
    /// temperatures of an impact.
    pub fn new(material: &Material, options: &PowerBalanceOptions, nominal_rate: f64) -> Self {
        let strength = material.strength.law();
        let law = strength.prepare(material, 1.0);
        let heating = match material.specific_heat {
            Some(specific_heat) if strength.depends_on_temperature() => {
                options.heat_fraction() / (material.density.si() * specific_heat.si())
            }
            _ => 0.0,
        };
        let mut temperature = material.room_temperature.si();
        let mut temperatures = vec![temperature];
        let melting = melting_heat(material) / options.heat_fraction();
        let softens = !strength.depends_on_temperature() && material.hardens_at(temperature);
        let mut work = 0.0;
        let mut strengths = if softens { vec![1.0] } else { Vec::new() };
        for i in 0..NODES {
            let (from, to) = (strain_of_node(i, NODES), strain_of_node(i + 1, NODES));
            let state = FlowState {
                plastic_strain: (from + to) / 2.0,
                strain_rate: nominal_rate,
                temperature,
                pressure: 0.0,
            };
            // The mean stress of the panel: its first half warms before its second half flows.
            let first = law.flow_stress(&state).stress;
            let warm = temperature + heating * first * (to - from) / 2.0;
            let mean = law.flow_stress(&FlowState {
                temperature: warm,
                ..state
            });
            temperature += heating * mean.stress * (to - from);
            temperatures.push(temperature);
            if softens {
                work += mean.stress * (to - from);
                strengths.push((-work / melting).exp());
            }
        }
        let mut flow = Self {
            law,
            temperatures,
            strengths,
            stresses: Vec::new(),
        };
        if flow.law.depends_on_strain_only() {
            let stress = |node| flow.stress(strain_of_node(node, STRESS_NODES), nominal_rate);
            flow.stresses = (0..=STRESS_NODES).map(stress).collect();
        }
        flow
    }

    /// Temperature at a plastic strain [K].
    pub fn temperature(&self, strain: f64) -> f64 {
        at_strain(&self.temperatures, strain)
    }

    /// Flow stress at a plastic strain and a strain rate [1/s] [Pa].
    pub fn stress(&self, strain: f64, rate: f64) -> f64 {
        if !self.stresses.is_empty() {
            return at_strain(&self.stresses, strain);
        }
        let state = FlowState {
            plastic_strain: strain.clamp(0.0, LARGEST_STRAIN),
            strain_rate: rate.max(0.0),
            temperature: self.temperature(strain),
            pressure: 0.0,
        };
        let left = match self.strengths.is_empty() {
            true => 1.0,
            false => at_strain(&self.strengths, strain),
        };
        left * self.law.flow_stress(&state).stress.max(0.0)
    }
}

/// A group of metals.
#[derive(Debug)]
pub(super) struct Metal {
    pub group: MaterialGroup,
    density: f64,
    modulus: f64,
    /// Heat up to the melting point over Young's modulus.
    pub heat: f64,
}

impl Metal {
    const fn new(group: MaterialGroup, density: f64, modulus: f64, heat: f64) -> Self {
        Self {
            group,
            density,
            modulus,
            heat,
        }
    }

    /// The group of a material: that of its record, or else the one of like density and modulus.
    pub fn of(material: &Material) -> Option<&'static Self> {
        let alike = |a: f64, b: f64, factor: f64| a < factor * b && b < factor * a;
        METALS.iter().find(|metal| match material.group {
            Some(group) => group == metal.group,
            None => {
                alike(metal.density, material.density.si(), ALIKE[0])
                    && alike(metal.modulus, material.youngs_modulus.si(), ALIKE[1])
            }
        })
    }
}

/// Heat per volume that warms a metal to its melting point [J/m3].
fn melting_heat(material: &Material) -> f64 {
    own_melting_heat(material).unwrap_or_else(|| {
        let ratio = Metal::of(material).map_or(OTHER_METALS, |metal| metal.heat);
        ratio * material.youngs_modulus.si()
    })
}

/// The same by the constants of the record [J/m3]; `None` where it lacks one.
pub(super) fn own_melting_heat(material: &Material) -> Option<f64> {
    let warming = material.melting_temperature?.si() - material.room_temperature.si();
    Some(material.density.si() * material.specific_heat?.si() * warming)
}

/// Value at a plastic strain of a table over the nodes, by cubic interpolation: the least of a function of it must not depend on its nodes.
fn at_strain(table: &[f64], strain: f64) -> f64 {
    let last = table.len() - 1;
    let place = last as f64 * (strain.max(0.0) / LARGEST_STRAIN).sqrt().min(1.0);
    // The place is at most the last node.
    let node = (place as usize).min(last - 1);
    let part = place - node as f64;
    let (here, next) = (table[node], table[node + 1]);
    // Beyond the ends the table goes on along a line.
    let before = node.checked_sub(1).map_or(2.0 * here - next, |i| table[i]);
    let after = table.get(node + 2).copied().unwrap_or(2.0 * next - here);
    let (rise, fall) = ((next - before) / 2.0, (after - here) / 2.0);
    let step = next - here;
    here + part
        * (rise + part * (3.0 * step - 2.0 * rise - fall + part * (rise + fall - 2.0 * step)))
}

fn strain_of_node(node: u32, nodes: u32) -> f64 {
    LARGEST_STRAIN * (f64::from(node) / f64::from(nodes)).powi(2)
}
