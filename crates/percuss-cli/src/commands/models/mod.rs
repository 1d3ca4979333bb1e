mod card;
mod table;

use clap::Args;
use percuss::{
    guard::Guard,
    model::{self, MODELS, Model},
};
use serde::Serialize;

use crate::{failure::Failure, terminal};

const LONG_ABOUT: &str = "\
List the models: what each of them is, which projectiles and targets it is made
for, and for which cases it is the first choice.

`percuss models NAME` prints everything that a model is made for, takes and
leaves out. `percuss compare CASE.toml` runs those that apply to a case.";

const AFTER_HELP: &str = "\
Examples:
  percuss models
  percuss models chain
  percuss models --json

Exit codes: 0 ok, 2 bad input, 4 the output could not be written";

/// List the models, or show one
#[derive(Debug, Args)]
#[command(long_about = LONG_ABOUT, after_help = AFTER_HELP)]
pub struct Models {
    /// Show one model in full
    #[arg(value_name = "NAME")]
    name: Option<String>,
    /// Print JSON: an array of models, or the object of one
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct ModelRecord {
    name: &'static str,
    summary: &'static str,
    guard: &'static Guard,
}

impl ModelRecord {
    fn new(model: &dyn Model) -> Self {
        Self {
            name: model.name(),
            summary: model.summary(),
            guard: model.guard(),
        }
    }
}

impl Models {
    pub fn run(&self) -> Result<(), Failure> {
        if let Some(name) = &self.name {
            let model = ModelRecord::new(model::model(name)?);
            return match self.json {
                true => terminal::print_json(&model),
                false => terminal::print(&card::text(&model)),
            };
        }
        let models: Vec<ModelRecord> = MODELS.iter().map(|m| ModelRecord::new(*m)).collect();
        match self.json {
            true => terminal::print_json(&models),
            false => terminal::print(&table::text(&models)),
        }
    }
}
