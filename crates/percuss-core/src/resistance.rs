//! Penetration resistance law of the caller's own.

use std::{fmt, ptr, sync::Arc};

/// A law of resistance: pressure on the crater floor under the projectile.
pub trait ResistanceLaw {
    /// Pressure on the floor [Pa], inertia of the target included, at a permanent depth of the crater [m] and while the floor advances
    /// at a speed [m/s], which is never negative. Below that pressure the floor stands.
    fn pressure(&self, depth: f64, speed: f64) -> f64;

    /// Text that differs between laws with different results, numbers with all their digits included: a checkpoint belongs to it. `None`
    /// refuses checkpoints.
    fn fingerprint(&self) -> Option<String> {
        None
    }
}

/// A law of the caller's own. No file can name it, and it equals itself only.
///
/// Model `chain` takes it in its target resistance model `expanding-cavity`, instead of the pressure of the expanding cavity; what the
/// projectile has spread beyond its own area presses with its flow stress, and no harder than the law.
///
/// ```
/// use std::sync::Arc;
/// use percuss::{case, model::{self, Control}, resistance::{CustomResistance, ResistanceLaw}};
///
/// struct Constant;
///
/// impl ResistanceLaw for Constant {
///     fn pressure(&self, _depth: f64, _speed: f64) -> f64 {
///         2e9
///     }
/// }
///
/// let mut scenario = case::load_str("case", "
///     projectile = { material = 'copper', length = '12.74 mm', diameter = '4.8 mm', impact_velocity = '230 m/s' }
///     target = { material = 'aluminium-2024-t351', thickness = '25 mm' }
/// ")?;
/// scenario.resistance = Some(CustomResistance(Arc::new(Constant)));
/// let result = model::run(model::model("chain")?, &scenario, &mut Control::default())?;
/// assert!(result.depth_of_penetration.is_some_and(|depth| depth > 0.0));
/// # Ok::<(), percuss::Error>(())
/// ```
#[derive(Clone)]
pub struct CustomResistance(pub Arc<dyn ResistanceLaw + Send + Sync>);

impl PartialEq for CustomResistance {
    fn eq(&self, other: &Self) -> bool {
        ptr::addr_eq(Arc::as_ptr(&self.0), Arc::as_ptr(&other.0))
    }
}

impl fmt::Debug for CustomResistance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a law of the caller's own")
    }
}
