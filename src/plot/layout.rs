//! Where the panels of a picture lie and what their axes span.

use super::axis::{Mapping, ends};
use super::{Layer, Panel, Plot};

/// The rectangle between the axes of a panel and the margins beside it, in units of the picture.
pub(super) struct Frame {
    pub width: f64,
    pub height: f64,
    /// Left edge of the rectangle.
    pub left: f64,
    /// Margin to the right of it.
    pub right: f64,
    /// Upper edge of the rectangle.
    pub top: f64,
    /// Margin below it.
    pub bottom: f64,
}

/// Width of every picture.
pub(super) const TOTAL_WIDTH: f64 = 960.0;

/// Height of the title of the picture.
const HEADER: f64 = 46.0;

impl Plot {
    /// Height of the picture.
    pub(super) fn height(&self) -> f64 {
        let rows = self.panels.len().div_ceil(self.columns.max(1));
        HEADER + rows as f64 * self.cell().1 + 8.0
    }

    /// Width and height of a panel with its margins.
    fn cell(&self) -> (f64, f64) {
        let columns = self.columns.max(1);
        let width = TOTAL_WIDTH / columns as f64;
        (width, if columns == 1 { 330.0 } else { (width * 0.72).max(250.0) })
    }

    /// Where the axes of a panel, counted from 0, lie.
    pub(super) fn frame(&self, k: usize) -> Frame {
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
}

impl Panel {
    pub(super) fn has_map(&self) -> bool {
        self.layers.iter().any(|l| matches!(l, Layer::Map { .. }))
    }

    /// Ends of the two axes.
    fn spans(&self) -> [(f64, f64); 2] {
        let has_map = self.has_map();
        let y_padding = if has_map { 0.0 } else { 0.06 };
        let x_padding = if has_map || !self.layers.iter().any(|l| matches!(l, Layer::Points { .. })) {
            0.0
        } else {
            0.03
        };
        let x = ends(&self.x, self.layers.iter().flat_map(Layer::abscissae), x_padding);
        let y = ends(&self.y, self.layers.iter().flat_map(Layer::ordinates), y_padding);
        [x, y]
    }

    /// The way from a value to a place in the picture, along x and along y.
    pub(super) fn mappings(&self, frame: &Frame) -> [Mapping; 2] {
        let [x, y] = self.spans();
        let (left, bottom) = (frame.left, frame.top + frame.height);
        let (right, signed_log) = (left + frame.width, self.x.signed_log);
        [
            Mapping { low: x.0, high: x.1, start: left, end: right, signed_log },
            Mapping { low: y.0, high: y.1, start: bottom, end: frame.top, signed_log: self.y.signed_log },
        ]
    }
}

impl Layer {
    /// Every abscissa that the axis must span.
    fn abscissae(&self) -> Vec<f64> {
        match self {
            Self::Curve { x, .. } | Self::Band { x, .. } | Self::Points { x, .. } => x.clone(),
            Self::Map { x, .. } => vec![x.0, x.1],
            Self::Rule { vertical: true, at, .. } => vec![*at],
            Self::Rule { .. } => Vec::new(),
        }
    }

    /// Every ordinate that the axis must span, ends of intervals among them.
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
