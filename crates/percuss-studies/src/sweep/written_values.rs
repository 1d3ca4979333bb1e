//! Values that a file of parameters writes down, tried on the case.

use crate::{case::Template, check::Check, inputs::Axis};

/// Tries every value that the file writes down on the case, one at a time.
pub(crate) fn check_values(axes: &[Axis], template: &Template, check: &mut Check<'_>) {
    // A list of materials may name any of them.
    let materials_vary = axes.iter().any(|axis| axis.key.ends_with(".material"));
    for (i, axis) in axes.iter().enumerate() {
        // The same key twice has been found before.
        let is_same =
            |other: &&Axis| other.key != axis.key && template.is_same_number(&other.key, &axis.key);
        if let Some(other) = axes[..i].iter().find(is_same) {
            let message = format!("`{}` and `{}` are one number", other.key, axis.key);
            check.fail(
                &format!("parameter.{i}.key"),
                message,
                "remove one of the two",
            );
            return;
        }
        for (key, value) in &axis.samples {
            let written = axis.written(*value);
            let Err(diagnostics) = template.scenario(&[(&axis.key, written.clone())]) else {
                continue;
            };
            if let Some(diagnostic) = diagnostics.into_iter().next() {
                let said = &diagnostic.message;
                if said.starts_with("unknown key") || said.ends_with("was renamed") {
                    let place = format!("parameter.{i}.key");
                    check.fail(&place, diagnostic.message, diagnostic.help);
                    return;
                }
                let of = match diagnostic.key.as_str() {
                    "" => axis.key.clone(),
                    key => key.to_owned(),
                };
                let message = format!(
                    "with {} = {written} the case is not valid: `{of}`: {}",
                    axis.key, diagnostic.message
                );
                check.fail(&format!("parameter.{i}.{key}"), message, diagnostic.help);
                return;
            }
        }
        if let Some(id) = template
            .unused_material(&axis.key)
            .filter(|_| !materials_vary)
        {
            let message = format!(
                "`{}` has no effect: no part of the case is of `{id}`",
                axis.key
            );
            let help = "name a material of the projectile or the target";
            check.fail(&format!("parameter.{i}.key"), message, help);
            return;
        }
    }
}
