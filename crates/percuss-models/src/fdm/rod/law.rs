//! Law of a rod: uniaxial stress in rate form, constant volume.

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

use crate::{
    fdm::{
        grid::{Law, Motion, Stored, View},
        viscosity,
    },
    lanes::{LANES, Lanes, PerLane},
    material::{
        FlowState, LaneStrength, LaneTrial, LawVisitor, PreparedStrength, Trial, YieldPoint,
        plastic_increments,
    },
    options::ArtificialViscosity,
};

/// A rod or a column of target.
#[derive(Debug)]
pub(super) struct RodLaw {
    pub(super) modulus: f64,
    pub(super) density: f64,
    pub(super) wave_speed: f64,
    pub(super) area: f64,
    pub(super) strength: Box<dyn PreparedStrength>,
    /// Temperature rise per plastic work per volume [K m3/J]; 0 without heating.
    pub(super) heating: f64,
    pub(super) start_temperature: f64,
    pub(super) rate_effects: bool,
    pub(super) viscosity: ArtificialViscosity,
}

/// A cell: its stress, and what led to it.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(super) struct RodCell {
    initial_position: f64,
    volume: f64,
    rest_length: f64,
    /// Length at the last load [m].
    length: f64,
    strain: f64,
    stress: f64,
    stress_before: f64,
    viscous_pressure: f64,
    /// Signed axial plastic strain, compression positive.
    axial_plastic: f64,
    plastic_strain: f64,
    /// Signed plastic strain of the last load.
    plastic_step: f64,
    strain_rate: f64,
    temperature: f64,
    yield_point: YieldPoint,
    plastic_work: f64,
    viscous_work: f64,
}

impl RodCell {
    /// Length without load [m].
    pub(super) fn unloaded_length(&self) -> f64 {
        self.rest_length * (-self.axial_plastic).exp()
    }

    pub(super) fn rest_length(&self) -> f64 {
        self.rest_length
    }

    pub(super) fn strain(&self) -> f64 {
        self.strain
    }
}

impl RodLaw {
    #[inline(always)]
    fn flow_state(&self, cell: &RodCell) -> FlowState {
        FlowState {
            plastic_strain: cell.plastic_strain,
            strain_rate: 0.0,
            temperature: cell.temperature,
            pressure: cell.stress / 3.0,
        }
    }

    fn diameter(&self, shortening: f64) -> f64 {
        2.0 * (self.area * shortening / PI).sqrt()
    }

    /// Diameter of a cell without load [m].
    pub(super) fn unloaded_diameter(&self, cell: &RodCell) -> f64 {
        self.diameter(cell.axial_plastic.exp())
    }

    fn flow(&self, cell: &mut RodCell, elapsed: f64) {
        let trial = cell.stress;
        let (start, trial_stress) = (self.flow_state(cell), self.trial(trial, elapsed));
        let increment = cell
            .yield_point
            .plastic_increment(&*self.strength, &start, &trial_stress);
        self.take(cell, trial, increment, elapsed);
    }

    /// Takes an increment of plastic strain that returns a trial stress to the yield surface.
    #[inline(always)]
    fn take(&self, cell: &mut RodCell, trial: f64, increment: f64, elapsed: f64) {
        if increment == 0.0 {
            return;
        }
        cell.plastic_step = increment.copysign(trial);
        cell.stress = trial - self.modulus * cell.plastic_step;
        cell.axial_plastic += cell.plastic_step;
        cell.plastic_strain += increment;
        let mean = 0.5 * (cell.stress_before + cell.stress).abs();
        cell.temperature += self.heating * mean * increment;
        if elapsed > 0.0 {
            cell.strain_rate = cell.strain_rate.max(increment / elapsed);
        }
    }

    /// Takes a new length as if nothing flowed; gives the plastic strain of the last step.
    #[inline(always)]
    fn stretch(&self, cell: &mut RodCell, length: f64) -> f64 {
        let step = 2.0 * (cell.length - length) / (cell.length + length);
        cell.length = length;
        cell.strain += step;
        cell.stress_before = cell.stress;
        cell.stress += self.modulus * step;
        std::mem::take(&mut cell.plastic_step)
    }

