//! The page "Comparison with other codes".

use std::fmt::Write as _;

use percuss::units::significant;

use crate::paper_case;

use super::{
    CodeComparison, ComparedValue, DimensionStudy,
    dimension::CELLS,
    figures,
    outside::{self, CASES},
    percent,
};
use percuss_report::figure::IN_PAGES;

pub(super) fn text(comparison: &CodeComparison) -> String {
    let mut page = String::from(INTRODUCTION);
    page += &summary(&comparison.values);
    page += CODES;
    page += "\n## Tables\n";
    for (name, _) in CASES {
        page += &table(name, &comparison.values);
    }
    page += STRAIN_RATE;
    page += REBOUND;
    page += &dimension(comparison);
    page += "\n## Figures\n";
    for figure in figures::draw(comparison) {
        // Writing to a String cannot fail.
        let _ = write!(
            page,
            "\n![{0}]({1}.{IN_PAGES})\n\n*{0}*\n",
            figure.title, figure.name
        );
    }
    page += REPRODUCTION;
    page
}

/// Smallest and largest difference of some rows [%].
fn range<'a>(rows: impl Iterator<Item = &'a ComparedValue>) -> String {
    let differences: Vec<f64> = rows.map(|value| value.found_percent).collect();
    let least = differences.iter().copied().fold(f64::INFINITY, f64::min);
    let most = differences
        .iter()
        .copied()
        .fold(f64::NEG_INFINITY, f64::max);
    match percent(least) == percent(most) {
        true => percent(least),
        false => format!("{} to {}", percent(least), percent(most)),
    }
}

/// What agrees and what does not, in computed numbers.
fn summary(values: &[ComparedValue]) -> String {
    let mut text = String::from(
        "\n## Result\n\n| case | quantity | codes | difference of percuss |\n|---|---|---|---:|\n",
    );
    for (name, _) in CASES {
        let own = |value: &&ComparedValue| value.outside.case == *name;
        let mut groups = Vec::new();
        for value in values.iter().filter(own) {
            let group = (value.outside.impact_velocity_m_s, value.outside.quantity);
            if !groups.contains(&group) {
                groups.push(group);
            }
        }
        for group in groups {
            let of = |value: &&ComparedValue| {
                own(value) && (value.outside.impact_velocity_m_s, value.outside.quantity) == group
            };
            let mut codes: Vec<&str> = Vec::new();
            for value in values.iter().filter(of) {
                if !codes.contains(&value.outside.code.as_str()) {
                    codes.push(&value.outside.code);
                }
            }
            let _ = writeln!(
                text,
                "| {name}, {} m/s | {} | {} | {} |",
                group.0,
                group.1.label(),
                codes.join(", "),
                range(values.iter().filter(of))
            );
        }
    }
    text += RESULT;
    let paper = paper_case::depth(&paper_case::built_in(), 230.0);
    let depth = paper.map_or(f64::NAN, |estimate| estimate.depth_mm);
    // Writing to a String cannot fail.
    let _ = writeln!(
        text,
        "- **Depth at 230 m/s** is less than a cell of these meshes, and the codes differ by a sixth. Between them lies\n  [{depth:.3} mm](../../models/axi.md#the-papers-case), the depth by `axi` on finer meshes."
    );
    text
}

fn table(name: &str, values: &[ComparedValue]) -> String {
    let own: Vec<&ComparedValue> = values
        .iter()
        .filter(|value| value.outside.case == name)
        .collect();
    let Some(first) = own.first() else {
        return String::new();
    };
    let title = outside::scenario(name, first.outside.impact_velocity_m_s)
        .map(|scenario| scenario.title)
        .unwrap_or_default();
    let mut text = format!(
        "\n### {name}\n\n{title}.\n\n| velocity | quantity | code | method, mesh | value | energy error | percuss | value | difference | tolerance | note |\n\
         |---:|---|---|---|---:|---:|---|---:|---:|---:|---|\n"
    );
    for value in own {
        let row = &value.outside;
        let energy = row
            .energy_error_percent
            .map_or_else(|| "\u{2013}".to_owned(), percent);
        let _ = writeln!(
            text,
            "| {} m/s | {} | {} | {} | {} {} | {energy} | {}, {} | {} | {} | {} | {} |",
            row.impact_velocity_m_s,
            row.quantity.label(),
            row.code,
            row.resolution,
            number(row.value, &row.unit),
            row.unit,
            row.model,
            row.mesh,
            number(value.percuss, &row.unit),
            percent(value.found_percent),
            tolerance(value),
            row.note
        );
    }
    text
}

