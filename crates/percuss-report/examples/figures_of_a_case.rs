//! Runs a case file and writes its figures and histories to a folder.
//!
//! `cargo run -p percuss-report --example figures_of_a_case -- CASE.toml FOLDER`

use std::{path::Path, time::Instant};

use percuss::{case, model};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [case_file, folder] = &arguments[..] else {
        return Err("give a case file and a folder".into());
    };
    let folder = Path::new(folder);
    let scenario = case::load(Path::new(case_file))?;
    let result = model::run(
        model::model("chain")?,
        &scenario,
        &mut model::Control::recording(),
    )?;
    println!("outcome: {}", result.outcome.describe());
    let start = Instant::now();
    for figure in percuss_report::run_figures(&scenario, &result)? {
        let files = figure.write(folder, percuss_report::FigureFormat::DEFAULT)?;
        let files: Vec<String> = files
            .iter()
            .map(|file| file.display().to_string())
            .collect();
        println!("{}: {}", files.join(", "), figure.title);
    }
    let drawn = start.elapsed();
    for file in percuss_report::write_histories(folder, &result, None)? {
        println!("{}", file.display());
    }
    println!(
        "figures {:.2} s, histories {:.2} s",
        drawn.as_secs_f64(),
        (start.elapsed() - drawn).as_secs_f64()
    );
    Ok(())
}
