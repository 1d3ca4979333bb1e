//! Tables of the benchmark report.

use percuss::{
    model_error::{self, Coverage, ErrorRecord, candidates},
    units::significant,
};
use percuss_report::table::{Rows, Table, number};

use super::BenchmarkResults;
use crate::{
    benchmark::{self, BenchmarkCase, CheckedReference, Errors, Group, Grouping, pair_name},
    paper_case::{self, PaperCaseRow, variants::VariantResult},
};

/// A relative error in per cent with its sign.
pub fn signed(error: f64) -> String {
    match (100.0 * error).round() {
        0.0 => "0".to_owned(),
        percent => format!("{percent:+.0}"),
    }
}

/// Columns of error statistics.
fn errors<R>(rows: Rows<'_, R>, of: impl Fn(&R) -> &Errors) -> Rows<'_, R> {
    rows.numbers("n", "", |row| of(row).count.to_string())
        .numbers("median", "%", |row| signed(of(row).median))
        .numbers("10th percentile", "%", |row| signed(of(row).low))
        .numbers("90th percentile", "%", |row| signed(of(row).high))
        .numbers("median absolute error", "%", |row| {
            format!("{:.0}", 100.0 * of(row).median_absolute)
        })
        .numbers("within 25 %", "%", |row| {
            format!("{:.0}", 100.0 * of(row).within_25_percent)
        })
}

/// One row per candidate and group, sorted by groups.
pub(super) fn groups(verdicts: &[ErrorRecord], grouping: Grouping) -> Table {
    let groups = benchmark::statistics(verdicts, grouping);
    let mut rows: Vec<(String, &Group)> = Vec::new();
    for value in grouping.values() {
        // Only the first row of a group has its value.
        let mut name = value.clone();
        let own = groups.iter().filter(|group| group.value == value);
        rows.extend(own.map(|group| (std::mem::take(&mut name), group)));
    }
    let rows = Table::of(&rows)
        .when(grouping != Grouping::All, |rows| {
            rows.words(grouping.describe(), |(name, _)| name.clone())
        })
        .words("model", |(_, group)| group.candidate);
    errors(rows, |(_, group)| &group.errors).table()
}

/// Case of the seed paper by one-dimensional variants, with columns of depth and error per velocity.
pub fn variants(lines: &[VariantResult]) -> Table {
    let mut variants: Vec<&VariantResult> = Vec::new();
    for line in lines {
        if variants.iter().all(|known| known.variant != line.variant) {
            variants.push(line);
        }
    }
    Table::of(&variants)
        .words("variant", |line| line.variant)
        .words("difference from the previous line", |line| line.change)
        .each(paper_case::SPEEDS, |rows, speed| {
            let at = |line: &VariantResult| {
                let is_own = |other: &&VariantResult| {
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

/// Case of the seed paper by the reference, on all meshes and in all targets.
pub(super) fn paper_case_rows(rows: &[PaperCaseRow]) -> Table {
    let mut rows: Vec<&PaperCaseRow> = rows.iter().collect();
    rows.sort_by(|a, b| {
        let speeds = a.impact_velocity_m_s.total_cmp(&b.impact_velocity_m_s);
        let radii = a.target_radius_mm.total_cmp(&b.target_radius_mm);
        let cells = a.cells_per_radius.cmp(&b.cells_per_radius);
        speeds.then(radii).then(cells)
    });
    Table::of(&rows)
        .numbers("impact velocity", "m/s", |row| {
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
        .numbers("energy balance error", "%", |row| {
            format!("{:.2}", 100.0 * row.energy_residual)
        })
        .table()
}

/// Every case with the reference on all meshes, its extrapolation, and the depth of every candidate with its error.
pub(super) fn every_case(compared: &BenchmarkResults) -> Table {
    let entries: Vec<&CheckedReference> = compared.references.iter().collect();
    cases(&entries)
        .numbers("reference", "mm", |entry| match &entry.estimate {
            Ok(estimate) => format!(
                "{} ± {}",
                significant(estimate.depth_mm, 4),
                significant(estimate.uncertainty_mm, 2)
            ),
            Err(refusal) => format!("refused: {}", refusal.describe()),
        })
        .each(candidates(), |rows, candidate| {
            let of = |case: &BenchmarkCase| {
                let is_own = |verdict: &&ErrorRecord| {
                    verdict.candidate == candidate.name && case.is_of(verdict)
                };
                compared.verdicts.iter().find(is_own)
            };
            rows.numbers(format!("{} [mm] (%)", candidate.name), "", |entry| {
                of(&entry.case).map_or_else(
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

/// Materials, L/D, velocity and the depths on all meshes of cases.
fn cases<'a>(entries: &'a [&'a CheckedReference]) -> Rows<'a, &'a CheckedReference> {
    Table::of(entries)
        .words("materials", |entry| {
            pair_name(&entry.case.projectile, &entry.case.target)
        })
        .numbers("L/D", "", |entry| entry.case.length_to_diameter.to_string())
        .numbers("impact velocity", "m/s", |entry| {
            entry.case.speed.to_string()
        })
        .numbers("depth by cells per radius", "mm", |entry| {
            let meshes = entry.meshes.iter();
            let meshes =
                meshes.map(|mesh| format!("{}: {}", mesh.cells, significant(mesh.value, 4)));
            meshes.collect::<Vec<_>>().join(", ")
        })
}

/// Cases whose reference fails its check, with the reason.
pub(super) fn refused(references: &[CheckedReference]) -> Table {
    let refused: Vec<&CheckedReference> = references
        .iter()
        .filter(|entry| entry.estimate.is_err())
        .collect();
    cases(&refused)
        .words("reason of the refusal", |entry| match &entry.estimate {
            Err(refusal) => refusal.describe(),
            Ok(_) => String::new(),
        })
        .table()
}

/// Coverage of the estimated model errors where pairs of materials are left out in turn.
pub fn coverage() -> Table {
    let rows: Vec<(&str, Coverage)> = candidates()
        .iter()
        .filter_map(|candidate| Some((candidate.name, model_error::coverage(candidate.name)?)))
        .collect();
    Table::of(&rows)
        .words("model", |(name, _)| *name)
        .numbers("pairs", "", |(_, found)| found.pairs.to_string())
        .numbers("cases", "", |(_, found)| found.cases.to_string())
        .numbers("coverage", "%", |(_, found)| {
            format!("{:.0}", 100.0 * found.coverage)
        })
        .numbers("median factor", "", |(_, found)| {
            format!("{:.2}", found.factor)
        })
        .table()
}
