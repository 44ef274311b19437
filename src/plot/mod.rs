//! Tables to pictures: a [`Plot`] is plain data, panels of layers taken from the columns of tables. The core itself
//! writes it as SVG, so the command and the page give the same bytes.
//!
//! | file | what it holds |
//! |---|---|
//! | this one | the data of a picture: [`Plot`], [`Panel`], [`Layer`] |
//! | [`axis`] | an axis, its ticks, and the way from a value to a place in the picture |
//! | `layout` | where the panels lie and what their axes span |
//! | `svg` | [`Plot::to_svg`] |
//! | `png` | a map as a small image within the SVG, one pixel for each cell |
//! | [`readout`] | the values that can be read at a place of the picture, [`Plot::fields`] |
//! | [`colour`] | the colour of a number |
//!
//! A coordinate is computed with addition, multiplication and division alone (on a signed logarithmic axis with a
//! portable logarithm too) and written with one decimal, so that it is the same on every machine. The colours differ
//! for colour-blind readers too, and no information is in colour alone: curves also differ in their dashes, points in
//! their shapes.
//!
//! ```
//! use ringroad::plot::{Axis, Layer, Panel, Plot};
//!
//! let plot = Plot {
//!     id: "speeds".into(),
//!     title: "Speed of one vehicle".into(),
//!     description: "The speed rises from 9 to 11 m/s within 20 s.".into(),
//!     columns: 1,
//!     panels: vec![Panel {
//!         title: "vehicle 1".into(),
//!         x: Axis::new("time (s)"),
//!         y: Axis::from_to("speed (m/s)", 0.0, 12.0),
//!         layers: vec![Layer::Curve {
//!             name: String::new(),
//!             style: 0,
//!             x: vec![0.0, 10.0, 20.0],
//!             y: vec![9.0, 10.5, 11.0],
//!         }],
//!     }],
//! };
//! let svg = plot.to_svg();
//! assert!(svg.starts_with("<svg") && svg.contains("speed (m/s)"));
//! ```

pub mod axis;
pub mod colour;
mod layout;
mod png;
pub mod readout;
mod svg;

pub use axis::{Axis, ticks};
pub use readout::{Field, Mark};

use serde::Serialize;

/// A picture: a title, a description in words, and panels in rows.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Plot {
    /// Identifier, unique on a page.
    pub id: String,
    /// Title.
    pub title: String,
    /// What the picture shows, in words, for readers that cannot see it.
    pub description: String,
    /// Number of panels side by side in a row.
    pub columns: usize,
    /// The panels, row by row.
    pub panels: Vec<Panel>,
}

/// A pair of axes and what is drawn between them.
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

/// Something drawn. `style` numbers the curves of a panel from 0 and chooses colour, dashes and shape. The lists of
/// one layer have equal lengths.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
#[non_exhaustive]
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
    /// A thin straight line from edge to edge with its name beside it: a threshold, a value of the paper.
    Rule {
        /// What it marks.
        name: String,
        /// Whether it is vertical, at an abscissa; otherwise it is horizontal, at an ordinate.
        vertical: bool,
        /// The abscissa or ordinate.
        at: f64,
        /// Whether the name of a horizontal line stands at its left end instead of its right end.
        left: bool,
    },
    /// Cells coloured by value.
    Map {
        /// What the colour means, with the unit.
        name: String,
        /// Number of cells along x, which is the length of a row of `values`.
        width: usize,
        /// Outer edges of the first and the last cell along x.
        x: (f64, f64),
        /// Outer edges of the first and the last cell along y.
        y: (f64, f64),
        /// Values, row by row, from the lowest y; a cell with NaN is left blank.
        values: Vec<f64>,
        /// The values at the ends of the colours.
        range: (f64, f64),
        /// The value drawn in the colour of the page; lower values are blue, higher ones amber. Without it, the
        /// colours get lighter with the value.
        middle: Option<f64>,
        /// Whether the colours follow the signed logarithmic scale.
        signed_log: bool,
    },
}

#[cfg(test)]
mod tests {
    use super::*;

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
}
