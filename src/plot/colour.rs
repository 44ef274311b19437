//! The colour of a number, for vehicles on the ring, for space-time maps and for maps in pictures.
//!
//! Speed is shown as its difference from the equilibrium speed, δv, on a *signed logarithmic* scale,
//! `u = sign(δv)·ln(1 + |δv|/ε)/ln(1 + δv_max/ε)`. On a linear scale of 0–20 m/s a wave that starts at a centimetre
//! per second is invisible for minutes; on this scale its growth or decay is visible from the first second.
//! Blue against amber, and cividis (Nuñez, Anderton & Renslow, PLoS ONE 13, 2018) for absolute values, can be told
//! apart by colour-blind readers.
//!
//! ```
//! use ringroad::plot::colour::{Ground, Quantity, Scale};
//!
//! let scale = Scale::new(Quantity::Difference, Ground::Light, 10.74);
//! let [red, _, blue] = scale.colour(-1.0);
//! assert!(blue > red, "slower than equilibrium is blue");
//! ```

#![allow(clippy::unreadable_literal)] // colours: red, green and blue, two hexadecimal digits each

/// ε, m/s: the scale is nearly linear below it and logarithmic above.
pub const SMALLEST: f64 = 0.01;
/// δv_max, m/s: the scale ends at ±δv_max; larger differences have the colour of the ends.
pub const LARGEST: f64 = 10.0;

/// What a colour stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[cfg_attr(test, ts(rename_all = "lowercase"))]
pub enum Quantity {
    /// Difference from the equilibrium speed, m/s, signed logarithmic.
    Difference,
    /// Speed, m/s, linear from 0.
    Speed,
    /// Frustration φ, linear in the probability of an attempt within a second, (2/π)·arctan φ.
    Frustration,
}

/// The background of the page. A difference of zero has its colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ground {
    /// A light page.
    Light,
    /// A dark page.
    Dark,
}

/// An opaque colour: red, green, blue.
pub type Rgb = [u8; 3];

/// The place of a difference of speed (m/s) on the signed logarithmic scale, −1 … 1.
pub fn signed_logarithmic(difference: f64) -> f64 {
    let u = libm::log1p(difference.abs() / SMALLEST) / libm::log1p(LARGEST / SMALLEST);
    u.min(1.0).copysign(difference)
}

/// Maps values of one quantity to colours.
#[derive(Clone, Debug)]
pub struct Scale {
    quantity: Quantity,
    /// The speed at the top of the linear scale, m/s.
    top: f64,
    /// Colours at equal distances over the scale, so many that neighbours look the same.
    colours: Vec<Rgb>,
}

/// Entries of a colour table.
const ENTRIES: usize = 512;

const DIFFERENCE_LIGHT: &[u32] =
    &[0x0b0f3f, 0x1a2a78, 0x4358a6, 0x93a2cf, 0xf8f7f2, 0xf0cf9c, 0xe0a04a, 0xcf7f14, 0x9c5700];
const DIFFERENCE_DARK: &[u32] =
    &[0xb5d3ff, 0x74a6f7, 0x4074cf, 0x224282, 0x16181d, 0x5e3d10, 0xa86c18, 0xe09a35, 0xffd58a];
const CIVIDIS: &[u32] =
    &[0x00224e, 0x123570, 0x3b496c, 0x575d6d, 0x707173, 0x8a8678, 0xa59c74, 0xc3b369, 0xe1cc55, 0xfee838];
const FRUSTRATION_LIGHT: &[u32] = &[0xd5d9de, 0xd9a3a0, 0xc95a5c, 0x9e1b32, 0x570a24];
const FRUSTRATION_DARK: &[u32] = &[0x3a4049, 0x793b42, 0xbd4c4f, 0xf07c6a, 0xffd2b8];

/// Colours at equal distances over the scale of a quantity, 0xRRGGBB.
fn stops(quantity: Quantity, ground: Ground) -> &'static [u32] {
    match (quantity, ground) {
        (Quantity::Difference, Ground::Light) => DIFFERENCE_LIGHT,
        (Quantity::Difference, Ground::Dark) => DIFFERENCE_DARK,
        (Quantity::Speed, _) => CIVIDIS,
        (Quantity::Frustration, Ground::Light) => FRUSTRATION_LIGHT,
        (Quantity::Frustration, Ground::Dark) => FRUSTRATION_DARK,
    }
}

