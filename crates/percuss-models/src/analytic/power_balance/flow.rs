//! Flow stress of the plate along an adiabatic path, by the material's own strength law.

use crate::{
    material::{FlowState, Material, PreparedStrength},
    options::PowerBalanceOptions,
};

/// Strain up to which the temperature is tabulated; beyond it the temperature stays.
const LARGEST_STRAIN: f64 = 50.0;
const NODES: u32 = 400;
/// Nodes of a stress that depends on the strain alone: interpolation is right to 1e-5.
const STRESS_NODES: u32 = 4000;
/// Heat that warms a metal to its melting point over Young's modulus: the median of 21 records of the library, among them aluminium alloys
/// with 0.021, steels with 0.026, copper alloys with 0.028 and titanium alloys with 0.032.
const MELTING_HEAT: f64 = 0.0267;

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
        let softens = !strength.depends_on_temperature() && hardens(&*law, temperature);
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

/// Heat per volume that warms a metal to its melting point [J/m3].
fn melting_heat(material: &Material) -> f64 {
    match (material.specific_heat, material.melting_temperature) {
        (Some(specific_heat), Some(melting)) => {
            let warming = melting.si() - material.room_temperature.si();
            material.density.si() * specific_heat.si() * warming
        }
        _ => MELTING_HEAT * material.youngs_modulus.si(),
    }
}

/// Whether the stress at unit strain is above that of first yield.
fn hardens(law: &dyn PreparedStrength, temperature: f64) -> bool {
    let stress = |plastic_strain| {
        let state = FlowState {
            plastic_strain,
            strain_rate: 0.0,
            temperature,
            pressure: 0.0,
        };
        law.flow_stress(&state).stress
    };
    stress(1.0) > stress(0.0) * (1.0 + 1e-9)
}

/// Value at a plastic strain of a table over the nodes.
fn at_strain(table: &[f64], strain: f64) -> f64 {
    let last = table.len() - 1;
    let place = last as f64 * (strain.max(0.0) / LARGEST_STRAIN).sqrt().min(1.0);
    // The place is at most the last node.
    let node = place as usize;
    let below = table[node];
    let above = table[(node + 1).min(last)];
    below + (place - node as f64) * (above - below)
}

fn strain_of_node(node: u32, nodes: u32) -> f64 {
    LARGEST_STRAIN * (f64::from(node) / f64::from(nodes)).powi(2)
}
