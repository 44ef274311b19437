//! Draws the space-time map on a canvas of the page: one column of pixels for each column of the recorded map, the
//! newest at the right edge once the canvas is full. Only columns that are new since the last time are drawn.

use crate::live::{BINS, COLUMNS, Column, Live};
use crate::plot::colour::{Ground, Quantity, Rgb, Scale};
use crate::web::types::MapReading;
use wasm_bindgen::{Clamped, JsValue};
use web_sys::{ImageData, OffscreenCanvas, OffscreenCanvasRenderingContext2d};

/// What the map shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct MapSettings {
    /// What colour stands for: a difference of speed, or a speed.
    pub(super) quantity: Quantity,
    /// Background of the page.
    pub(super) ground: Ground,
    /// Lane, from 0.
    pub(super) lane: usize,
    /// Whether the map is drawn in the co-moving frame, which moves at the equilibrium speed.
    pub(super) co_moving: bool,
}

impl MapSettings {
    /// Cells by which the co-moving frame has moved along the ring at the time of a column.
    fn offset(&self, column: &Column, length: f64) -> usize {
        if !self.co_moving {
            return 0;
        }
        let laps = column.equilibrium * column.time / length;
        ((laps - laps.floor()) * BINS as f64) as usize % BINS
    }
}

/// The canvas and what is drawn on it.
pub(super) struct MapPainter {
    canvas: Option<(OffscreenCanvas, OffscreenCanvasRenderingContext2d)>,
    settings: MapSettings,
    /// Number of columns that the run had made when the map was last drawn; `None` if everything is to be drawn anew.
    drawn: Option<u64>,
}

impl Default for MapPainter {
    fn default() -> Self {
        let settings =
            MapSettings { quantity: Quantity::Difference, ground: Ground::Light, lane: 0, co_moving: false };
        Self { canvas: None, settings, drawn: None }
    }
}

impl MapPainter {
    /// Draws on that canvas from now on.
    pub(super) fn attach(&mut self, canvas: OffscreenCanvas, context: OffscreenCanvasRenderingContext2d) {
        self.canvas = Some((canvas, context));
        self.drawn = None;
    }

    /// Shows something else from now on.
    pub(super) fn set(&mut self, settings: MapSettings) {
        if settings != self.settings {
            self.settings = settings;
            self.drawn = None;
        }
    }

    /// Another run begins: everything is drawn anew.
    pub(super) fn clear(&mut self) {
        self.drawn = None;
    }

    /// Draws the columns that are new. The time it takes grows with their number.
    pub(super) fn paint(&mut self, live: &Live) -> Result<(), JsValue> {
        let Some((canvas, context)) = &self.canvas else { return Ok(()) };
        let (made, kept) = (live.columns_made(), live.columns().len());
        let new = if let Some(drawn) = self.drawn {
            (made - drawn).min(kept as u64) as usize
        } else {
            context.clear_rect(0.0, 0.0, COLUMNS as f64, BINS as f64);
            kept
        };
        if new == 0 {
            return Ok(());
        }
        // What is drawn already moves to the left by the number of columns that are no longer kept.
        let before = kept - new;
        let leaving =
            self.drawn.map_or(0, |drawn| (drawn.min(COLUMNS as u64) as usize).saturating_sub(before));
        if leaving > 0 {
            context.draw_image_with_offscreen_canvas(canvas, -(leaving as f64), 0.0)?;
        }
        let pixels = self.pixels(live, before, new);
        let image = ImageData::new_with_u8_clamped_array_and_sh(Clamped(&pixels), new as u32, BINS as u32)?;
        context.put_image_data(&image, before as f64, 0.0)?;
        self.drawn = Some(made);
        Ok(())
    }

    /// Red, green, blue, opacity of `new` columns from `first` on, row by row from the top (x = L).
    fn pixels(&self, live: &Live, first: usize, new: usize) -> Vec<u8> {
        let length = live.simulation().scenario().length;
        let scale = Scale::new(self.settings.quantity, self.settings.ground, live.equilibrium().speed);
        let mut pixels = vec![0; 4 * new * BINS];
        for (k, column) in live.columns().iter().skip(first).enumerate() {
            let Some(cells) = column.speeds.chunks_exact(BINS).nth(self.settings.lane) else { continue };
            let offset = self.settings.offset(column, length);
            for row in 0..BINS {
                let speed = f64::from(cells[(BINS - 1 - row + offset) % BINS]);
                if speed.is_nan() {
                    continue;
                }
                let value = match self.settings.quantity {
                    Quantity::Difference => speed - column.equilibrium,
                    _ => speed,
                };
                let [r, g, b]: Rgb = scale.colour(value);
                pixels[4 * (row * new + k)..][..4].copy_from_slice(&[r, g, b, 255]);
            }
        }
        pixels
    }

    /// What is drawn in a column (from the left edge) and a cell (from x = 0 up); `None` outside the map.
    pub(super) fn reading(&self, live: &Live, column: usize, bin: usize) -> Option<MapReading> {
        let shown = live.columns().get(column).filter(|_| bin < BINS)?;
        let length = live.simulation().scenario().length;
        let cell = (bin + self.settings.offset(shown, length)) % BINS;
        let speed = shown.speeds.get(self.settings.lane * BINS + cell).copied().unwrap_or(f32::NAN);
        Some(MapReading {
            time: shown.time,
            position: (cell as f64 + 0.5) * length / BINS as f64,
            speed: speed.into(),
            difference: f64::from(speed) - shown.equilibrium,
        })
    }
}
