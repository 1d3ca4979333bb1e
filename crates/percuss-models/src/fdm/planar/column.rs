//! A column of planar bodies between two ends: the solver by itself, for problems that are no impact.

use super::law::PlanarLaw;
use crate::{
    Error,
    fdm::grid::{BoundaryCondition, Grid, Slab},
    ledger::{EnergyLedger, MomentumLedger},
    material::{Material, StateEquation},
    options::{ArtificialViscosity, ChainOptions},
};

/// What a layer is made of.
#[derive(Debug, Clone, PartialEq)]
pub struct Medium {
    /// Equation of state.
    pub state: StateEquation,
    /// Density at the start [kg/m3].
    pub density: f64,
    /// Energy at the start [J/kg].
    pub energy: f64,
    /// Shear modulus and strength law; `None` for a fluid.
    pub solid: Option<Solid>,
    /// Tensile stress at which it spalls [Pa]; `None` if it holds any.
    pub spall_strength: Option<f64>,
}

/// What a solid has beyond its pressure: shear modulus and strength law of a material.
#[derive(Debug, Clone, PartialEq)]
pub struct Solid {
    /// Shear modulus [Pa].
    pub shear_modulus: f64,
    /// The material whose strength law and thermal constants hold.
    pub material: Material,
}

impl Medium {
    /// A solid as its record describes it; `None` without an equation of state.
    pub fn of(material: &Material) -> Option<Self> {
        Some(Self {
            state: StateEquation::of(material)?,
            density: material.density.si(),
            energy: 0.0,
            solid: Some(Solid {
                shear_modulus: material.shear_modulus(),
                material: material.clone(),
            }),
            spall_strength: material.spall_strength.map(|strength| strength.si()),
        })
    }

    /// An ideal gas of a ratio of specific heats, a density [kg/m3] and an energy [J/kg].
    pub fn ideal_gas(gamma: f64, density: f64, energy: f64) -> Self {
        Self {
            state: StateEquation::IdealGas { gamma },
            density,
            energy,
            solid: None,
            spall_strength: None,
        }
    }

    /// Its law with the usual heating, and strength that depends on the rate.
    pub(super) fn law(&self, area: f64, viscosity: ArtificialViscosity) -> PlanarLaw {
        let material = self.solid.as_ref().map(|solid| &solid.material);
        PlanarLaw {
            state: self.state,
            area,
            start_density: self.density,
            start_energy: self.energy,
            shear_modulus: self.solid.as_ref().map_or(0.0, |solid| solid.shear_modulus),
            strength: material.map(|material| material.strength.law().prepare(material, 1.0)),
            heat_fraction: ChainOptions::default().heat_fraction(),
            specific_heat: material
                .and_then(|material| material.specific_heat)
                .map(|c| c.si()),
            start_temperature: material.map_or(293.0, |material| material.room_temperature.si()),
            rate_effects: true,
            viscosity,
            spall_strength: self.spall_strength,
        }
    }
}

/// A layer of a column.
#[derive(Debug, Clone, PartialEq)]
pub struct Layer {
    /// What it is made of.
    pub medium: Medium,
    /// Thickness [m].
    pub thickness: f64,
    /// Number of cells.
    pub cells: usize,
    /// Velocity at the start [m/s].
    pub velocity: f64,
}

/// What stands at an end of a column.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Boundary {
    /// Nothing.
    Free,
    /// A piston of this velocity [m/s]; a wall at 0.
    Piston(f64),
}

/// State of a cell of a column.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CellState {
    /// Layer, counted from 0.
    pub layer: usize,
    /// Position of its middle [m].
    pub position: f64,
    /// Mean velocity of its faces [m/s].
    pub velocity: f64,
    /// Density [kg/m3].
    pub density: f64,
    /// Pressure without viscosity [Pa].
    pub pressure: f64,
    /// Axial stress deviator, compression positive [Pa].
    pub deviator: f64,
    /// Energy [J/kg].
    pub energy: f64,
}

/// A column of planar bodies, 1 m2 in cross-section, the first layer starting at 0.
#[derive(Debug)]
pub struct PlanarGrid {
    grid: Grid<PlanarLaw>,
    courant: f64,
}

impl PlanarGrid {
    /// A column at time 0.
    pub fn new(
        layers: &[Layer],
        [left, right]: [Boundary; 2],
        viscosity: ArtificialViscosity,
        courant: f64,
    ) -> Self {
        let mut start = 0.0;
        let slabs = layers.iter().map(|layer| {
            let slab = Slab {
                law: layer.medium.law(1.0, viscosity),
                line_density: layer.medium.density,
                line_friction: 0.0,
                start,
                length: layer.thickness,
                cells: layer.cells,
                velocity: layer.velocity,
            };
            start += layer.thickness;
            slab
        });
        let end = |boundary| match boundary {
            Boundary::Free => BoundaryCondition::Free,
            Boundary::Piston(velocity) => BoundaryCondition::Driven(velocity),
        };
        Self {
            grid: Grid::new(slabs.collect(), [end(left), end(right)]),
            courant,
        }
    }

    /// Advances by one step, but not beyond a time [s].
    ///
    /// # Errors
    /// [`Error::Numerical`] when a cell is compressed beyond its equation of state.
    pub fn step(&mut self, until: f64) -> Result<(), Error> {
        Ok(self.grid.advance(self.courant, until - self.grid.time)?)
    }

    /// Advances to a time [s].
    ///
    /// # Errors
    /// Those of [`Self::step`].
    pub fn advance_to(&mut self, time: f64) -> Result<(), Error> {
        while self.grid.time < time * (1.0 - 1e-12) {
            self.step(time)?;
        }
        Ok(())
    }

    /// Time [s].
    pub fn time(&self) -> f64 {
        self.grid.time
    }

    /// Cells from left to right.
    pub fn cells(&self) -> Vec<CellState> {
        let mut cells = Vec::with_capacity(self.grid.cells.len());
        for (s, segment) in self.grid.segments.iter().enumerate() {
            for c in segment.cells.clone() {
                let (a, b) = (self.grid.nodes.at(c + s), self.grid.nodes.at(c + s + 1));
                let cell = self.grid.cells[c];
                cells.push(CellState {
                    layer: segment.body,
                    position: 0.5 * (a.position + b.position),
                    velocity: 0.5 * (a.velocity + b.velocity),
                    density: 1.0 / cell.volume,
                    pressure: cell.pressure,
                    deviator: cell.deviator,
                    energy: cell.energy,
                });
            }
        }
        cells
    }

    /// Velocity of the first and the last node [m/s].
    pub fn end_velocities(&self) -> (f64, f64) {
        let last = self.grid.nodes.last().unwrap_or_default();
        (self.grid.nodes.velocity[0], last.velocity)
    }

    /// Initial position [m] and time [s] of every spall plane.
    pub fn spalls(&self) -> Vec<(f64, f64)> {
        let spalls = self.grid.spalls.iter();
        spalls.map(|spall| (spall.position, spall.time)).collect()
    }

    /// Energy balance [J]; the first layer counts as the projectile.
    pub fn energy(&self) -> EnergyLedger {
        self.grid.energy()
    }

    /// Momentum balance [N s].
    pub fn momentum(&self) -> MomentumLedger {
        self.grid.momentum()
    }
}
