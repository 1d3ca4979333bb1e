//! Columns of histories: name, unit, description and value of each.

use std::mem::offset_of;

use super::{ElementState, Sample};
use crate::units::ResultUnit as Unit;

/// A number in every row of a history, where `R` is the type of a row.
#[derive(Debug)]
pub struct HistoryColumn<R> {
    /// Its name without a unit.
    pub quantity: &'static str,
    /// Its unit.
    pub unit: Unit,
    /// What it is, in a sentence.
    pub description: &'static str,
    /// Reads it in SI units.
    pub read: Read<R>,
    /// Where it lies in a row, in bytes.
    pub offset: usize,
}

/// How a column reads a row.
#[derive(Debug)]
pub enum Read<R> {
    /// A number in SI units.
    Number(fn(&R) -> f64),
    /// A whole number of 64 bits.
    Whole(fn(&R) -> u64),
    /// A whole number of the size of a pointer.
    Size(fn(&R) -> usize),
}

impl<R> HistoryColumn<R> {
    /// Its name in files and in Python, which ends with its unit.
    pub fn name(&self) -> String {
        format!("{}{}", self.quantity, self.unit.suffix)
    }

    /// Its name in SI units.
    pub fn si_name(&self) -> String {
        format!("{}{}", self.quantity, self.unit.si_suffix)
    }
}

macro_rules! columns {
    ($row:ty: $($name:literal $unit:ident $read:ident $($field:ident).+, $description:literal;)+) => {
        &[$( HistoryColumn {
            quantity: $name,
            unit: Unit::$unit,
            description: $description,
            read: Read::$read(|row| row.$($field).+),
            offset: offset_of!($row, $($field).+),
        } ),+]
    };
}

/// Columns of a history.
pub static SAMPLE_COLUMNS: &[HistoryColumn<Sample>] = columns! { Sample:
    "time" US Number time, "Time.";
    "step" NONE Whole step, "Time step number.";
    "tip_velocity" M_S Number tip_velocity, "Velocity of the projectile's front end.";
    "tail_velocity" M_S Number tail_velocity, "Velocity of the projectile's rear end.";
    "interface_velocity" M_S Number interface_velocity, "Velocity of the crater floor; not a number on a rigid wall.";
    "back_velocity" M_S Number back_velocity, "Velocity of the target's rear face; not a number where there is none.";
    "mean_velocity" M_S Number mean_velocity, "Mean velocity of the projectile.";
    "tip_position" MM Number tip_position, "Position of the projectile's front end below the original face.";
    "depth" MM Number depth, "Position of the crater floor below the original face.";
    "projectile_length" MM Number projectile_length, "Current length of the projectile.";
    "contact_force" KN Number contact_force, "Force between projectile and target.";
    "back_force" KN Number back_force, "Force on the rear face; not a number where there is none.";
    "crack_length" MM Number crack_length, "Length of a straight crack that takes as many bonds as are broken; 0 from a model without cracks.";
    "crack_reach" MM Number crack_reach, "Largest distance of a broken bond from the tip of its notch, or from the point of impact; 0 from a model without cracks.";
    "energy_initial" J Number energy.initial, "Kinetic energy at the start.";
    "energy_kinetic_projectile" J Number energy.kinetic_projectile, "Kinetic energy of the projectile.";
    "energy_kinetic_target" J Number energy.kinetic_target, "Kinetic energy of the target.";
    "energy_elastic_projectile" J Number energy.elastic_projectile, "Elastic energy of the projectile.";
    "energy_elastic_target" J Number energy.elastic_target, "Elastic energy of the target.";
    "energy_plastic_projectile" J Number energy.plastic_projectile, "Plastic work in the projectile.";
    "energy_plastic_target" J Number energy.plastic_target, "Plastic work in the target.";
    "energy_border_shear" J Number energy.border_shear, "Work against border shear, a shear band, or a constant pressure.";
    "energy_viscosity_and_damping" J Number energy.viscous, "Work against artificial viscosity and damping.";
    "energy_contact" J Number energy.contact, "Loss where free ends meet; it vanishes with the element mass.";
    "energy_through_rear_face" J Number energy.boundary, "Energy that left through a non-reflecting rear face, or through the edge of the modelled target.";
    "energy_eroded" J Number energy.eroded, "Energy that eroded elements carried away.";
    "energy_fracture" J Number energy.fracture, "Fracture energy of cracks.";
    "energy_kinetic_plate" J Number energy.kinetic_plate, "Kinetic energy of the plate around a plug.";
    "energy_elastic_plate" J Number energy.elastic_plate, "Elastic energy of the plate around a plug.";
    "energy_plastic_plate" J Number energy.plastic_plate, "Plastic work of bending the plate around a plug.";
    "energy_particles_to_grid" J Number energy.transfer, "Loss between particles and grid; it vanishes with the cell size.";
    "energy_changes_of_the_time_step" J Number energy.step_changes, "Taken by changes of the time step; it vanishes with the square of the step.";
    "energy_stabilisation" J Number energy.stabilisation, "Energy of the forces that hold particles to the mean gradient of their deformation, stored and lost.";
    "momentum_initial" N_S Number momentum.initial, "Momentum at the start.";
    "momentum_projectile" N_S Number momentum.projectile, "Momentum of the projectile.";
    "momentum_target" N_S Number momentum.target, "Momentum of the target.";
    "momentum_support" N_S Number momentum.support, "Impulse on a fixed rear face, a wall or another support.";
    "momentum_border_shear" N_S Number momentum.border_shear, "Impulse of border shear, or of a constant pressure.";
    "momentum_eroded" N_S Number momentum.eroded, "Momentum that eroded elements carried away.";
    "momentum_local_damping" N_S Number momentum.damping, "Impulse of local damping.";
    "momentum_plate" N_S Number momentum.plate, "Momentum of the plate around a plug.";
};

