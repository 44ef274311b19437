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
use crate::vector::{CHUNK, Chunk, Real, Width, kernel};

/// Steps between full evaluations of all factors.
pub const REFRESH: u64 = 64;

/// Largest |a| that the polynomial serves.
const SMALL: f64 = 1.0 / 64.0;

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
fn moved<T: Real>(factor: T, a: T) -> T {
    // Taylor's polynomial, Estrin's scheme: short chains, so that a vector unit stays busy.
    let c = T::all;
    let a2 = a * a;
    let low = c(1.0) + a;
    let middle = c(1.0 / 2.0) + a * c(1.0 / 6.0);
    let high = (c(1.0 / 24.0) + a * c(1.0 / 120.0)) + a2 * c(1.0 / 720.0);
    factor * ((low + middle * a2) + high * (a2 * a2))
}

#[inline(always)]
fn is_small(a: f64) -> bool {
    // False for NaN: a vehicle without a valid factor.
    a.abs() <= SMALL
}

/// The laws of one chunk of vehicles.
#[derive(Clone, Copy)]
struct ChunkLaw {
    max_speed: Chunk,
    rate: Chunk,
    min_headway: Chunk,
}

impl ChunkLaw {
    #[inline(always)]
    fn common(law: Law) -> Self {
        let all = Chunk::splat;
        Self { max_speed: all(law.max_speed), rate: all(law.rate), min_headway: all(law.min_headway) }
    }

    #[inline(always)]
    fn of(laws: &Laws, start: usize) -> Self {
        Self {
            max_speed: Chunk::load(&laws.max_speed, start),
            rate: Chunk::load(&laws.rate, start),
            min_headway: Chunk::load(&laws.min_headway, start),
        }
    }
}

/// New factors, speeds and perceived headways of one chunk of vehicles.
#[inline(always)]
fn respond_chunk(scene: Chunk, law: ChunkLaw, refresh: bool, state: &mut State, start: usize) {
    let a = law.rate * (scene - Chunk::load(&state.perceived, start));
    let mut next = moved(Chunk::load(&state.factor, start), a);
    if refresh || !a.all_within(SMALL) {
        next = some_in_full(next, a, law.rate * (scene - law.min_headway), refresh);
    }
    let v = law.max_speed - law.max_speed * next;
    Chunk::splat(0.0).most(v).store(&mut state.speed, start);
    next.store(&mut state.factor, start);
    scene.store(&mut state.perceived, start);
}

/// The exponential in full of `argument`, for all where `all` says so, else where `a` is not small.
#[inline(always)]
fn some_in_full(next: Chunk, a: Chunk, argument: Chunk, all: bool) -> Chunk {
    let (mut next, a, argument) = (next.to_array(), a.to_array(), argument.to_array());
    for j in 0..CHUNK {
        let full = exp_within(argument[j]);
        next[j] = if all || !is_small(a[j]) { full } else { next[j] };
    }
    Chunk::load(&next, 0)
}

kernel! {
    /// One law for all; the leader of j is j + 1: what everyone sees is `offset[j] + (seen[j+1] − seen[j])`.
    fn respond_in_order(offset: &[f64], seen: &[f64], law: Law, refresh: bool, state: &mut State) {
        let law = ChunkLaw::common(law);
        for start in (0..offset.len()).step_by(CHUNK) {
            let scene = Chunk::load(offset, start) + (Chunk::load(seen, start + 1) - Chunk::load(seen, start));
            respond_chunk(scene, law, refresh, state, start);
        }
    }
}

kernel! {
    /// One law for all, scenes as given.
    fn respond_alike(scene: &[f64], law: Law, refresh: bool, state: &mut State) {
        let law = ChunkLaw::common(law);
        for start in (0..scene.len()).step_by(CHUNK) {
            respond_chunk(Chunk::load(scene, start), law, refresh, state, start);
        }
    }
}

kernel! {
    /// Everyone has a law of their own.
    fn respond_apart(scene: &[f64], laws: &Laws, refresh: bool, state: &mut State) {
        for start in (0..scene.len()).step_by(CHUNK) {
            respond_chunk(Chunk::load(scene, start), ChunkLaw::of(laws, start), refresh, state, start);
        }
    }
}

kernel! {
    /// Positions: x += v·dt. `extremes` gets the smallest and the largest of the first `vehicles` speeds, which does not
    /// depend on the order of comparisons.
    fn drive(old: &[f64], speed: &[f64], dt: f64, vehicles: usize, new: &mut [f64], extremes: &mut [f64; 2]) {
        let (mut least, mut most) = (Chunk::splat(f64::INFINITY), Chunk::splat(f64::NEG_INFINITY));
        let dt = Chunk::splat(dt);
        let whole = vehicles - vehicles % CHUNK;
        for start in (0..speed.len()).step_by(CHUNK) {
            let v = Chunk::load(speed, start);
            (Chunk::load(old, start) + v * dt).store(new, start);
            if start < whole {
                (least, most) = (least.least(v), most.most(v));
            }
        }
        *extremes = [f64::INFINITY, f64::NEG_INFINITY];
        let rest = &speed[whole..vehicles];
        for v in least.to_array().iter().chain(&most.to_array()).chain(rest) {
            if v.is_finite() {
                *extremes = [extremes[0].min(*v), extremes[1].max(*v)];
            }
        }
    }
}

