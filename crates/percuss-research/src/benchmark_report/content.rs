//! Content of the benchmark report.

use percuss_report::page::Block;

use super::{BenchmarkResults, Origin, figures::BenchmarkFigures, tables};
use crate::{
    benchmark::{self, Estimate, Grouping},
    paper_case,
};

pub(super) fn page<'a>(
    compared: &BenchmarkResults,
    origin: &Origin,
    figures: &'a BenchmarkFigures,
) -> Vec<Block<'a>> {
    let verdicts = &compared.verdicts;
    let mut page = vec![
        Block::Title("Depth models against the axisymmetric reference".to_owned()),
        Block::Text(format!(
            "Every depth model of percuss {} on every case of the benchmark. Reference: {}. Command: {}",
            env!("CARGO_PKG_VERSION"),
            origin.reference,
            origin.command
        )),
        Block::Heading("Findings".to_owned()),
        Block::List(benchmark::findings(verdicts).iter().map(|line| line.replace('`', "")).collect()),
        Block::Heading("Definitions".to_owned()),
        Block::List(
            [
                "Relative error = depth by the model / depth by the reference - 1: positive where the model is too deep.",
                "The reference is the model axi on three meshes. Monotone depths with an observed order of 0.5 to 2.2 are extrapolated in the \
                 cell size, by at most 25 %. Otherwise the finest mesh counts if the meshes agree within 10 %.",
                "A case is left out of all numbers if its reference fails this check or if a shorter rod penetrates deeper.",
                "Medians and percentiles are over cases.",
                "The last column is the fraction of the cases with an absolute error of at most 25 %.",
                "Models with different n are compared on different cases, because a model counts only where it applies.",
            ]
            .map(str::to_owned)
            .to_vec(),
        ),
        Block::Heading("All cases".to_owned()),
        Block::Table(tables::groups(verdicts, Grouping::All)),
    ];
    let refused = tables::refused(&compared.references);
    if !refused.is_empty() {
        let title = format!(
            "{} cases left out: their reference fails its check",
            refused.len()
        );
        page.push(Block::Folded(title, vec![Block::Table(refused)]));
    }
    page.extend(figures.maps.iter().map(Block::Figure));
    page.push(Block::Heading("Errors by property".to_owned()));
    for &grouping in Grouping::ALL {
        let title = format!("By {}", grouping.describe());
        let table = || Block::Table(tables::groups(verdicts, grouping));
        match grouping {
            Grouping::All => {}
            Grouping::Regime => page.extend([Block::Subheading(title), table()]),
            _ => page.push(Block::Folded(title, vec![table()])),
        }
    }
    page.extend(paper_case(compared));
    page.push(Block::Heading(
        "Depth of penetration versus impact velocity".to_owned(),
    ));
    page.extend(figures.depths.iter().map(Block::Figure));
    page.push(Block::WebOnly(
        figures.more_depths.iter().map(Block::Figure).collect(),
    ));
    page.push(Block::WebOnly(vec![
        Block::Heading("Every case".to_owned()),
        Block::Table(tables::every_case(compared)),
    ]));
    page
}

fn paper_case<'a>(compared: &BenchmarkResults) -> Vec<Block<'a>> {
    let mut blocks = vec![
        Block::Heading("Case of the seed paper, one change at a time".to_owned()),
        Block::Text(
            "A copper rod (12.74 mm by 4.8 mm) on 25 mm of 2024-T351 with a fixed rear face. The second column gives the difference from \
             the previous line."
                .to_owned(),
        ),
        Block::Table(tables::variants(&compared.variants)),
    ];
    if !compared.paper_case.is_empty() {
        let depths = paper_case::SPEEDS.iter().filter_map(|&speed| {
            let estimate = paper_case::depth(&compared.paper_case, speed)?;
            Some(format!("{} at {speed} m/s", with_uncertainty(&estimate)))
        });
        let depths: Vec<String> = depths.collect();
        blocks.extend([
            Block::Subheading("Depth by the reference".to_owned()),
            Block::Text(format!(
                "At a target radius of {} mm: {}, the means over meshes of at least {} cells with their largest distance from the mean. \
                 The depth alternates with the mesh and is not extrapolated. The other rows vary the radius of the target.",
                paper_case::RADIUS,
                depths.join(", "),
                paper_case::FINE
            )),
            Block::Table(tables::paper_case_rows(&compared.paper_case)),
        ]);
    }
    blocks
}

/// A depth to three digits, and its uncertainty rounded up to the last of them.
fn with_uncertainty(estimate: &Estimate) -> String {
    let before = estimate.depth_mm.log10().floor().max(0.0) as usize;
    let leading_zeros = (-estimate.depth_mm.log10()).ceil().max(0.0) as usize;
    let decimals = (2 + leading_zeros).saturating_sub(before);
    let unit = 10_f64.powi(-(decimals as i32));
    let uncertainty = (estimate.uncertainty_mm / unit).ceil() * unit;
    format!(
        "{:.decimals$} ± {uncertainty:.decimals$} mm",
        estimate.depth_mm
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_uncertainty_is_rounded_up_to_the_last_digit_of_the_depth() {
        for (depth_mm, uncertainty_mm, words) in [
            (0.21733, 0.01045, "0.217 ± 0.011 mm"),
            (2.2111, 0.0167, "2.21 ± 0.02 mm"),
            (12.34, 0.51, "12.3 ± 0.6 mm"),
            (0.0512, 0.001, "0.0512 ± 0.0010 mm"),
            (345.6, 3.2, "346 ± 4 mm"),
        ] {
            let estimate = Estimate {
                depth_mm,
                uncertainty_mm,
            };
            assert_eq!(with_uncertainty(&estimate), words);
        }
    }
}
