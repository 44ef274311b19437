//! Tables to pictures: a [`Plot`] is plain data, panels of layers taken from the columns of tables, and is written
//! as SVG by the core alone, so that the command and the page give the same bytes.
//!
//! Only addition, multiplication and division go into a coordinate, which is then written with one decimal.
//! A map is a small PNG image, one pixel a cell, within the SVG. Colours are told apart by colour-blind eyes too,
//! and nothing is told by colour alone: curves differ in their dashes, points in their shapes.

pub mod colour;

use crate::plot::colour::{Ground, LARGEST, Quantity, Rgb, Scale, signed_logarithmic};
use serde::Serialize;
use std::fmt::Write as _;

/// A picture: a title, what is to be seen in words, and panels in rows.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Plot {
    /// Identifier, unique on a page.
    pub id: String,
    /// Title.
    pub title: String,
    /// What is to be seen, in words, for those who do not see it.
    pub description: String,
    /// Panels side by side in a row.
    pub columns: usize,
    /// The panels, row by row.
    pub panels: Vec<Panel>,
}

/// One pair of axes with what is drawn between them.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Panel {
    /// What it shows, in a few words.
    pub title: String,
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// What is drawn, the first at the bottom.
    pub layers: Vec<Layer>,
}

/// An axis.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Axis {
    /// What it measures, with the unit: `time (s)`.
    pub label: String,
    /// Its ends; found from the data where there are none.
    pub range: Option<(f64, f64)>,
    /// Whether it is the signed logarithmic scale of [`crate::plot::colour`], from −10 to 10: small and large
    /// differences in one picture.
    pub signed_log: bool,
}

impl Axis {
    /// An axis whose ends follow from the data.
    pub fn new(label: impl Into<String>) -> Self {
        Self { label: label.into(), range: None, signed_log: false }
    }
    /// An axis from `low` to `high`.
    pub fn from_to(label: impl Into<String>, low: f64, high: f64) -> Self {
        Self { label: label.into(), range: Some((low, high)), signed_log: false }
    }
    /// An axis on the signed logarithmic scale.
    pub fn signed_log(label: impl Into<String>) -> Self {
        Self { label: label.into(), range: Some((-LARGEST, LARGEST)), signed_log: true }
    }
}

/// Something drawn. `style` counts the curves of a panel from 0 and stands for colour, dashes and shape.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Layer {
    /// A curve, broken where a value is NaN.
    Curve {
        /// Name in the legend; empty for none.
        name: String,
        /// Colour and dashes.
        style: usize,
        /// Abscissae.
        x: Vec<f64>,
        /// Ordinates.
        y: Vec<f64>,
    },
    /// The area between two curves: an interval.
    Band {
        /// Name in the legend; empty for none.
        name: String,
        /// Colour.
        style: usize,
        /// Abscissae.
        x: Vec<f64>,
        /// Lower ends.
        low: Vec<f64>,
        /// Upper ends.
        high: Vec<f64>,
    },
    /// Points with error bars.
    Points {
        /// Name in the legend; empty for none.
        name: String,
        /// Colour and shape.
        style: usize,
        /// Abscissae.
        x: Vec<f64>,
        /// Ordinates.
        y: Vec<f64>,
        /// Half-lengths of the error bars; empty for none.
        error: Vec<f64>,
    },
    /// A thin line across, with its name beside it: a threshold, a value of the paper.
    Rule {
        /// What it marks.
        name: String,
        /// Whether it is vertical, at an abscissa.
        vertical: bool,
        /// Where.
        at: f64,
        /// Whether the name of a horizontal line stands at its left end.
        left: bool,
    },
    /// Cells coloured by value.
    Map {
        /// What the colour means, with the unit.
        name: String,
        /// Number of cells along x; their values are side by side.
        width: usize,
        /// The ends of the cells along x.
        x: (f64, f64),
        /// The ends of the cells along y.
        y: (f64, f64),
        /// Values, row by row, from the lowest y; NaN is left blank.
        values: Vec<f64>,
        /// The values at the ends of the colours.
        range: (f64, f64),
        /// The value drawn in the colour of the page, lower ones blue, higher ones amber; without it, colours rise
        /// in lightness.
        middle: Option<f64>,
        /// Whether the colours follow the signed logarithmic scale.
        signed_log: bool,
    },
}

const INK: &str = "#1c2430";
const QUIET: &str = "#5b6675";
const GRID: &str = "#e6e9ee";
/// Colours of curves: as different in lightness as in hue.
const COLOURS: [&str; 6] = ["#1d4f91", "#c06a00", "#7a4fa3", "#a3262a", "#1f7a4d", "#4a5a6a"];
const DASHES: [&str; 6] = ["", "7 3", "2 3", "9 3 2 3", "12 4", "4 2"];

/// Size of a panel's axes, and the room around them.
struct Frame {
    width: f64,
    height: f64,
    left: f64,
    right: f64,
    top: f64,
    bottom: f64,
}

const TOTAL_WIDTH: f64 = 960.0;
const HEADER: f64 = 46.0;

