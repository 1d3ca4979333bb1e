//! `--fast` and the axisymmetric model by name.

use percuss::axisymmetric;

use crate::failure::Failure;

/// Refuses `--fast` where `axi`, which it leaves out, is named.
pub fn refuse_with_fast(fast: bool, names: &[String]) -> Result<(), Failure> {
    match fast && names.iter().any(|name| name == axisymmetric::MODEL) {
        true => Err(Failure::Usage {
            message: "`--fast` leaves out the axisymmetric model, and `--model axi` names it"
                .to_owned(),
            help: "remove one of the two".to_owned(),
        }),
        false => Ok(()),
    }
}
