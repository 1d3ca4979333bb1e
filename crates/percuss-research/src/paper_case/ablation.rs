//! What the difference between paper and reference consists of: one-dimensional models that differ in one thing at a time.

use percuss::{
    Error,
    model::{self, Control},
};
use serde::Serialize;

use super::{SPEEDS, Study, depth, scenario};

/// A variant of the one-dimensional model.
struct Variant {
    name: &'static str,
    /// In what it differs from the one before.
    change: &'static str,
    /// Its options.
    options: &'static str,
}

/// From the paper's scheme to the expanding cavity.
const VARIANTS: &[Variant] = &[
    Variant {
        name: "published scheme",
        change: "the paper's equations as printed",
        options: "[chain]\nscheme = \"published\"\n",
    },
    Variant {
        name: "column, small strain",
        change: "balanced books and plastic unloading; elements erode at a strain of 0.9, before they turn inside out",
        options: "[chain]\ntarget_resistance = \"column\"\nkinematics = \"small-strain\"\nerosion_strain = 0.9\n",
    },
    Variant {
        name: "column",
        change: "large strain: elements thicken as they shorten and erode at a strain of 2",
        options: "[chain]\ntarget_resistance = \"column\"\n",
    },
    Variant {
        name: "column, no border shear",
        change: "no shear on the border of the column",
        options: "[chain]\ntarget_resistance = \"column\"\nborder_shear = 0.0\n",
    },
    Variant {
        name: "column, no border shear, factor 1",
        change: "no constraint factor: the bare one-dimensional column",
        options: "[chain]\ntarget_resistance = \"column\"\nborder_shear = 0.0\nconstraint_factor = 1.0\n",
    },
    Variant {
        name: "diverging",
        change: "the target widens as a cone of the half-space's stiffness",
        options: "[chain]\ntarget_resistance = \"diverging\"\n",
    },
    Variant {
        name: "diverging-penetrable",
        change: "the tip penetrates the cone",
        options: "[chain]\ntarget_resistance = \"diverging-penetrable\"\n",
    },
    Variant {
        name: "expanding-cavity",
        change: "the crater floor advances against an expanding cavity, under a rod that takes time to widen",
        options: "[chain]\ntarget_resistance = \"expanding-cavity\"\n",
    },
];

/// Name of the reference in the table.
pub const REFERENCE: &str = "axi";

/// A line of the ablation table.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Line {
    /// Impact speed [m/s].
    pub impact_velocity_m_s: f64,
    /// Name of the variant.
    pub variant: &'static str,
    /// In what it differs from the one before.
    pub change: &'static str,
    /// Depth of penetration [mm].
    pub depth_of_penetration_mm: f64,
    /// Relative error against the reference, where there is one.
    pub error: Option<f64>,
}

/// The paper's case by every variant, and by the reference of a study at the end of each speed. A variant that fails is left out.
///
/// # Errors
/// [`Error::Input`] when the library has no such materials.
pub fn ablation(study: &[Study]) -> Result<Vec<Line>, Error> {
    let mut lines = Vec::new();
    for &speed in SPEEDS {
        let reference = depth(study, speed).map(|estimate| estimate.depth_mm);
        let mut add = |variant, change, depth: f64| {
            lines.push(Line {
                impact_velocity_m_s: speed,
                variant,
                change,
                depth_of_penetration_mm: depth,
                error: reference.map(|reference| depth / reference - 1.0),
            });
        };
        for variant in VARIANTS {
            let scenario = scenario(speed, variant.options)?;
            let chain = model::model("chain")?;
            let run = model::run(chain, &scenario, &mut Control::default());
            if let Some(depth) = run.ok().and_then(|result| result.depth_of_penetration) {
                add(variant.name, variant.change, depth * 1e3);
            }
        }
        if let Some(reference) = reference {
            add(
                REFERENCE,
                "axisymmetric: not one-dimensional any more",
                reference,
            );
        }
    }
    Ok(lines)
}