/// Shape and energy of the compared rod beside those of the default mesh in one dimension.
fn what_is_left_out(study: &DimensionStudy) -> String {
    let (Some(rod), Some(line)) = (study.rods.get(1), study.lines.first()) else {
        return String::new();
    };
    let less = |two: f64, one: f64| format!("{:.0} %", 100.0 * (1.0 - two / one));
    let shortening = |length: f64| study.length_mm - length;
    format!(
        "\n**What one dimension leaves out has the size of the diameter.** The foot of the rod by `axi` is {:.1} diameters wide, in one dimension {:.1}. \
         Up to {:.0} % of the impact\nenergy is in radial motion at one time, which one dimension does not have. That part falls in proportion to the diameter. \
         Strain gathers in the foot, where it hardens\nthe metal more and shortens the rod less. At L/D {:.1} the mean plastic strain is {} smaller than in one dimension, \
         the shortening {}. As the diameter falls, so does the share\nof the foot, and the length tends to that of one dimension. The test demands that each halving of the diameter \
         takes a fifth or more of the difference.\n",
        rod.foot,
        line.foot,
        100.0 * rod.radial_motion,
        rod.length_to_diameter,
        less(rod.mean_strain, line.mean_strain),
        less(
            shortening(rod.final_length_mm),
            shortening(line.final_length_mm)
        )
    )
}

/// A number in its unit; what is 0 in an exact solution has two decimals.
fn number(value: f64, unit: &str) -> String {
    match unit {
        "%" => format!("{value:.2}").replace('-', "\u{2212}"),
        _ => significant(value, 4),
    }
}

fn tolerance(value: &ComparedValue) -> String {
    let row = &value.outside;
    let range = format!("\u{00b1}{} %", row.tolerance_percent);
    match row.difference_percent == 0.0 {
        true => range,
        false => format!("{} {range}", percent(row.difference_percent)),
    }
}

fn dimension(comparison: &CodeComparison) -> String {
    let study = &comparison.dimension;
    let mut text = String::from(DIMENSION);
    text += "\n| model | L/D | final length | foot over diameter | mean plastic strain | plastic work | viscosity | most in radial motion |\n\
             |---|---:|---:|---:|---:|---:|---:|---:|\n";
    let part = |fraction: f64| format!("{:.1} %", 100.0 * fraction);
    for rod in &study.rods {
        let _ = writeln!(
            text,
            "| axi, {CELLS} cells | {} | {} mm | {} | {} | {} | {} | {} |",
            significant(rod.length_to_diameter, 3),
            significant(rod.final_length_mm, 4),
            significant(rod.foot, 3),
            significant(rod.mean_strain, 3),
            part(rod.plastic_work),
            part(rod.viscous_work),
            part(rod.radial_motion)
        );
    }
    for line in &study.lines {
        let _ = writeln!(
            text,
            "| {}, {} elements | any | {} mm | {} | {} | {} | | |",
            line.model,
            line.elements,
            significant(line.final_length_mm, 4),
            significant(line.foot, 3),
            significant(line.mean_strain, 3),
            part(line.plastic_work)
        );
    }
    text += &what_is_left_out(study);
    text += DIMENSION_RESULT;
    text
}

const INTRODUCTION: &str = "\
# Comparison with other codes

Three open codes were run on cases of percuss, with the same laws and constants. `percuss reproduce codes --out docs/reference/codes` computes the
cases again and writes this page.

**Agreement with another code is no proof.** Each has errors of its own; where two codes disagree, an exact problem decides. Agreement here is
verification: it shows that equations are solved, not that they hold for a metal.
";

const RESULT: &str = "
- **Rods on a wall and planar impacts** agree within 1 %, apart from the edge of the foot and one rate law (below).
- **Depth at 600 m/s** agrees within 6 %, and within 4 % on finer meshes of the other codes.
- **Perforation by `chain`** does not agree: +8 % of the residual velocity at 300 m/s, and no perforation at 200 m/s. OpenRadioss brackets the measured limit of
  184.5 m/s from 185 to 200 m/s, not converged.
";

const CODES: &str = "
## Codes

