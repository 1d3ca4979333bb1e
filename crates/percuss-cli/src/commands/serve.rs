//! `percuss serve`: the interactive page.

use std::{
    net::{IpAddr, Ipv4Addr, SocketAddr},
    path::{Path, PathBuf},
};

use clap::Args;
use percuss::{
    case,
    document::{Document, read_text},
    model::memory::{MEMORY_VARIABLE, set_memory_limit},
};
use percuss_serve::{Options, RequestLimits, ServeError, Server, StartCase};

use crate::{failure::Failure, output, whole_numbers::from_to};

/// Largest memory of a run of the page [bytes], unless the environment sets another one.
const RUN_MEMORY: u64 = 1 << 30;

const LONG_ABOUT: &str = "\
Serve a page that recomputes the case while its sliders move: the case as a form
and as text, time histories, stress versus position and time, and all applicable
models; convergence, ballistic limits, sweeps, uncertainty and calibrations on
demand. The page is part of the program and loads nothing from a network.

By default only this machine can open the page. To serve it to other machines,
give an address, --allow-remote and a token. The connection is not encrypted:
over a network, use `ssh -L` or a proxy with TLS.

Materials and measured curves of files that the case names are put into its
text. The page itself reads no files.";

const AFTER_HELP: &str = "\
Examples:
  percuss serve
  percuss serve my-case/scenario.toml --port 8080
  percuss serve --address 0.0.0.0 --allow-remote --token-file token.txt

Exit codes: 0 ok, 2 bad input or an address that is not safe, 4 a file could not
be read";

/// Serve an interactive page for the browser
#[derive(Debug, Args)]
#[command(long_about = LONG_ABOUT, after_help = AFTER_HELP)]
pub struct Serve {
    /// Case file to open the page with [default: the case of the seed paper]
    #[arg(value_name = "CASE.toml")]
    case: Option<PathBuf>,
    /// Port to listen on; 0 selects a free one
    #[arg(long, value_name = "PORT", default_value_t = 7355)]
    port: u16,
    /// Address to listen on
    #[arg(long, value_name = "IP", default_value_t = IpAddr::V4(Ipv4Addr::LOCALHOST))]
    address: IpAddr,
    /// Allow an address that other machines can reach
    #[arg(long, requires = "token_file")]
    allow_remote: bool,
    /// File with the token that opens the page
    #[arg(long, value_name = "FILE")]
    token_file: Option<PathBuf>,
    /// Host name of the page, in addition to IP addresses and localhost; may be given several times
    #[arg(long, value_name = "NAME")]
    host_name: Vec<String>,
    /// Largest number of elements of projectile and target together
    #[arg(long, value_name = "N", default_value_t = RequestLimits::default().elements)]
    #[arg(value_parser = from_to::<usize>(1, 1_000_000_000, "a number of elements"))]
    max_elements: usize,
    /// Time limit of a run or a study, in seconds
    #[arg(long, value_name = "S", default_value_t = RequestLimits::default().seconds)]
    #[arg(value_parser = from_to::<u64>(1, 86_400, "a time limit"))]
    max_seconds: u64,
    /// Largest number of simultaneous runs and studies [default: one per core]
    #[arg(long, value_name = "N", value_parser = from_to::<u16>(1, 1000, "a number of runs"))]
    max_runs: Option<u16>,
}

impl Serve {
    pub fn run(&self) -> Result<(), Failure> {
        // Others may open the page, and several runs go on at once.
        if std::env::var_os(MEMORY_VARIABLE).is_none() {
            set_memory_limit(RUN_MEMORY);
        }
        let bounds = RequestLimits::default();
        let options = Options {
            address: SocketAddr::new(self.address, self.port),
            allow_remote: self.allow_remote,
            token: self.token_file.as_deref().map(token).transpose()?,
            host_names: self.host_name.clone(),
            bounds: RequestLimits {
                elements: self.max_elements,
                seconds: self.max_seconds,
                runs: self.max_runs.map_or(bounds.runs, usize::from),
            },
            case: self.case.as_deref().map(start_case).transpose()?,
        };
        let server = Server::bind(options)?;
        let address = server.address();
        let reached = match address.ip().is_unspecified() {
            true => format!("port {} of every address of this machine", address.port()),
            false => format!("http://{address}"),
        };
        let with_token = match self.token_file {
            Some(_) => "; open it with `/?token=` and the token behind the address",
            None => "",
        };
        output::print(&format!("serving {reached}{with_token}\nend with Ctrl-C\n"))?;
        server.run()
    }
}

/// The first line of a file.
fn token(path: &Path) -> Result<String, Failure> {
    let text = read_text(path)?;
    Ok(text.lines().next().unwrap_or_default().trim().to_owned())
}

/// Valid case with its name.
fn start_case(path: &Path) -> Result<StartCase, Failure> {
    let document = Document::read(path)?;
    Ok(StartCase {
        name: case::scenario(&document)?.name,
        text: case::self_contained(&document)?,
    })
}

impl From<ServeError> for Failure {
    fn from(error: ServeError) -> Self {
        match error {
            ServeError::Case(error) => Self::Library(error),
            other => Self::Usage {
                message: other.to_string(),
                help: other.help(),
            },
        }
    }
}
