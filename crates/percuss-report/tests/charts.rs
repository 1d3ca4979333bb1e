//! Charts by themselves.

use percuss_report::{AreaChart, Axis, HeatMap, LineChart, Mark, Series, Style};

fn chart() -> LineChart {
    LineChart::new("chart", "A chart", Axis::new("x [mm]"), Axis::new("y [kN]"))
}

#[test]
fn labels_names_and_dashes_are_in_the_drawing() {
    let figure = chart()
        .caption("from somewhere")
        .series(Series::new("first", [(0.0, 0.0), (1.0, 2.0)]))
        .series(Series::new("second", [(0.0, 1.0), (1.0, 3.0)]).style(Style::Dashed))
        .mark(Mark::horizontal("limit", 1.5))
        .draw();
    assert_eq!(figure.name, "chart");
    assert_eq!(figure.title, "A chart: from somewhere");
    for text in [
        "A chart",
        "from somewhere",
        "x [mm]",
        "y [kN]",
        "first",
        "second",
        "limit",
    ] {
        assert!(figure.svg.contains(&format!(">{text}</text>")), "{text}");
    }
    // Once in the plot, once in the legend.
    assert_eq!(figure.svg.matches(r#"stroke-dasharray="5 2.5""#).count(), 2);
    assert_eq!(figure.svg.matches(r#"stroke-dasharray="2 2""#).count(), 2);
}

#[test]
fn points_without_value_leave_a_gap() {
    let points = [
        (0.0, 0.0),
        (1.0, 2.0),
        (2.0, f64::NAN),
        (3.0, 1.0),
        (4.0, 2.0),
    ];
    let figure = chart()
        .series(Series::new("", points).color("#123456"))
        .draw();
    assert_eq!(figure.svg.matches("#123456").count(), 2);
    assert!(!figure.svg.contains("NaN"));
}

#[test]
fn a_point_alone_is_marked() {
    let figure = chart()
        .series(Series::new("", [(1.0, 2.0)]).color("#123456"))
        .draw();
    assert_eq!(figure.svg.matches("#123456").count(), 1);
}

#[test]
fn odd_input_is_drawn_all_the_same() {
    let log = || Axis::new("x [1]").log();
    let nothing: [(f64, f64); 0] = [];
    let figures = [
        chart().draw(),
        chart().series(Series::new("none", nothing)).draw(),
        chart()
            .series(Series::new("flat", [(0.0, 5.0), (1.0, 5.0)]))
            .draw(),
        chart()
            .series(Series::new("far", [(0.0, 1e300), (1.0, -1e-300)]))
            .draw(),
        chart()
            .series(Series::new("flat", [(0.0, 0.0), (0.0, 0.0)]))
            .true_to_scale()
            .draw(),
        LineChart::new("log", "$x$ < \"y\"", log(), log())
            .series(
                Series::new("a", [(1.0, 1.0), (-1.0, 10.0), (10.0, 0.0), (100.0, 50.0)])
                    .style(Style::LineAndMarkers)
                    .error_bars([(2.0, 1.0)]),
            )
            .draw(),
        LineChart::new("log", "", log(), log()).draw(),
        AreaChart::new("areas", "Areas", Axis::new("x"), Axis::new("y"), []).draw(),
        HeatMap::new(
            ["map", "Map"],
            [log(), log()],
            [(1.0, 2.0); 2],
            "v",
            Vec::new(),
        )
        .draw(),
        HeatMap::new(
            ["map", "Map"],
            [Axis::new("x"), Axis::new("y")],
            [(0.0, 1.0); 2],
            "v [1]",
            vec![vec![f64::NAN, 0.0], vec![0.0, 0.0]],
        )
        .draw(),
        chart().caption("word ".repeat(200)).draw(),
        LineChart::new(
            "t",
            "title ".repeat(50),
            Axis::new("x ".repeat(200)),
            Axis::new("y"),
        )
        .draw(),
    ];
    for figure in figures {
        assert!(!figure.png().unwrap().is_empty());
        assert!(
            !figure.svg.contains("NaN") && !figure.svg.contains("inf"),
            "{}",
            figure.svg
        );
    }
}

#[test]
fn a_heat_map_is_made_of_runs_of_one_colour() {
    let figure = HeatMap::new(
        ["map", "Map"],
        [Axis::new("x [mm]"), Axis::new("t [µs]")],
        [(-1.0, 1.0), (0.0, 3.0)],
        "stress [MPa]",
        vec![
            vec![2.0, 2.0, -2.0, -2.0],
            vec![2.0, 2.0, 2.0, 2.0],
            vec![0.0, f64::NAN, f64::NAN, 0.0],
        ],
    )
    .draw();
    for path in [
        "M0 0h2v1h-2zM0 1h4v1h-4z",
        "M2 0h2v1h-2z",
        "M0 2h1v1h-1zM3 2h1v1h-1z",
        "M1 2h2v1h-2z",
    ] {
        assert!(figure.svg.contains(&format!("d=\"{path}\"")), "{path}");
    }
    assert!(figure.svg.contains("stress [MPa]"));
}

#[test]
fn the_cells_of_a_heat_map_hold_their_texts() {
    let figure = HeatMap::new(
        ["map", "Map"],
        [Axis::new("x"), Axis::new("y")],
        [(0.5, 2.5); 2],
        "v [%]",
        vec![vec![-90.0, 10.0], vec![f64::NAN, 200.0]],
    )
    .texts(vec![
        vec!["low".to_owned(), "small".to_owned()],
        vec!["none".to_owned(), "high".to_owned()],
    ])
    .limit(100.0)
    .draw();
    for text in ["low", "small", "none", "high"] {
        assert!(figure.svg.contains(&format!(">{text}</text>")), "{text}");
    }
    assert!(
        figure.svg.contains(">100</text>") && !figure.svg.contains(">200</text>"),
        "the bar ends at the limit"
    );
}
