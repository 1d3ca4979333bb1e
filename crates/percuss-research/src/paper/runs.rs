//! Computations behind the checks.

use percuss::{
    Error, Scenario, case,
    case::{
        ErosionStrain, Interface, PublishedBorderShear, PublishedOptions, Scheme,
        SmallStrainStiffness,
    },
    model::{self, Control},
    outcome::RunResult,
    solver::go_on_to_next_run,
    units::Mass,
};

use super::OnProgress;

/// Meshes of the paper's figure 8: penetrator and target elements.
pub(super) const MESHES: [(u32, u32); 5] = [(10, 20), (20, 40), (30, 60), (40, 80), (50, 100)];
/// Finer meshes, for the conservative scheme and for observed orders.
pub(super) const FINE_MESHES: [(u32, u32); 3] = [(80, 160), (160, 320), (320, 640)];
/// Meshes on which discrete elements and finite differences are compared: that of figure 7 and the paper's own.
pub(super) const COMPARED_MESHES: [(u32, u32); 2] = [(10, 20), PAPER_MESH];
/// Impact velocities [m/s]; the text gives only 230 m/s.
pub(super) const SPEEDS: [f64; 8] = [100.0, 150.0, 200.0, 230.0, 300.0, 400.0, 500.0, 600.0];
/// Border-shear constants of the study.
pub(super) const SHEARS: [f64; 6] = [0.0, 0.1, 0.3, 0.577, 0.8, 1.0];
/// Impact velocities of the depth-time curves [m/s].
pub(super) const TIME_SPEEDS: [f64; 4] = [150.0, 230.0, 400.0, 600.0];
/// Impact velocity of the paper [m/s].
pub(super) const PAPER_SPEED: f64 = 230.0;
/// The paper's mesh.
pub(super) const PAPER_MESH: (u32, u32) = (40, 80);

/// Table 1 as a case file, with the target resistance model of the paper.
const TABLE_1: &str = r#"
projectile = { material = "copper", length = "12.74 mm", diameter = "4.8 mm", impact_velocity = "230 m/s" }
target = { material = "aluminium-2024-t351", thickness = "25 mm" }
chain.target_resistance = "column"
"#;

/// A scheme with its reading.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Way {
    Chain,
    Joined,
    Conservative,
}

pub(super) const WAYS: [Way; 3] = [Way::Chain, Way::Joined, Way::Conservative];

impl Way {
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Chain => "published, chain",
            Self::Joined => "published, joined",
            Self::Conservative => "conservative",
        }
    }
}

/// Parameters of one run.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Key {
    way: Way,
    speed: f64,
    mesh: (u32, u32),
    shear: f64,
}

/// Depth by discrete elements and by finite differences, neither with erosion [mm].
#[derive(Debug, Clone, Copy)]
pub(super) struct Compared {
    pub(super) speed: f64,
    pub(super) mesh: (u32, u32),
    pub(super) elements: f64,
    pub(super) differences: f64,
}

impl Compared {
    /// Relative excess of the depth by finite differences.
    pub(super) fn excess(&self) -> f64 {
        self.differences / self.elements - 1.0
    }
}