kernel! {
    /// What everyone sees where each has a delay of their own: row `head − delay` of `rows` rows, `row` numbers each.
    fn see_apart(offset: &[f64], leaders: &[u32], delays: &[u32], data: &[f64], geometry: [u32; 3], scene: &mut [f64]) {
        let [head, rows, row] = geometry;
        for start in (0..delays.len()).step_by(CHUNK) {
            let delays: &[u32; CHUNK] = (&delays[start..start + CHUNK]).try_into().expect("padded");
            let leaders: &[u32; CHUNK] = (&leaders[start..start + CHUNK]).try_into().expect("padded");
            let (offset, scene) = (&offset[start..start + CHUNK], &mut scene[start..start + CHUNK]);
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
    use crate::random::{Generator, Stream};

    /// Over the corners of what the table of parameters allows: headways that wander as far as a step can take them,
    /// a million steps, vehicles with one law and with laws of their own.
    #[test]
    fn a_million_steps_stay_within_the_stated_error_of_the_exponential() {
        let mut generator = Generator::new(1, Stream::Start);
        let mut worst = 0.0_f64;
        for max_speed in [0.1, 40.0, 100.0] {
            for sensitivity in [0.01, 1.0, 20.0] {
                for (dt, steps) in [(0.001, 1_000_000_u64), (0.01, 100_000), (0.5, 10_000)] {
                    for apart in [false, true] {
                        let mut drivers = [Driver { max_speed, sensitivity, ..Driver::default() }; CHUNK];
                        if apart {
                            drivers[0].min_headway = 9.0;
                        }
                        let mut following = Following::new(&drivers, CHUNK);
                        let mut scene = [20.0; CHUNK];
                        for step in 0..steps {
                            following.respond(&scene, step.is_multiple_of(REFRESH));
                            if step % REFRESH == REFRESH - 1 {
                                for (j, driver) in drivers.iter().enumerate() {
                                    let error = (following.speeds()[j] - driver.speed(scene[j])).abs();
                                    worst = worst.max(error / max_speed);
                                }
                            }
                            for h in &mut scene {
                                *h += (generator.uniform() - 0.5) * 2.0 * max_speed * dt;
                                *h = h.abs();
                            }
                        }
                    }
                }
            }
        }
        println!("largest error: {worst:e} V");
        assert!(worst < 3e-14, "largest error {worst:e} V");
        assert!(worst > 0.0, "the factor is not evaluated anew at every step");
    }

    /// The polynomial against the exponential where it is used.
    #[test]
    fn one_step_of_the_factor_is_good_to_rounding() {
        for k in -10_000..=10_000 {
            let a = f64::from(k) * 1e-4 * SMALL;
            assert!((moved(1.0, a) / exp_within(a) - 1.0).abs() < 5e-16, "a = {a}");
        }
    }

    #[test]
    fn a_jump_is_evaluated_in_full_and_does_not_touch_the_others() {
        let driver = Driver::default();
        let mut following = Following::new(&[driver; CHUNK], CHUNK);
        let mut scene = [20.0; CHUNK];
        following.respond(&scene, true);
        scene[3] = 8.0;
        scene[4] = 20.0 + 1e-9;
        following.respond(&scene, false);
        assert_eq!(following.speeds()[3], driver.speed(8.0));
        assert_eq!(following.speeds()[2], driver.speed(20.0));
        scene[3] = -1e6;
        scene[5] = 1e9;
        following.respond(&scene, false);
        assert_eq!((following.speeds()[3], following.speeds()[5]), (0.0, 40.0));
        // Back from where the exponential would have overflowed.
        scene[3] = 20.0;
        following.respond(&scene, false);
        assert_eq!(following.speeds()[3], driver.speed(20.0));
    }

    #[test]
    fn one_vehicle_and_all_at_once_agree_to_the_bit() {
        let drivers = [Driver { sensitivity: 1.3, ..Driver::default() }; CHUNK];
        let (mut one, mut all) = (Following::new(&drivers, CHUNK), Following::new(&drivers, CHUNK));
        let mut generator = Generator::new(3, Stream::Start);
        for _ in 0..1000 {
            let scene: [f64; CHUNK] = std::array::from_fn(|_| 20.0 + generator.uniform());
            all.respond(&scene, false);
            for (j, h) in scene.iter().enumerate() {
                one.respond_one(j, *h);
            }
            assert_eq!(one.speeds(), all.speeds());
        }
    }
}
