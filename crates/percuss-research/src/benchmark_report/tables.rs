//! Tables of a compared.

use percuss::{
    model_error::{Verdict, contenders},
    units::significant,
};
use percuss_report::page::Table;

use super::Benchmark;
use crate::{
    benchmark::{self, CheckedReference, Errors, Grouping, pair_name},
    paper_case::{self, Study, ablation::Line},
};

/// A relative error in per cent with its sign.
pub(super) fn signed(error: f64) -> String {
    match (100.0 * error).round() {
        0.0 => "0".to_owned(),
        percent => format!("{percent:+.0}").replace('-', "\u{2212}"),
    }
}

const ERRORS: [&str; 6] = [
    "#n",
    "#median [%]",
    "#10 % below [%]",
    "#10 % above [%]",
    "#median magnitude [%]",
    "#within 25 % [%]",
];

fn errors(errors: &Errors) -> Vec<String> {
    vec![
        errors.count.to_string(),
        signed(errors.median),
        signed(errors.low),
        signed(errors.high),
        format!("{:.0}", 100.0 * errors.median_absolute),
        format!("{:.0}", 100.0 * errors.within_25_percent),
    ]
}

/// One row a contender and group; the groups together, for the contenders to be compared.
pub(super) fn groups(verdicts: &[Verdict], grouping: Grouping) -> Table {
    let groups = benchmark::statistics(verdicts, grouping);
    if grouping == Grouping::All {
        let mut table = Table::new(&[&["contender"], ERRORS.as_slice()].concat());
        for group in &groups {
            let mut row = vec![group.contender.to_owned()];
            row.extend(errors(&group.errors));
            table.rows.push(row);
        }
        return table;
    }
    let head = [&[grouping.in_words(), "contender"], ERRORS.as_slice()].concat();
    let mut table = Table::new(&head);
    for value in grouping.values() {
        let mut name = value.clone();
        for group in groups.iter().filter(|group| group.value == value) {
            let mut row = vec![std::mem::take(&mut name), group.contender.to_owned()];
            row.extend(errors(&group.errors));
            table.rows.push(row);
        }
    }
    table
}

/// The paper's case by one-dimensional variants, a column of depth and error a speed.
pub(super) fn ablation(lines: &[Line]) -> Table {
    let mut table = Table::new(&["variant", "what is new"]);
    for speed in paper_case::SPEEDS {
        table.head.push(format!("#depth at {speed} m/s [mm]"));
        table.head.push("#error [%]".to_owned());
    }
    let mut names: Vec<(&str, &str)> = Vec::new();
    for line in lines {
        if !names.contains(&(line.variant, line.change)) {
            names.push((line.variant, line.change));
        }
    }
    for (name, change) in names {
        let mut row = vec![name.to_owned(), change.to_owned()];
        for &speed in paper_case::SPEEDS {
            let line = lines
                .iter()
                .find(|line| line.variant == name && line.impact_velocity_m_s == speed);
            row.push(line.map_or_else(String::new, |line| {
                significant(line.depth_of_penetration_mm, 3)
            }));
            row.push(
                line.and_then(|line| line.error)
                    .map_or_else(String::new, signed),
            );
        }
        table.rows.push(row);
    }
    table
}

/// The paper's case by the reference, on its meshes and in its targets.
pub(super) fn study(rows: &[Study]) -> Table {
    let mut table = Table::new(&[
        "#speed [m/s]",
        "#cells per radius",
        "#target radius [mm]",
        "#depth [mm]",
        "#particles",
        "#energy residual [%]",
    ]);
    let mut rows: Vec<&Study> = rows.iter().collect();
    rows.sort_by(|a, b| {
        let place = |row: &Study| (row.impact_velocity_m_s, row.target_radius_mm);
        let (a_place, b_place) = (place(a), place(b));
        a_place
            .0
            .total_cmp(&b_place.0)
            .then(a_place.1.total_cmp(&b_place.1))
            .then(a.cells_per_radius.cmp(&b.cells_per_radius))
    });
    for row in rows {
        table.rows.push(vec![
            significant(row.impact_velocity_m_s, 4),
            row.cells_per_radius.to_string(),
            significant(row.target_radius_mm, 4),
            significant(row.depth_of_penetration_mm, 4),
            row.particles.to_string(),
            format!("{:.2}", 100.0 * row.energy_residual),
        ]);
    }
    table
}

/// Every shot: its reference on all meshes, extrapolated, and the depth of every contender with its error.
pub(super) fn every_shot(compared: &Benchmark) -> Table {
    let mut table = Table::new(&[
        "materials",
        "#L/D",
        "#speed [m/s]",
        "#on meshes [mm]",
        "#reference [mm]",
    ]);
    let contenders = contenders();
    table
        .head
        .extend(contenders.iter().map(|c| format!("#{} [mm] (%)", c.name)));
    for entry in &compared.references {
        let shot = &entry.shot;
        let reference = match &entry.estimate {
            Ok(estimate) => format!(
                "{} ± {}",
                significant(estimate.depth_mm, 4),
                significant(estimate.uncertainty_mm, 2)
            ),
            Err(refusal) => format!("refused: {}", refusal.in_words()),
        };
        let mut row = shot_columns(entry);
        row.push(reference);
        let own: Vec<&Verdict> = compared
            .verdicts
            .iter()
            .filter(|verdict| shot.is_of(verdict))
            .collect();
        row.extend(contenders.iter().map(|contender| {
            own.iter()
                .find(|verdict| verdict.contender == contender.name)
                .map_or_else(
                    || "\u{2013}".to_owned(),
                    |verdict| {
                        let depth = significant(verdict.depth_of_penetration_mm, 3);
                        format!("{depth} ({})", signed(verdict.error()))
                    },
                )
        }));
        table.rows.push(row);
    }
    table
}

/// Materials, L/D, velocity and the depths on all meshes of a shot.
fn shot_columns(entry: &CheckedReference) -> Vec<String> {
    let shot = &entry.shot;
    let meshes: Vec<String> = entry
        .meshes
        .iter()
        .map(|mesh| format!("{}: {}", mesh.cells, significant(mesh.value, 4)))
        .collect();
    vec![
        pair_name(&shot.projectile, &shot.target),
        shot.length_to_diameter.to_string(),
        shot.speed.to_string(),
        meshes.join(", "),
    ]
}

/// The shots whose reference fails its check, each with the reason.
pub(super) fn refused(references: &[CheckedReference]) -> Table {
    let mut table = Table::new(&[
        "materials",
        "#L/D",
        "#speed [m/s]",
        "#on meshes [mm]",
        "refused because",
    ]);
    for entry in references {
        if let Err(refusal) = &entry.estimate {
            let mut row = shot_columns(entry);
            row.push(refusal.in_words());
            table.rows.push(row);
        }
    }
    table
}
