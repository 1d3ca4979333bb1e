//! What a step does to a whole projectile and the far field at once: nothing damps them, and nothing parts.

use pulp::NullaryFnOnce;

use super::{
    block,
    far_field::{self, FarField},
    rod::Rod,
};

/// Collects the forces on the nodes of both and gives new velocities to all but the tip and the mouth, as collecting and kicking one after
/// the other do.
pub(super) struct Push<'a> {
    pub(super) rod: &'a mut Rod,
    pub(super) far_field: &'a mut FarField,
    pub(super) kick: f64,
}

impl NullaryFnOnce for Push<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Self {
            rod,
            far_field,
            kick,
        } = self;
        block::push(rod, kick);
        far_field::push(far_field, kick);
    }
}

/// Moves both on; gives what [`block::Drift`] does.
pub(super) struct Drift<'a> {
    pub(super) rod: &'a mut Rod,
    pub(super) far_field: &'a mut FarField,
    pub(super) time_step: f64,
}

impl NullaryFnOnce for Drift<'_> {
    type Output = Result<f64, usize>;

    #[inline(always)]
    fn call(self) -> Result<f64, usize> {
        let Self {
            rod,
            far_field,
            time_step,
        } = self;
        let ground = far_field::Drift {
            far_field,
            time_step,
        };
        ground.call();
        block::Drift { rod, time_step }.call()
    }
}
