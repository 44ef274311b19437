//! The values that can be read off a picture, and where in it they are drawn: for a page that shows the value at the
//! pointer, or moves along a curve by the keyboard.
//!
//! ```
//! use ringroad::plot::{Axis, Layer, Mark, Panel, Plot};
//!
//! let curve = Layer::Curve { name: "a".into(), style: 0, x: vec![0.0, 1.0], y: vec![2.0, 3.0] };
//! let panel = Panel { title: "p".into(), x: Axis::new("x"), y: Axis::new("y"), layers: vec![curve] };
//! let plot = Plot { id: "p".into(), title: "p".into(), description: "A line.".into(), columns: 1, panels: vec![panel] };
//! let fields = plot.fields();
//! let Mark::Curve { y, right, .. } = &fields[0].marks[0] else { panic!("a curve") };
//! assert_eq!(y, &[2.0, 3.0]);
//! assert!(right[0] < right[1]);
//! ```

use super::axis::Mapping;
use super::{Layer, Panel, Plot};
use serde::Serialize;

impl Plot {
    /// The values that can be read off every panel, and where they lie in the picture.
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

/// The rectangle between the axes of a panel, in units of the picture, and the values that can be read in it.
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
    /// Its curves, points and maps, as far as they lie between the axes.
    pub marks: Vec<Mark<'a>>,
}

/// Values that can be read off a picture (seven digits of them), and where they are drawn, in units of the picture.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(tag = "kind", rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Mark<'a> {
    /// A curve, or points. The lists have equal lengths, but for `low` and `high`, which may be empty.
    Curve {
        /// Its name; empty where it is alone.
        name: &'a str,
        /// Abscissae.
        x: Vec<f32>,
        /// Ordinates.
        y: Vec<f32>,
        /// Lower ends of the band about the curve, or of the error bars; empty where there are none.
        #[cfg_attr(test, ts(type = "Array<number | null>"))]
        low: Vec<f32>,
        /// Upper ends; empty where there are none.
        #[cfg_attr(test, ts(type = "Array<number | null>"))]
        high: Vec<f32>,
        /// Distance of the points from the left edge of the picture.
        right: Vec<f32>,
        /// Distance of the points from the upper edge of the picture.
        down: Vec<f32>,
    },
    /// A map.
    Map {
        /// What its values mean, or their unit.
        name: &'a str,
        /// Number of cells along x, which is the length of a row of `values`.
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
    /// The values that can be read off it.
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
    let visible: Vec<usize> = (0..xs.len()).filter(|&k| x.holds(xs[k]) && y.holds(ys[k])).collect();
    let each = |of: &dyn Fn(usize) -> f64| visible.iter().map(|&k| of(k) as f32).collect::<Vec<_>>();
    let tenths = |v: f64| (v * 10.0).round() / 10.0;
    let known = visible.iter().any(|&k| interval(k).is_some());
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
