//! Gauges: waves arrive when and as strong as they must, in every numerical solver.

use percuss::{
    Error, case,
    history::{ElementState, GaugeHistory},
    model::{self, Control},
};

/// An elastic rod of steel on a bar of the same section; wave speed 5000 m/s, impedance ρc = 40 MPa s/m.
const BARS: &str = r#"
    [projectile]
    material = "bar"
    length = "50 mm"
    diameter = "10 mm"
    impact_velocity = "10 m/s"
    [target]
    material = "bar"
    thickness = "100 mm"
    back_face = "free"
    [[gauges]]
    name = "rod"
    position = "-25 mm"
    [[gauges]]
    position = "50 mm"
    [materials.bar]
    name = "elastic bar"
    density = "8000 kg/m3"
    youngs_modulus = "200 GPa"
    poissons_ratio = 0.0
    strength.elastic = {}
"#;

fn gauges(model: &str, text: &str) -> Vec<GaugeHistory> {
    let scenario = case::load_str("bars", text).unwrap_or_else(|error| panic!("{error}"));
    let model = model::model(model).unwrap();
    let result = model::run(model, &scenario, &mut Control::recording())
        .unwrap_or_else(|error| panic!("{error}"));
    result.history.unwrap().gauges
}

/// State at a time [s].
fn at(gauge: &GaugeHistory, time: f64) -> ElementState {
    let index = gauge.times.partition_point(|&t| t < time);
    gauge.states[index.min(gauge.states.len() - 1)]
}

/// At 5000 m/s the wave reaches the gauge in the rod after 5 us and that in the bar after 10 us; behind it the velocity is half the
/// impact velocity and the stress ρ c V / 2 = 200 MPa. The release from the rod's rear end follows 15 and 20 us after the impact.
fn check(model: &str, gauges: &[GaugeHistory], tolerance: f64) {
    let [rod, bar] = gauges else {
        panic!("{gauges:?}");
    };
    assert_eq!((rod.name.as_str(), bar.name.as_str()), ("rod", "gauge 2"));
    for (gauge, times, velocities, stresses) in [
        (rod, [3e-6, 10e-6], [10.0, 5.0], [0.0, 200e6]),
        (bar, [8e-6, 15e-6], [0.0, 5.0], [0.0, 200e6]),
    ] {
        assert_eq!(gauge.times.len(), gauge.states.len());
        for i in 0..2 {
            let state = at(gauge, times[i]);
            println!(
                "{model}, {}, {:.0} us: {:.3} m/s, {:.1} MPa",
                gauge.name,
                times[i] * 1e6,
                state.velocity,
                state.stress * 1e-6
            );
            assert!(
                (state.velocity - velocities[i]).abs() < tolerance * 10.0,
                "{model}"
            );
            assert!(
                (state.stress - stresses[i]).abs() < tolerance * 400e6,
                "{model}"
            );
        }
    }
    assert_eq!(rod.states[0].initial_position, -25e-3);
    assert!((bar.states[0].position - 50e-3).abs() < 1e-9);
}

#[test]
fn a_wave_in_bars_arrives_at_the_gauges_of_every_one_dimensional_solver() {
    let column = "[chain]\ntarget_resistance = 'column'\nborder_shear = 0.0\nconstraint_factor = 1.0\n\
                  projectile_elements = 100\ntarget_elements = 200\nend_time = '18 us'";
    check(
        "chain",
        &gauges("chain", &format!("{BARS}\n{column}")),
        0.08,
    );
    let rod = "[fdm]\nborder_shear = 0.0\nprojectile_elements = 100\ntarget_elements = 200\nend_time = '18 us'";
    check("fdm", &gauges("fdm", &format!("{BARS}\n{rod}")), 0.08);
}

#[test]
fn a_plane_wave_arrives_at_the_gauges_of_material_points() {
    // Without lateral strain by Poisson's ratio the bars of the axisymmetric model are the same ones.
    let text = format!(
        "{BARS}\n[axi]\ncells_per_radius = 8\ntarget_radius = '5 mm'\nedge = 'free'\ncourant = 0.3\nend_time = '18 us'"
    );
    check("axi", &gauges("axi", &text), 0.15);
}

