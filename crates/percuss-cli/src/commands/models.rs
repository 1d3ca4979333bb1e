use clap::Args;
use percuss::{guard::Guard, model::MODELS};
use serde::Serialize;

use crate::{failure::Failure, terminal};

const AFTER_HELP: &str = "\
Examples:
  percuss models
  percuss models --json

Exit codes: 0 ok, 2 bad input, 4 the output could not be written";

/// List the models and what they apply to
///
/// Lists the models that `percuss run --model NAME` computes with: what each of
/// them is, and what it takes.
#[derive(Debug, Args)]
#[command(verbatim_doc_comment, after_help = AFTER_HELP)]
pub struct Models {
    /// Print a JSON array
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct ModelRecord {
    name: &'static str,
    summary: &'static str,
    guard: &'static Guard,
}

impl Models {
    pub fn run(&self) -> Result<(), Failure> {
        let models: Vec<ModelRecord> = MODELS
            .iter()
            .map(|model| ModelRecord {
                name: model.name(),
                summary: model.summary(),
                guard: model.guard(),
            })
            .collect();
        if self.json {
            return terminal::print_json(&models);
        }
        let width = terminal::width();
        let entries: Vec<String> = models
            .iter()
            .map(|model| {
                let mut entry = format!(
                    "{}\n  {}\n",
                    terminal::bold(model.name),
                    terminal::wrap(model.summary, width - 2, 2)
                );
                for line in model.guard.in_words() {
                    entry += &format!("  - {}\n", terminal::wrap(&line, width - 4, 4));
                }
                entry
            })
            .collect();
        terminal::print(&entries.join("\n"))
    }
}
