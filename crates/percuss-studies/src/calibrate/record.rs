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
        let from = problem
            .observations
            .iter()
            .find_map(|o| o.template.material(id, &changes).transpose());
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
    for source in problem.training().flat_map(|o| &o.sources) {
        if !sources.contains(source) {
            sources.push(source.clone());
        }
    }
    let tests: Vec<String> = problem.training().map(|o| o.id.clone()).collect();
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
    let note = format!(
        "Calibrated from {} of {} with the model `{}`{corrected} (percuss {}, seed {}): {}. RMS relative error {:.1} %.{determined} \
         The other constants are those of `{id}`{others}",
        counted(tests.len()),
        sources.join(", "),
        calibration.model,
        calibration.percuss_version,
        calibration.seed,
        values.join(", "),
        100.0 * calibration.training.rms,
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
        name: format!("{}, calibrated", material.name),
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

fn counted(values: usize) -> String {
    match values {
        1 => "1 measured value".to_owned(),
        _ => format!("{values} measured values"),
    }
}