#[test]
fn a_gauge_moves_with_the_material_and_ends_with_its_element() {
    let text = r#"
        projectile = { material = "copper", length = "12.74 mm", diameter = "4.8 mm", impact_velocity = "500 m/s" }
        target = { material = "aluminium-2024-t351", thickness = "50 mm" }
        chain = { target_resistance = "column", erosion_strain = 1.0 }
        gauges = [{ position = "-0.2 mm" }, { position = "-12 mm" }]
        "#;
    let gauges = gauges("chain", text);
    let last = |gauge: &GaugeHistory| gauge.states[gauge.states.len() - 1];
    assert!(last(&gauges[0]).position.is_nan(), "it has eroded");
    let moved = last(&gauges[1]).position + 12e-3;
    assert!(moved > 1e-3, "{moved}");
    assert!(
        gauges[1]
            .states
            .iter()
            .all(|state| state.velocity.is_finite())
    );
}

#[test]
fn a_fixed_gauge_stays_where_it_is() {
    let gauges_of = |model: &str, options: &str| {
        let (head, tail) = BARS.split_once("    [[gauges]]").unwrap();
        let (_, material) = tail.split_once("    [materials.bar]").unwrap();
        let text = format!(
            "gauges = [{{ position = '-49.95 mm', fixed = true }}, {{ position = '50 mm', fixed = true }}, {{ position = '50 mm', name = 'moves' }}]\n\
             {head}\n[materials.bar]{material}\n{options}"
        );
        gauges(model, &text)
    };
    let column = "[chain]\ntarget_resistance = 'column'\nborder_shear = 0.0\nconstraint_factor = 1.0\n\
                  projectile_elements = 100\ntarget_elements = 200\nend_time = '15 us'";
    let rod = "[fdm]\nborder_shear = 0.0\nprojectile_elements = 300\ntarget_elements = 600\nend_time = '15 us'";
    for (model, options) in [("chain", column), ("fdm", rod)] {
        let found = gauges_of(model, options);
        let [left, fixed, moves] = found.as_slice() else {
            panic!("{found:?}");
        };
        // The tail of the rod leaves the place 0.05 mm ahead of it after 5 us.
        assert!((at(left, 3e-6).velocity - 10.0).abs() < 1e-8, "{model}");
        assert!(at(left, 7e-6).velocity.is_nan(), "{model}");
        assert!(fixed.states.iter().all(|state| state.position == 50e-3));
        // The material that the wave moves passes the place; far from its front both have its stress.
        let (here, there) = (at(fixed, 14e-6), at(moves, 14e-6));
        assert!(
            (here.stress / there.stress - 1.0).abs() < 0.02,
            "{model}: {here:?} {there:?}"
        );
        assert!(here.initial_position < 50e-3 - 1e-5, "{model}: {here:?}");
        let expected = 5.0 * 4e-6;
        assert!(
            (there.displacement / expected - 1.0).abs() < 0.1,
            "{model}: {there:?}"
        );
        assert!(
            (there.position - 50e-3 - there.displacement).abs() < 1e-12,
            "{model}"
        );
        assert_eq!(at(moves, 5e-6).displacement, 0.0, "{model}");
    }
}

#[test]
fn a_fixed_gauge_of_material_points_is_passed_by_the_projectile() {
    let text = r#"
        projectile = { material = "copper", length = "12 mm", diameter = "4 mm", impact_velocity = "900 m/s" }
        target = { material = "aluminium-2024-t351", thickness = "20 mm" }
        axi = { cells_per_radius = 3, end_time = "10 us" }
        gauges = [{ position = "1 mm", fixed = true }, { position = "-11 mm", fixed = true }, { position = "-6 mm" }]
        "#;
    let gauges = gauges("axi", text);
    let [struck, behind, rod] = gauges.as_slice() else {
        panic!("{gauges:?}");
    };
    let parts = |gauge: &GaugeHistory| {
        [
            gauge.states[0].part,
            gauge.states[gauge.states.len() - 1].part,
        ]
    };
    // The crater floor passes 1 mm, and the projectile follows.
    assert_eq!(parts(struck), [1, 0]);
    assert!(struck.states.iter().all(|state| state.position == 1e-3));
    // Nothing is left where the tail was.
    assert!(behind.states[0].velocity > 890.0);
    assert!(behind.states.last().unwrap().velocity.is_nan());
    let last = rod.states.last().unwrap();
    assert!((last.displacement - (last.position + 6e-3)).abs() < 1e-15 && last.displacement > 3e-3);
}

