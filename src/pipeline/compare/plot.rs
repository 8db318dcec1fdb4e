//! Errors against the angles of view and light, and against iterations, as drawings.

use plotters::{
    coord::Shift,
    prelude::{
        ChartBuilder, Circle, DrawingArea, IntoDrawingArea, IntoFont, LineSeries, PathElement, RGBColor, SVGBackend, SeriesLabelPosition,
        ShapeStyle, WHITE,
    },
};

use super::{AtElevation, Comparison, Quality};
use crate::pipeline::PipelineError;

/// Width and height of the drawing in pixels.
const SIZE: (u32, u32) = (1140, 360);

/// Lines of view and light: blue and orange, told apart by those who see no red or green too.
const VIEW: RGBColor = RGBColor(0, 90, 160);
const LIGHT: RGBColor = RGBColor(220, 120, 0);

/// What is drawn over θ.
struct Quantity {
    title: &'static str,
    value: fn(&Quality) -> Option<f64>,
    /// What the axis shows in any case.
    shown: Option<f64>,
    /// Least range of the axis.
    range: f64,
    /// A mark of the axis.
    mark: fn(&f64) -> String,
}

const QUANTITIES: [Quantity; 3] = [
    Quantity {
        title: "relative RMS error",
        value: |quality| quality.relative_rms,
        shown: Some(0.0),
        range: 0.1,
        mark: |value| format!("{value:.2}"),
    },
    Quantity { title: "PSNR / dB", value: |quality| quality.psnr_db, shown: None, range: 4.0, mark: |value| format!("{value:.0}") },
    Quantity {
        title: "mean signed error / %",
        value: |quality| quality.bias.map(|bias| 100.0 * bias),
        shown: Some(0.0),
        range: 4.0,
        mark: |value| if *value == 0.0 { "0".to_owned() } else { format!("{value:+.0}") },
    },
];

/// The three quantities side by side, as SVG: over θ of the view, and over θ of the light.
pub fn svg(comparison: &Comparison) -> Result<String, PipelineError> {
    let mut text = String::new();
    let areas = SVGBackend::with_string(&mut text, SIZE).into_drawing_area().split_evenly((1, QUANTITIES.len()));
    for (area, quantity) in areas.iter().zip(&QUANTITIES) {
        panel(area, quantity, comparison).map_err(|message| PipelineError::Plot { message })?;
    }
    drop(areas);
    Ok(text)
}

/// Errors after each iteration but the first, as SVG: that one is so much larger that it would hide the others.
pub fn iterations(errors: &[f64]) -> Result<String, PipelineError> {
    let mut text = String::new();
    let area = SVGBackend::with_string(&mut text, (SIZE.0 / 2, SIZE.1)).into_drawing_area();
    let points = (1_u32..).map(f64::from).zip(errors.iter().copied()).skip(1).collect();
    let axes = Axes {
        title: "relative RMS error",
        over: "iteration",
        shown: None,
        range: 1e-3,
        marks: [|value| format!("{value:.0}"), |value| format!("{value:.4}")],
    };
    chart(&area, &axes, &[Line { name: "left after assignment", color: VIEW, points }])
        .map_err(|message| PipelineError::Plot { message })?;
    drop(area);
    Ok(text)
}

fn panel(area: &DrawingArea<SVGBackend<'_>, Shift>, quantity: &Quantity, comparison: &Comparison) -> Result<(), String> {
    let points = |groups: &[AtElevation]| -> Vec<(f64, f64)> {
        groups.iter().filter_map(|group| Some((group.theta_degrees, (quantity.value)(&group.quality)?))).collect()
    };
    let axes = Axes {
        title: quantity.title,
        over: "θ of view or light / degrees",
        shown: quantity.shown,
        range: quantity.range,
        marks: [|theta| format!("{theta:.0}"), quantity.mark],
    };
    let line = |name, color, groups: &[AtElevation]| Line { name, color, points: points(groups) };
    let lines = [line("view", VIEW, &comparison.by_view_elevation), line("light", LIGHT, &comparison.by_light_elevation)];
    chart(area, &axes, &lines)
}

/// What a chart shows.
struct Axes {
    title: &'static str,
    /// Name of the horizontal axis.
    over: &'static str,
    /// What the vertical axis shows in any case.
    shown: Option<f64>,
    /// Least range of the vertical axis.
    range: f64,
    /// Marks of the horizontal and the vertical axis.
    marks: [fn(&f64) -> String; 2],
}

/// A line of a chart, and its name.
struct Line {
    name: &'static str,
    color: RGBColor,
    points: Vec<(f64, f64)>,
}

fn chart(area: &DrawingArea<SVGBackend<'_>, Shift>, axes: &Axes, lines: &[Line]) -> Result<(), String> {
    let values = || lines.iter().flat_map(|line| &line.points);
    let [low, high] = values()
        .map(|&(_, value)| value)
        .chain(axes.shown)
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(value), high.max(value)]);
    // Nothing to draw but the axes.
    let [low, high] = if low <= high { [low, high] } else { [0.0, 0.0] };
    let last = values().fold(10.0_f64, |last, &(theta, _)| last.max(theta));
    let room = 0.08 * (high - low) + 0.5 * (axes.range - (high - low)).max(0.0);
    // An error of 0 is the floor of the axis; above the lines there is room for their names.
    let (floor, ceiling) = (if low == 0.0 { 0.0 } else { low - room }, high + 0.35 * (high - low) + room);
    let failed = |error: &dyn std::fmt::Display| error.to_string();

    area.fill(&WHITE).map_err(|error| failed(&error))?;
    let mut chart = ChartBuilder::on(area)
        .margin(10)
        .caption(axes.title, ("sans-serif", 20).into_font())
        .x_label_area_size(44)
        .y_label_area_size(58)
        .build_cartesian_2d(0.0..1.04 * last, floor..ceiling)
        .map_err(|error| failed(&error))?;
    chart
        .configure_mesh()
        .x_desc(axes.over)
        .x_labels(6)
        .y_labels(8)
        .x_label_formatter(&axes.marks[0])
        .y_label_formatter(&axes.marks[1])
        .label_style(("sans-serif", 15))
        .axis_desc_style(("sans-serif", 17))
        .light_line_style(WHITE)
        .draw()
        .map_err(|error| failed(&error))?;
    for Line { name, color, points } in lines {
        let style = ShapeStyle::from(color).stroke_width(2);
        chart
            .draw_series(LineSeries::new(points.iter().copied(), style))
            .map_err(|error| failed(&error))?
            .label(*name)
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 18, y)], style));
        chart.draw_series(points.iter().map(|&point| Circle::new(point, 3, style.filled()))).map_err(|error| failed(&error))?;
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::UpperLeft)
        .label_font(("sans-serif", 15))
        .background_style(WHITE)
        .border_style(RGBColor(200, 200, 200))
        .draw()
        .map_err(|error| failed(&error))
}