/// A number of an SVG attribute: one decimal, no trailing zero.
fn number(value: f64) -> String {
    let tenths = (value * 10.0).round();
    let text = format!("{:.1}", if tenths == 0.0 { 0.0 } else { tenths / 10.0 });
    text.strip_suffix(".0").map_or(text.clone(), str::to_owned)
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// Width of a text at 12 px, roughly.
fn text_width(text: &str) -> f64 {
    text.chars().map(|c| if "ijlt.,:;|()' ".contains(c) { 3.6 } else { 6.7 }).sum()
}

/// Places of ticks: 1, 2 or 5 times a power of ten apart, at most about `most` of them, with their labels.
pub fn ticks(low: f64, high: f64, most: usize) -> Vec<(f64, String)> {
    let span = high - low;
    if span.is_nan() || span <= 0.0 || most == 0 {
        return Vec::new();
    }
    let least = span / most as f64;
    let (mut power, mut decimals) = (1.0, 0_usize);
    while power > least {
        power /= 10.0;
        decimals += 1;
    }
    while power * 10.0 <= least {
        power *= 10.0;
        decimals = decimals.saturating_sub(1);
    }
    let factor = [1.0, 2.0, 5.0].into_iter().find(|f| f * power >= least * (1.0 - 1e-9)).unwrap_or(10.0);
    let (step, decimals) =
        if factor == 10.0 { (10.0 * power, decimals.saturating_sub(1)) } else { (factor * power, decimals) };
    let (first, last) = ((low / step - 1e-9).ceil() as i64, (high / step + 1e-9).floor() as i64);
    (first..=last)
        .map(|k| {
            let value = k as f64 * step;
            (value, format!("{value:.decimals$}").replace('-', "−"))
        })
        .collect()
}

fn signed_log_ticks() -> Vec<(f64, String)> {
    let scale = Scale::new(Quantity::Difference, Ground::Light, 1.0);
    scale.ticks().into_iter().map(|t| (t, format!("{t}").replace('-', "−"))).collect()
}

/// From data to the page along one axis.
#[derive(Clone, Copy)]
struct Mapping {
    low: f64,
    high: f64,
    start: f64,
    end: f64,
    signed_log: bool,
}

impl Mapping {
    fn at(self, value: f64) -> f64 {
        let place = if self.signed_log && !value.is_nan() {
            0.5 + 0.5 * signed_logarithmic(value)
        } else {
            (value - self.low) / (self.high - self.low)
        };
        self.start + place * (self.end - self.start)
    }
    fn ticks(self, most: usize) -> Vec<(f64, String)> {
        if self.signed_log { signed_log_ticks() } else { ticks(self.low, self.high, most) }
    }
    fn holds(self, value: f64) -> bool {
        let slack = 1e-9 * (self.high - self.low);
        value >= self.low - slack && value <= self.high + slack
    }
}

/// Ends of an axis for data: a little room, and zero where it is near.
fn ends(axis: &Axis, data: impl Iterator<Item = f64>, room: f64) -> (f64, f64) {
    if let Some(range) = axis.range {
        return range;
    }
    let (low, high) = data
        .filter(|v| v.is_finite())
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
    if low > high {
        return (0.0, 1.0);
    }
    if low == high {
        return (low - 0.5, high + 0.5);
    }
    let pad = room * (high - low);
    let near_zero = |end: f64, padded: f64| if end >= 0.0 && padded < 0.0 { 0.0 } else { padded };
    (near_zero(low, low - pad), -near_zero(-high, -high - pad))
}

impl Layer {
    fn abscissae(&self) -> Vec<f64> {
        match self {
            Self::Curve { x, .. } | Self::Band { x, .. } | Self::Points { x, .. } => x.clone(),
            Self::Map { x, .. } => vec![x.0, x.1],
            Self::Rule { vertical: true, at, .. } => vec![*at],
            Self::Rule { .. } => Vec::new(),
        }
    }

    fn ordinates(&self) -> Vec<f64> {
        match self {
            Self::Curve { y, .. } => y.clone(),
            Self::Band { low, high, .. } => low.iter().chain(high).copied().collect(),
            Self::Points { y, error, .. } if error.is_empty() => y.clone(),
            Self::Points { y, error, .. } => y
                .iter()
                .zip(error)
                .flat_map(|(&y, &e)| if e.is_nan() { [y, y] } else { [y - e, y + e] })
                .collect(),
            Self::Map { y, .. } => vec![y.0, y.1],
            Self::Rule { vertical: false, at, .. } => vec![*at],
            Self::Rule { .. } => Vec::new(),
        }
    }
}

impl Plot {
    /// The picture as a standalone SVG document.
    pub fn to_svg(&self) -> String {
        let rows = self.panels.len().div_ceil(self.columns.max(1));
        let height = HEADER + rows as f64 * self.cell().1 + 8.0;
        let id = escaped(&self.id);
        let mut out = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {w} {h}\" width=\"{w}\" height=\"{h}\" role=\"img\" aria-labelledby=\"{id}-title {id}-description\" font-family=\"system-ui, 'Segoe UI', 'DejaVu Sans', sans-serif\" font-size=\"12\" fill=\"{INK}\">\n<title id=\"{id}-title\">{}</title>\n<desc id=\"{id}-description\">{}</desc>\n<rect width=\"{w}\" height=\"{h}\" fill=\"#fff\"/>\n<text x=\"16\" y=\"28\" font-size=\"16\" font-weight=\"600\">{}</text>\n",
            escaped(&self.title),
            escaped(&self.description),
            escaped(&self.title),
            w = number(TOTAL_WIDTH),
            h = number(height),
        );
        for (k, panel) in self.panels.iter().enumerate() {
            panel.draw(&mut out, &self.frame(k), &format!("{id}-{k}"));
        }
        out.push_str("</svg>\n");
        out
    }

    /// Width and height of a panel with the room around it.
    fn cell(&self) -> (f64, f64) {
        let columns = self.columns.max(1);
        let width = TOTAL_WIDTH / columns as f64;
        (width, if columns == 1 { 330.0 } else { (width * 0.72).max(250.0) })
    }

    fn frame(&self, k: usize) -> Frame {
        let (columns, (cell_width, cell_height)) = (self.columns.max(1), self.cell());
        let (left, right, top, bottom) =
            (62.0, if self.panels[k].has_map() { 74.0 } else { 18.0 }, 44.0, 46.0);
        Frame {
            width: cell_width - left - right,
            height: cell_height - top - bottom,
            left: (k % columns) as f64 * cell_width + left,
            right,
            top: HEADER + (k / columns) as f64 * cell_height + top,
            bottom,
        }
    }

    /// What can be read off every panel and where it lies in the picture, for who points at a place or walks along
    /// a curve.
    pub fn fields(&self) -> Vec<Field<'_>> {
        let one = |(k, panel): (usize, &'_ Panel)| {
            let frame = self.frame(k);
            Field {
                title: &self.panels[k].title,
                left: frame.left,
                top: frame.top,
                width: frame.width,
                height: frame.height,
                x: &self.panels[k].x.label,
                y: &self.panels[k].y.label,
                marks: self.panels[k].marks(panel.mappings(&frame)),
            }
        };
        self.panels.iter().enumerate().map(one).collect()
    }
}

