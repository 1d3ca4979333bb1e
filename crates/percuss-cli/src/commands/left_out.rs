//! Commands and options that this build leaves out.

use std::ffi::OsString;

use clap::Args;

use crate::failure::Failure;
#[cfg(not(feature = "parquet"))]
use crate::response::Response;

/// Not part of this build
#[cfg(not(feature = "serve"))]
#[derive(Debug, Args)]
#[command(hide = true, disable_help_flag = true)]
pub struct Serve {
    #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
    words: Vec<OsString>,
}

#[cfg(not(feature = "serve"))]
impl Serve {
    pub fn run(&self) -> Result<(), Failure> {
        Err(refuse("`percuss serve`", "serve"))
    }
}

/// Not part of this build
#[cfg(not(feature = "parquet"))]
#[derive(Debug, Args)]
#[command(hide = true, disable_help_flag = true)]
pub struct Sweep {
    #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
    words: Vec<OsString>,
}

#[cfg(not(feature = "parquet"))]
impl Sweep {
    pub fn run(&self) -> Result<(), Failure> {
        Err(refuse("`percuss sweep`", "parquet"))
    }

    pub fn execute(&self) -> Result<Response, Failure> {
        Err(refuse("`percuss sweep`", "parquet"))
    }
}

/// The refusal of a command or option that needs a feature which this build leaves out.
pub(crate) fn refuse(part: &str, feature: &str) -> Failure {
    Failure::Usage {
        message: format!(
            "{part} needs the feature `{feature}`, which this build of percuss leaves out"
        ),
        help: "`cargo install --locked --path crates/percuss-cli` installs the program with all features"
            .to_owned(),
    }
}
