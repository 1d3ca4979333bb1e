//! Web server and page of `percuss serve`: a case with live results in a browser.
//!
//! [`Server::bind`] checks the options, computes the first case and binds the address; [`Server::run`] serves until the program
//! ends. Everything that the page needs is part of the program. The page reads no files. It uses the same reader and
//! the same models as the command line.
//!
//! ```
//! use percuss_serve::{Options, Server};
//!
//! let server = Server::bind(Options::default())?;
//! assert!(server.address().ip().is_loopback());
//! println!("serving http://{}", server.address());
//! # Ok::<(), percuss_serve::ServeError>(())
//! ```

mod assets;
mod cases;
mod connection;
mod constants;
mod edit;
mod events;
mod files;
mod form;
mod host_guard;
mod http;
mod in_use;
mod index;
mod job;
mod limits;
mod materials;
mod options;
mod pages;
mod problem;
mod refinement;
mod request;
mod response;
mod server;
mod stream;
mod study;

pub use limits::RequestLimits;
pub use options::{Options, ServeError, StartCase};
pub use server::Server;