/// The rectangle between the axes of a panel, in units of the picture, and what can be read there.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Field<'a> {
    /// The panel's title.
    pub title: &'a str,
    /// Left edge.
    pub left: f64,
    /// Upper edge.
    pub top: f64,
    /// Width.
    pub width: f64,
    /// Height.
    pub height: f64,
    /// What the horizontal axis measures, with the unit.
    pub x: &'a str,
    /// What the vertical axis measures, with the unit.
    pub y: &'a str,
    /// Its curves, points and maps, as far as they are to be seen.
    pub marks: Vec<Mark<'a>>,
}

/// Values that can be read off a picture, with seven digits, and where they are drawn, in units of the picture.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Mark<'a> {
    /// A curve, or points.
    Curve {
        /// Its name; empty where it is alone.
        name: &'a str,
        /// Abscissae.
        x: Vec<f32>,
        /// Ordinates.
        y: Vec<f32>,
        /// Ends of the band about the curve, or of the error bars; empty where there are none.
        #[cfg_attr(test, ts(type = "Array<number | null>"))]
        low: Vec<f32>,
        /// Upper ends.
        #[cfg_attr(test, ts(type = "Array<number | null>"))]
        high: Vec<f32>,
        /// Where the points lie: from the left.
        right: Vec<f32>,
        /// Where the points lie: from the top.
        down: Vec<f32>,
    },
    /// A map.
    Map {
        /// What its values are, or their unit.
        name: &'a str,
        /// Number of cells along x.
        width: usize,
        /// Centres of the first and the last cell along x.
        x: (f32, f32),
        /// Centres of the first and the last cell along y.
        y: (f32, f32),
        /// Values, row by row, from the lowest y; `null` where there is none.
        #[cfg_attr(test, ts(type = "Array<number | null>"))]
        values: Vec<f32>,
        /// Left and right edge in the picture.
        across: (f64, f64),
        /// Lower and upper edge in the picture.
        up: (f64, f64),
    },
}

impl Panel {
    fn has_map(&self) -> bool {
        self.layers.iter().any(|l| matches!(l, Layer::Map { .. }))
    }

    /// Ends of the two axes.
    fn spans(&self) -> [(f64, f64); 2] {
        let has_map = self.has_map();
        let room = if has_map { 0.0 } else { 0.06 };
        let x_room = if has_map || !self.layers.iter().any(|l| matches!(l, Layer::Points { .. })) {
            0.0
        } else {
            0.03
        };
        let x = ends(&self.x, self.layers.iter().flat_map(Layer::abscissae), x_room);
        let y = ends(&self.y, self.layers.iter().flat_map(Layer::ordinates), room);
        [x, y]
    }

    /// From data to the picture, along x and along y.
    fn mappings(&self, frame: &Frame) -> [Mapping; 2] {
        let [x, y] = self.spans();
        let (left, bottom) = (frame.left, frame.top + frame.height);
        let (right, signed_log) = (left + frame.width, self.x.signed_log);
        [
            Mapping { low: x.0, high: x.1, start: left, end: right, signed_log },
            Mapping { low: y.0, high: y.1, start: bottom, end: frame.top, signed_log: self.y.signed_log },
        ]
    }

