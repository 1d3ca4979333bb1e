//! Measured curves of a case in `percuss run` and `percuss compare`.

use std::fs;

use serde_json::Value;

use crate::support::{CASE, flat, folder_with, json, ok, percuss};

/// A case with a gauge and tables of curves.
fn case(tables: &str) -> String {
    format!("{CASE}gauges = [{{ name = \"rod\", position = \"-6 mm\" }}]\n{tables}")
}

const OF_GAUGE: &str = "[[measured_curves]]\nfile = \"rod.csv\"\ngauge = \"rod\"\n";

fn curves(results: &Value) -> &Vec<Value> {
    results["results"][0]["measured_curves"].as_array().unwrap()
}

/// The history that a run wrote is a measured curve without a difference, and a shifted one has the shift as its difference.
#[test]
fn the_history_of_a_run_is_its_own_measured_curve() {
    let tables = format!(
        "{OF_GAUGE}[[measured_curves]]\nfile = \"history.csv\"\n[[measured_curves]]\nfile = \"higher.csv\"\n"
    );
    let folder = folder_with(&[("plain.toml", &case("")), ("shot.toml", &case(&tables))]);
    let path = folder.path();
    ok(path, &["run", "plain.toml", "--fast", "--out", "plain"]);
    let history = fs::read_to_string(path.join("plain/history.csv")).unwrap();
    let gauges = fs::read_to_string(path.join("plain/gauges.csv")).unwrap();
    let column = |text: &str, names: [&str; 2]| -> Vec<[f64; 2]> {
        let mut lines = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
        let header = lines.next().unwrap();
        let at = names.map(|name| header.iter().position(|found| *found == name).unwrap());
        let rows = lines.map(|row| at.map(|at| row[at].parse().unwrap()));
        rows.collect()
    };
    let depths = column(&history, ["time_us", "depth_mm"]);
    let table = |header: &str, rows: &[[f64; 2]], shift: f64| {
        let rows = rows.iter().map(|[t, x]| format!("{t},{}\n", x + shift));
        format!("{header}\n{}", rows.collect::<String>())
    };
    let stresses = column(&gauges, ["time_us", "stress_mpa"]);
    fs::write(
        path.join("rod.csv"),
        table("Time (us),Stress (MPa)", &stresses, 0.0),
    )
    .unwrap();
    fs::write(
        path.join("history.csv"),
        table("time_us,depth_mm", &depths, 0.0),
    )
    .unwrap();
    fs::write(
        path.join("higher.csv"),
        table("time_us,depth_mm", &depths, 0.5),
    )
    .unwrap();

    let text = ok(path, &["run", "shot.toml", "--fast", "--json"]);
    let results = json(&text);
    let found = curves(&results);
    assert_eq!(found.len(), 3, "{text}");
    for (curve, difference) in found.iter().zip([0.0, 0.0, 0.5]) {
        for name in ["largest_difference", "rms_difference"] {
            let value = curve[name].as_f64().unwrap();
            assert!((value - difference).abs() < 1e-9, "{name} of {curve}");
        }
        assert_eq!(
            (&curve["time_shift_us"], &curve["reason"]),
            (&0.0.into(), &Value::Null)
        );
    }
    assert_eq!(
        (&found[0]["gauge"], &found[0]["unit"]),
        (&"rod".into(), &"MPa".into())
    );

    // The copy of the case needs no other file.
    let said = flat(&ok(path, &["run", "shot.toml", "--fast", "--out", "out"]));
    assert!(said.contains("differences from measured curves"), "{said}");
    assert!(
        said.contains("higher: depth RMS difference 0.5 mm"),
        "{said}"
    );
    assert!(path.join("out/measured-curve-3.svg").exists());
    for name in ["rod.csv", "history.csv", "higher.csv"] {
        fs::remove_file(path.join(name)).unwrap();
    }
    let again = json(&ok(
        path,
        &["run", "out/case-as-run.toml", "--fast", "--json"],
    ));
    assert_eq!(curves(&again), found);
}

