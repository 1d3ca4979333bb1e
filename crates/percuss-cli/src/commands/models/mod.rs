//! `percuss models`: list of the models.

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
use crate::{failure::Failure, output, response::Response};

const LONG_ABOUT: &str = "\
List the models with a description and their projectiles and targets.

`percuss models NAME` prints the range of validity of a model, the cases for
which it is the first choice, its options in a case file, and the page with its
equations and sources. `percuss compare CASE.toml` runs the models that apply to
a case.";

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
    /// Page with its equations, sources and checks, in the folder of the project.
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

    /// Output of --json.
    pub fn execute(&self) -> Result<Response, Failure> {
        match &self.name {
            Some(name) => Response::json_of(&one(name)?, Vec::new()),
            None => Response::json_of(&all(), Vec::new()),
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