    /// What can be read off it.
    fn marks(&self, [x, y]: [Mapping; 2]) -> Vec<Mark<'_>> {
        let mut marks = Vec::new();
        for layer in &self.layers {
            match layer {
                Layer::Curve { name, style, x: xs, y: ys } => {
                    let band = self.layers.iter().find_map(|l| match l {
                        Layer::Band { style: of, x, low, high, .. } if of == style && x == xs => {
                            Some((low, high))
                        }
                        _ => None,
                    });
                    let interval = |k: usize| band.map(|(low, high)| (low[k], high[k]));
                    marks.push(mark(name, xs, ys, interval, x, y));
                }
                Layer::Points { name, x: xs, y: ys, error, .. } => {
                    let interval = |k: usize| error.get(k).map(|e| (ys[k] - e, ys[k] + e));
                    marks.push(mark(name, xs, ys, interval, x, y));
                }
                Layer::Map { name, width, x: across, y: up, values, .. } if !values.is_empty() => {
                    let centres = |(low, high): (f64, f64), cells: usize| {
                        let half = 0.5 * (high - low) / cells as f64;
                        ((low + half) as f32, (high - half) as f32)
                    };
                    marks.push(Mark::Map {
                        name,
                        width: *width,
                        x: centres(*across, *width),
                        y: centres(*up, values.len() / width),
                        values: values.iter().map(|&v| v as f32).collect(),
                        across: (x.at(across.0), x.at(across.1)),
                        up: (y.at(up.0), y.at(up.1)),
                    });
                }
                Layer::Map { .. } | Layer::Band { .. } | Layer::Rule { .. } => {}
            }
        }
        marks
    }

    fn draw(&self, out: &mut String, frame: &Frame, id: &str) {
        let (has_map, [x, y]) = (self.has_map(), self.mappings(frame));
        let clip = format!("{id}-clip");
        let _ = writeln!(
            out,
            "<clipPath id=\"{clip}\"><rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/></clipPath>",
            number(frame.left),
            number(frame.top),
            number(frame.width),
            number(frame.height)
        );
        self.draw_title(out, frame);
        self.draw_axes(out, frame, x, y, has_map);
        let _ = writeln!(out, "<g clip-path=\"url(#{clip})\">");
        for layer in &self.layers {
            draw_layer(out, layer, x, y);
        }
        out.push_str("</g>\n");
        for layer in &self.layers {
            match layer {
                Layer::Rule { name, vertical, at, left } => {
                    draw_rule_name(out, name, (*vertical, *at, *left), x, y);
                }
                Layer::Map { name, range, middle, signed_log, .. } => {
                    draw_colour_bar(out, name, *range, (middle.is_some(), *signed_log), frame, id);
                }
                _ => {}
            }
        }
        self.draw_legend(out, frame);
    }

    fn draw_title(&self, out: &mut String, frame: &Frame) {
        let _ = writeln!(
            out,
            "<text x=\"{}\" y=\"{}\" font-weight=\"600\" font-size=\"13\">{}</text>",
            number(frame.left),
            number(frame.top - 26.0),
            escaped(&self.title)
        );
    }

    fn draw_axes(&self, out: &mut String, frame: &Frame, x: Mapping, y: Mapping, has_map: bool) {
        let bottom = frame.top + frame.height;
        let right = frame.left + frame.width;
        let y_ticks = y.ticks((frame.height / 34.0) as usize);
        let widest = x.ticks(8).iter().map(|t| text_width(&t.1)).fold(24.0, f64::max);
        let x_ticks = x.ticks((frame.width / (widest + 22.0)) as usize);
        let _ = writeln!(out, "<g fill=\"{QUIET}\" stroke-width=\"1\">");
        for (value, label) in &y_ticks {
            let at = number(y.at(*value));
            let (from, to, stroke) =
                if has_map { (frame.left - 4.0, frame.left, QUIET) } else { (frame.left, right, GRID) };
            let _ = writeln!(
                out,
                "<path d=\"M{} {at}H{}\" stroke=\"{stroke}\"/><text x=\"{}\" y=\"{}\" text-anchor=\"end\">{label}</text>",
                number(from),
                number(to),
                number(frame.left - 8.0),
                number(y.at(*value) + 4.0)
            );
        }
        for (value, label) in &x_ticks {
            let at = number(x.at(*value));
            let _ = writeln!(
                out,
                "<path d=\"M{at} {}v4\" stroke=\"{QUIET}\"/><text x=\"{at}\" y=\"{}\" text-anchor=\"middle\">{label}</text>",
                number(bottom),
                number(bottom + 18.0)
            );
        }
        let _ = writeln!(
            out,
            "<path d=\"M{} {}H{}\" stroke=\"{QUIET}\"/>",
            number(frame.left),
            number(bottom),
            number(right)
        );
        let (middle_x, middle_y) = (frame.left + frame.width / 2.0, frame.top + frame.height / 2.0);
        let _ = writeln!(
            out,
            "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n<text transform=\"translate({} {}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n</g>",
            number(middle_x),
            number(bottom + frame.bottom - 10.0),
            escaped(&self.x.label),
            number(frame.left - 46.0),
            number(middle_y),
            escaped(&self.y.label)
        );
    }

    /// Names of curves, bands and points in a row above the axes.
    fn draw_legend(&self, out: &mut String, frame: &Frame) {
        let mut at = frame.left;
        let y = frame.top - 9.0;
        for layer in &self.layers {
            let (name, style, swatch) = match layer {
                Layer::Curve { name, style, .. } => {
                    let d = format!("M{} {}h22", number(at), number(y - 4.0));
                    (name, *style, format!("<path d=\"{d}\" {}/>", stroke(*style)))
                }
                Layer::Band { name, style, .. } => (
                    name,
                    *style,
                    format!(
                        "<rect x=\"{}\" y=\"{}\" width=\"22\" height=\"10\" fill=\"{}\" fill-opacity=\"0.18\"/>",
                        number(at),
                        number(y - 9.0),
                        COLOURS[style % COLOURS.len()]
                    ),
                ),
                Layer::Points { name, style, .. } => (name, *style, marker(*style, at + 11.0, y - 4.0)),
                Layer::Rule { .. } | Layer::Map { .. } => continue,
            };
            // The last ones give way to the panel beside; they can be read off all the same.
            let fits = at + 27.0 + text_width(name) <= frame.left + frame.width + frame.right;
            if name.is_empty() || !fits {
                continue;
            }
            let _ = writeln!(
                out,
                "{swatch}<text x=\"{}\" y=\"{}\" fill=\"{}\">{}</text>",
                number(at + 27.0),
                number(y),
                COLOURS[style % COLOURS.len()],
                escaped(name)
            );
            at += 27.0 + text_width(name) + 14.0;
        }
    }
}

