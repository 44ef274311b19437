//! Car following, all vehicles at once: perceived headways to speeds.
//!
//! # The gap factor
//!
//! v = max(V − V·y, 0) with the *gap factor* y = exp(−(λ/V)(h − d)). From one step to the next h moves by a little,
//! so y moves by a factor e^a with a small a = −(λ/V)·δh: |a| ≤ λ·dt for equal drivers. Where |a| ≤ 2⁻⁶ the factor is
//! multiplied by the Taylor polynomial of degree 6, whose remainder a⁷/7! is below 5·10⁻¹⁷ relative; where a is
//! larger (a nudge, a lane change, a large λ·dt) that vehicle's factor is evaluated in full. The choice is made
//! vehicle by vehicle, so that it does not depend on the width of the vectors.
//!
//! **Accuracy.** One multiplication by the polynomial rounds like y·(1 + ε) with |ε| under 5·10⁻¹⁶, the
//! rounding of a itself included; every [`REFRESH`] steps all factors are evaluated in full. So y stays within
//! 64·5·10⁻¹⁶ ≈ 3·10⁻¹⁴ of exp, for ever, over the whole range of the parameters, and v within V·y times that.
//! Arguments of the full evaluation are held to ±700: y then means "stand still" (e^700) or "as fast as possible"
//! (e^−700) and stays so through [`REFRESH`] steps of at most 2⁻⁶ each.

use crate::driver::Driver;
use crate::exp::exp_within;
use crate::history::History;
use crate::vector::{CHUNK, Width, kernel, larger, smaller};

/// Steps between full evaluations of all factors.
pub const REFRESH: u64 = 64;

/// Largest |a| that the polynomial serves.
const SMALL: f64 = 1.0 / 64.0;

/// Where |a| is no larger, the terms from a⁴/24 on come to less than 2⁻⁵⁶, and half a unit in the last place of a sum
/// near 1 is 2⁻⁵⁴: leaving them out changes no bit. So it is with most of a calm road.
const TINY: f64 = 1.0 / 8192.0;

/// V, −λ/V and d of a vehicle's driver.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Law {
    max_speed: f64,
    rate: f64,
    min_headway: f64,
}

impl Law {
    fn of(driver: &Driver) -> Self {
        Self {
            max_speed: driver.max_speed,
            rate: -(driver.sensitivity / driver.max_speed),
            min_headway: driver.min_headway,
        }
    }
}

/// Perceived headways, gap factors and speeds of all vehicles; padded to whole chunks.
#[derive(Clone, Debug)]
pub struct Following {
    width: Width,
    state: State,
    laws: Laws,
    /// The one law of all vehicles, if there is one: its constants then need not be read vehicle by vehicle.
    common: Option<Law>,
}

#[derive(Clone, Debug)]
struct State {
    perceived: Vec<f64>,
    factor: Vec<f64>,
    speed: Vec<f64>,
}

#[derive(Clone, Debug)]
struct Laws {
    max_speed: Vec<f64>,
    rate: Vec<f64>,
    min_headway: Vec<f64>,
}

/// A new factor from the old one: by the polynomial, which is wrong where `a` is not small.
#[inline(always)]
fn moved(factor: f64, a: f64) -> f64 {
    // Taylor's polynomial, Estrin's scheme: short chains, so that a vector unit stays busy.
    let a2 = a * a;
    let high = ((1.0 / 24.0) + a * (1.0 / 120.0)) + a2 * (1.0 / 720.0);
    factor * (low_terms(a, a2) + high * (a2 * a2))
}

/// The terms of degree 0 … 3: where |a| ≤ [`TINY`], the others vanish in rounding.
#[inline(always)]
fn low_terms(a: f64, a2: f64) -> f64 {
    let low = 1.0 + a;
    let middle = (1.0 / 2.0) + a * (1.0 / 6.0);
    low + middle * a2
}

#[inline(always)]
fn is_small(a: f64) -> bool {
    // False for NaN: a vehicle without a valid factor.
    a.abs() <= SMALL
}

/// A chunk of a padded slice.
#[inline(always)]
fn chunk(slice: &[f64], start: usize) -> &[f64; CHUNK] {
    (&slice[start..start + CHUNK]).try_into().expect("slices are padded to whole chunks")
}

#[inline(always)]
fn chunk_mut(slice: &mut [f64], start: usize) -> &mut [f64; CHUNK] {
    (&mut slice[start..start + CHUNK]).try_into().expect("slices are padded to whole chunks")
}

