//! Tables of the benchmark report.

use percuss::{
    model_error::{Verdict, contenders},
    units::significant,
};
use percuss_report::table::{Rows, Table, number};

use super::BenchmarkResults;
use crate::{
    benchmark::{self, CheckedReference, Errors, Group, Grouping, Shot, pair_name},
    paper_case::{self, Study, ablation::Line},
};

/// A relative error in per cent with its sign.
pub fn signed(error: f64) -> String {
    match (100.0 * error).round() {
        0.0 => "0".to_owned(),
        percent => format!("{percent:+.0}"),
    }
}

/// Columns of errors, of which each row has some.
fn errors<R>(rows: Rows<'_, R>, of: impl Fn(&R) -> &Errors) -> Rows<'_, R> {
    rows.numbers("n", "", |row| of(row).count.to_string())
        .numbers("median", "%", |row| signed(of(row).median))
        .numbers("10 % below", "%", |row| signed(of(row).low))
        .numbers("10 % above", "%", |row| signed(of(row).high))
        .numbers("median magnitude", "%", |row| {
            format!("{:.0}", 100.0 * of(row).median_absolute)
        })
        .numbers("within 25 %", "%", |row| {
            format!("{:.0}", 100.0 * of(row).within_25_percent)
        })
}

/// One row a contender and group; the groups together, for the contenders to be compared.
pub(super) fn groups(verdicts: &[Verdict], grouping: Grouping) -> Table {
    let groups = benchmark::statistics(verdicts, grouping);
    let mut rows: Vec<(String, &Group)> = Vec::new();
    for value in grouping.values() {
        // The value stands in the first row of its group.
        let mut name = value.clone();
        let own = groups.iter().filter(|group| group.value == value);
        rows.extend(own.map(|group| (std::mem::take(&mut name), group)));
    }
    let rows = Table::of(&rows)
        .when(grouping != Grouping::All, |rows| {
            rows.words(grouping.in_words(), |(name, _)| name.clone())
        })
        .words("contender", |(_, group)| group.contender);
    errors(rows, |(_, group)| &group.errors).table()
}

/// The paper's case by one-dimensional variants, a column of depth and error a speed.
pub fn ablation(lines: &[Line]) -> Table {
    let mut variants: Vec<&Line> = Vec::new();
    for line in lines {
        if variants.iter().all(|known| known.variant != line.variant) {
            variants.push(line);
        }
    }
    Table::of(&variants)
        .words("variant", |line| line.variant)
        .words("what is new", |line| line.change)
        .each(paper_case::SPEEDS, |rows, speed| {
            let at = |line: &Line| {
                let is_own = |other: &&Line| {
                    other.variant == line.variant && other.impact_velocity_m_s == *speed
                };
                lines.iter().find(is_own)
            };
            rows.numbers(format!("depth at {speed} m/s"), "mm", |line| {
                number(at(line).map(|line| line.depth_of_penetration_mm), 3)
            })
            .numbers("error", "%", |line| {
                let error = at(line).and_then(|line| line.error);
                error.map_or_else(|| number(None, 0), signed)
            })
        })
        .table()
}

/// The paper's case by the reference, on its meshes and in its targets.
pub(super) fn study(rows: &[Study]) -> Table {
    let mut rows: Vec<&Study> = rows.iter().collect();
    rows.sort_by(|a, b| {
        let speeds = a.impact_velocity_m_s.total_cmp(&b.impact_velocity_m_s);
        let radii = a.target_radius_mm.total_cmp(&b.target_radius_mm);
        let cells = a.cells_per_radius.cmp(&b.cells_per_radius);
        speeds.then(radii).then(cells)
    });
    Table::of(&rows)
        .numbers("speed", "m/s", |row| {
            significant(row.impact_velocity_m_s, 4)
        })
        .numbers("cells per radius", "", |row| {
            row.cells_per_radius.to_string()
        })
        .numbers("target radius", "mm", |row| {
            significant(row.target_radius_mm, 4)
        })
        .numbers("depth", "mm", |row| {
            significant(row.depth_of_penetration_mm, 4)
        })
        .numbers("particles", "", |row| row.particles.to_string())
        .numbers("energy residual", "%", |row| {
            format!("{:.2}", 100.0 * row.energy_residual)
        })
        .table()
}

/// Every shot: its reference on all meshes, extrapolated, and the depth of every contender with its error.
pub(super) fn every_shot(compared: &BenchmarkResults) -> Table {
    let entries: Vec<&CheckedReference> = compared.references.iter().collect();
    shots(&entries)
        .numbers("reference", "mm", |entry| match &entry.estimate {
            Ok(estimate) => format!(
                "{} ± {}",
                significant(estimate.depth_mm, 4),
                significant(estimate.uncertainty_mm, 2)
            ),
            Err(refusal) => format!("refused: {}", refusal.in_words()),
        })
        .each(contenders(), |rows, contender| {
            let of = |shot: &Shot| {
                let is_own =
                    |verdict: &&Verdict| verdict.contender == contender.name && shot.is_of(verdict);
                compared.verdicts.iter().find(is_own)
            };
            rows.numbers(format!("{} [mm] (%)", contender.name), "", |entry| {
                of(&entry.shot).map_or_else(
                    || number(None, 0),
                    |verdict| {
                        let depth = significant(verdict.depth_of_penetration_mm, 3);
                        format!("{depth} ({})", signed(verdict.error()))
                    },
                )
            })
        })
        .table()
}

/// Materials, L/D, velocity and the depths on all meshes of shots.
fn shots<'a>(entries: &'a [&'a CheckedReference]) -> Rows<'a, &'a CheckedReference> {
    Table::of(entries)
        .words("materials", |entry| {
            pair_name(&entry.shot.projectile, &entry.shot.target)
        })
        .numbers("L/D", "", |entry| entry.shot.length_to_diameter.to_string())
        .numbers("speed", "m/s", |entry| entry.shot.speed.to_string())
        .numbers("on meshes", "mm", |entry| {
            let meshes = entry.meshes.iter();
            let meshes =
                meshes.map(|mesh| format!("{}: {}", mesh.cells, significant(mesh.value, 4)));
            meshes.collect::<Vec<_>>().join(", ")
        })
}

/// The shots whose reference fails its check, each with the reason.
pub(super) fn refused(references: &[CheckedReference]) -> Table {
    let refused: Vec<&CheckedReference> = references
        .iter()
        .filter(|entry| entry.estimate.is_err())
        .collect();
    shots(&refused)
        .words("refused because", |entry| match &entry.estimate {
            Err(refusal) => refusal.in_words(),
            Ok(_) => String::new(),
        })
        .table()
}
