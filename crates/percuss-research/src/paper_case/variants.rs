//! Case of the seed paper by one-dimensional models that differ in one change at a time, from its scheme to the expanding cavity.

use percuss::{
    Error,
    model::{self, Control},
};
use serde::Serialize;

use super::{PaperCaseRow, SPEEDS, depth, scenario};

/// A variant of the one-dimensional model.
struct Variant {
    name: &'static str,
    /// Difference from the previous variant.
    change: &'static str,
    /// Options of the case.
    options: &'static str,
}

/// Variants from the scheme of the paper to the expanding cavity.
const VARIANTS: &[Variant] = &[
    Variant {
        name: "published scheme",
        change: "the paper's equations as printed",
        options: "[chain]\nscheme = \"published\"\n",
    },
    Variant {
        name: "column, small strain",
        change: "closed energy balance and plastic unloading; elements erode at a strain of 0.9, before they invert",
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
        change: "no constraint factor: one-dimensional column without any confinement",
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

/// Depth by one variant.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct VariantResult {
    /// Impact velocity [m/s].
    pub impact_velocity_m_s: f64,
    /// Name of the variant.
    pub variant: &'static str,
    /// Difference from the previous variant.
    pub change: &'static str,
    /// Depth of penetration [mm].
    pub depth_of_penetration_mm: f64,
    /// Relative error against the reference, where there is one.
    pub error: Option<f64>,
}

/// Depths by every variant at every impact velocity, each followed by the reference. A variant that fails is left out.
///
/// # Errors
/// [`Error::Input`] when the library has no such materials.
pub fn compute(rows: &[PaperCaseRow]) -> Result<Vec<VariantResult>, Error> {
    let mut lines = Vec::new();
    for &speed in SPEEDS {
        let reference = depth(rows, speed).map(|estimate| estimate.depth_mm);
        let mut add = |variant, change, depth: f64| {
            lines.push(VariantResult {
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
            add(REFERENCE, "two-dimensional axisymmetric", reference);
        }
    }
    Ok(lines)
}