    /// Completes a load once what flows has flowed.
    #[inline(always)]
    fn settle(&self, cell: &mut RodCell, plastic_before: f64, approach: f64) {
        cell.plastic_work +=
            0.5 * cell.volume * cell.stress_before * (plastic_before + cell.plastic_step);
        cell.viscous_pressure =
            viscosity::viscous_pressure(self.viscosity, self.density, self.wave_speed, approach);
    }
}

/// Loads cells, those that flow eight at a time.
struct LoadTogether<'a> {
    rod: &'a RodLaw,
    cells: &'a mut [RodCell],
    moving: &'a [(usize, Motion)],
}

/// A cell that flows: its number, how it moves and the plastic strain of the last step.
#[derive(Debug, Clone, Copy)]
struct FlowingCell {
    cell: usize,
    motion: Motion,
    plastic_before: f64,
}

impl LawVisitor<f64> for LoadTogether<'_> {
    type Output = ();

    #[inline(always)]
    fn visit<L>(self, law: &L)
    where
        L: PerLane + Copy + Default,
        L::One: LaneStrength,
    {
        let Self { rod, cells, moving } = self;
        let (mut flowing, mut count) = ([None; LANES], 0);
        for (i, motion) in moving {
            let cell = &mut cells[*i];
            let plastic_before = rod.stretch(cell, motion.length);
            if cell.yield_point.holds(cell.stress.abs()) {
                rod.settle(cell, plastic_before, motion.approach);
                continue;
            }
            flowing[count] = Some(FlowingCell {
                cell: *i,
                motion: *motion,
                plastic_before,
            });
            count += 1;
            if count == LANES {
                rod.flow_together(law, cells, &flowing);
                (flowing, count) = ([None; LANES], 0);
            }
        }
        if count > 0 {
            rod.flow_together(law, cells, &flowing);
        }
    }
}

impl RodLaw {
    /// Lets cells flow side by side, by the equations of [`RodLaw::flow`], and completes their load.
    #[inline(always)]
    fn flow_together<L>(
        &self,
        law: &L,
        cells: &mut [RodCell],
        flowing: &[Option<FlowingCell>; LANES],
    ) where
        L: PerLane + Copy + Default,
        L::One: LaneStrength,
    {
        let mut points = YieldPoint::<Lanes>::default();
        let mut trial = LaneTrial::<Lanes>::default();
        let mut places = Lanes::all(0.0);
        for (l, own) in flowing.iter().enumerate() {
            // A lane without a cell repeats the first one; its result is not used.
            let Some(FlowingCell { cell, motion, .. }) = own.as_ref().or(flowing[0].as_ref())
            else {
                continue;
            };
            let (cell, elapsed) = (&cells[*cell], motion.since_load);
            points.set_lane(l, cell.yield_point);
            let one = LaneTrial::new(&self.flow_state(cell), &self.trial(cell.stress, elapsed));
            trial.set_lane(l, one);
            places[l] = f64::from(u8::from(own.is_some()));
        }
        let increments = plastic_increments(law, &mut points, &trial, &places);
        for (l, flowing) in flowing.iter().enumerate() {
            let Some(flowing) = flowing else {
                continue;
            };
            let cell = &mut cells[flowing.cell];
            cell.yield_point = points.lane(l);
            let motion = &flowing.motion;
            self.take(cell, cell.stress, increments[l], motion.since_load);
            self.settle(cell, flowing.plastic_before, motion.approach);
        }
    }

    /// A trial stress beyond the yield surface.
    #[inline(always)]
    fn trial(&self, stress: f64, elapsed: f64) -> Trial {
        Trial {
            stress: stress.abs(),
            modulus: self.modulus,
            pressure_fall: self.modulus.copysign(stress) / 3.0,
            elapsed: self.rate_effects.then_some(elapsed),
        }
    }
}

