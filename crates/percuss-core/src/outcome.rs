//! Result of a run: outcome, numbers, balances and warnings.

use serde::Serialize;

use crate::{
    fragments::Fragment,
    history::History,
    ledger::{EnergyLedger, MomentumLedger},
    shapes::Shapes,
    units::ResultUnit,
};

/// Part of the impact velocity below which a projectile counts as stopped.
pub const REST_FRACTION: f64 = 0.01;

/// Outcome of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// The projectile stopped: its mean speed is within 1 % of the impact velocity around zero.
    AtRest,
    /// The projectile left the target backwards.
    Rebounded,
    /// The target moved away from the projectile, which still moves forward.
    Separated,
    /// The crater floor passed the original rear face of the target, or a plug left it: the hole is open, whether or not the projectile
    /// follows.
    Perforated,
    /// Nothing of the projectile is left.
    ProjectileEroded,
    /// The run ended before the impact was over.
    #[default]
    OutOfTime,
    /// The model does not apply.
    NotApplicable,
    /// The model failed on this case.
    Failed,
}

impl Outcome {
    /// Whether the target was perforated, where that can be said.
    pub fn perforated(self) -> Option<bool> {
        match self {
            Self::Perforated => Some(true),
            Self::AtRest | Self::Rebounded | Self::ProjectileEroded => Some(false),
            Self::Separated | Self::OutOfTime | Self::NotApplicable | Self::Failed => None,
        }
    }

    /// The outcome in words.
    pub fn describe(self) -> &'static str {
        match self {
            Self::AtRest => "at rest",
            Self::Rebounded => "rebounded",
            Self::Separated => "separated, moving forward",
            Self::Perforated => "perforated",
            Self::ProjectileEroded => "projectile eroded",
            Self::OutOfTime => "out of time",
            Self::NotApplicable => "not applicable",
            Self::Failed => "failed",
        }
    }
}

/// Why a run was ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Termination {
    /// The tip has stopped and neither depth nor dissipated energy grew over a round trip of a wave in the projectile.
    Quiescent,
    /// Projectile and target have separated without further contact, and their vibrations dissipate almost nothing.
    Parted,
    /// The tip's speed reached zero (scheme `published`, paper section 3.6).
    TipStopped,
    /// The crater floor passed the original rear face.
    PassedBackFace,
    /// No border shear holds the plug any more, and projectile and plug fly at their final speeds.
    PlugFree,
    /// The last of the projectile eroded.
    ProjectileConsumed,
    /// The resistance of the target holds what is left of the projectile.
    PenetrationStopped,
    /// The projectile left the target through its back.
    LeftTarget,
    /// The projectile's momentum is used up, where `end_at_rest` ends the run.
    AtRest,
    /// The answer is a formula.
    ClosedForm,
    /// `end_time` was reached.
    #[default]
    EndTime,
    /// `max_steps` was reached.
    StepLimit,
    /// Nothing moves: the impact velocity is zero.
    NothingMoves,
}

impl Termination {
    /// The reason in words.
    pub fn describe(self) -> &'static str {
        match self {
            Self::Quiescent => {
                "tip stopped; neither depth nor dissipation grew over a round trip of a wave"
            }
            Self::Parted => "projectile and target have separated: no further contact",
            Self::TipStopped => "the tip's speed reached zero",
            Self::PassedBackFace => "crater floor passed the original rear face",
            Self::PlugFree => "no border shear is left; projectile and plug fly freely",
            Self::ProjectileConsumed => "the last of the projectile eroded",
            Self::PenetrationStopped => {
                "the target's resistance holds what is left of the projectile"
            }
            Self::LeftTarget => "the projectile left the target through its back",
            Self::AtRest => {
                "the projectile's momentum is used up, where `end_at_rest` ends the run"
            }
            Self::ClosedForm => "the answer is a formula",
            Self::EndTime => "end_time reached",
            Self::StepLimit => "max_steps reached",
            Self::NothingMoves => "impact velocity is zero",
        }
    }
}

