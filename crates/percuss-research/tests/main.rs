//! All integration tests of this crate as one program: what it tests is linked once, not once per file.

mod benchmark;
mod codes;
mod damping;
mod pages;
mod paper;
mod strain_rate;
