//! Limit of the memory of a run, from the environment.

use percuss::model::memory::{MEMORY_VARIABLE, parse_size, set_memory_limit};

use crate::failure::Failure;

/// Sets the limit of the memory of a run by the variable of the environment, if it is there.
///
/// # Errors
/// [`Failure::Usage`] for a value that is no size.
pub fn limit_memory() -> Result<(), Failure> {
    let Some(value) = std::env::var_os(MEMORY_VARIABLE) else {
        return Ok(());
    };
    let value = value.to_string_lossy();
    let bytes = parse_size(&value).ok_or_else(|| Failure::Usage {
        message: format!("{MEMORY_VARIABLE} = `{value}` is no size"),
        help: "write it as \"16 GiB\" or \"500 MiB\"".to_owned(),
    })?;
    set_memory_limit(bytes);
    Ok(())
}
