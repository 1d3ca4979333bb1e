//! Histories and samples as arrays of NumPy that are views of the memory of a result: nothing is copied.

use std::{
    any::Any,
    mem::{offset_of, size_of},
    sync::Arc,
};

use percuss::{
    history::{ElementState, Sample},
    outcome::RunResult,
};
use pyo3::{prelude::*, types::PyDict};

/// A number in each of a row of equal structures.
pub struct Field {
    /// Its name, which ends with the unit.
    pub name: &'static str,
    offset: usize,
    /// Its type as NumPy names it, without the order of bytes.
    kind: &'static str,
}

macro_rules! fields {
    ($row:ty: $($name:literal $kind:ident $($field:ident).+;)*) => {
        &[$(Field {
            name: $name,
            offset: {
                // A field of another type than the one that NumPy is told of does not compile.
                const _: fn(&$row) -> &$kind = |row| &row.$($field).+;
                offset_of!($row, $($field).+)
            },
            kind: fields!(@kind $kind),
        }),*]
    };
    (@kind f64) => { "f8" };
    (@kind u64) => { "u8" };
    (@kind usize) => { match size_of::<usize>() { 8 => "u8", _ => "u4" } };
}

/// The columns of a history.
pub const SAMPLE: &[Field] = fields! { Sample:
    "time_s" f64 time;
    "step" u64 step;
    "tip_velocity_m_s" f64 tip_velocity;
    "tail_velocity_m_s" f64 tail_velocity;
    "interface_velocity_m_s" f64 interface_velocity;
    "back_velocity_m_s" f64 back_velocity;
    "mean_velocity_m_s" f64 mean_velocity;
    "tip_position_m" f64 tip_position;
    "depth_m" f64 depth;
    "projectile_length_m" f64 projectile_length;
    "contact_force_n" f64 contact_force;
    "back_force_n" f64 back_force;
    "energy_initial_j" f64 energy.initial;
    "energy_kinetic_projectile_j" f64 energy.kinetic_projectile;
    "energy_kinetic_target_j" f64 energy.kinetic_target;
    "energy_elastic_projectile_j" f64 energy.elastic_projectile;
    "energy_elastic_target_j" f64 energy.elastic_target;
    "energy_plastic_projectile_j" f64 energy.plastic_projectile;
    "energy_plastic_target_j" f64 energy.plastic_target;
    "energy_border_shear_j" f64 energy.border_shear;
    "energy_viscosity_and_damping_j" f64 energy.viscous;
    "energy_contact_j" f64 energy.contact;
    "energy_through_back_face_j" f64 energy.boundary;
    "energy_eroded_j" f64 energy.eroded;
    "energy_fracture_j" f64 energy.fracture;
    "energy_kinetic_plate_j" f64 energy.kinetic_plate;
    "energy_elastic_plate_j" f64 energy.elastic_plate;
    "energy_plastic_plate_j" f64 energy.plastic_plate;
    "energy_particles_to_grid_j" f64 energy.transfer;
    "momentum_initial_n_s" f64 momentum.initial;
    "momentum_projectile_n_s" f64 momentum.projectile;
    "momentum_target_n_s" f64 momentum.target;
    "momentum_support_n_s" f64 momentum.support;
    "momentum_border_shear_n_s" f64 momentum.border_shear;
    "momentum_eroded_n_s" f64 momentum.eroded;
    "momentum_local_damping_n_s" f64 momentum.damping;
    "momentum_plate_n_s" f64 momentum.plate;
};

/// The columns of a state along the axis.
pub const ELEMENT: &[Field] = fields! { ElementState:
    "part" usize part;
    "initial_position_m" f64 initial_position;
    "position_m" f64 position;
    "length_m" f64 length;
    "stress_pa" f64 stress;
    "strain" f64 strain;
    "plastic_strain" f64 plastic_strain;
    "diameter_m" f64 diameter;
    "temperature_k" f64 temperature;
};

/// A column that NumPy can look at; it keeps the result alive for as long as an array does.
#[pyclass(frozen, module = "percuss._percuss")]
pub struct Column {
    _owner: Arc<dyn Any + Send + Sync>,
    address: usize,
    stride: usize,
    count: usize,
    kind: &'static str,
}

impl Column {
    /// A column of the history.
    pub fn of_samples(result: &Arc<RunResult>, name: &str) -> Option<Self> {
        let history = result.history.as_ref()?;
        Self::new(result, SAMPLE, name, &history.samples)
    }

    /// A column of a state along the axis.
    pub fn of_elements(result: &Arc<RunResult>, index: usize, name: &str) -> Option<Self> {
        let profile = result.history.as_ref()?.profiles.get(index)?;
        Self::new(result, ELEMENT, name, &profile.elements)
    }

    /// A column that stands by itself; `values` belong to `owner`.
    pub fn of_numbers<O: Any + Send + Sync>(owner: &Arc<O>, values: &[f64]) -> Self {
        Self {
            _owner: owner.clone(),
            address: values.as_ptr() as usize,
            stride: size_of::<f64>(),
            count: values.len(),
            kind: "f8",
        }
    }

    fn new<R>(owner: &Arc<RunResult>, fields: &[Field], name: &str, rows: &[R]) -> Option<Self> {
        let field = fields.iter().find(|field| field.name == name)?;
        Some(Self {
            _owner: owner.clone(),
            address: rows.as_ptr() as usize + field.offset,
            stride: size_of::<R>(),
            count: rows.len(),
            kind: field.kind,
        })
    }
}

#[pymethods]
impl Column {
    /// What NumPy asks of memory that it is to look at: a result is never written to again, so the array is read-only.
    #[getter]
    fn __array_interface__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let order = if cfg!(target_endian = "little") {
            "<"
        } else {
            ">"
        };
        let interface = PyDict::new(py);
        interface.set_item("version", 3)?;
        interface.set_item("shape", (self.count,))?;
        interface.set_item("typestr", format!("{order}{}", self.kind))?;
        interface.set_item("data", (self.address, true))?;
        interface.set_item("strides", (self.stride,))?;
        Ok(interface)
    }
}
