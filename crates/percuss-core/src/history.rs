//! Time histories of a run, thinned as it grows so that memory stays flat.

mod columns;

use serde::{Deserialize, Serialize};

pub use columns::{ELEMENT_COLUMNS, HistoryColumn, Read, SAMPLE_COLUMNS};

use crate::ledger::{EnergyLedger, MomentumLedger};

/// One moment of a run.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Sample {
    /// Time [s].
    pub time: f64,
    /// Time step number.
    pub step: u64,
    /// Velocity of the projectile's front end [m/s].
    pub tip_velocity: f64,
    /// Velocity of the projectile's rear end [m/s].
    pub tail_velocity: f64,
    /// Speed of the target's struck face, the crater floor [m/s]; no number on a rigid wall.
    pub interface_velocity: f64,
    /// Speed of the target's rear face [m/s]; no number where there is none.
    pub back_velocity: f64,
    /// Mean velocity of the projectile [m/s].
    pub mean_velocity: f64,
    /// Position of the projectile's front end below the original face [m].
    pub tip_position: f64,
    /// Position of the crater floor below the original face [m].
    pub depth: f64,
    /// Current length of the projectile [m].
    pub projectile_length: f64,
    /// Force between projectile and target [N].
    pub contact_force: f64,
    /// Force on the rear face [N]; no number where there is none.
    pub back_force: f64,
    /// Length of a straight crack that takes as many bonds as are broken [m]; 0 from a model without cracks.
    pub crack_length: f64,
    /// Largest distance of a broken bond from the tip of its notch, or from the point of impact [m]; 0 from a model without cracks.
    pub crack_reach: f64,
    /// Energy balance.
    pub energy: EnergyLedger,
    /// Momentum balance.
    pub momentum: MomentumLedger,
}

/// State of one element at one moment.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ElementState {
    /// Part: 0 is the projectile, 1 the first layer of the target.
    pub part: usize,
    /// Initial position of its middle, struck face at 0, depth positive [m].
    pub initial_position: f64,
    /// Current position of its middle [m].
    pub position: f64,
    /// Displacement of its material since the start [m]; no number where the material in it changes.
    pub displacement: f64,
    /// Current length [m].
    pub length: f64,
    /// Axial stress, compression positive [Pa].
    pub stress: f64,
    /// Axial strain, compression positive.
    pub strain: f64,
    /// Equivalent plastic strain.
    pub plastic_strain: f64,
    /// Current diameter [m].
    pub diameter: f64,
    /// Temperature [K].
    pub temperature: f64,
    /// Axial velocity, into the target positive [m/s].
    pub velocity: f64,
}

impl ElementState {
    /// A state of a part without numbers: of a place that has eroded.
    pub fn gone(part: usize, initial_position: f64) -> Self {
        let none = f64::NAN;
        Self {
            part,
            initial_position,
            position: none,
            displacement: none,
            length: none,
            stress: none,
            strain: none,
            plastic_strain: none,
            diameter: none,
            temperature: none,
            velocity: none,
        }
    }

    /// The state between two others of one part, at a fraction of the way from this one.
    pub fn between(&self, ahead: &Self, fraction: f64) -> Self {
        let mixed = |of: fn(&Self) -> f64| of(self) + fraction * (of(ahead) - of(self));
        Self {
            part: self.part,
            initial_position: mixed(|e| e.initial_position),
            position: mixed(|e| e.position),
            displacement: mixed(|e| e.displacement),
            length: mixed(|e| e.length),
            stress: mixed(|e| e.stress),
            strain: mixed(|e| e.strain),
            plastic_strain: mixed(|e| e.plastic_strain),
            diameter: mixed(|e| e.diameter),
            temperature: mixed(|e| e.temperature),
            velocity: mixed(|e| e.velocity),
        }
    }
}

/// State along the axis at one moment.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Profile {
    /// Time [s].
    pub time: f64,
    /// Elements from the projectile's tail to the target's rear face; eroded ones are left out.
    pub elements: Vec<ElementState>,
}

/// Most elements in a profile of a history: a finer mesh than a picture can show is thinned out.
pub const PROFILE_ELEMENTS: usize = 400;

impl Profile {
    /// The same with at most [`PROFILE_ELEMENTS`] elements.
    #[must_use]
    pub fn thinned(self) -> Self {
        let stride = self.elements.len().div_ceil(PROFILE_ELEMENTS).max(1);
        if stride == 1 {
            return self;
        }
        Self {
            time: self.time,
            elements: self.elements.into_iter().step_by(stride).collect(),
        }
    }
}

/// Histories of a run.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct History {
    /// Scalars against time.
    pub samples: Vec<Sample>,
    /// State along the axis against time.
    pub profiles: Vec<Profile>,
    /// State at each gauge of the case at the times of the samples.
    pub gauges: Vec<GaugeHistory>,
}

