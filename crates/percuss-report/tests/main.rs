//! All integration tests of this crate as one program: what it tests is linked once, not once a file.

mod cases;
mod charts;
mod compare;
