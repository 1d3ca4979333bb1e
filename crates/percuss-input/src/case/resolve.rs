//! The scenario of a case: materials looked up, what is given indirectly worked out.

use super::Case;
use crate::{
    chain,
    check::{Check, limits, limits::MAX_ELEMENTS},
    history::GaugePlace,
    material::{Library, MaterialEntry},
    options::{ChainOptions, Scheme},
    problem::{Experiment, Gauge, Layer, Nose, RearFaceCondition, Thickness, Uncertainty},
    scenario::{
        Given, Measurement, Plate, PlateEdge, Rod, Scenario, TargetBody, modelled_thickness,
    },
    units::{Length, Mass, Quantity, Temperature, Time, Velocity},
};

/// Materials of the user that an error lists at most.
const MOST_OWN: usize = 6;

/// Looks up materials and works out what is given indirectly; diagnostics go to `check`.
pub(super) fn resolve(
    name: &str,
    case: Case,
    library: &Library,
    check: &mut Check<'_>,
) -> Option<Scenario> {
    let projectile = resolve_rod(&case, library, check);
    let target = resolve_target(&case, library, check);
    let options = case.model_options();
    let given = Given {
        rear_face: case.target.back_face.is_some(),
        target_resistance: options.chain.target_resistance.is_some(),
    };
    let mut scenario = Scenario {
        name: name.to_owned(),
        title: case.title,
        sources: case.sources,
        projectile: projectile?,
        impact_velocity: case.projectile.impact_velocity.si(),
        obliquity: case.projectile.obliquity(),
        target: target?,
        resistance: None,
        resistance_reason: None,
        options,
        gauges: Vec::new(),
        history_interval: case.history.interval.map(Time::si),
        extensions: case.extensions,
        experiments: case.experiments.iter().filter_map(measurement).collect(),
        // They come from files, which the caller reads.
        measured_curves: Vec::new(),
        given,
    };
    let chain = &mut scenario.options.chain;
    if chain.projectile_elements.is_none() && chain.scheme == Scheme::Conservative {
        scenario.options.chain.projectile_elements = long_projectile_elements(&scenario);
    }
    let chain = &mut scenario.options.chain;
    if chain.target_elements.is_none() && chain.scheme == Scheme::Conservative {
        scenario.options.chain.target_elements = thin_target_elements(&scenario);
    }
    chain::choose_target_resistance(&mut scenario);
    scenario.gauges = gauges(&case.gauges, &scenario, check);
    Some(scenario)
}

/// Gauges, of which each that moves with the material lies in a body.
fn gauges(gauges: &[Gauge], scenario: &Scenario, check: &mut Check<'_>) -> Vec<GaugePlace> {
    let behind = -scenario.projectile.length;
    let ahead = match &scenario.target {
        TargetBody::Layers { layers, .. } => layers
            .iter()
            .map(|plate| plate.gap + modelled_thickness(plate, scenario))
            .sum(),
        _ => 0.0,
    };
    for (i, gauge) in gauges.iter().enumerate() {
        if !gauge.fixed && !(behind..=ahead).contains(&gauge.position.si()) {
            check.fail(
                &format!("gauges.{i}.position"),
                format!("{} lies in no body", gauge.position),
                format!(
                    "allowed: {} (rear end of the projectile) to {} (end of the modelled target); `fixed = true` is for places beside them",
                    Length::new(behind),
                    Length::new(ahead)
                ),
            );
        }
    }
    let place = |(i, gauge): (usize, &Gauge)| GaugePlace {
        name: gauge.name(i),
        position: gauge.position.si(),
        fixed: gauge.fixed,
    };
    gauges.iter().enumerate().map(place).collect()
}

/// Elements along a rod so long that those of the default number would be longer than half its diameter: what erodes at a time is one element.
fn long_projectile_elements(scenario: &Scenario) -> Option<u32> {
    let rod = &scenario.projectile;
    let elements = (rod.length / (ChainOptions::LONGEST_ELEMENT * rod.diameter)).ceil();
    let is_long = elements > f64::from(ChainOptions::PROJECTILE_ELEMENTS);
    is_long.then_some(elements.min(f64::from(MAX_ELEMENTS)) as u32)
}

/// Elements through a target so thin that the default number would make them far shorter than the projectile's: a fourth of
/// that length is short enough. The shortest element sets the time step of all.
fn thin_target_elements(scenario: &Scenario) -> Option<u32> {
    const ENOUGH: f64 = 24.0;
    let shortest =
        0.25 * scenario.projectile.length / scenario.options.chain.projectile_elements() as f64;
    let elements = (scenario.target_thickness()? / shortest).ceil().max(ENOUGH);
    (elements < scenario.options.chain.target_elements() as f64).then_some(elements as u32)
}

fn measurement(experiment: &Experiment) -> Option<Measurement> {
    let (quantity, value) = experiment.measured()?;
    Some(Measurement {
        quantity,
        impact_velocity: experiment.impact_velocity.map(Velocity::si),
        value,
        uncertainty: experiment.uncertainty.map(Uncertainty::si),
        sources: experiment.source.0.clone(),
        note: experiment.note.clone(),
    })
}

fn look_up<'a>(
    library: &'a Library,
    name: &str,
    table: &str,
    check: &mut Check<'_>,
) -> Option<&'a MaterialEntry> {
    let found = library.find(name);
    if found.is_none() {
        let near = library.suggestion(name);
        let own = match own_ids(library).as_slice() {
            [] => "your own go under `[materials.NAME]`".to_owned(),
            ids => format!("your own: {}", ids.join(", ")),
        };
        check.of_material().fail(
            &format!("{table}.material"),
            library.unknown(name),
            format!("{near}`percuss materials` lists all; {own}"),
        );
    }
    found
}