/// A point of the material on the axis, or a place there.
#[derive(Debug, Clone, PartialEq)]
pub struct GaugePlace {
    /// Name in results.
    pub name: String,
    /// Position before the impact, below the struck face [m]; negative in the projectile.
    pub position: f64,
    /// Whether it stays at that place, whatever material is there.
    pub fixed: bool,
}

/// History of the material at a gauge.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct GaugeHistory {
    /// Name of the gauge.
    pub name: String,
    /// Times [s]: those of the samples.
    pub times: Vec<f64>,
    /// State of the material; not a number once it has eroded, and at a fixed place without any.
    pub states: Vec<ElementState>,
}

/// Samples kept lie between this number and half of it.
const MOST_SAMPLES: usize = 1600;
/// Most samples at an interval of the case.
const MOST_AT_INTERVAL: usize = 20_000;
/// Part of an interval by which a step may end before a sample is due.
const ROUNDING: f64 = 1e-6;
/// Profiles kept after the first waves lie between this number and half of it.
const MOST_PROFILES: usize = 400;
/// Steps per element in which the first waves are followed: they run through all elements and back.
const WAVE_STEPS: usize = 2;
/// Most profiles of the first waves, which move on by an element in a step or two, that stay in a longer run.
const MOST_WAVE_PROFILES: usize = 128;

/// Distance from one sample to the next.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
enum Spacing {
    /// In time steps.
    Steps(u64),
    /// In time [s].
    Time(f64),
}

impl Spacing {
    /// Most samples that are kept.
    fn most(self) -> usize {
        match self {
            Self::Steps(_) => MOST_SAMPLES,
            Self::Time(_) => MOST_AT_INTERVAL,
        }
    }

    fn doubled(self) -> Self {
        match self {
            Self::Steps(stride) => Self::Steps(2 * stride),
            Self::Time(interval) => Self::Time(2.0 * interval),
        }
    }
}

/// Collects histories of a run of unknown length: when it is full, it drops every other entry and doubles its stride. Profiles of the
/// first waves stay.
#[derive(Debug, Serialize, Deserialize)]
pub struct Recorder {
    history: History,
    sample_spacing: Spacing,
    profile_stride: u64,
    /// Steps in which the first waves are followed.
    wave_steps: u64,
    /// Profiles of the first waves, once they are over.
    wave_profiles: Option<usize>,
}

impl Recorder {
    /// An empty history with gauges, and with samples at an interval [s] if there is one.
    pub fn new(gauges: &[GaugePlace], interval: Option<f64>) -> Self {
        let gauge = |place: &GaugePlace| GaugeHistory {
            name: place.name.clone(),
            ..GaugeHistory::default()
        };
        Self {
            history: History {
                gauges: gauges.iter().map(gauge).collect(),
                ..History::default()
            },
            sample_spacing: interval.map_or(Spacing::Steps(1), Spacing::Time),
            profile_stride: 1,
            wave_steps: 0,
            wave_profiles: None,
        }
    }

    /// Whether a step that ends at a time [s] is one of those with a sample.
    pub fn wants_sample(&self, step: u64, time: f64) -> bool {
        match self.sample_spacing {
            Spacing::Steps(stride) => step.is_multiple_of(stride),
            Spacing::Time(interval) => self.history.samples.last().is_none_or(|last| {
                // Steps end a little before or after a multiple of the interval by rounding alone.
                let intervals = |time: f64| (time / interval + ROUNDING).floor();
                intervals(time) > intervals(last.time)
            }),
        }
    }

    /// Time between samples [s] where there were too many at the interval of the case.
    pub fn longer_interval(&self, given: Option<f64>) -> Option<f64> {
        match self.sample_spacing {
            Spacing::Time(interval) if given != Some(interval) => Some(interval),
            _ => None,
        }
    }

    /// Whether a step is one of those with a profile.
    pub fn wants_profile(&self, step: u64) -> bool {
        step.is_multiple_of(self.profile_stride)
    }

    /// Adds a sample, with the states at all gauges.
    pub fn sample(&mut self, sample: Sample, gauges: Vec<ElementState>) {
        for (history, state) in self.history.gauges.iter_mut().zip(gauges) {
            history.times.push(sample.time);
            history.states.push(state);
        }
        self.history.samples.push(sample);
        if self.history.samples.len() > self.sample_spacing.most() {
            thin(&mut self.history.samples);
            for history in &mut self.history.gauges {
                thin(&mut history.times);
                thin(&mut history.states);
            }
            self.sample_spacing = self.sample_spacing.doubled();
        }
    }

