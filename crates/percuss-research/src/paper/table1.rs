//! Checks of Table 1.

use percuss::{case::PublishedTimeStep, chain::Published, scenario::TargetBody};

use super::{Assessment, Item, runs::Runs};

pub(super) fn check(runs: &Runs, items: &mut Vec<Item>) {
    let scenario = runs.table_1();
    let rod = &scenario.projectile;
    let mut push = |statement: &str, assessment, finding: String| {
        items.push(Item {
            place: "Table 1",
            statement: statement.to_owned(),
            assessment,
            finding,
        });
    };
    push(
        "penetrator mass 1.96e-3 kg",
        assess_within(rod.mass, 1.96e-3, 5e-3),
        format!("{:.4e} kg from density, length and diameter", rod.mass),
    );
    let (density, thickness) = match &scenario.target {
        TargetBody::Layers { layers, .. } => (
            layers[0].material.density.si(),
            layers[0].thickness.unwrap_or(f64::NAN),
        ),
        _ => (f64::NAN, f64::NAN),
    };
    let volume = rod.area() * thickness;
    push(
        "target column mass 1.22e-3 kg",
        assess_within(density * volume, 1.22e-3, 5e-3),
        format!(
            "{:.4e} kg from the table's own density and size; the printed mass needs {:.0} kg/m3",
            density * volume,
            1.22e-3 / volume
        ),
    );
    push(
        "element heights 0.32 and 0.31 mm",
        Assessment::Reproduced,
        format!(
            "{:.4} and {:.4} mm from 40 and 80 elements",
            rod.length / 40.0 * 1e3,
            thickness / 80.0 * 1e3
        ),
    );
    let step = |form| {
        let mut scenario = scenario.clone();
        if let Some(published) = &mut scenario.options.chain.published {
            published.time_step = form;
        }
        Published::new(&scenario).map_or(f64::NAN, |run| run.time_step())
    };
    let (table, equation) = (
        step(PublishedTimeStep::Table1),
        step(PublishedTimeStep::Equation21),
    );
    push(
        "time step 4.85e-9 s",
        assess_within(table, 4.85e-9, 1e-3),
        format!(
            "{table:.3e} s from 0.1 sqrt(m/K) with the printed target mass and the elastic stiffness of copper"
        ),
    );
    push(
        "time step by equation (21), 0.1 · 2 sqrt(m/K)",
        assess_within(equation, 4.85e-9, 1e-3),
        format!("{equation:.3e} s: the printed time step lacks the factor 2"),
    );
    let counts: Vec<String> = runs
        .joined_steps
        .iter()
        .map(|(name, steps)| format!("{steps} ({name})"))
        .collect();
    push(
        "95 time steps to rest",
        Assessment::ReadingDependent,
        format!(
            "the joined interpretation stops after {} steps, by border shear; the chain interpretation takes over a thousand",
            counts.join(", ")
        ),
    );
    push(
        "95 steps and a depth of millimetres (figures 7 to 11)",
        Assessment::Contradicted,
        format!(
            "in 95 steps of 4.85 ns a mass that starts at 230 m/s and decelerates moves at most {:.3} mm: the two statements exclude each other",
            230.0 * 95.0 * 4.85e-9 * 1e3
        ),
    );
}

fn assess_within(value: f64, printed: f64, fraction: f64) -> Assessment {
    if (value / printed - 1.0).abs() <= fraction {
        Assessment::Reproduced
    } else {
        Assessment::Contradicted
    }
}