/// New factors, speeds and perceived headways of one chunk of vehicles.
#[inline(always)]
fn respond_chunk(
    scene: &[f64; CHUNK],
    law: impl Fn(usize) -> Law,
    refresh: bool,
    state: &mut State,
    start: usize,
) {
    let perceived = chunk_mut(&mut state.perceived, start);
    let factor = chunk_mut(&mut state.factor, start);
    let speed = chunk_mut(&mut state.speed, start);
    let (mut a, mut next) = ([0.0; CHUNK], [0.0; CHUNK]);
    let mut all_tiny = true;
    for j in 0..CHUNK {
        a[j] = law(j).rate * (scene[j] - perceived[j]);
        all_tiny &= a[j].abs() <= TINY;
    }
    if all_tiny && !refresh {
        for j in 0..CHUNK {
            next[j] = factor[j] * low_terms(a[j], a[j] * a[j]);
        }
    } else {
        let mut all_small = true;
        for j in 0..CHUNK {
            next[j] = moved(factor[j], a[j]);
            all_small &= is_small(a[j]);
        }
        if refresh || !all_small {
            for j in 0..CHUNK {
                let law = law(j);
                let full = exp_within(law.rate * (scene[j] - law.min_headway));
                next[j] = if refresh || !is_small(a[j]) { full } else { next[j] };
            }
        }
    }
    let mut unbounded = [0.0; CHUNK];
    for j in 0..CHUNK {
        let max_speed = law(j).max_speed;
        unbounded[j] = max_speed - max_speed * next[j];
    }
    *speed = larger(&[0.0; CHUNK], &unbounded);
    *factor = next;
    *perceived = *scene;
}

kernel! {
    /// One law for all; the leader of j is j + 1: what everyone sees is `offset[j] + (seen[j+1] − seen[j])`.
    fn respond_in_order(offset: &[f64], seen: &[f64], law: Law, refresh: bool, state: &mut State) {
        for start in (0..offset.len()).step_by(CHUNK) {
            let (offset, leader) = (chunk(offset, start), chunk(&seen[1..], start));
            let own = chunk(seen, start);
            let mut scene = [0.0; CHUNK];
            for j in 0..CHUNK {
                scene[j] = offset[j] + (leader[j] - own[j]);
            }
            respond_chunk(&scene, |_| law, refresh, state, start);
        }
    }
}

kernel! {
    /// One law for all, scenes as given.
    fn respond_alike(scene: &[f64], law: Law, refresh: bool, state: &mut State) {
        for start in (0..scene.len()).step_by(CHUNK) {
            respond_chunk(chunk(scene, start), |_| law, refresh, state, start);
        }
    }
}

kernel! {
    /// Everyone has a law of their own.
    fn respond_apart(scene: &[f64], laws: &Laws, refresh: bool, state: &mut State) {
        for start in (0..scene.len()).step_by(CHUNK) {
            let (max_speed, rate) = (chunk(&laws.max_speed, start), chunk(&laws.rate, start));
            let min_headway = chunk(&laws.min_headway, start);
            let law = |j: usize| Law { max_speed: max_speed[j], rate: rate[j], min_headway: min_headway[j] };
            respond_chunk(chunk(scene, start), law, refresh, state, start);
        }
    }
}

kernel! {
    /// Positions: x += v·dt. `extremes` gets the smallest and the largest of the first `vehicles` speeds, which does not
    /// depend on the order of comparisons.
    fn drive(old: &[f64], speed: &[f64], dt: f64, vehicles: usize, new: &mut [f64], extremes: &mut [f64; 2]) {
        let (mut least, mut most) = ([f64::INFINITY; CHUNK], [f64::NEG_INFINITY; CHUNK]);
        for start in (0..speed.len()).step_by(CHUNK) {
            let (old, speed) = (chunk(old, start), chunk(speed, start));
            let new = chunk_mut(new, start);
            for j in 0..CHUNK {
                new[j] = old[j] + speed[j] * dt;
            }
            if start + CHUNK <= vehicles {
                least = smaller(&least, speed);
                most = larger(&most, speed);
            } else {
                for v in &speed[..vehicles - start] {
                    least[0] = least[0].min(*v);
                    most[0] = most[0].max(*v);
                }
            }
        }
        *extremes = [least.into_iter().fold(f64::INFINITY, f64::min), most.into_iter().fold(f64::NEG_INFINITY, f64::max)];
    }
}

kernel! {
    /// What everyone sees where each has a delay of their own: row `head − delay` of `rows` rows, `row` numbers each.
    fn see_apart(offset: &[f64], leaders: &[u32], delays: &[u32], data: &[f64], geometry: [u32; 3], scene: &mut [f64]) {
        let [head, rows, row] = geometry;
        for start in (0..delays.len()).step_by(CHUNK) {
            let delays: &[u32; CHUNK] = (&delays[start..start + CHUNK]).try_into().expect("padded");
            let leaders: &[u32; CHUNK] = (&leaders[start..start + CHUNK]).try_into().expect("padded");
            let offset = chunk(offset, start);
            let scene = chunk_mut(scene, start);
            for j in 0..CHUNK {
                let back = if delays[j] > head { rows } else { 0 };
                let begin = ((head + back) - delays[j]) as usize * row as usize;
                scene[j] = offset[j] + (data[begin + leaders[j] as usize] - data[begin + start + j]);
            }
        }
    }
}

