"""Types of the values of results and histories, for editors and type checkers. Written by reference.py."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from .record import Record

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]


class ResultValues:
    """Values of the result of a run."""

    model: str
    scheme: str
    model_choice: str | None
    target_resistance: str | None
    target_resistance_choice: str | None
    outcome: str
    criterion: str | None
    termination: str | None
    reason: str | None
    impact_velocity_m_s: float
    depth_of_penetration_mm: float | None
    expected_error: Record | None
    largest_depth_mm: float | None
    permanent_depth_mm: float | None
    residual_velocity_m_s: float | None
    flight_direction_deg: float | None
    projectile_axis_deg: float | None
    ballistic_limit_m_s: float | None
    band: Record | None
    projectile_final_length_mm: float | None
    projectile_final_diameter_mm: float | None
    projectile_final_mass_g: float | None
    plug_mass_g: float | None
    plug_velocity_m_s: float | None
    time_to_rest_us: float | None
    peak_force_kn: float | None
    contact_time_us: float | None
    crack_length_mm: float | None
    crack_area_mm2: float | None
    crack_speed_m_s: float | None
    crack_angle_deg: float | None
    broken_bonds: int | None
    pieces: int | None
    largest_piece: float | None
    end_time_us: float | None
    steps: int | None
    time_step_ns: float | None
    smallest_time_step_ns: float | None
    eroded_projectile_elements: int | None
    eroded_target_elements: int | None
    projectile_plastic_strain: float | None
    target_plastic_strain: float | None
    projectile_temperature_k: float | None
    target_temperature_k: float | None
    impact_energy_j: float
    energy_residual: float | None
    momentum_residual: float | None
    fragments: list[Record]
    measured_curves: list[Record]
    details: list[Record]
    warnings: list[str]


class SampleColumns:
    """Columns of a history."""

    time_us: Array
    step: Array
    tip_velocity_m_s: Array
    tail_velocity_m_s: Array
    interface_velocity_m_s: Array
    back_velocity_m_s: Array
    mean_velocity_m_s: Array
    tip_position_mm: Array
    depth_mm: Array
    projectile_length_mm: Array
    contact_force_kn: Array
    back_force_kn: Array
    crack_length_mm: Array
    crack_reach_mm: Array
    energy_initial_j: Array
    energy_kinetic_projectile_j: Array
    energy_kinetic_target_j: Array
    energy_elastic_projectile_j: Array
    energy_elastic_target_j: Array
    energy_plastic_projectile_j: Array
    energy_plastic_target_j: Array
    energy_border_shear_j: Array
    energy_viscosity_and_damping_j: Array
    energy_contact_j: Array
    energy_through_rear_face_j: Array
    energy_eroded_j: Array
    energy_fracture_j: Array
    energy_kinetic_plate_j: Array
    energy_elastic_plate_j: Array
    energy_plastic_plate_j: Array
    energy_particles_to_grid_j: Array
    energy_changes_of_the_time_step_j: Array
    energy_stabilisation_j: Array
    momentum_initial_n_s: Array
    momentum_projectile_n_s: Array
    momentum_target_n_s: Array
    momentum_support_n_s: Array
    momentum_border_shear_n_s: Array
    momentum_eroded_n_s: Array
    momentum_local_damping_n_s: Array
    momentum_plate_n_s: Array


class ElementColumns:
    """Columns of a state along the axis."""

    part: Array
    initial_position_mm: Array
    position_mm: Array
    displacement_mm: Array
    length_mm: Array
    stress_mpa: Array
    strain: Array
    plastic_strain: Array
    diameter_mm: Array
    temperature_k: Array
    velocity_m_s: Array