#[test]
fn models_with_histories_are_compared_with_the_curves() {
    let table = "[[measured_curves]]\nname = 'load cell'\ncsv = '''\n# channel 2\n# 1 MHz\nt (msec),Force_lbf,remark\n0,0,a\n0.01,2000,b\n'''\n";
    let folder = folder_with(&[("shot.toml", &case(table))]);
    let path = folder.path();
    let words = ["compare", "shot.toml", "--fast", "--out", "out"];
    let text = ok(path, &words);
    assert!(text.contains("differences from measured curves"), "{text}");
    assert!(text.contains("load cell: contact force"), "{text}");
    let read = "load cell: read `t (msec)` as `time_us`, converted; read `Force_lbf` as `contact_force_kn`, converted; column `remark` not read";
    assert!(flat(&text).contains(read), "{text}");
    let figure = fs::read_to_string(path.join("out/measured-curve-1.svg")).unwrap();
    assert!(figure.contains(">chain<") && figure.contains(">finite differences<"));
    assert_eq!(figure.matches(" %<").count(), 2);
    let results = json(&fs::read_to_string(path.join("out/compare.json")).unwrap());
    let models = results["results"].as_array().unwrap();
    let of = |model: &str| models.iter().find(|entry| entry["model"] == model).unwrap();
    let curve = &of("chain")["measured_curves"][0];
    assert_eq!(curve["unread_columns"][0], "remark");
    assert!(curve["rms_difference"].as_f64().unwrap() > 0.0, "{curve}");
    let formula = &of("crater_energy")["measured_curves"][0];
    assert_eq!(formula["reason"], "the model keeps no history");

    // At another velocity nothing was measured, which is said.
    for (velocity, is_own) in [("300", false), ("260,300", false), ("230,300", true)] {
        let words = ["compare", "shot.toml", "--fast", "--velocity", velocity];
        let other = ok(path, &words);
        assert_eq!(other.contains("measured curves"), is_own, "{other}");
        let note = "The curves of the case were measured at 230 m/s, and are compared at that velocity alone.";
        assert_eq!(flat(&other).contains(note), !is_own, "{other}");
    }
}

#[test]
fn a_wrong_table_is_refused_with_its_place() {
    for (text, place, message, help) in [
        (
            "time_us,stress\n0,0\n1,1\n",
            "rod.csv:1:9",
            "the unit of `stress` is missing",
            "write `stress (MPa)`",
        ),
        (
            "time_us,stress (kg)\n0,0\n1,1\n",
            "rod.csv:1:9",
            "`kg` is no unit of `stress`",
            "psi",
        ),
        (
            "time (us):stress (MPa)\n0:0\n1:1\n",
            "rod.csv:1:1",
            "is no unit of `time`",
            "columns are separated by commas, semicolons or tabs",
        ),
        (
            "time_us,stress_mpa\n0,0\n2,1\n1,2\n",
            "rod.csv:4:1",
            "time 1 does not come after 2",
            "sort the rows",
        ),
        (
            "time_us,stress_mpa\n0,0\n1,x\n",
            "rod.csv:3:3",
            "`x` is no number",
            "plain number",
        ),
        (
            "time_us,stress_mpa\n0,0\n",
            "rod.csv:1:9",
            "fewer than two values",
            "two values or more",
        ),
        (
            "time_us,stres_mpa\n0,0\n1,1\n",
            "rod.csv:1:9",
            "no column is named `stres_mpa`",
            "did you mean `stress_mpa`?",
        ),
        (
            "time_us,contact_force_kn\n0,0\n1,1\n",
            "rod.csv:1:9",
            "no quantity of a gauge",
            "without `gauge`",
        ),
        (
            "time_us,time_ms,strain\n0,0,0\n1,1,1\n",
            "rod.csv:1:9",
            "two columns are of `time`: `time_us` and `time_ms`",
            "remove one",
        ),
        (
            "stress_mpa\n0\n1\n",
            "rod.csv",
            "the table has no column of times",
            "lines before the names of the columns start with `#`",
        ),
        (
            "time_us,channel\n0,0\n1,1\n",
            "rod.csv",
            "the table has no column of a quantity",
            "stress",
        ),
    ] {
        let folder = folder_with(&[("shot.toml", &case(OF_GAUGE)), ("rod.csv", text)]);
        let said = percuss(folder.path(), ["run", "shot.toml", "--fast"]);
        assert_eq!(said.code, 2, "{text}");
        let stderr = flat(&said.stderr);
        for part in [place, message, help] {
            assert!(stderr.contains(part), "{part:?} is not in {stderr}");
        }
    }
    for (tables, code, message) in [
        (OF_GAUGE, 4, "cannot read `rod.csv`"),
        (
            "[[measured_curves]]\n",
            2,
            "the measured curve has no values",
        ),
        (
            "[[measured_curves]]\ncsv = 'time_s,strain'\ngauge = 'bar'\n",
            2,
            "allowed: rod",
        ),
    ] {
        let folder = folder_with(&[("shot.toml", &case(tables))]);
        let said = percuss(folder.path(), ["run", "shot.toml", "--fast"]);
        assert_eq!(said.code, code, "{tables}");
        assert!(flat(&said.stderr).contains(message), "{}", said.stderr);
    }
}

/// A run that ends before the test began keeps its numbers and gives the reason.
#[test]
fn a_curve_of_another_time_is_not_compared() {
    let table = "time_s,depth_m,interface_velocity_m_s\n1,0,0\n2,0,0\n";
    let tables = format!("[[measured_curves]]\ncsv = '''\n{table}'''\n");
    let folder = folder_with(&[("shot.toml", &case(&tables))]);
    let text = ok(folder.path(), &["run", "shot.toml", "--fast", "--json"]);
    let results = json(&text);
    let found = curves(&results);
    assert_eq!(found.len(), 2);
    let reason = found[0]["reason"].as_str().unwrap();
    assert!(reason.contains("without a common time"), "{reason}");
    assert_eq!(found[0]["rms_difference"], Value::Null);
}
