//! A page that answers while its user drags: `percuss` in a browser, served by the program itself.
//!
//! [`Server::bind`] checks the options, computes the first answer and takes the address; [`Server::run`] serves until the program
//! ends. Everything that the page needs is part of the program. The page reads no files, and answers come from the same reader
//! and the same models as on the command line.
//!
//! ```
//! use percuss_serve::{Options, Server};
//!
//! let server = Server::bind(Options::default())?;
//! assert!(server.address().ip().is_loopback());
//! println!("serving http://{}", server.address());
//! # Ok::<(), percuss_serve::ServeError>(())
//! ```

mod answer;
mod assets;
mod bounds;
mod cases;
mod constants;
mod edit;
mod files;
mod form;
mod gate;
mod http;
mod index;
mod listen;
mod options;
mod pages;
mod problem;
mod request;
mod stream;
mod study;
mod worker;

pub use bounds::Bounds;
pub use listen::Server;
pub use options::{Options, ServeError, StartCase};