/// The points of a curve that lie between the axes.
fn mark<'a>(
    name: &'a str,
    xs: &[f64],
    ys: &[f64],
    interval: impl Fn(usize) -> Option<(f64, f64)>,
    x: Mapping,
    y: Mapping,
) -> Mark<'a> {
    let seen: Vec<usize> = (0..xs.len()).filter(|&k| x.holds(xs[k]) && y.holds(ys[k])).collect();
    let each = |of: &dyn Fn(usize) -> f64| seen.iter().map(|&k| of(k) as f32).collect::<Vec<_>>();
    let tenths = |v: f64| (v * 10.0).round() / 10.0;
    let known = seen.iter().any(|&k| interval(k).is_some());
    let end = |of: fn((f64, f64)) -> f64| {
        if known { each(&|k| interval(k).map_or(f64::NAN, of)) } else { Vec::new() }
    };
    Mark::Curve {
        name,
        x: each(&|k| xs[k]),
        y: each(&|k| ys[k]),
        low: end(|i| i.0),
        high: end(|i| i.1),
        right: each(&|k| tenths(x.at(xs[k]))),
        down: each(&|k| tenths(y.at(ys[k]))),
    }
}

fn stroke(style: usize) -> String {
    let (colour, dash) = (COLOURS[style % COLOURS.len()], DASHES[style % DASHES.len()]);
    let dashes = if dash.is_empty() { String::new() } else { format!(" stroke-dasharray=\"{dash}\"") };
    format!("fill=\"none\" stroke=\"{colour}\" stroke-width=\"1.6\" stroke-linejoin=\"round\"{dashes}")
}

/// A point: disc, square, triangle, diamond, by style.
fn marker(style: usize, x: f64, y: f64) -> String {
    let colour = COLOURS[style % COLOURS.len()];
    let d = match style % 4 {
        0 => format!("M{} {}a3.5 3.5 0 1 0 7 0a3.5 3.5 0 1 0 -7 0z", number(x - 3.5), number(y)),
        1 => format!("M{} {}h7v7h-7z", number(x - 3.5), number(y - 3.5)),
        2 => format!("M{} {}l4.5 8h-9z", number(x), number(y - 5.0)),
        _ => format!("M{} {}l4.5 4.5l-4.5 4.5l-4.5 -4.5z", number(x), number(y - 4.5)),
    };
    format!("<path d=\"{d}\" fill=\"{colour}\" stroke=\"#fff\" stroke-width=\"0.8\"/>")
}

/// `M… L…` through the points, with a new start after what does not exist.
fn path(points: impl Iterator<Item = (f64, f64)>, x: Mapping, y: Mapping) -> String {
    let mut d = String::new();
    let mut pen_down = false;
    // Far outside the axes nothing is seen, and huge numbers upset viewers.
    let bounded = |v: f64, m: Mapping| m.at(v).clamp(-4000.0, 4000.0);
    for (px, py) in points {
        if px.is_finite() && py.is_finite() {
            let command = if pen_down { 'L' } else { 'M' };
            let _ = write!(d, "{command}{} {}", number(bounded(px, x)), number(bounded(py, y)));
        }
        pen_down = px.is_finite() && py.is_finite();
    }
    d
}

