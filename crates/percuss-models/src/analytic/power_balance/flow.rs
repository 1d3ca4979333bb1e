//! Flow stress of the plate along an adiabatic path, by the material's own strength law.

use crate::{
    material::{FlowState, Material, PreparedStrength},
    options::PowerBalanceOptions,
};

/// Strain up to which the temperature is tabulated; beyond it the temperature stays.
const LARGEST_STRAIN: f64 = 50.0;
const NODES: u32 = 400;

/// Strength law with the temperature of an adiabatic path.
#[derive(Debug)]
pub(super) struct Flow {
    law: Box<dyn PreparedStrength>,
    /// Strain of the largest stress at the nominal rate, where heat makes the metal weaker beyond it.
    pub peak_strain: Option<f64>,
    /// Temperatures at the strains `LARGEST_STRAIN (i/NODES)²` [K].
    temperatures: Vec<f64>,
}

impl Flow {
    /// The law of a material; its temperature follows from the plastic work at a nominal strain rate [1/s].
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
        for i in 0..NODES {
            let (from, to) = (strain_of_node(i), strain_of_node(i + 1));
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
        }
        let mut flow = Self {
            law,
            temperatures,
            peak_strain: None,
        };
        flow.peak_strain = flow.peak(nominal_rate);
        flow
    }

    /// Temperature at a plastic strain [K].
    pub fn temperature(&self, strain: f64) -> f64 {
        let place = f64::from(NODES) * (strain.max(0.0) / LARGEST_STRAIN).sqrt();
        let mut below = self.temperatures[0];
        // The place is at most the last node.
        let node = place.min(f64::from(NODES)) as usize;
        if let Some(&at) = self.temperatures.get(node) {
            below = at;
        }
        let above = self.temperatures.get(node + 1).copied().unwrap_or(below);
        below + (place.min(f64::from(NODES)) - node as f64) * (above - below)
    }

    /// Flow stress at a plastic strain and a strain rate [1/s] [Pa].
    pub fn stress(&self, strain: f64, rate: f64) -> f64 {
        let state = FlowState {
            plastic_strain: strain.clamp(0.0, LARGEST_STRAIN),
            strain_rate: rate.max(0.0),
            temperature: self.temperature(strain),
            pressure: 0.0,
        };
        self.law.flow_stress(&state).stress.max(0.0)
    }

    /// Strain of the largest stress at a rate [1/s]; `None` where the stress never falls.
    fn peak(&self, rate: f64) -> Option<f64> {
        let stress = |node: &u32| self.stress(strain_of_node(*node), rate);
        let best = (0..=NODES).max_by(|a, b| stress(a).total_cmp(&stress(b)))?;
        let falls = stress(&NODES) < stress(&best) * (1.0 - 1e-9);
        falls.then(|| strain_of_node(best))
    }
}

fn strain_of_node(node: u32) -> f64 {
    LARGEST_STRAIN * (f64::from(node) / f64::from(NODES)).powi(2)
}