/// The colour at a place, 0 … 1, by linear interpolation of each channel.
fn between(stops: &[u32], place: f64) -> Rgb {
    let x = place * (stops.len() - 1) as f64;
    let k = (x as usize).min(stops.len() - 2);
    let part = x - k as f64;
    let channel = |shift: u32| {
        let (a, b) = (f64::from((stops[k] >> shift) & 255), f64::from((stops[k + 1] >> shift) & 255));
        (a + part * (b - a)).round() as u8
    };
    [channel(16), channel(8), channel(0)]
}

impl Scale {
    /// The scale of `quantity`, for a ring whose equilibrium speed is `equilibrium` (m/s).
    pub fn new(quantity: Quantity, ground: Ground, equilibrium: f64) -> Self {
        let stops = stops(quantity, ground);
        let colours = (0..ENTRIES).map(|i| between(stops, i as f64 / (ENTRIES - 1) as f64)).collect();
        // Twice the equilibrium speed, rounded up to a multiple of 5 m/s.
        let top = (equilibrium * 2.0 / 5.0).ceil().max(1.0) * 5.0;
        Self { quantity, top, colours }
    }

    /// The place of a value on the scale, 0 … 1. `value` is a difference of speed, a speed or a frustration, according
    /// to the quantity of the scale.
    pub fn place(&self, value: f64) -> f64 {
        let place = match self.quantity {
            Quantity::Difference => 0.5 + 0.5 * signed_logarithmic(value),
            Quantity::Speed => value / self.top,
            Quantity::Frustration => libm::atan(value) * std::f64::consts::FRAC_2_PI,
        };
        place.clamp(0.0, 1.0)
    }

    /// The colour of a value.
    pub fn colour(&self, value: f64) -> Rgb {
        self.colours[(self.place(value) * (ENTRIES - 1) as f64).round() as usize]
    }

    /// Every colour, from the lowest value to the highest.
    pub fn colours(&self) -> &[Rgb] {
        &self.colours
    }

    /// Values to write beside a colour bar.
    pub fn ticks(&self) -> Vec<f64> {
        match self.quantity {
            Quantity::Difference => vec![-10.0, -1.0, -0.1, 0.0, 0.1, 1.0, 10.0],
            Quantity::Speed => (0..=5).map(|i| self.top * f64::from(i) / 5.0).collect(),
            Quantity::Frustration => vec![0.0, 0.5, 1.0, 2.0, 5.0],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scale_is_odd_monotone_and_ends_where_it_says() {
        assert_eq!(signed_logarithmic(0.0), 0.0);
        assert_eq!(signed_logarithmic(LARGEST), 1.0);
        assert_eq!(signed_logarithmic(-25.0), -1.0);
        let mut last = 0.0;
        for k in 1..2000 {
            let u = signed_logarithmic(f64::from(k) * 0.005);
            assert!(u > last && u <= 1.0 && signed_logarithmic(-f64::from(k) * 0.005) == -u);
            last = u;
        }
        // A tenth of the scale is passed before a fiftieth of a metre per second.
        assert!(signed_logarithmic(0.02) > 0.1);
    }

    #[test]
    fn slower_is_blue_faster_is_amber_and_zero_is_the_page() {
        for ground in [Ground::Light, Ground::Dark] {
            let scale = Scale::new(Quantity::Difference, ground, 10.0);
            let [r, _, b] = scale.colour(-1.0);
            assert!(b > r, "slower is blue");
            let [r, _, b] = scale.colour(1.0);
            assert!(r > b, "faster is amber");
            let middle = scale.colour(0.0).map(f64::from).iter().sum::<f64>() / 3.0;
            assert!(if ground == Ground::Light { middle > 235.0 } else { middle < 40.0 });
        }
    }

    #[test]
    fn ticks_lie_inside_the_scale_in_order() {
        for quantity in [Quantity::Difference, Quantity::Speed, Quantity::Frustration] {
            let scale = Scale::new(quantity, Ground::Light, 10.74);
            let places: Vec<_> = scale.ticks().into_iter().map(|t| scale.place(t)).collect();
            assert!(places.windows(2).all(|w| w[0] < w[1]), "{quantity:?}: {places:?}");
            assert!(places.iter().all(|p| (0.0..=1.0).contains(p)));
        }
        assert_eq!(Scale::new(Quantity::Speed, Ground::Light, 10.74).ticks().last(), Some(&25.0));
    }
}