/// Ids of the first few materials that the program does not ship: those of the case and of the files that it names.
fn own_ids(library: &Library) -> Vec<String> {
    let of_case = library.iter().filter(|entry| {
        let shipped = Library::built_in().find(&entry.id);
        shipped.is_none_or(|shipped| shipped.origin != entry.origin)
    });
    of_case
        .take(MOST_OWN)
        .map(|entry| format!("`{}`", entry.id))
        .collect()
}

fn resolve_rod(case: &Case, library: &Library, check: &mut Check<'_>) -> Option<Rod> {
    let entry = look_up(library, &case.projectile.material, "projectile", check)?;
    let (length, mass) = case
        .projectile
        .length_and_mass(entry.material.density.si())?;
    let diameter = case.projectile.diameter.si();
    let nose = case.projectile.nose();
    let given = if case.projectile.length.is_some() {
        "length"
    } else {
        "mass"
    };
    let key = format!("projectile.{given}");
    if length <= nose.length(diameter) && nose != Nose::Flat {
        check.fail(
            &key,
            format!(
                "the projectile has no shank behind its {} nose",
                nose.name()
            ),
            format!(
                "the nose alone is {} long; give more than that, or a mass above {}",
                Length::new(nose.length(diameter)),
                Mass::new(entry.material.density.si() * nose.volume(diameter))
            ),
        );
        return None;
    }
    let temperature = case.projectile.temperature;
    if is_molten(temperature, entry, "projectile.temperature", check) {
        return None;
    }
    let (derived, [value, min, max], is_allowed) = if given == "length" {
        let limits = limits::MASS;
        let words = [mass, limits.min, limits.max].map(|kg| Mass::new(kg).to_string());
        ("mass", words, limits.allow(mass))
    } else {
        let limits = limits::LENGTH;
        let words = [length, limits.min, limits.max].map(|m| Length::new(m).to_string());
        ("length", words, limits.allow(length))
    };
    if !is_allowed {
        check.fail(
            &key,
            format!("the {given} gives a {derived} of {value}, which is out of range"),
            format!(
                "allowed: {min} to {max}; check the units of length, mass, diameter and density"
            ),
        );
        return None;
    }
    Some(Rod {
        material: entry.material.clone(),
        material_id: entry.id.clone(),
        length,
        mass,
        diameter,
        nose,
        temperature: temperature.map(Quantity::si),
    })
}

/// Whether a body would start at or above its melting point, which is reported at the key of its temperature.
fn is_molten(
    temperature: Option<Temperature>,
    entry: &MaterialEntry,
    key: &str,
    check: &mut Check<'_>,
) -> bool {
    let (Some(temperature), Some(melting)) = (temperature, entry.material.melting_temperature)
    else {
        return false;
    };
    let molten = temperature.si() >= melting.si();
    if molten {
        check.fail(
            key,
            format!("{temperature} is at or above the melting temperature"),
            format!("the material `{}` melts at {melting}", entry.id),
        );
    }
    molten
}

fn resolve_target(case: &Case, library: &Library, check: &mut Check<'_>) -> Option<TargetBody> {
    let target = &case.target;
    if target.rigid_wall {
        return Some(TargetBody::RigidWall);
    }
    if let Some(pressure) = target.constant_pressure {
        return Some(TargetBody::ConstantPressure(pressure.si()));
    }
    let written = target.layers_with_keys();
    let semi_infinite = written
        .last()
        .is_some_and(|(_, layer)| layer.thickness == Thickness::SemiInfinite);
    let layers: Option<Vec<Plate>> = written
        .iter()
        .map(|(key, layer): &(String, Layer)| {
            let entry = look_up(library, &layer.material, key, check)?;
            let (temperature, table) = match layer.temperature {
                None => (target.temperature, "target"),
                own => (own, key.as_str()),
            };
            if is_molten(temperature, entry, &format!("{table}.temperature"), check) {
                return None;
            }
            Some(Plate {
                material: entry.material.clone(),
                material_id: entry.id.clone(),
                thickness: match layer.thickness {
                    Thickness::Finite(thickness) => Some(thickness.si()),
                    Thickness::SemiInfinite => None,
                },
                gap: layer.gap.map_or(0.0, Length::si),
                interface: layer.interface.unwrap_or_default(),
                column_diameter: layer.column_diameter.map(Length::si),
                temperature: temperature.map(Quantity::si),
            })
        })
        .collect();
    let natural = if semi_infinite {
        RearFaceCondition::NonReflecting
    } else {
        RearFaceCondition::Fixed
    };
    let column_diameter = target
        .column_diameter
        .map_or(case.projectile.diameter.si(), Length::si);
    if let Some(diameter) = target.plate_diameter
        && diameter.si() <= 2.0 * column_diameter
    {
        check.fail(
            "target.plate_diameter",
            format!("{diameter} leaves no plate around what is struck"),
            format!(
                "give more than twice the diameter of what is struck, {}",
                Length::new(column_diameter)
            ),
        );
        return None;
    }
    Some(TargetBody::Layers {
        layers: layers?,
        back_face: target.back_face.unwrap_or(natural),
        column_diameter: target
            .column_diameter
            .map_or(case.projectile.diameter.si(), Length::si),
        separate_layers: target.has_separate_layers(),
        edge: target.plate_diameter.map(|diameter| PlateEdge {
            diameter: diameter.si(),
            support: target.support.unwrap_or_default(),
        }),
    })
}
