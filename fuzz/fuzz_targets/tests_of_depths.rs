#![no_main]

percuss_fuzz::guided!();
