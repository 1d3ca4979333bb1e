//! Options of a server, and errors at its start.

use std::{
    io,
    net::{IpAddr, Ipv4Addr, SocketAddr},
};

use crate::{RequestLimits, problem::Problem};

/// Smallest number of characters of a token.
const LEAST_TOKEN: usize = 16;
/// Largest number of characters of a token.
const MOST_TOKEN: usize = 200;

/// Options of a server.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// Address to listen on; port 0 takes a free one.
    pub address: SocketAddr,
    /// Whether an address is allowed that other machines can reach.
    pub allow_remote: bool,
    /// Token of every request; `None` on a loopback address.
    pub token: Option<String>,
    /// Allowed host names, besides IP addresses and `localhost`.
    pub host_names: Vec<String>,
    /// Limits of a request.
    pub bounds: RequestLimits,
    /// First case of the page; that of the seed paper when not given.
    pub case: Option<StartCase>,
}

/// A case to open on.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StartCase {
    /// Its name.
    pub name: String,
    /// The text of its file.
    pub text: String,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            address: SocketAddr::new(IpAddr::V4(Ipv4Addr::LOCALHOST), 0),
            allow_remote: false,
            token: None,
            host_names: Vec::new(),
            bounds: RequestLimits::default(),
            case: None,
        }
    }
}

impl Options {
    pub(crate) fn check(&self) -> Result<(), ServeError> {
        if let Some(token) = &self.token {
            let plain = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
            let length = token.chars().count();
            if !(LEAST_TOKEN..=MOST_TOKEN).contains(&length) || !token.chars().all(plain) {
                return Err(ServeError::Token {
                    least: LEAST_TOKEN,
                    most: MOST_TOKEN,
                });
            }
        }
        if self.address.ip().is_loopback() {
            return Ok(());
        }
        if !self.allow_remote {
            return Err(ServeError::Remote {
                address: self.address.ip(),
            });
        }
        match self.token {
            Some(_) => Ok(()),
            None => Err(ServeError::NoToken {
                address: self.address.ip(),
            }),
        }
    }
}

/// Why a server does not start or has ended.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ServeError {
    /// Other machines reach the address, and nothing says that they may.
    #[error("{address} is not a loopback address: other machines could reach the page")]
    Remote {
        /// The address.
        address: IpAddr,
    },
    /// Other machines may reach the address, and nothing keeps strangers out.
    #[error("{address} is not a loopback address, and there is no token")]
    NoToken {
        /// The address.
        address: IpAddr,
    },
    /// The token is too short, too long or holds other characters than it may.
    #[error("a token has {least} to {most} letters, digits, `-` and `_`")]
    Token {
        /// Fewest characters.
        least: usize,
        /// Most characters.
        most: usize,
    },
    /// The first case is not valid.
    #[error(transparent)]
    Case(#[from] percuss::Error),
    /// The first case has no answer.
    #[error("{message}")]
    NoResult {
        /// What is wrong.
        message: String,
        /// What to do.
        help: String,
    },
    /// The address cannot be taken.
    #[error("cannot listen on {address}: {source}")]
    Listen {
        /// The address.
        address: SocketAddr,
        /// The system's error.
        #[source]
        source: io::Error,
    },
    /// The system gives no threads.
    #[error("cannot start: {0}")]
    Start(#[source] io::Error),
}

impl From<Problem> for ServeError {
    fn from(problem: Problem) -> Self {
        let (message, help) = problem.into_message_and_help();
        Self::NoResult { message, help }
    }
}

impl ServeError {
    /// What to do; empty where there is nothing to say.
    pub fn help(&self) -> String {
        match self {
            Self::Remote { .. } => {
                "serve on 127.0.0.1 and use `ssh -L` from other machines; or give `--allow-remote` and `--token-file`"
                    .to_owned()
            }
            Self::NoToken { .. } => {
                "give `--token-file FILE` with a long random text, for example from `openssl rand -hex 24`".to_owned()
            }
            Self::Token { .. } => "for example from `openssl rand -hex 24`".to_owned(),
            Self::Case(error) => error.message_and_help().1,
            Self::NoResult { help, .. } => help.clone(),
            Self::Listen { address, source } => match source.kind() {
                io::ErrorKind::AddrInUse => format!(
                    "port {} is in use: give another one, or `--port 0` for a free one",
                    address.port()
                ),
                _ => String::new(),
            },
            Self::Start(_) => String::new(),
        }
    }
}
