//! All integration tests of this crate as one program: what it tests is linked once, not once a file.

mod axi;
mod bad_input;
mod calibrate;
mod compare;
mod docs;
mod figures;
mod help;
mod judge;
mod layout;
mod limit;
mod materials;
mod models;
mod moved;
mod new;
mod readme;
mod reference;
mod reproduce;
mod run;
mod schema;
mod serve;
mod support;
mod sweep;
mod sweep_faults;
mod sweep_plot;
mod uncertainty;
mod validate;
