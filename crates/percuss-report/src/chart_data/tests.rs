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
fn rows_and_areas_keep_names_and_numbers() {
    let rows = RowChart::new("r", "R", Axis::new("depth [mm]"));
    let data_of_rows = data(rows.row("tate", 2.0, Some((1.0, 3.0)), "#000000"));
    assert_eq!(data_of_rows["rows"][0]["range"], json!([1.0, 3.0]));
    let areas = AreaChart::new("a", "A", Axis::new("t"), Axis::new("E"), [0.0, 1.0]);
    let data_of_areas = data(areas.area("kinetic", None, [1.0, 0.5]));
    assert_eq!(data_of_areas["areas"][0]["heights"], json!([1.0, 0.5]));
    assert_eq!(data_of_areas["positions"], json!([0.0, 1.0]));
}