/// Columns of a state along the axis; the time of the state stands apart.
pub static ELEMENT_COLUMNS: &[HistoryColumn<ElementState>] = columns! { ElementState:
    "part" NONE Size part, "Part: 0 is the projectile, 1 the first layer of the target.";
    "initial_position" MM Number initial_position, "Initial position of the element's middle below the original face.";
    "position" MM Number position, "Current position of the element's middle below the original face.";
    "displacement" MM Number displacement, "Displacement of the material since the start; not a number where cells stand for elements, other than at gauges.";
    "length" MM Number length, "Current length.";
    "stress" MPA Number stress, "Axial stress, compression positive.";
    "strain" NONE Number strain, "Axial strain, compression positive.";
    "plastic_strain" NONE Number plastic_strain, "Equivalent plastic strain.";
    "diameter" MM Number diameter, "Current diameter.";
    "temperature" K Number temperature, "Temperature.";
    "velocity" M_S Number velocity, "Axial velocity, into the target positive.";
};

#[cfg(test)]
mod tests {
    use super::{Read, SAMPLE_COLUMNS};
    use crate::{
        history::Sample,
        ledger::{EnergyLedger, MomentumLedger},
    };

    /// The lines of both balances, in their order and with their values.
    #[test]
    fn every_line_of_a_balance_is_a_column() {
        let mut sample: Sample = serde_json::from_value(zeros()).unwrap();
        let numbers = |sample: &Sample, start: &str| -> Vec<(String, f64)> {
            let of_balance = SAMPLE_COLUMNS
                .iter()
                .filter(|c| c.quantity.starts_with(start));
            let value = |read: &Read<Sample>| match read {
                Read::Number(read) => read(sample),
                _ => panic!("{start} is a whole number"),
            };
            of_balance
                .map(|c| (c.quantity.replace(start, ""), value(&c.read)))
                .collect()
        };
        sample.energy = counted::<EnergyLedger>();
        sample.momentum = counted::<MomentumLedger>();
        let words = |label: &str| label.replace(", ", "_").replace(' ', "_");
        let energy: Vec<_> = sample
            .energy
            .lines()
            .map(|(label, x)| (words(label), x))
            .into();
        assert_eq!(numbers(&sample, "energy_")[1..], energy);
        assert_eq!(numbers(&sample, "energy_")[0].0, "initial");
        let momentum: Vec<_> = sample
            .momentum
            .lines()
            .map(|(label, x)| (words(label), x))
            .into();
        assert_eq!(numbers(&sample, "momentum_")[1..], momentum);
    }

    /// A balance whose lines all differ.
    fn counted<B: Default + serde::Serialize + serde::de::DeserializeOwned>() -> B {
        let mut lines = serde_json::to_value(B::default()).unwrap();
        for (i, line) in lines.as_object_mut().unwrap().values_mut().enumerate() {
            *line = (i as f64 + 0.5).into();
        }
        serde_json::from_value(lines).unwrap()
    }

    fn zeros() -> serde_json::Value {
        let mut row = serde_json::Map::new();
        for column in SAMPLE_COLUMNS {
            row.insert(column.quantity.to_owned(), 0.into());
        }
        row.insert(
            "energy".to_owned(),
            serde_json::to_value(EnergyLedger::default()).unwrap(),
        );
        row.insert(
            "momentum".to_owned(),
            serde_json::to_value(MomentumLedger::default()).unwrap(),
        );
        row.into()
    }
}