| code | method | energy balance of its own | limits found |
|---|---|---|---|
| NairnMPM (nairnj/nairn-mpm-fea, 7f47b022) | axisymmetric material point method: FLIP, uGIMP or lCPDI, hyperelastic plasticity | kinetic energy and work of the stresses, in the tables | the wall holds the rod in tension as well; heating leaves out the stored energy; frictionless lCPDI contact loses particles at 600 m/s; a rate law depends on the time step (below) |
| OpenRadioss (OpenRadioss/OpenRadioss, bd4557ba) | explicit finite elements, axisymmetric quadrilaterals, penalty contact | perforation: 3 to 8 % missing, by deleted elements | contact of plate nodes beyond the punch's radius creates energy (+58 % at 220 m/s); squashed elements must be deleted; the plate at 200 m/s is not converged on 0.20 mm |
| pyKO (ImpactsWiki/pyko, 9bccb4a1) | one-dimensional finite differences of Wilkins | +1.4 % of kinetic and internal energy, +2.8 % with spall | spall acts on the mean tension, and holds back while the density is above a part of the reference, which a case gives; a fifth of the default time step is needed with spall; its equation of state expands the Hugoniot to the third order |

Energy errors are of the code's own sum, relative to the impact energy; a dash where it was not recorded.
";

const STRAIN_RATE: &str = "
## Strain rate of rate-dependent laws

With strain rate, the rod of NairnMPM is 0.2 to 1.3 % longer than that of `axi`; without, 0.0 to 0.3 %. Both use the equivalent plastic strain rate
`√(2/3 D_p:D_p)` of the step.

**The measure is right in both.** In homogeneous compression and in shear at a constant rate, the stress of percuss is the closed form
`A (1 + C ln(ε̇/ε̇₀))` to 1e-6, with `ε̇ = √(2/3 D:D)` (test `homogeneous_flow_has_the_stress_of_its_rate`). The norm of the deviatoric rate, `√(D:D)`, would give
another stress.

**The rate differs.** In NairnMPM velocities fluctuate from step to step, so flow stops and starts. Steps with flow have a larger rate than the mean, and a larger
stress. The row *excess of the flow stress* has the mean of `σ/Y(ε_p, ε̇) − 1`, with ε̇ the growth of plastic strain over many steps. It is 0 for an
exact solution, and less than 0.1 % in `axi`. In NairnMPM it depends on the time step and on the order of its updates, and the rod is longer the larger it is. Extrapolated linearly to no
excess, the rod is 17.33 mm long on 4 cells and 17.38 mm on 8. That is 0.1 and 0.6 % longer than by `axi`; without strain rate it is 0.3 %. In `axi` a quarter of the time step changes the length by
0.005 %. The longer rod is an error of NairnMPM; a mesh-dependent rest of 0.3 % is unexplained.
";

const REBOUND: &str = "
## Rebound

At 600 m/s NairnMPM has a rebound of 84 m/s or more. Transfers that filter the motion in every step gave 60 m/s in `axi`: they took elastic energy
from the rod. [Transfers without that loss](../../decisions/0024-transfers-of-axi.md) give the value in the table. NairnMPM was right.

The exact problem is an elastic rod without lateral contraction on a rigid wall. It rebounds with its impact velocity. `axi` gives 0.95 and 0.97 of it on 6 and 12 cells
(L/D 3), and 0.98 (L/D 10). The rest rings in the rod and falls with the mesh (test `an_elastic_rod_rebounds_with_its_impact_velocity`).
";

const DIMENSION: &str = "
## Taylor rods in one dimension

`chain` and `fdm` end 3 % shorter than all two-dimensional codes: 16.84 mm instead of 17.3 to 17.5 mm. The measured length is 16.81 mm. A rod in one
dimension has no diameter, so `axi` was run on rods of the same length and other diameters:
";

const DIMENSION_RESULT: &str = "
**The measured length is met by compensating errors.** The two-dimensional solution of this law is 3.4 % longer than the measured rod. One dimension is 3 to 4 % shorter
than two, which hides it. A one-dimensional agreement with a Taylor test therefore does not validate a strength law to better than 4 %.
";

const REPRODUCTION: &str = "
## Reproduction

The stored numbers are `crates/percuss-research/data/codes/results.csv`, beside the case files. `validation/run` writes the decks of the other codes from these
case files and runs the codes that are installed ([how](../../../validation/README.md)).
";
