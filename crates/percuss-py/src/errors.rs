//! Failures as Python exceptions, with the messages of the program.

use percuss::{Error, Subject};
use percuss_cli::Failure;
use pyo3::{exceptions::PyKeyboardInterrupt, prelude::*, types::PyDict};

/// The exception of a failure.
pub fn raise(py: Python<'_>, failure: impl Into<Failure>) -> PyErr {
    let failure = failure.into();
    let attributes = PyDict::new(py);
    let class = match describe(&failure, &attributes) {
        Ok(Some(class)) => class,
        Ok(None) => return PyKeyboardInterrupt::new_err(()),
        Err(error) => return error,
    };
    let text = as_argument(failure.plain_text().trim_end());
    let made = py
        .import("percuss.errors")
        .and_then(|module| module.getattr(class))
        .and_then(|class| class.call((text,), None));
    match made {
        Ok(exception) => {
            for (name, value) in &attributes {
                if let Err(error) = exception.setattr(name.to_string().as_str(), value) {
                    return error;
                }
            }
            PyErr::from_value(exception)
        }
        Err(error) => error,
    }
}

/// A message about an option of the command line as one about the argument of a function.
fn as_argument(text: &str) -> String {
    let hint = "For more information, try '--help'.";
    let text = text.strip_suffix(hint).unwrap_or(text).trim_end();
    let option = text
        .split_once("'--")
        .and_then(|(before, rest)| Some((before, rest.split_once('\'')?)));
    let Some((before, (option, after))) = option else {
        return text.to_owned();
    };
    let name = option.split([' ', '=']).next().unwrap_or_default();
    format!("{before}`{}`{after}", name.replace('-', "_"))
}

/// The name of the exception's class, `None` for a run that its caller stopped; what it carries goes into `attributes`.
fn describe(failure: &Failure, attributes: &Bound<'_, PyDict>) -> PyResult<Option<&'static str>> {
    Ok(Some(match failure {
        Failure::Library(Error::Cancelled { .. }) => return Ok(None),
        Failure::Library(Error::Input(error)) => {
            attributes.set_item("file", &error.file)?;
            attributes.set_item("line", error.line())?;
            attributes.set_item("key", &error.key)?;
            attributes.set_item("message", &error.message)?;
            attributes.set_item("help", &error.help)?;
            match error.subject {
                Subject::Material | Subject::MaterialFile => "MaterialError",
                Subject::Case | Subject::CaseFile => "CaseError",
            }
        }
        Failure::Library(Error::NotApplicable { model, refusal }) => {
            attributes.set_item("model", model)?;
            attributes.set_item("reason", refusal.to_string())?;
            "NotApplicableError"
        }
        Failure::Library(Error::NoModelApplies { reasons, .. }) => {
            let (model, reason) = reasons.first().cloned().unwrap_or_default();
            attributes.set_item("model", model)?;
            attributes.set_item("reason", reason)?;
            "NotApplicableError"
        }
        Failure::Library(Error::Numerical(error)) => {
            attributes.set_item("message", &error.what)?;
            attributes.set_item("step", error.step)?;
            attributes.set_item("time_us", error.time_us)?;
            attributes.set_item("element", error.element)?;
            attributes.set_item("help", &error.remedy)?;
            "NumericalError"
        }
        Failure::Library(Error::Read {
            path,
            reason,
            remedy,
            ..
        }) => {
            attributes.set_item("filename", path)?;
            attributes.set_item("message", reason)?;
            attributes.set_item("help", remedy)?;
            "ReadError"
        }
        Failure::Write { path, reason, .. } => {
            attributes.set_item("filename", path)?;
            attributes.set_item("message", reason)?;
            "WriteError"
        }
        Failure::Material { message, help } => {
            attributes.set_item("message", message)?;
            attributes.set_item("help", help)?;
            "MaterialError"
        }
        _ => "UsageError",
    }))
}