impl Law for RodLaw {
    type Cell = RodCell;
    const STORED_ACROSS_STEPS: bool = true;

    fn cell(&self, back: f64, front: f64) -> RodCell {
        let length = front - back;
        let mut cell = RodCell {
            initial_position: 0.5 * (back + front),
            volume: self.area * length,
            rest_length: length,
            length,
            strain: 0.0,
            stress: 0.0,
            stress_before: 0.0,
            viscous_pressure: 0.0,
            axial_plastic: 0.0,
            plastic_strain: 0.0,
            plastic_step: 0.0,
            strain_rate: 0.0,
            temperature: self.start_temperature,
            yield_point: YieldPoint::default(),
            plastic_work: 0.0,
            viscous_work: 0.0,
        };
        cell.yield_point = YieldPoint::slow(&*self.strength, &self.flow_state(&cell));
        cell
    }

    /// `Δσ = E (Δε − Δε_p)` with the shortening over the mean length as Δε.
    ///
    /// The plastic work that belongs to a stress is that stress times half the plastic strain before it and half the one
    /// after it: with that, elastic, plastic and kinetic energy add up exactly for a constant step.
    #[inline(always)]
    fn load(&self, cell: &mut RodCell, motion: Motion) {
        let plastic_before = self.stretch(cell, motion.length);
        if !cell.yield_point.holds(cell.stress.abs()) {
            self.flow(cell, motion.since_load);
        }
        self.settle(cell, plastic_before, motion.approach);
    }

    fn load_all(&self, cells: &mut [RodCell], moving: &[(usize, Motion)]) {
        match self.strength.in_lanes() {
            Some(law) => law.visit(LoadTogether {
                rod: self,
                cells,
                moving,
            }),
            None => {
                for (i, motion) in moving {
                    self.load(&mut cells[*i], *motion);
                }
            }
        }
    }

    fn force(&self, cell: &RodCell) -> f64 {
        (cell.stress + cell.viscous_pressure) * cell.volume / cell.length
    }

    fn finish(&self, cell: &mut RodCell, _: f64, shortening: f64) -> bool {
        if cell.viscous_pressure != 0.0 {
            let force = cell.viscous_pressure * cell.volume / cell.length;
            cell.viscous_work += force * shortening;
        }
        true
    }

    fn stable_step(&self, cell: &RodCell, length: f64, approach: f64) -> f64 {
        // The force grows faster than the stress as the area grows: the tangent is E + σ.
        let stiffness = 1.0 + (cell.stress / self.modulus).max(0.0);
        let speed = self.wave_speed * (1.0 + 0.5 * (stiffness - 1.0));
        viscosity::stable_step(self.viscosity, length, speed, approach)
    }

    fn allows(&self, cell: &RodCell, length: f64, step: f64) -> bool {
        let stiffness = self.modulus + 0.5 * cell.stress.max(0.0);
        self.viscosity.is_none() && length * self.modulus > step * self.wave_speed * stiffness
    }

    fn stored(&self, cell: &RodCell) -> Stored {
        Stored {
            elastic: cell.volume * cell.stress_before * cell.stress / (2.0 * self.modulus),
            plastic: cell.plastic_work,
            viscous: cell.viscous_work,
        }
    }

    fn view(&self, cell: &RodCell) -> View {
        View {
            initial_position: cell.initial_position,
            stress: cell.stress,
            strain: cell.strain,
            plastic_strain: cell.plastic_strain,
            strain_rate: cell.strain_rate,
            temperature: cell.temperature,
            diameter: self.diameter(cell.strain.exp()),
        }
    }

    fn is_settled(&self, cell: &RodCell) -> bool {
        cell.plastic_step == 0.0
            && cell.viscous_pressure == 0.0
            && cell.stress == cell.stress_before
    }

    fn axial_stress(&self, cell: &RodCell) -> f64 {
        cell.stress
    }
}
