use serde_json::{Value, json};

use super::*;

fn data(chart: impl Into<Chart>) -> Value {
    serde_json::to_value(chart.into().data()).unwrap()
}

#[test]
fn lines_share_positions_and_keep_their_gaps() {
    let axes = [Axis::new("time [µs]").tight(), Axis::new("depth [mm]")];
    let [x, y] = axes.clone();
    let chart = LineChart::new("depth", "Depth", x, y)
        .series(Series::new("a", [(0.0, 0.0), (1.0, f64::NAN), (2.0, 4.0)]))
        .series(Series::new("b", [(0.0, 1.0), (1.0, 1.0), (2.0, 1.0)]).style(Style::Dashed))
        .series(Series::new("c", [(0.5, 1.0)]).style(Style::Markers))
        .mark(Mark::horizontal("end", 4.0));
    let data = data(chart);
    assert_eq!(data["kind"], "lines");
    assert_eq!(data["x"]["range"], json!([0.0, 2.0]));
    let series = &data["series"];
    assert_eq!(series[0]["x"], json!([0.0, 1.0, 2.0]));
    assert_eq!(series[0]["y"], json!([0.0, null, 4.0]));
    assert!(series[1].get("x").is_none() && series[1]["dashes"].is_string());
    assert_eq!(series[2]["x"], json!([0.5]));
    assert_eq!(series[2]["line"], false);
    assert_ne!(series[0]["color"], series[1]["color"]);
    assert_eq!(data["marks"][0]["value"], 4.0);
}

#[test]
fn a_cell_is_the_character_of_its_colour() {
    let rows = vec![vec![-2.0, 0.0], vec![f64::NAN, 2.0]];
    let axes = [Axis::new("x"), Axis::new("t")];
    let map = HeatMap::new(["m", "M"], axes, [(0.0, 1.0), (0.0, 1.0)], "stress", rows);
    let data = data(map.limit(2.0));
    let cells: Vec<u32> = data["cells"]
        .as_str()
        .unwrap()
        .chars()
        .map(u32::from)
        .collect();
    let colors = data["colors"].as_array().unwrap();
    let last = colors.len() as u32 - 1;
    let first = cells[0];
    assert_eq!(
        cells,
        [first, first + last / 2, u32::from(' '), first + last]
    );
    assert_eq!(colors[0], palette::diverging(-1.0));
    assert_eq!(colors[last as usize], palette::diverging(1.0));
}

#[test]
fn a_histogram_keeps_its_parts_and_its_marks() {
    let chart = Histogram::new("h", "H", Axis::new("depth [mm]"), (0..100).map(f64::from));
    let data = data(chart.mark(Mark::vertical("mean", 49.5)));
    assert_eq!(data["kind"], "histogram");
    let numbers = |key: &str| -> Vec<f64> {
        let values = data[key].as_array().unwrap().iter();
        values.map(|value| value.as_f64().unwrap()).collect()
    };
    let (middles, parts) = (numbers("middles"), numbers("parts"));
    let width = data["width"].as_f64().unwrap();
    assert!((parts.iter().sum::<f64>() - 100.0).abs() < 1e-3);
    assert!((middles[0] - 0.5 * width).abs() < 1e-4);
    assert!((middles[middles.len() - 1] - (99.0 - 0.5 * width)).abs() < 1e-3);
    assert_eq!(data["marks"][0]["value"], 49.5);
    assert!(data["x"]["range"][1].as_f64().unwrap() >= 99.0);
}

#[test]
fn bars_keep_their_ends_and_leave_room_for_their_texts() {
    let bar = Bar {
        ends: (2.0, 1.0),
        color: "#000000".to_owned(),
        lane: 0,
        interval: Some((0.5, 1.5)),
        text: "230 m/s".to_owned(),
    };
    let chart = BarRows::new("b", "B", Axis::new("depth [mm]"), 1);
    let data = data(
        chart
            .row("speed", [bar])
            .color("at its 5th percentile", "#000000"),
    );
    assert_eq!(data["kind"], "bars");
    let bar = &data["rows"][0]["bars"][0];
    assert_eq!(bar["ends"], json!([2.0, 1.0]));
    assert_eq!(bar["interval"], json!([0.5, 1.5]));
    assert_eq!(bar["text"], "230 m/s");
    assert_eq!(data["colors"][0][0], "at its 5th percentile");
    assert!(data["x"]["range"][0].as_f64().unwrap() < 0.4);
}

#[test]
fn rows_and_areas_keep_names_and_numbers() {
    let rows = RowChart::new("r", "R", Axis::new("depth [mm]"));
    let data_of_rows = data(rows.row("tate", 2.0, Some((1.0, 3.0)), "#000000"));
    assert_eq!(data_of_rows["rows"][0]["range"], json!([1.0, 3.0]));
    let areas = AreaChart::new("a", "A", Axis::new("t"), Axis::new("E"), [0.0, 1.0]);
    let data_of_areas = data(areas.area("kinetic", None, [1.0, 0.5]));
    assert_eq!(data_of_areas["areas"][0]["heights"], json!([1.0, 0.5]));
    assert_eq!(data_of_areas["positions"], json!([0.0, 1.0]));
}