/// The result of one model on one case; a number that the model does not give is `None`.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct RunResult {
    /// Name of the model.
    pub model: &'static str,
    /// Scheme of the model.
    pub scheme: &'static str,
    /// Why it is this model and not the default one, of a run that names none; `None` otherwise.
    pub model_choice: Option<String>,
    /// Why the target resistance model is not the usual one, of a case that names none, and the depth by that one if it differs by more than a
    /// tenth; `None` otherwise.
    pub target_resistance_choice: Option<String>,
    /// Outcome of the run.
    pub outcome: Outcome,
    /// Termination criterion, in words; empty where the model names nothing beyond its termination.
    pub criterion: String,
    /// Why the run was ended.
    pub termination: Termination,
    /// Depth of the crater floor below the original face when the projectile's momentum is used up [m].
    ///
    /// The largest depth reached when the run ends before that; `None` for a rigid wall and a perforated target.
    pub depth_of_penetration: Option<f64>,
    /// Largest depth of the crater floor at any time, elastic deflection included [m]; `None` for a rigid wall and a perforated target.
    pub largest_depth: Option<f64>,
    /// Depth that plastic flow and erosion leave once the load is gone [m]; `None` for a perforated target.
    pub permanent_depth: Option<f64>,
    /// Mean speed of what is left of the projectile at the end, forward positive [m/s].
    pub residual_velocity: Option<f64>,
    /// Angle at the end of a free projectile's path to the normal into the target [rad].
    pub flight_direction: Option<f64>,
    /// Angle at the end of its axis to that normal [rad].
    pub projectile_axis: Option<f64>,
    /// Impact velocity above which the target is perforated [m/s].
    pub ballistic_limit: Option<f64>,
    /// Range that the model gives its main number: where its own constants are uncertain.
    pub band: Option<Band>,
    /// Length of what is left of the projectile, unloaded [m].
    pub projectile_final_length: Option<f64>,
    /// Largest diameter of what is left of the projectile, unloaded [m].
    pub projectile_final_diameter: Option<f64>,
    /// Mass left of the projectile [kg].
    pub projectile_final_mass: Option<f64>,
    /// Mass of the plug that is ejected from a plate [kg].
    pub plug_mass: Option<f64>,
    /// Its speed [m/s].
    pub plug_velocity: Option<f64>,
    /// Time at which the projectile's momentum was used up [s].
    pub time_to_rest: Option<f64>,
    /// Largest force between projectile and target [N].
    pub peak_force: Option<f64>,
    /// Total time during which projectile and target touch, pauses left out [s]; to the end of a run that ends before they part.
    pub contact_time: Option<f64>,
    /// Time at the end [s].
    pub end_time: Option<f64>,
    /// Pieces that fly free at the end, from the projectile's tail to the target's back, or those of cracks from the largest to the smallest;
    /// empty from a model that follows none.
    pub fragments: Vec<Fragment>,
    /// Cracks at the end, from a model whose solids break.
    pub cracks: Option<Cracks>,
    /// Numbers that this model alone has, in its own order.
    pub details: Vec<Detail>,
    /// Steps and balances of a model that steps through time on a mesh.
    pub numerics: Option<Numerics>,
    /// Crater and projectile at the end, from a model that has fields.
    pub shapes: Option<Shapes>,
    /// Limitations of the numbers.
    pub warnings: Vec<String>,
    /// Time histories, when they were asked for.
    pub history: Option<History>,
}

/// Cracks of a brittle solid.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct Cracks {
    /// Bonds that are broken, without those of notches.
    pub broken_bonds: usize,
    /// Length of a straight crack that takes as many bonds, of a plane body [m].
    pub length: Option<f64>,
    /// Area of a plane crack that takes as many bonds, of a body in space [m2].
    pub area: Option<f64>,
    /// Mean speed of the farthest crack tip from a tenth to nine tenths of its way [m/s].
    pub tip_speed: Option<f64>,
    /// Angle between the cracks of the notches and the notches, the mean over them [rad].
    pub angle: Option<f64>,
    /// Pieces that no bond holds together, single particles included.
    pub pieces: usize,
    /// Mass of the largest piece over that of the body.
    pub largest_piece: f64,
}

/// Range of a result where a model's own constants are uncertain.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Band {
    /// What the range is of.
    pub quantity: BandQuantity,
    /// Lower end, in the unit of the quantity's name.
    pub low: f64,
    /// Upper end, in the unit of the quantity's name.
    pub high: f64,
    /// What the ends stand for.
    pub basis: &'static str,
}

/// What a range is of; the name carries the unit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BandQuantity {
    /// Depth of penetration [mm].
    DepthOfPenetration,
    /// Residual velocity [m/s].
    ResidualVelocity,
    /// Ballistic limit [m/s].
    BallisticLimit,
    /// Final length of the projectile [mm].
    ProjectileFinalLength,
}

impl Serialize for BandQuantity {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
    }
}