    /// Adds a profile.
    pub fn profile(&mut self, profile: Profile) {
        let profiles = &mut self.history.profiles;
        if profiles.is_empty() {
            // A power of two, so that later profiles stay multiples of their stride.
            self.wave_steps = match profile.elements.len() {
                0 => 0,
                count => (WAVE_STEPS * count).next_power_of_two() as u64,
            };
        }
        let steps = profiles.len() as u64 * self.profile_stride;
        if self.wave_profiles.is_none() && steps >= self.wave_steps {
            while profiles.len() > MOST_WAVE_PROFILES {
                thin(profiles);
            }
            self.wave_profiles = Some(profiles.len());
        }
        profiles.push(profile);
        let of_waves = self.wave_profiles.unwrap_or(0);
        if profiles.len() > of_waves + MOST_PROFILES {
            let mut later = profiles.split_off(of_waves);
            thin(&mut later);
            profiles.extend(later);
            self.profile_stride *= 2;
        }
    }

    /// The history with its last moment, which the stride may have passed over.
    pub fn finish(
        mut self,
        sample: Sample,
        gauges: Vec<ElementState>,
        profile: Profile,
    ) -> History {
        if self.history.samples.last().map(|last| last.step) != Some(sample.step) {
            // What is complete is not thinned out any more.
            for (history, state) in self.history.gauges.iter_mut().zip(gauges) {
                history.times.push(sample.time);
                history.states.push(state);
            }
            self.history.samples.push(sample);
        }
        if self.history.profiles.last().map(|last| last.time) != Some(profile.time) {
            self.history.profiles.push(profile);
        }
        self.history
    }
}

fn thin<T>(entries: &mut Vec<T>) {
    let mut index = 0;
    entries.retain(|_| {
        index += 1;
        index % 2 == 1
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn profiles_of_the_first_waves_stay_and_later_ones_are_evenly_spread() {
        let mut recorder = Recorder::new(&[], None);
        for step in 0..20_000 {
            if recorder.wants_profile(step) {
                recorder.profile(Profile {
                    time: step as f64,
                    elements: vec![ElementState::gone(0, 0.0); 100],
                });
            }
        }
        let times: Vec<f64> = recorder.history.profiles.iter().map(|p| p.time).collect();
        // 100 elements: 256 steps, every other one.
        let first: Vec<f64> = (0..128).map(|i| 2.0 * f64::from(i)).collect();
        assert_eq!(times[..128], first);
        let later = &times[128..];
        assert!((MOST_PROFILES / 2..=MOST_PROFILES).contains(&later.len()));
        assert_eq!(later[0], 256.0);
        assert!(
            later.windows(2).all(|pair| pair[1] - pair[0] == 64.0),
            "{later:?}"
        );
    }

    #[test]
    fn a_long_run_keeps_few_entries_evenly_spread() {
        let mut recorder = Recorder::new(&[], None);
        for step in 0..100_000 {
            if recorder.wants_profile(step) {
                recorder.profile(Profile {
                    time: step as f64,
                    elements: Vec::new(),
                });
            }
        }
        let history = recorder.history;
        assert!((MOST_PROFILES / 2..=MOST_PROFILES).contains(&history.profiles.len()));
        let gaps: Vec<f64> = history
            .profiles
            .windows(2)
            .map(|pair| pair[1].time - pair[0].time)
            .collect();
        assert!(gaps.iter().all(|gap| *gap == gaps[0]));
    }

    fn samples(interval: f64, steps: u64, time_step: f64) -> (Recorder, Vec<f64>) {
        let mut recorder = Recorder::new(&[], Some(interval));
        for step in 0..steps {
            let time = step as f64 * time_step;
            if recorder.wants_sample(step, time) {
                let sample = Sample {
                    time,
                    step,
                    ..Sample::default()
                };
                recorder.sample(sample, Vec::new());
            }
        }
        let times = recorder.history.samples.iter().map(|sample| sample.time);
        let times = times.collect();
        (recorder, times)
    }

    #[test]
    fn samples_at_an_interval_end_the_step_in_which_they_are_due() {
        let (recorder, times) = samples(1.0, 100, 0.3);
        assert!((times[1] - 1.2).abs() < 1e-12 && (times[2] - 2.1).abs() < 1e-12);
        assert_eq!(times.len(), 30);
        assert_eq!(recorder.longer_interval(Some(1.0)), None);
        // Multiples of the interval that are a little short of it count, and none counts twice.
        let (_, times) = samples(1e-7, 1001, 1e-8);
        assert_eq!(times.len(), 101);
    }

    #[test]
    fn an_interval_with_too_many_samples_grows() {
        let (recorder, times) = samples(1.0, 50_000, 1.0);
        assert_eq!(recorder.longer_interval(Some(1.0)), Some(4.0));
        assert!(times.len() <= MOST_AT_INTERVAL);
        assert!(times.windows(2).all(|pair| pair[1] - pair[0] == 4.0));
    }
}
