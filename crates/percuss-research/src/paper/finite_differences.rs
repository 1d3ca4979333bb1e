//! Figure 7 by two discretisations: discrete elements and finite differences.

use super::{
    Assessment, Item, Table,
    figures::number,
    runs::{COMPARED_MESHES, Runs, SPEEDS, Way},
};

/// Largest relative difference of results that agree.
const AGREEMENT: f64 = 0.1;

pub(super) fn check(runs: &Runs, items: &mut Vec<Item>, tables: &mut Vec<Table>) {
    let largest = |mesh| {
        let own = runs
            .compared
            .iter()
            .filter(|compared| compared.mesh == mesh);
        own.map(|compared| compared.excess().abs())
            .fold(0.0, f64::max)
    };
    let [coarse, fine] = COMPARED_MESHES.map(largest);
    items.push(Item {
        place: "Fig. 7",
        statement: "discrete elements agree with 1-D finite differences at every velocity (conservative)"
            .to_owned(),
        assessment: match coarse < AGREEMENT && fine < AGREEMENT {
            true => Assessment::Reproduced,
            false => Assessment::Contradicted,
        },
        finding: format!(
            "against the model `fdm`, which solves the same equations in another discretisation, neither with erosion: the \
             depths differ by at most {:.1} % on 10–20 elements and {:.1} % on 40–80, from {} to {} m/s; Woodward's own program \
             and numbers could not be read",
            100.0 * coarse,
            100.0 * fine,
            SPEEDS[0],
            SPEEDS[7]
        ),
    });
    for way in [Way::Chain, Way::Joined] {
        let ratios = SPEEDS.map(|speed| {
            runs.depth_on(way, speed, (10, 20)) / runs.differences_on(speed, (10, 20))
        });
        let least = ratios.into_iter().fold(f64::INFINITY, f64::min);
        let most = ratios.into_iter().fold(0.0, f64::max);
        items.push(Item {
            place: "Fig. 7",
            statement: format!(
                "discrete elements agree with 1-D finite differences at every velocity ({})",
                way.name()
            ),
            assessment: match least > 1.0 - AGREEMENT && most < 1.0 + AGREEMENT {
                true => Assessment::Reproduced,
                false => Assessment::Contradicted,
            },
            finding: format!(
                "{least:.1} to {most:.1} times the depth by finite differences on 10–20 elements"
            ),
        });
    }
    let mut columns = vec!["Impact velocity (m/s)".to_owned()];
    for mesh in COMPARED_MESHES {
        let mesh = format!("{}–{}", mesh.0, mesh.1);
        columns.push(format!("discrete elements, {mesh} [mm]"));
        columns.push(format!("finite differences, {mesh} [mm]"));
        columns.push(format!("difference, {mesh} [%]"));
    }
    let rows = SPEEDS
        .iter()
        .map(|&speed| {
            let own = runs
                .compared
                .iter()
                .filter(|compared| compared.speed == speed);
            let cells = own.flat_map(|compared| {
                [
                    number(compared.elements),
                    number(compared.differences),
                    format!("{:+.1}", 100.0 * compared.excess()),
                ]
            });
            std::iter::once(format!("{speed}")).chain(cells).collect()
        })
        .collect();
    tables.push(Table {
        title: "Discrete elements (conservative) versus finite differences (figure 7), C = 0.577, no erosion in either."
            .to_owned(),
        columns,
        rows,
    });
}
