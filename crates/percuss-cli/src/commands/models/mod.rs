mod card;
mod options;
mod table;

use clap::Args;
use percuss::{
    case,
    model::{self, MODELS, Model},
    validity::ValidityDomain,
};
use serde::Serialize;
use serde_json::Value;

use self::options::ModelOption;
use crate::{answer::Answer, failure::Failure, output};

const LONG_ABOUT: &str = "\
List the models: what each of them is, and which projectiles and targets it is
made for.

`percuss models NAME` prints everything that a model is made for, for which
cases it is the first choice, its options in a case file, and which page says
how far its equations can be trusted. `percuss compare CASE.toml` runs the
models that apply to a case.";

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
    validity: &'static ValidityDomain,
    /// Keys of the model's table in a case file.
    #[serde(serialize_with = "options::keys")]
    options: Vec<ModelOption>,
    /// Where its equations, sources and checks are, in the project's folder.
    page: String,
}

impl ModelRecord {
    fn new(model: &dyn Model, schema: &Value) -> Self {
        Self {
            name: model.name(),
            summary: model.summary(),
            validity: model.validity(),
            options: options::of(model.name(), schema),
            page: format!("docs/models/{}.md", model.name()),
        }
    }
}

impl Models {
    pub fn run(&self) -> Result<(), Failure> {
        match (&self.name, self.json) {
            (Some(name), true) => output::print_json(&one(name)?),
            (None, true) => output::print_json(&all()),
            (Some(name), false) => output::print(&card::text(&one(name)?)),
            (None, false) => output::print(&table::text(&all())),
        }
    }

    /// What the command prints with --json.
    pub fn answer(&self) -> Result<Answer, Failure> {
        match &self.name {
            Some(name) => Answer::json_of(&one(name)?, Vec::new()),
            None => Answer::json_of(&all(), Vec::new()),
        }
    }
}

fn one(name: &str) -> Result<ModelRecord, Failure> {
    let schema = case::schema();
    Ok(ModelRecord::new(model::model(name)?, &schema))
}

fn all() -> Vec<ModelRecord> {
    let schema = case::schema();
    let record = |model: &&dyn Model| ModelRecord::new(*model, &schema);
    MODELS.iter().map(record).collect()
}