#[test]
fn an_interval_of_histories_is_kept_to_the_step_by_every_solver() {
    let text = format!("{BARS}\n[history]\ninterval = \"2 us\"");
    for (model, options) in [
        ("chain", ""),
        ("fdm", ""),
        (
            "axi",
            "\n[axi]\ncells_per_radius = 4\ntarget_radius = \"5 mm\"\nend_time = \"20 us\"",
        ),
    ] {
        let of = gauges(model, &format!("{text}{options}"));
        let times = &of[0].times;
        assert!(times.len() > 8, "{model}: {times:?}");
        // All but the last, which is that of the end.
        for (i, time) in times[..times.len() - 1].iter().enumerate() {
            let due = 2e-6 * i as f64;
            assert!(
                *time > due - 1e-11 && *time < due + 1e-6,
                "{model}: {times:?}"
            );
        }
    }
}

#[test]
fn an_interval_of_histories_out_of_range_is_refused() {
    let text = format!("{BARS}\n[history]\ninterval = \"0 us\"");
    let error = case::load_str("bars", &text).unwrap_err().to_string();
    for part in ["history.interval", "0 s", "1 ns"] {
        assert!(error.contains(part), "{error}");
    }
}

#[test]
fn a_gauge_outside_the_bodies_is_refused() {
    for (gauge, key, words) in [
        (
            "position = \"-60 mm\"",
            "gauges.0.position",
            "lies in no body",
        ),
        ("position = \"120 mm\"", "gauges.0.position", "to 100 mm"),
        ("position = \"500 m\"", "gauges.0.position", "out of range"),
        (
            "position = \"1 mm\"\nname = \" \"",
            "gauges.0.name",
            "empty",
        ),
    ] {
        let (head, _) = BARS.split_once("    [[gauges]]").unwrap();
        let (_, material) = BARS.split_once("    [materials.bar]").unwrap();
        let text = format!("{head}[[gauges]]\n{gauge}\n[materials.bar]{material}");
        match case::load_str("bars", &text) {
            Err(Error::Input(error)) => {
                assert_eq!(error.key, key);
                assert!(error.to_string().contains(words), "{error}");
            }
            other => panic!("{other:?}"),
        }
    }
}

#[test]
fn a_gauge_below_the_modelled_target_is_reported() {
    let text = r#"
        projectile = { material = "copper", length = "6 mm", diameter = "4 mm", impact_velocity = "300 m/s" }
        target = { material = "aluminium-2024-t351", thickness = "semi-infinite" }
        axi = { cells_per_radius = 4, target_radius = "12 mm", target_depth = "14 mm", end_time = "2 us" }
        gauges = [{ position = "20 mm" }, { position = "5 mm" }]
        "#;
    let scenario = case::load_str("deep", text).unwrap();
    let axi = model::model("axi").unwrap();
    let result = model::run(axi, &scenario, &mut Control::recording()).unwrap();
    let told: Vec<_> = result
        .warnings
        .iter()
        .filter(|warning| warning.contains("gauge"))
        .collect();
    assert_eq!(told.len(), 1, "{told:?}");
    assert!(told[0].contains("`gauge 1`") && told[0].contains("`axi.target_depth`"));
    let gauges = result.history.unwrap().gauges;
    assert!(gauges[0].states.iter().all(|state| state.stress.is_nan()));
    assert!(
        gauges[1]
            .states
            .iter()
            .all(|state| state.stress.is_finite())
    );
}

/// Under a crater the target is an elastic half-space far from it: a wave in a bar is not seen there.
#[test]
fn gauges_under_a_crater_are_warned_of() {
    let warned = |text: &str| {
        let text = text.replace(
            "strength.elastic = {}",
            "strength.perfectly_plastic = { flow_stress = \"300 MPa\" }",
        );
        let scenario = case::load_str("bars", &text).unwrap_or_else(|error| panic!("{error}"));
        let result = model::run(
            model::model("chain").unwrap(),
            &scenario,
            &mut Control::default(),
        );
        let result = result.unwrap_or_else(|error| panic!("{error}"));
        result
            .warnings
            .iter()
            .any(|warning| warning.starts_with("gauges in the target"))
    };
    assert!(warned(BARS));
    assert!(!warned(
        &BARS.replace("position = \"50 mm\"", "position = \"-10 mm\"")
    ));
    assert!(!warned(&format!(
        "{BARS}\n[chain]\ntarget_resistance = \"column\"\n"
    )));
}