impl Following {
    /// For these drivers, in arrays padded to `padded` numbers; no factor is valid yet.
    pub fn new(drivers: &[Driver], padded: usize) -> Self {
        let filled = |value| vec![value; padded];
        let mut following = Self {
            width: Width::widest(),
            state: State { perceived: filled(f64::NAN), factor: filled(1.0), speed: filled(0.0) },
            laws: Laws { max_speed: filled(1.0), rate: filled(-1.0), min_headway: filled(1.0) },
            common: None,
        };
        for (j, driver) in drivers.iter().enumerate() {
            following.set_driver(j, driver);
        }
        following.find_common_law(drivers);
        following
    }

    /// Uses vectors of another width; results stay the same.
    pub fn set_width(&mut self, width: Width) {
        self.width = width;
    }

    /// Takes over the law of a driver that has changed; the vehicle's factor is no longer valid.
    pub fn set_driver(&mut self, j: usize, driver: &Driver) {
        let law = Law::of(driver);
        self.laws.max_speed[j] = law.max_speed;
        self.laws.rate[j] = law.rate;
        self.laws.min_headway[j] = law.min_headway;
        self.invalidate(j);
    }

    /// To be called after [`Self::set_driver`], once for all that changed.
    pub fn find_common_law(&mut self, drivers: &[Driver]) {
        let first = Law::of(&drivers[0]);
        self.common = drivers.iter().all(|d| Law::of(d) == first).then_some(first);
    }

    /// Has the vehicle's factor evaluated in full next time.
    pub fn invalidate(&mut self, j: usize) {
        self.state.perceived[j] = f64::NAN;
    }

    /// Perceived headways, m (padded).
    #[inline]
    pub fn perceived(&self) -> &[f64] {
        &self.state.perceived
    }

    /// Speeds, m/s (padded).
    #[inline]
    pub fn speeds(&self) -> &[f64] {
        &self.state.speed
    }

    /// Overrules the law: a braked vehicle.
    pub fn set_speed(&mut self, j: usize, speed: f64) {
        self.state.speed[j] = speed;
    }

    /// What everyone sees, each with a delay of their own; all slices padded.
    pub fn see_apart(
        &self,
        offset: &[f64],
        leaders: &[u32],
        delays: &[u32],
        history: &History,
        scene: &mut [f64],
    ) {
        let (data, geometry) = history.rows();
        see_apart(self.width, offset, leaders, delays, data, geometry, scene);
    }

    /// New displacements after a step of `dt` seconds; how far the fastest of the first `vehicles` has gone ahead of the
    /// slowest, m.
    pub fn drive(&self, old: &[f64], dt: f64, vehicles: usize, new: &mut [f64]) -> f64 {
        let mut extremes = [0.0; 2];
        drive(self.width, old, &self.state.speed, dt, vehicles, new, &mut extremes);
        (extremes[1] - extremes[0]) * dt
    }

    /// New speeds where the leader of j is j + 1, and the displacements that all see are in one row `seen`, in which
    /// the first vehicle's stands again behind the last one's. All factors in full where `refresh` says so.
    ///
    /// Where drivers have laws of their own, `scene` holds what they see in the meantime.
    pub fn respond_in_order(&mut self, offset: &[f64], seen: &[f64], scene: &mut [f64], refresh: bool) {
        if let Some(law) = self.common {
            respond_in_order(self.width, offset, seen, law, refresh, &mut self.state);
        } else {
            for ((scene, offset), pair) in scene.iter_mut().zip(offset).zip(seen.windows(2)) {
                *scene = offset + (pair[1] - pair[0]);
            }
            self.respond(scene, refresh);
        }
    }

    /// New speeds for the perceived headways `scene` (m, padded); all factors in full where `refresh` says so.
    pub fn respond(&mut self, scene: &[f64], refresh: bool) {
        match self.common {
            Some(law) => respond_alike(self.width, scene, law, refresh, &mut self.state),
            None => respond_apart(self.width, scene, &self.laws, refresh, &mut self.state),
        }
    }

    /// The same for one vehicle whose scene has changed within a step.
    pub fn respond_one(&mut self, j: usize, scene: f64) {
        let (max_speed, rate) = (self.laws.max_speed[j], self.laws.rate[j]);
        let a = rate * (scene - self.state.perceived[j]);
        let factor = if is_small(a) {
            moved(self.state.factor[j], a)
        } else {
            exp_within(rate * (scene - self.laws.min_headway[j]))
        };
        let v = max_speed - max_speed * factor;
        self.state.speed[j] = if v > 0.0 { v } else { 0.0 };
        self.state.factor[j] = factor;
        self.state.perceived[j] = scene;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_left_out_of_tiny_moves_changes_no_bit() {
        for k in 0..=200_000 {
            let a = TINY * f64::from(k - 100_000) / 100_000.0;
            assert_eq!(moved(0.7, a), 0.7 * low_terms(a, a * a), "a = {a}");
        }
        assert_ne!(moved(1.0, 4.0 * TINY), low_terms(4.0 * TINY, 16.0 * TINY * TINY));
    }
}