fn draw_layer(out: &mut String, layer: &Layer, x: Mapping, y: Mapping) {
    match layer {
        Layer::Curve { style, x: xs, y: ys, .. } => {
            let d = path(xs.iter().copied().zip(ys.iter().copied()), x, y);
            let _ = writeln!(out, "<path d=\"{d}\" {}/>", stroke(*style));
        }
        Layer::Band { style, x: xs, low, high, .. } => {
            let there = xs.iter().copied().zip(high.iter().copied());
            let back = xs.iter().copied().zip(low.iter().copied()).rev();
            let known = there.chain(back).filter(|p| p.1.is_finite());
            let d = path(known, x, y);
            let colour = COLOURS[style % COLOURS.len()];
            let _ = writeln!(out, "<path d=\"{d}z\" fill=\"{colour}\" fill-opacity=\"0.18\"/>");
        }
        Layer::Points { style, x: xs, y: ys, error, .. } => {
            let colour = COLOURS[style % COLOURS.len()];
            for (k, (&px, &py)) in xs.iter().zip(ys).enumerate() {
                if !(py.is_finite() && x.holds(px)) {
                    continue;
                }
                if let Some(&e) = error.get(k).filter(|e| e.is_finite() && **e > 0.0) {
                    let _ = writeln!(
                        out,
                        "<path d=\"M{} {}V{}\" stroke=\"{colour}\" stroke-width=\"1.3\"/>",
                        number(x.at(px)),
                        number(y.at(py - e)),
                        number(y.at(py + e))
                    );
                }
                let _ = writeln!(out, "{}", marker(*style, x.at(px), y.at(py)));
            }
        }
        Layer::Rule { vertical, at, .. } => {
            let d = if *vertical {
                format!("M{} {}V{}", number(x.at(*at)), number(y.start), number(y.end))
            } else {
                format!("M{} {}H{}", number(x.start), number(y.at(*at)), number(x.end))
            };
            let _ = writeln!(out, "<path d=\"{d}\" stroke=\"{QUIET}\" stroke-dasharray=\"4 3\"/>");
        }
        Layer::Map { width, x: across, y: up, values, range, middle, signed_log, .. } => {
            let scale =
                Mapping { low: range.0, high: range.1, start: 0.0, end: 1.0, signed_log: *signed_log };
            let png = map_png(*width, values, scale, middle.is_some());
            let _ = writeln!(
                out,
                "<image x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" preserveAspectRatio=\"none\" image-rendering=\"pixelated\" href=\"data:image/png;base64,{}\"/>",
                number(x.at(across.0)),
                number(y.at(up.1)),
                number(x.at(across.1) - x.at(across.0)),
                number(y.at(up.0) - y.at(up.1)),
                base64(&png)
            );
        }
    }
}

fn draw_rule_name(
    out: &mut String,
    name: &str,
    (vertical, at, left): (bool, f64, bool),
    x: Mapping,
    y: Mapping,
) {
    if name.is_empty() || !(if vertical { x } else { y }).holds(at) {
        return;
    }
    let name = escaped(name);
    let halo = "stroke=\"#fff\" stroke-width=\"3\" paint-order=\"stroke\"";
    if vertical {
        let place = x.at(at);
        let (shift, anchor) = if place > 0.5 * (x.start + x.end) { (-5.0, "end") } else { (5.0, "start") };
        let _ = writeln!(
            out,
            "<text x=\"{}\" y=\"{}\" text-anchor=\"{anchor}\" fill=\"{QUIET}\" {halo}>{name}</text>",
            number(place + shift),
            number(y.end + 12.0)
        );
    } else {
        let (place, anchor) = if left { (x.start + 4.0, "start") } else { (x.end - 4.0, "end") };
        let _ = writeln!(
            out,
            "<text x=\"{}\" y=\"{}\" text-anchor=\"{anchor}\" fill=\"{QUIET}\" {halo}>{name}</text>",
            number(place),
            number(y.at(at) - 4.0)
        );
    }
}

/// Colours of a map; the first entry of the image's palette is kept for blanks.
fn palette(diverging: bool) -> Vec<Rgb> {
    let quantity = if diverging { Quantity::Difference } else { Quantity::Speed };
    let scale = Scale::new(quantity, Ground::Light, 1.0);
    let colours = scale.colours();
    (0..255).map(|i| colours[i * (colours.len() - 1) / 254]).collect()
}

fn draw_colour_bar(
    out: &mut String,
    name: &str,
    range: (f64, f64),
    (diverging, signed_log): (bool, bool),
    frame: &Frame,
    id: &str,
) {
    let colours = palette(diverging);
    let x = frame.left + frame.width + 12.0;
    let _ = write!(out, "<linearGradient id=\"{id}-bar\" x1=\"0\" y1=\"1\" x2=\"0\" y2=\"0\">");
    for k in 0..=16 {
        let [r, g, b] = colours[k * 254 / 16];
        let _ = write!(out, "<stop offset=\"{}\" stop-color=\"#{r:02x}{g:02x}{b:02x}\"/>", k as f64 / 16.0);
    }
    let _ = writeln!(
        out,
        "</linearGradient><rect x=\"{}\" y=\"{}\" width=\"10\" height=\"{}\" fill=\"url(#{id}-bar)\"/>",
        number(x),
        number(frame.top),
        number(frame.height)
    );
    let bottom = frame.top + frame.height;
    let up = Mapping { low: range.0, high: range.1, start: bottom, end: frame.top, signed_log };
    for (value, label) in up.ticks(5) {
        let _ = writeln!(
            out,
            "<text x=\"{}\" y=\"{}\" fill=\"{QUIET}\" font-size=\"11\">{label}</text>",
            number(x + 14.0),
            number(up.at(value) + 4.0)
        );
    }
    let _ = writeln!(
        out,
        "<text x=\"{}\" y=\"{}\" text-anchor=\"end\" fill=\"{QUIET}\" font-size=\"11\">{}</text>",
        number(frame.left + frame.width + frame.right - 6.0),
        number(frame.top - 9.0),
        escaped(name)
    );
}

