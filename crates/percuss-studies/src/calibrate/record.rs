//! Calibrated materials as records that cases and the library take.

use toml::Value;

use super::{Calibration, Fitted, Problem};
use crate::{
    case::materials_toml,
    material::{Calibrated, Material, MaterialTable, Trust},
    units::significant,
};

/// Digits of a constant in a record: more than any fit is good for.
const DIGITS: usize = 6;

/// A material with calibrated constants.
#[derive(Debug, Clone, PartialEq)]
pub struct CalibratedRecord {
    /// Name of its table.
    pub id: String,
    /// The record.
    pub material: Material,
}

impl CalibratedRecord {
    /// The record as a file of materials, which `material_files` of a case and `--materials` of commands take; the same table under
    /// `[materials]` of a case does as well.
    pub fn toml(&self) -> String {
        let table = MaterialTable::from([(self.id.clone(), self.material.clone())]);
        materials_toml(&table)
    }
}

/// The materials of which constants were fitted, with the best values. `name` is the id of the new record, `-2` and so on added where
/// there are more; the old id with `-calibrated` when not given.
///
/// # Errors
/// What is wrong with a record: values can be possible one at a time and not together.
pub fn records(
    problem: &Problem,
    calibration: &Calibration,
    name: Option<&str>,
) -> Result<Vec<CalibratedRecord>, String> {
    let mut ids: Vec<&str> = Vec::new();
    for (id, _) in problem.fitted.iter().filter_map(Fitted::material) {
        if !ids.contains(&id) {
            ids.push(id);
        }
    }
    let record = |(i, id): (usize, &&str)| {
        let id = *id;
        let changes: Vec<(&str, Value)> = problem
            .fitted
            .iter()
            .zip(&calibration.parameters)
            .map(|(parameter, found)| {
                let rounded = significant(found.best, DIGITS).parse();
                parameter.change(rounded.unwrap_or(found.best))
            })
            .collect();
        let values = problem.observations.iter().map(|value| &value.template);
        let curves = problem.curve_sets.iter().map(|set| &set.template);
        let mut templates = values.chain(curves);
        let from = templates.find_map(|template| template.material(id, &changes).transpose());
        let material = match from {
            Some(Ok(material)) => material,
            Some(Err(findings)) => {
                let words: Vec<String> = findings.into_iter().map(|f| f.message).collect();
                return Err(words.join("; "));
            }
            None => return Err(format!("no material is named `{id}`")),
        };
        let suffix = if i == 0 {
            String::new()
        } else {
            format!("-{}", i + 1)
        };
        let new_id = match name {
            Some(name) => format!("{name}{suffix}"),
            None => format!("{id}-calibrated"),
        };
        Ok(CalibratedRecord {
            material: stamped(problem, calibration, id, material),
            id: new_id,
        })
    };
    ids.iter().enumerate().map(record).collect()
}

/// A record with what it was calibrated on.
fn stamped(problem: &Problem, calibration: &Calibration, id: &str, material: Material) -> Material {
    let mut sources: Vec<String> = Vec::new();
    let of_values = problem.training().map(|value| &value.sources);
    let of_curves = problem.training_curves().map(|curve| &curve.curve.sources);
    for source in of_values.chain(of_curves).flatten() {
        if !source.is_empty() && !sources.contains(source) {
            sources.push(source.clone());
        }
    }
    let values = problem.training().map(|value| value.id.clone());
    let curves = problem.training_curves().map(|curve| curve.id.clone());
    let (value_count, curve_count) = (
        problem.training().count(),
        problem.training_curves().count(),
    );
    let tests: Vec<String> = values.chain(curves).collect();
    let own = problem
        .fitted
        .iter()
        .zip(&calibration.parameters)
        .filter_map(|(parameter, found)| {
            let (of, key) = parameter.material()?;
            (of == id).then_some((key, found))
        });
    let mut values = Vec::new();
    let mut parameters = Vec::new();
    for (key, found) in own {
        let unit = match found.unit.as_str() {
            "" => String::new(),
            unit => format!(" {unit}"),
        };
        let range = found.posterior.map_or_else(String::new, |marginal| {
            let [low, _, high] = marginal.quantiles.map(|value| significant(value, 3));
            format!(" (95 %: {low} to {high})")
        });
        values.push(format!(
            "{key} = {}{unit}{range}",
            significant(found.best, 4)
        ));
        parameters.push(key.to_owned());
    }
    let others = match material.note.as_str() {
        "" => String::new(),
        note => format!(", of which is said: {note}"),
    };
    let determined = match calibration.findings.is_empty() {
        true => String::new(),
        false => {
            let words: Vec<&str> = calibration
                .findings
                .iter()
                .map(|f| f.words.as_str())
                .collect();
            format!(" Caution: {}.", words.join("; "))
        }
    };
    let corrected = match calibration.correction {
        Some(_) => ", corrected to axisymmetric answers",
        None => "",
    };
    let mut errors = String::new();
    if let Some(quality) = &calibration.training {
        errors += &format!(" RMS relative error {:.1} %.", 100.0 * quality.rms);
    }
    for curve in calibration.curves.iter().filter(|curve| !curve.held_out) {
        if let Some(part) = curve.best.and_then(|best| best.relative_rms_difference) {
            let (name, part) = (&curve.name, 100.0 * part);
            errors += &format!(" Relative RMS difference of the curve {name} {part:.1} %.");
        }
    }
    let of_sources = match sources.is_empty() {
        true => String::new(),
        false => format!(" of {}", sources.join(", ")),
    };
    let note = format!(
        "Calibrated from {}{of_sources} with the model `{}`{corrected} (percuss {}, seed {}): {}.{errors}{determined} \
         The other constants are those of `{id}`{others}",
        counted(value_count, curve_count),
        calibration.model,
        calibration.percuss_version,
        calibration.seed,
        values.join(", "),
    );
    let mut all = sources.clone();
    all.extend(
        material
            .sources
            .iter()
            .filter(|s| !sources.contains(s))
            .cloned(),
    );
    Material {
        name: match material.name.as_str() {
            "" => format!("{id}, calibrated"),
            name => format!("{name}, calibrated"),
        },
        recommended: false,
        trust: Trust::User,
        sources: all,
        note,
        calibrated: Some(Calibrated {
            parameters,
            from: id.to_owned(),
            model: calibration.model.to_owned(),
            sources,
            tests,
            percuss_version: calibration.percuss_version.to_owned(),
            seed: calibration.seed,
        }),
        ..material
    }
}

fn counted(values: usize, curves: usize) -> String {
    let some = |count: usize, what: &str| match count {
        0 => None,
        1 => Some(format!("1 measured {what}")),
        _ => Some(format!("{count} measured {what}s")),
    };
    let parts = [some(values, "value"), some(curves, "curve")];
    let parts: Vec<String> = parts.into_iter().flatten().collect();
    parts.join(" and ")
}
