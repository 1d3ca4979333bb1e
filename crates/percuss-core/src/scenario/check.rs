//! Ranges of a scenario: what a program changed in it is checked as what a file says.

use super::{Scenario, TargetBody};
use crate::{
    check::{Check, Diagnostic, limits},
    error::Error,
    problem::{Layer, LayerInterface, Projectile, Target, Thickness},
    units::{Angle, Length, Mass, Pressure, Temperature, Velocity},
};

impl Scenario {
    /// Checks bodies, materials and impact velocity as those of a case file are, and the ranges of options. A case that was read has passed;
    /// the function `run` asks again, because its fields are public.
    ///
    /// # Errors
    /// [`Error::Input`] with the key of the first value that is not allowed, the allowed range and a remedy.
    pub fn check(&self) -> Result<(), Error> {
        let first = self.faults().into_iter().next();
        first.map_or(Ok(()), |first| Err(first.in_no_file(&self.name).into()))
    }

    /// All that [`Self::check`] finds.
    pub(crate) fn faults(&self) -> Vec<Diagnostic> {
        let mut found = Vec::new();
        let check = &mut Check::new(&mut found);
        let (rod, target) = (self.projectile_as_written(), self.target_as_written());
        rod.check(&mut check.within("projectile"));
        let mass = Mass::new(self.projectile.mass);
        check
            .within("projectile")
            .quantity("mass", mass, limits::MASS);
        target.check(&mut check.within("target"));
        // What reads a case and what studies it give options that have no effect on some targets: only a file may not.
        let mut of_options = Vec::new();
        let options = &mut Check::new(&mut of_options);
        self.options.check(options, &target);
        of_options.retain(|diagnostic: &Diagnostic| diagnostic.out_of_range);
        let layers = self.layers().iter();
        let own = (&self.projectile.material, &self.projectile.material_id);
        for (material, id) in
            std::iter::once(own).chain(layers.map(|layer| (&layer.material, &layer.material_id)))
        {
            material.check(&mut check.within("materials").within(id));
        }
        found.extend(of_options);
        found
    }

    fn projectile_as_written(&self) -> Projectile {
        let rod = &self.projectile;
        let [length, diameter] = [rod.length, rod.diameter].map(Length::new);
        let speed = Velocity::new(self.impact_velocity);
        Projectile {
            obliquity: (self.obliquity != 0.0).then(|| Angle::new(self.obliquity)),
            temperature: rod.temperature.map(Temperature::new),
            ..Projectile::rod(rod.material_id.clone(), length, diameter, speed).with_nose(rod.nose)
        }
    }

    fn target_as_written(&self) -> Target {
        let (layers, back_face, edge) = match &self.target {
            TargetBody::RigidWall => return Target::rigid_wall(),
            TargetBody::ConstantPressure(pressure) => {
                return Target::constant_pressure(Pressure::new(*pressure));
            }
            TargetBody::Layers {
                layers,
                back_face,
                edge,
                ..
            } => (layers, back_face, edge),
        };
        let is_finite = layers.last().is_some_and(|last| last.thickness.is_some());
        let written = layers.iter().enumerate().map(|(i, plate)| {
            let thickness = plate.thickness.map(Length::new);
            let thickness = thickness.map_or(Thickness::SemiInfinite, Thickness::Finite);
            let is_bonded = plate.interface == LayerInterface::Bonded;
            Layer {
                gap: (i > 0 || plate.gap != 0.0).then(|| Length::new(plate.gap)),
                interface: is_bonded.then_some(LayerInterface::Bonded),
                column_diameter: plate.column_diameter.map(Length::new),
                temperature: plate.temperature.map(Temperature::new),
                ..Layer::new(plate.material_id.clone(), thickness)
            }
        });
        Target {
            back_face: is_finite.then_some(*back_face),
            plate_diameter: edge.map(|edge| Length::new(edge.diameter)),
            support: edge.map(|edge| edge.support),
            ..Target::layers(written)
        }
    }
}
