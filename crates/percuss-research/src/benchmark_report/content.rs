//! Content of the benchmark report.

use percuss_report::{page::Block, result_rows::with_uncertainty};

use super::{BenchmarkResults, Origin, figures::BenchmarkFigures, tables};
use crate::{
    benchmark::{self, Grouping},
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
                "The reference is the model axi on three meshes, by the rule of the axisymmetric answer: monotone depths with an observed order \
                 of 1 to 3 are extrapolated in the cell size, otherwise the finest mesh counts. A reference whose uncertainty exceeds 15 % \
                 is left out.",
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
    page.extend([
        Block::Heading("Estimated model errors".to_owned()),
        Block::Text(
            "Every pair of materials of both designs is left out in turn: part of its cases in the 80 % interval that the others give, mean \
             over the pairs, and median factor from the centre of the interval to its end. By the stored results of the program."
                .to_owned(),
        ),
        Block::Table(tables::coverage()),
    ]);
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
            Some(format!(
                "{} at {speed} m/s",
                with_uncertainty(estimate.depth_mm, estimate.uncertainty_mm, "mm")
            ))
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