/// All runs.
pub(super) struct Runs {
    base: Scenario,
    done: Vec<(Key, RunResult)>,
    /// Runs with histories, at [`TIME_SPEEDS`].
    pub(super) histories: Vec<(Way, f64, RunResult)>,
    /// Discrete elements against finite differences, at [`SPEEDS`] on [`COMPARED_MESHES`].
    pub(super) compared: Vec<Compared>,
    /// Steps of the joined reading by treatment of the border shear.
    pub(super) joined_steps: Vec<(&'static str, u64)>,
}

const SHEAR: f64 = 0.577;

fn scenario(base: &Scenario, key: Key) -> Scenario {
    let mut scenario = base.clone();
    scenario.impact_velocity = key.speed;
    scenario.options.chain.projectile_elements = Some(key.mesh.0);
    scenario.options.chain.target_elements = Some(key.mesh.1);
    scenario.options.chain.border_shear = Some(key.shear);
    let mut published = PublishedOptions::default();
    // With the printed mass the time step comes out as printed.
    published.target_mass = Some(Mass::new(1.22e-3));
    match key.way {
        Way::Conservative => return scenario,
        Way::Chain => published.small_strain = SmallStrainStiffness::Elastic,
        Way::Joined => published.interface = Interface::Joined,
    }
    scenario.options.chain.scheme = Scheme::Published;
    scenario.options.chain.published = Some(published);
    scenario
}

fn run(scenario: &Scenario, record: bool) -> Result<RunResult, Error> {
    let mut control = Control {
        record,
        progress: None,
        ..Control::default()
    };
    model::run(model::model("chain")?, scenario, &mut control)
}

impl Runs {
    pub(super) fn compute(progress: OnProgress<'_>) -> Result<Self, Error> {
        let base = case::load_str("paper", TABLE_1)?;
        let mut keys = Vec::new();
        for way in WAYS {
            let key = |speed, mesh, shear| Key {
                way,
                speed,
                mesh,
                shear,
            };
            for speed in SPEEDS {
                keys.push(key(speed, (10, 20), SHEAR));
                keys.extend(MESHES[1..].iter().map(|mesh| key(speed, *mesh, SHEAR)));
            }
            keys.extend(
                FINE_MESHES
                    .iter()
                    .map(|mesh| key(PAPER_SPEED, *mesh, SHEAR)),
            );
            for shear in SHEARS {
                keys.push(key(PAPER_SPEED, PAPER_MESH, shear));
                keys.push(key(600.0, PAPER_MESH, shear));
            }
        }
        let total = (keys.len() + WAYS.len() * TIME_SPEEDS.len()) as f64;
        let mut runs = Self {
            base,
            done: Vec::new(),
            histories: Vec::new(),
            compared: Vec::new(),
            joined_steps: Vec::new(),
        };
        let mut tell = |done: usize| go_on_to_next_run(progress(done as f64 / total));
        for (i, key) in keys.into_iter().enumerate() {
            if !runs.done.iter().any(|(done, _)| *done == key) {
                runs.done
                    .push((key, run(&scenario(&runs.base, key), false)?));
            }
            tell(i)?;
        }
        for way in WAYS {
            for speed in TIME_SPEEDS {
                let key = Key {
                    way,
                    speed,
                    mesh: PAPER_MESH,
                    shear: SHEAR,
                };
                runs.histories
                    .push((way, speed, run(&scenario(&runs.base, key), true)?));
            }
        }
        runs.compare_with_finite_differences()?;
        runs.count_joined_steps()?;
        tell(total as usize)?;
        Ok(runs)
    }

    fn compare_with_finite_differences(&mut self) -> Result<(), Error> {
        for mesh in COMPARED_MESHES {
            for speed in SPEEDS {
                let key = Key {
                    way: Way::Conservative,
                    speed,
                    mesh,
                    shear: SHEAR,
                };
                let mut scenario = scenario(&self.base, key);
                scenario.options.chain.erosion_strain = Some(ErosionStrain::Never);
                let depth = |name| -> Result<f64, Error> {
                    let result =
                        model::run(model::model(name)?, &scenario, &mut Control::default())?;
                    Ok(result.depth_of_penetration.unwrap_or(f64::NAN) * 1e3)
                };
                self.compared.push(Compared {
                    speed,
                    mesh,
                    elements: depth("chain")?,
                    differences: depth("fdm")?,
                });
            }
        }
        Ok(())
    }

    /// Depth by finite differences on a mesh at a speed [mm].
    pub(super) fn differences_on(&self, speed: f64, mesh: (u32, u32)) -> f64 {
        let found = self
            .compared
            .iter()
            .find(|c| c.speed == speed && c.mesh == mesh);
        found.map_or(f64::NAN, |compared| compared.differences)
    }

    fn count_joined_steps(&mut self) -> Result<(), Error> {
        for (name, shear) in [
            ("none", PublishedBorderShear::None),
            ("friction on the target", PublishedBorderShear::Friction),
            ("constant force", PublishedBorderShear::Constant),
            (
                "friction on both",
                PublishedBorderShear::FrictionAndPenetrator,
            ),
        ] {
            let key = Key {
                way: Way::Joined,
                speed: PAPER_SPEED,
                mesh: PAPER_MESH,
                shear: SHEAR,
            };
            let mut scenario = scenario(&self.base, key);
            if let Some(published) = &mut scenario.options.chain.published {
                published.border_shear = shear;
            }
            self.joined_steps
                .push((name, run(&scenario, false)?.numerics().steps));
        }
        Ok(())
    }

    /// Table 1 as a scenario of the published scheme.
    pub(super) fn table_1(&self) -> Scenario {
        let key = Key {
            way: Way::Joined,
            speed: PAPER_SPEED,
            mesh: PAPER_MESH,
            shear: SHEAR,
        };
        scenario(&self.base, key)
    }

    fn depth(&self, key: Key) -> f64 {
        let found = self.done.iter().find(|(done, _)| *done == key);
        found
            .and_then(|(_, result)| result.depth_of_penetration)
            .map_or(f64::NAN, |depth| depth * 1e3)
    }

    /// Depth on a mesh at a speed [mm].
    pub(super) fn depth_on(&self, way: Way, speed: f64, mesh: (u32, u32)) -> f64 {
        self.depth(Key {
            way,
            speed,
            mesh,
            shear: SHEAR,
        })
    }

    /// Depth on the paper's mesh with a border-shear constant [mm].
    pub(super) fn depth_with(&self, way: Way, speed: f64, shear: f64) -> f64 {
        self.depth(Key {
            way,
            speed,
            mesh: PAPER_MESH,
            shear,
        })
    }
}