/// One pixel a cell, the largest y in the first row.
fn map_png(width: usize, values: &[f64], scale: Mapping, diverging: bool) -> Vec<u8> {
    let height = values.len() / width.max(1);
    let mut pixels = Vec::with_capacity(height * (width + 1));
    for row in (0..height).rev() {
        pixels.push(0); // no filter
        for &value in &values[row * width..][..width] {
            let place = scale.at(value).clamp(0.0, 1.0);
            // NaN becomes 0, the blank.
            pixels.push(if place.is_nan() { 0 } else { 1 + (place * 254.0).round() as u8 });
        }
    }
    let mut colours = vec![255, 255, 255];
    colours.extend(palette(diverging).into_iter().flatten());
    let mut png = b"\x89PNG\r\n\x1a\n".to_vec();
    let mut head = Vec::new();
    head.extend((width as u32).to_be_bytes());
    head.extend((height as u32).to_be_bytes());
    head.extend([8, 3, 0, 0, 0]); // 8 bits, palette
    chunk(&mut png, *b"IHDR", &head);
    chunk(&mut png, *b"PLTE", &colours);
    chunk(&mut png, *b"IDAT", &zlib_stored(&pixels));
    chunk(&mut png, *b"IEND", &[]);
    png
}

/// A PNG chunk: length, name, data and their CRC-32.
fn chunk(png: &mut Vec<u8>, name: [u8; 4], data: &[u8]) {
    png.extend((data.len() as u32).to_be_bytes());
    let start = png.len();
    png.extend(name);
    png.extend(data);
    let crc = !png[start..].iter().fold(u32::MAX, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |c, _| if c & 1 == 1 { (c >> 1) ^ 0xedb8_8320 } else { c >> 1 })
    });
    png.extend(crc.to_be_bytes());
}

/// A zlib stream of stored blocks: the maps are small, and a compressor would be larger than what it saves.
fn zlib_stored(data: &[u8]) -> Vec<u8> {
    let mut out = vec![0x78, 0x01];
    let mut blocks = data.chunks(65_535).peekable();
    while let Some(block) = blocks.next() {
        out.push(u8::from(blocks.peek().is_none()));
        let length = block.len() as u16;
        out.extend(length.to_le_bytes());
        out.extend((!length).to_le_bytes());
        out.extend(block);
    }
    let (a, b) = data.iter().fold((1_u32, 0_u32), |(a, b), &byte| {
        let a = (a + u32::from(byte)) % 65_521;
        (a, (b + a) % 65_521)
    });
    out.extend(((b << 16) | a).to_be_bytes());
    out
}

fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut out = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for part in bytes.chunks(3) {
        let byte = |i: usize| u32::from(part.get(i).copied().unwrap_or(0));
        let bits = byte(0) << 16 | byte(1) << 8 | byte(2);
        for i in 0..4 {
            let digit = DIGITS[(bits >> (18 - 6 * i)) as usize & 63] as char;
            out.push(if i <= part.len() { digit } else { '=' });
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(low: f64, high: f64, most: usize) -> Vec<String> {
        ticks(low, high, most).into_iter().map(|t| t.1).collect()
    }

    #[test]
    fn ticks_are_round_numbers() {
        assert_eq!(labels(0.0, 1000.0, 5), ["0", "200", "400", "600", "800", "1000"]);
        assert_eq!(labels(-1.2, 0.5, 5), ["−1.0", "−0.5", "0.0", "0.5"]);
        assert_eq!(labels(0.0, 0.8, 4), ["0.0", "0.2", "0.4", "0.6", "0.8"]);
        assert_eq!(labels(0.53, 0.55, 4), ["0.530", "0.535", "0.540", "0.545", "0.550"]);
        assert_eq!(labels(1.0, 1.0, 4), Vec::<String>::new());
        assert_eq!(labels(f64::NAN, 1.0, 4), Vec::<String>::new());
        assert_eq!(labels(0.0, 30_000.0, 3), ["0", "10000", "20000", "30000"]);
    }

    #[test]
    fn base64_of_the_standard() {
        for (text, code) in [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foobar", "Zm9vYmFy")]
        {
            assert_eq!(base64(text.as_bytes()), code);
        }
    }

    /// Checksums of the standards: CRC-32 of "IEND" and Adler-32 of "Wikipedia".
    #[test]
    fn checksums_are_right() {
        let mut png = Vec::new();
        chunk(&mut png, *b"IEND", &[]);
        assert_eq!(png, [0, 0, 0, 0, b'I', b'E', b'N', b'D', 0xae, 0x42, 0x60, 0x82]);
        assert_eq!(zlib_stored(b"Wikipedia")[16..], [0x11, 0xe6, 0x03, 0x98]);
    }

    fn plot() -> Plot {
        Plot {
            id: "test".into(),
            title: "Speed < flow & more".into(),
            description: "A curve".into(),
            columns: 2,
            panels: vec![
                Panel {
                    title: "curve".into(),
                    x: Axis::new("time (s)"),
                    y: Axis::new("speed (m/s)"),
                    layers: vec![
                        Layer::Band {
                            name: "interval".into(),
                            style: 0,
                            x: vec![0.0, 1.0],
                            low: vec![0.0, 0.5],
                            high: vec![1.0, 2.0],
                        },
                        Layer::Curve {
                            name: "a".into(),
                            style: 0,
                            x: vec![0.0, 1.0, 2.0, 3.0],
                            y: vec![0.0, f64::NAN, 1.0, 2.0],
                        },
                        Layer::Points {
                            name: "b".into(),
                            style: 1,
                            x: vec![1.0],
                            y: vec![1.0],
                            error: vec![0.2],
                        },
                        Layer::Rule { name: "limit".into(), vertical: false, at: 1.5, left: false },
                    ],
                },
                Panel {
                    title: "map".into(),
                    x: Axis::new("x"),
                    y: Axis::new("y"),
                    layers: vec![Layer::Map {
                        name: "flow".into(),
                        width: 2,
                        x: (0.0, 2.0),
                        y: (0.0, 2.0),
                        values: vec![0.0, 0.5, 1.0, f64::NAN],
                        range: (0.0, 1.0),
                        middle: None,
                        signed_log: false,
                    }],
                },
            ],
        }
    }

    #[test]
    fn a_picture_says_what_it_is_and_escapes_its_texts() {
        let svg = plot().to_svg();
        assert!(svg.starts_with("<svg xmlns") && svg.ends_with("</svg>\n"));
        for part in [
            "role=\"img\"",
            "<title id=\"test-title\">Speed &lt; flow &amp; more</title>",
            "<desc",
            "time (s)",
            "limit",
        ] {
            assert!(svg.contains(part), "{part}");
        }
        assert!(!svg.contains("NaN") && !svg.contains("inf"));
        assert_eq!(svg, plot().to_svg());
    }

    /// Every value that is drawn can be read, and lies where it is drawn.
    #[test]
    fn what_is_drawn_can_be_read() {
        let plot = plot();
        let svg = plot.to_svg();
        let fields = plot.fields();
        let Mark::Curve { name, x, y, low, high, right, down } = &fields[0].marks[0] else {
            panic!("a curve")
        };
        // A value is missing at 1; the band, which ends at 1, is not that of the curve.
        assert_eq!((*name, x.as_slice(), y.as_slice()), ("a", &[0.0, 2.0, 3.0][..], &[0.0, 1.0, 2.0][..]));
        assert!(low.is_empty() && high.is_empty());
        assert!(
            svg.contains(&format!("M{} {}M{} {}L", right[0], down[0], right[1], down[1])),
            "{right:?} {down:?}"
        );
        let Mark::Curve { name, low, high, .. } = &fields[0].marks[1] else { panic!("points") };
        assert_eq!((*name, low.as_slice(), high.as_slice()), ("b", &[0.8][..], &[1.2][..]));
        let Mark::Map { width, x, y, values, across, up, .. } = &fields[1].marks[0] else { panic!("a map") };
        assert_eq!((*width, *x, *y, values.len()), (2, (0.5, 1.5), (0.5, 1.5), 4));
        let field = &fields[1];
        assert_eq!((across.1, up.0), (field.left + field.width, field.top + field.height));
        let json = serde_json::to_value(&fields).unwrap();
        assert!(json[1]["marks"][0]["values"][3].is_null(), "a cell without a value");
    }

    #[test]
    fn a_band_about_a_curve_is_read_with_it() {
        let mut plot = plot();
        let Layer::Band { x, low, high, .. } = &mut plot.panels[0].layers[0] else { panic!("a band") };
        (*x, *low, *high) = (vec![0.0, 1.0, 2.0, 3.0], vec![-1.0; 4], vec![1.0; 4]);
        let fields = plot.fields();
        let Mark::Curve { low, high, .. } = &fields[0].marks[0] else { panic!("a curve") };
        assert_eq!((low.as_slice(), high.as_slice()), (&[-1.0; 3][..], &[1.0; 3][..]));
    }

    #[test]
    fn a_curve_is_broken_where_there_is_no_value() {
        let m = Mapping { low: 0.0, high: 3.0, start: 0.0, end: 30.0, signed_log: false };
        let d = path([(0.0, 0.0), (1.0, f64::NAN), (2.0, 1.0), (3.0, 2.0)].into_iter(), m, m);
        assert_eq!(d, "M0 0M20 10L30 20");
    }

    #[test]
    fn a_map_has_one_pixel_a_cell_with_the_largest_y_first() {
        let unit = Mapping { low: 0.0, high: 1.0, start: 0.0, end: 1.0, signed_log: false };
        let png = map_png(2, &[0.0, 0.5, 1.0, f64::NAN], unit, false);
        let start = png.windows(4).position(|w| w == b"IDAT").unwrap() + 4 + 2 + 5;
        assert_eq!(png[start..start + 6], [0, 255, 0, 0, 1, 128]);
    }
}