impl BandQuantity {
    /// All of them.
    pub const ALL: &'static [Self] = &[
        Self::DepthOfPenetration,
        Self::ResidualVelocity,
        Self::BallisticLimit,
        Self::ProjectileFinalLength,
    ];

    /// Its name in results, with the unit.
    pub fn name(self) -> &'static str {
        match self {
            Self::DepthOfPenetration => "depth_of_penetration_mm",
            Self::ResidualVelocity => "residual_velocity_m_s",
            Self::BallisticLimit => "ballistic_limit_m_s",
            Self::ProjectileFinalLength => "projectile_final_length_mm",
        }
    }

    /// A value in SI units as one in the quantity's own unit.
    pub fn in_unit(self, si: f64) -> f64 {
        self.result_unit().of_si(si)
    }

    /// Its name in words.
    pub fn describe(self) -> &'static str {
        match self {
            Self::DepthOfPenetration => "depth",
            Self::ResidualVelocity => "residual velocity",
            Self::BallisticLimit => "ballistic limit",
            Self::ProjectileFinalLength => "final length",
        }
    }

    /// Its unit.
    pub fn unit(self) -> &'static str {
        self.result_unit().symbol
    }

    fn result_unit(self) -> ResultUnit {
        match self {
            Self::DepthOfPenetration | Self::ProjectileFinalLength => ResultUnit::MM,
            Self::ResidualVelocity | Self::BallisticLimit => ResultUnit::M_S,
        }
    }
}

/// Name of the detail that holds the force of a plane impact: that of the first contact, before a wave from the edge arrives.
pub const PLANE_IMPACT: &str = "force of a plane impact";

/// A number that one model alone has.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Detail {
    /// Its name, in words with spaces.
    pub name: &'static str,
    /// Its unit; empty for a plain number.
    pub unit: &'static str,
    /// Its value in that unit.
    pub value: f64,
}

impl Detail {
    /// A number by its name, its unit and its value in it.
    pub const fn new(name: &'static str, unit: &'static str, value: f64) -> Self {
        Self { name, unit, value }
    }
}

/// Steps and balances of a model that steps through time on a mesh.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Numerics {
    /// Time steps taken.
    pub steps: u64,
    /// First time step [s].
    pub first_time_step: f64,
    /// Smallest time step [s].
    pub smallest_time_step: f64,
    /// Elements of the mesh: projectile, target.
    pub elements: (usize, usize),
    /// Elements that eroded: projectile, target.
    pub eroded_elements: (usize, usize),
    /// Largest plastic strain reached: projectile, target.
    pub largest_plastic_strain: (f64, f64),
    /// Largest temperature reached [K]: projectile, target.
    pub largest_temperature: (f64, f64),
    /// Energy book at the end.
    pub energy: EnergyLedger,
    /// Momentum book at the end.
    pub momentum: MomentumLedger,
    /// Largest energy residual that was seen during the run, as a part of the initial energy.
    pub energy_residual: f64,
    /// Largest momentum residual that was seen during the run, as a part of the initial momentum.
    pub momentum_residual: f64,
}

impl RunResult {
    /// A result without numbers, for a model to fill in.
    pub fn new(
        model: &'static str,
        scheme: &'static str,
        outcome: Outcome,
        termination: Termination,
    ) -> Self {
        Self {
            model,
            scheme,
            outcome,
            termination,
            ..Self::default()
        }
    }

    /// A quantity that can be measured, in SI units, if the model gives it.
    pub fn measurable(&self, quantity: BandQuantity) -> Option<f64> {
        match quantity {
            BandQuantity::DepthOfPenetration => self.depth_of_penetration,
            BandQuantity::ResidualVelocity => self.residual_velocity,
            BandQuantity::BallisticLimit => self.ballistic_limit,
            BandQuantity::ProjectileFinalLength => self.projectile_final_length,
        }
    }

    /// Takes out what is not known before bodies that have come to rest have parted.
    pub fn without_rebound(&mut self) {
        self.criterion.clear();
        if self.outcome == Outcome::Rebounded {
            self.outcome = Outcome::AtRest;
        }
        self.largest_depth = None;
        self.permanent_depth = None;
        self.residual_velocity = None;
        self.projectile_final_length = None;
        self.projectile_final_diameter = None;
        self.contact_time = None;
    }

    /// Steps and balances of a model that steps through time on a mesh.
    ///
    /// # Panics
    /// When the model has none: a formula.
    pub fn numerics(&self) -> &Numerics {
        match &self.numerics {
            Some(numerics) => numerics,
            None => panic!("model `{}` takes no time steps", self.model),
        }
    }
}
