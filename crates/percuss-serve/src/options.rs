//! What a server is told to do, and what can keep it from doing so.

use std::{
    io,
    net::{IpAddr, Ipv4Addr, SocketAddr},
};

use crate::{Bounds, problem::Problem};

/// Fewest characters of a token: enough that nobody guesses it.
const LEAST_TOKEN: usize = 16;
/// Most characters of a token.
const MOST_TOKEN: usize = 200;

/// How a server is set up.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// Address to listen on; port 0 takes a free one.
    pub address: SocketAddr,
    /// Whether an address that other machines reach is allowed.
    pub allow_remote: bool,
    /// What every request has to know; none on an address that this machine alone reaches.
    pub token: Option<String>,
    /// Names by which browsers may address the server, beside IP addresses and `localhost`.
    pub host_names: Vec<String>,
    /// What a request may ask for.
    pub bounds: Bounds,
    /// The case that the page opens on; the seed paper's when not given.
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
            bounds: Bounds::default(),
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
    #[error("{address} is not a loopback address, and there is no token to keep strangers out")]
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
    NoAnswer {
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
        Self::NoAnswer { message, help }
    }
}

impl ServeError {
    /// What to do; empty where there is nothing to say.
    pub fn help(&self) -> String {
        match self {
            Self::Remote { .. } => {
                "serve on 127.0.0.1, to which `ssh -L` leads from elsewhere; or say `--allow-remote` and give `--token-file`"
                    .to_owned()
            }
            Self::NoToken { .. } => {
                "give `--token-file FILE` with a long random word in it, for example from `openssl rand -hex 24`".to_owned()
            }
            Self::Token { .. } => "for example from `openssl rand -hex 24`".to_owned(),
            Self::Case(error) => error.message_and_help().1,
            Self::NoAnswer { help, .. } => help.clone(),
            Self::Listen { address, source } => match source.kind() {
                io::ErrorKind::AddrInUse => format!(
                    "something else listens on port {}: give another one, or `--port 0` for one that is free",
                    address.port()
                ),
                _ => String::new(),
            },
            Self::Start(_) => String::new(),
        }
    }
}
