//! The fields of a result, in the order of JSON: the one list that files, tables, sweeps, studies and Python take them from.

use serde::Serialize;

use super::number::{
    FieldType,
    InStatistics::{NotPerforated, ZeroWhereStopped},
    NumberType, ResultField, ResultNumber,
    Role::{Detail, Input, Main, Numerics, Result},
};
use crate::{
    fragments::FragmentRecord,
    measured_curves::CurveComparison,
    model_error::ModelErrorEstimate,
    outcome::{Band, Detail as ModelDetail, Outcome, RunResult, Termination},
    scenario::Scenario,
    units::ResultUnit as Unit,
};

/// Declares the record and [`RESULT_FIELDS`]. A number has a label, a unit and a role, and is read in SI units from the case and the run.
macro_rules! result_record {
    (
        $(#[$of_record:meta])*
        pub struct $record:ident {$(
            $(#[doc = $doc:literal])+
            $name:ident: $type:ty $(= $number:expr, $si:expr)?;
        )+}
    ) => {
        $(#[$of_record])*
        pub struct $record {
            $( $(#[doc = $doc])+ pub $name: $type, )+
        }

        /// The fields of a result in the order of JSON. Adding a result number is one entry in this file.
        pub static RESULT_FIELDS: &[ResultField] = &[
            $( ResultField::new(
                stringify!($name),
                concat!($($doc),+),
                <$type as FieldType>::KIND,
                result_record!(@number $name $type $(, $number, $si)?),
            ) ),+
        ];

        impl $record {
            /// The record with its numbers alone. Without a run, only the case gives any.
            pub(super) fn of_numbers(scenario: &Scenario, run: Option<&RunResult>) -> Self {
                Self { $( $name: result_record!(@value (scenario, run) $type $(, $number, $si)?) ),+ }
            }
        }
    };
    (@number $name:ident $type:ty) => { None };
    (@number $name:ident $type:ty, $number:expr, $si:expr) => {
        Some(ResultNumber {
            name: stringify!($name),
            of_record: |record| record.$name.value(),
            of_run: |case, run| result_record!(@value (case, Some(run)) $type, $number, $si).value(),
            ..$number
        })
    };
    (@value ($scenario:expr, $run:expr) $type:ty) => { <$type>::default() };
    (@value ($scenario:expr, $run:expr) $type:ty, $number:expr, $si:expr) => {{
        const NUMBER: ResultNumber = $number;
        let si: fn(&Scenario, Option<&RunResult>) -> $type = $si;
        si($scenario, $run).in_unit(NUMBER.unit)
    }};
}

/// A number with its label, unit and role.
const fn number(label: &'static str, unit: Unit, role: super::Role) -> ResultNumber {
    ResultNumber::new(label, unit, role)
}

/// What a solver with time steps counts.
fn numerics(run: Option<&RunResult>) -> Option<&crate::outcome::Numerics> {
    run?.numerics.as_ref()
}

result_record! {
    /// Results of one model. The names are stable; a number that the model does not give is null.
    #[derive(Debug, Clone, PartialEq, Serialize)]
    #[non_exhaustive]
    pub struct ResultRecord {
        /// Name of the model.
        model: &'static str;
        /// Scheme of the model.
        scheme: &'static str;
        /// Reason why it is this model and not the default one, where the run names none; null otherwise.
        model_choice: Option<String>;
        /// Target resistance model (`chain.target_resistance`), where there is a choice of it.
        target_resistance: Option<&'static str>;
        /// Reason why that is not the usual one, where the case names none, with the depth by the usual one if it differs by more than a tenth;
        /// null otherwise, and where models are compared.
        target_resistance_choice: Option<String>;
        /// Outcome of the run.
        outcome: Outcome;
        /// Criterion of the outcome, in words; null where it is the termination alone.
        criterion: Option<String>;
        /// Reason for which the run ended.
        termination: Option<Termination>;
        /// Reason why there is no result, if there is none.
        reason: Option<String>;

        /// Impact velocity.
        impact_velocity_m_s: f64
            = number("impact velocity", Unit::M_S, Input), |case, _| case.impact_velocity;

        /// Depth of the crater floor in a target that is not perforated, when the projectile's momentum is used up.
        depth_of_penetration_mm: Option<f64>
            = number("depth of penetration", Unit::MM, Main).in_statistics(NotPerforated).known_at_rest(), |_, run| run?.depth_of_penetration;

        /// Estimated error of that depth against the axisymmetric reference, where similar cases are in the benchmark.
        expected_error: Option<ModelErrorEstimate>;

        /// Largest depth at any time in a target that is not perforated, elastic deflection included.
        largest_depth_mm: Option<f64>
            = number("largest depth", Unit::MM, Result).in_statistics(NotPerforated), |_, run| run?.largest_depth;

        /// Depth in a target that is not perforated, once the load is gone.
        permanent_depth_mm: Option<f64>
            = number("permanent depth", Unit::MM, Result).in_statistics(NotPerforated), |_, run| run?.permanent_depth;

        /// Mean velocity of what is left of the projectile at the end, forward positive.
        residual_velocity_m_s: Option<f64>
            = number("residual velocity", Unit::M_S, Main).in_statistics(ZeroWhereStopped), |_, run| run?.residual_velocity;

        /// Direction of flight at the end, to the normal into the target, of a projectile that is free to turn.
        flight_direction_deg: Option<f64>
            = number("direction of flight", Unit::DEG, Result), |_, run| run?.flight_direction;

        /// Direction of its axis at the end, to the same normal.
        projectile_axis_deg: Option<f64>
            = number("direction of the projectile's axis", Unit::DEG, Result), |_, run| run?.projectile_axis;

        /// Impact velocity above which the target is perforated.
        ballistic_limit_m_s: Option<f64>
            = number("ballistic limit", Unit::M_S, Main), |_, run| run?.ballistic_limit;

        /// Range that the model gives its main number; `chain` gives it in `percuss run` alone.
        band: Option<Band>;

        /// Unloaded length of what is left of the projectile.
        projectile_final_length_mm: Option<f64>
            = number("final projectile length", Unit::MM, Main), |_, run| run?.projectile_final_length;

        /// Largest unloaded diameter of what is left of the projectile.
        projectile_final_diameter_mm: Option<f64>
            = number("final projectile diameter", Unit::MM, Result), |_, run| run?.projectile_final_diameter;

        /// Mass left of the projectile.
        projectile_final_mass_g: Option<f64>
            = number("final projectile mass", Unit::G, Result), |_, run| run?.projectile_final_mass;

        /// Mass of the ejected plug.
        plug_mass_g: Option<f64>
            = number("mass of the plug", Unit::G, Result), |_, run| run?.plug_mass;

        /// Velocity of the ejected plug.
        plug_velocity_m_s: Option<f64>
            = number("velocity of the plug", Unit::M_S, Result), |_, run| run?.plug_velocity;

        /// Time at which the projectile's momentum is used up.
        time_to_rest_us: Option<f64>
            = number("time to rest", Unit::US, Result).known_at_rest(), |_, run| run?.time_to_rest;

        /// Largest force between projectile and target.
        peak_force_kn: Option<f64>
            = number("peak force", Unit::KN, Result), |_, run| run?.peak_force;

        /// Total time of contact between projectile and target, without pauses; to the end of a run that ends before they part.
        contact_time_us: Option<f64>
            = number("contact time", Unit::US, Result), |_, run| run?.contact_time;

        /// Length of a straight crack that takes as many bonds as are broken.
        crack_length_mm: Option<f64>
            = number("length of the cracks", Unit::MM, Result), |_, run| run?.cracks?.length;

        /// Area of a plane crack that takes as many bonds as are broken, of a body in space.
        crack_area_mm2: Option<f64>
            = number("area of the cracks", Unit::MM2, Result), |_, run| run?.cracks?.area;

        /// Mean speed of the farthest crack tip from a tenth to nine tenths of its way.
        crack_speed_m_s: Option<f64>
            = number("speed of the crack tip", Unit::M_S, Result), |_, run| run?.cracks?.tip_speed;

        /// Angle between the cracks that start at notches and the notches, the mean over them.
        crack_angle_deg: Option<f64>
            = number("angle of the cracks to the notches", Unit::DEG, Result), |_, run| run?.cracks?.angle;

        /// Bonds between particles that are broken, without those of notches.
        broken_bonds: Option<usize>
            = number("broken bonds", Unit::NONE, Detail), |_, run| Some(run?.cracks?.broken_bonds);

        /// Pieces of a body that no bond holds together, single particles included.
        pieces: Option<usize>
            = number("pieces", Unit::NONE, Result), |_, run| Some(run?.cracks?.pieces);

        /// Mass of the largest piece over that of the body.
        largest_piece: Option<f64>
            = number("largest piece over the body", Unit::NONE, Result), |_, run| Some(run?.cracks?.largest_piece);

        /// Time at the end of the run.
        end_time_us: Option<f64>
            = number("time at the end", Unit::US, Detail), |_, run| run?.end_time;

        /// Time steps taken.
        steps: Option<u64>
            = number("time steps", Unit::NONE, Numerics), |_, run| Some(numerics(run)?.steps);

        /// First time step.
        time_step_ns: Option<f64>
            = number("first time step", Unit::NS, Numerics), |_, run| Some(numerics(run)?.first_time_step);

        /// Smallest time step.
        smallest_time_step_ns: Option<f64>
            = number("smallest time step", Unit::NS, Numerics), |_, run| Some(numerics(run)?.smallest_time_step);

        /// Elements of the projectile that eroded.
        eroded_projectile_elements: Option<usize>
            = number("eroded elements of the projectile", Unit::NONE, Detail), |_, run| Some(numerics(run)?.eroded_elements.0);

        /// Elements of the target that eroded.
        eroded_target_elements: Option<usize>
            = number("eroded elements of the target", Unit::NONE, Detail), |_, run| Some(numerics(run)?.eroded_elements.1);

        /// Largest plastic strain in the projectile.
        projectile_plastic_strain: Option<f64>
            = number("largest plastic strain of the projectile", Unit::NONE, Detail), |_, run| Some(numerics(run)?.largest_plastic_strain.0);

        /// Largest plastic strain in the target.
        target_plastic_strain: Option<f64>
            = number("largest plastic strain of the target", Unit::NONE, Detail), |_, run| Some(numerics(run)?.largest_plastic_strain.1);

        /// Largest temperature in the projectile.
        projectile_temperature_k: Option<f64>
            = number("largest temperature of the projectile", Unit::K, Detail), |_, run| Some(numerics(run)?.largest_temperature.0);

        /// Largest temperature in the target.
        target_temperature_k: Option<f64>
            = number("largest temperature of the target", Unit::K, Detail), |_, run| Some(numerics(run)?.largest_temperature.1);

        /// Kinetic energy at impact.
        impact_energy_j: f64
            = number("kinetic energy at impact", Unit::J, Input), |case, _| 0.5 * case.projectile.mass * case.impact_velocity.powi(2);

        /// Energy balance error: largest part of the initial energy that is not accounted for.
        energy_residual: Option<f64>
            = number("energy residual", Unit::NONE, Detail), |_, run| Some(numerics(run)?.energy_residual);

        /// Momentum balance error: largest part of the initial momentum that is not accounted for.
        momentum_residual: Option<f64>
            = number("momentum residual", Unit::NONE, Detail), |_, run| Some(numerics(run)?.momentum_residual);

        /// Fragments that fly free at the end, from the projectile's tail to the target's rear face; of `particles` from the largest to the smallest.
        fragments: Vec<FragmentRecord>;
        /// Differences from the measured curves of the case; empty at another impact velocity.
        measured_curves: Vec<CurveComparison>;
        /// Numbers that this model alone has.
        details: Vec<ModelDetail>;
        /// Warnings: Limitations of the numbers.
        warnings: Vec<String>;
    }
}
