//! Car following, all vehicles at once: gaps to speeds.
//!
//! # The shortfall
//!
//! v = max(V − w, 0) with the *shortfall* w = V·exp(−(λ/V)(h − d)), by which a driver stays below the maximum speed.
//! The perceived headway h is the offset of the leader, which stays as it is while the leader does, plus the *gap*:
//! by how much more the leader has driven than oneself, as it was seen. From one step to the next the gap
//! moves by a little, so w moves by a factor e^a with a small a = −(λ/V)·δgap: |a| ≤ λ·dt for equal drivers. Where
//! |a| ≤ 2⁻¹⁰ the shortfall is multiplied by the Taylor polynomial of degree 4, where |a| ≤ 2⁻⁶ by that of degree 6.
//! Their remainders, about a⁵/5! and a⁷/7!, are below 7.5·10⁻¹⁸ and 4.6·10⁻¹⁷ of e^a: less than half the distance from
//! one number to the next. Where a is larger (a nudge, a large λ·dt) and where the leader or the driver has changed,
//! that vehicle's shortfall is evaluated in full. The choice is made vehicle by vehicle, so that it does not depend on
//! the width of the vectors.
//!
//! Equal drivers in order who only drive are taken on many steps at once, up to their delay, a block of vehicles after
//! the other: it saves memory traffic, and every step computes the same bits as one by itself.
//!
//! **Accuracy.** One multiplication by a polynomial rounds like w·(1 + ε) with |ε| under 5·10⁻¹⁶, the
//! rounding of a itself included; every [`REFRESH`] steps all shortfalls are evaluated in full. So w stays within
//! 64·5·10⁻¹⁶ = 3.2·10⁻¹⁴ of V times the exponential, relatively, for ever, over the whole range of the parameters, and v with it.
//! Arguments of the full evaluation are held to ±700: w then means "stand still" (V·e^700) or "as fast as possible"
//! (V·e^−700) and stays so through [`REFRESH`] steps of at most 2⁻⁶ each.

use crate::numerics::exp::{all_within, exp_within};
use crate::numerics::simd::{Aligned, CHUNK, Chunk, Extremes, Real, Width, chunks, chunks_mut, kernel};
use crate::scenario::driver::Driver;
#[cfg(doc)]
use crate::simulation::delays::Delays;
use crate::simulation::history::{History, images};

/// Steps between full evaluations of all shortfalls.
pub const REFRESH: u64 = 64;

/// Largest a² that the polynomial of degree 4 serves.
const TINY: f64 = 1.0 / (1024.0 * 1024.0);
/// Largest a² that the polynomial of degree 6 serves.
const SMALL: f64 = 1.0 / (64.0 * 64.0);

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

/// What drivers see who follow one another in order; rows of displacements and arrays padded.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scene<'a> {
    /// Offsets of the leaders, m.
    pub(crate) offset: &'a [f64],
    /// Displacements (m) as they were each of a few delays ago.
    pub(crate) seen: &'a [&'a [f64]],
    /// Who sees which; see [`Delays::chosen`].
    pub(crate) chosen: &'a [Aligned],
}

/// Gaps, shortfalls and speeds of all vehicles; padded to whole chunks with the first vehicles again.
#[derive(Clone, Debug)]
pub struct CarFollowing {
    width: Width,
    vehicles: usize,
    state: State,
    laws: Laws,
    /// The one law of all vehicles, if there is one: its constants then need not be read vehicle by vehicle.
    common: Option<Law>,
}

#[derive(Clone, Debug)]
struct State {
    gap: Aligned,
    shortfall: Aligned,
    speed: Aligned,
}

#[derive(Clone, Debug)]
struct Laws {
    max_speed: Aligned,
    rate: Aligned,
    min_headway: Aligned,
}

/// The numbers that most steps need, ready in registers.
#[derive(Clone, Copy)]
struct Constants<T> {
    zero: T,
    one: T,
    half: T,
    sixth: T,
    twenty_fourth: T,
    tiny: T,
}

impl<T: Real> Constants<T> {
    /// Numbers that the compiler cannot foresee: JavaScript engines make a constant anew wherever it is used, in a loop, too.
    #[inline(always)]
    fn new() -> Self {
        let kept = |value: f64| T::all(std::hint::black_box(value));
        Self {
            zero: kept(0.0),
            one: kept(1.0),
            half: kept(1.0 / 2.0),
            sixth: kept(1.0 / 6.0),
            twenty_fourth: kept(1.0 / 24.0),
            tiny: kept(TINY),
        }
    }

    /// A new shortfall from the old one, where `a2` = a² ≤ [`TINY`].
    #[inline(always)]
    fn moved_a_little(&self, shortfall: T, a: T, a2: T) -> T {
        // Taylor's polynomial, Estrin's scheme: short chains, so that a vector unit stays busy.
        let high = (self.half + a * self.sixth) + a2 * self.twenty_fourth;
        shortfall * ((self.one + a) + high * a2)
    }

    /// The same where a² ≤ [`SMALL`].
    #[inline(always)]
    fn moved(&self, shortfall: T, a: T, a2: T) -> T {
        let low = self.one + a;
        let middle = self.half + a * self.sixth;
        let high = (self.twenty_fourth + a * T::all(1.0 / 120.0)) + a2 * T::all(1.0 / 720.0);
        shortfall * ((low + middle * a2) + high * (a2 * a2))
    }
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
}

impl Laws {
    /// That of a chunk.
    #[inline(always)]
    fn at(&self, k: usize) -> ChunkLaw {
        let at = |numbers: &[f64]| Chunk::load(&chunks(numbers)[k]);
        ChunkLaw { max_speed: at(&self.max_speed), rate: at(&self.rate), min_headway: at(&self.min_headway) }
    }
}

/// A [`State`] chunk by chunk, and what is needed to respond.
struct Drivers<'a> {
    gap: &'a mut [[f64; CHUNK]],
    shortfall: &'a mut [[f64; CHUNK]],
    speed: &'a mut [[f64; CHUNK]],
    offset: &'a [[f64; CHUNK]],
    constants: Constants<Chunk>,
}

impl<'a> Drivers<'a> {
    #[inline(always)]
    fn new(state: &'a mut State, offset: &'a [f64]) -> Self {
        let end = state.speed.len() / CHUNK;
        Self::some(state, offset, 0, end)
    }

    /// Those of some chunks.
    #[inline(always)]
    fn some(state: &'a mut State, offset: &'a [f64], begin: usize, end: usize) -> Self {
        Self {
            gap: &mut chunks_mut(&mut state.gap)[begin..end],
            shortfall: &mut chunks_mut(&mut state.shortfall)[begin..end],
            speed: &mut chunks_mut(&mut state.speed)[begin..end],
            offset: &chunks(offset)[begin..end],
            constants: Constants::new(),
        }
    }

    /// Speeds of chunk `k`, for gaps that are seen now.
    #[inline(always)]
    fn respond(&mut self, k: usize, gap: Chunk, law: ChunkLaw, refresh: bool) {
        let shortfall = self.shortfall(k, gap, law, refresh);
        gap.store(&mut self.gap[k]);
        shortfall.store(&mut self.shortfall[k]);
        self.constants.zero.most(law.max_speed - shortfall).store(&mut self.speed[k]);
    }

    #[inline(always)]
    fn shortfall(&self, k: usize, gap: Chunk, law: ChunkLaw, refresh: bool) -> Chunk {
        let old = Chunk::load(&self.shortfall[k]);
        let a = law.rate * (gap - Chunk::load(&self.gap[k]));
        let a2 = a * a;
        if !refresh {
            if a2.are_at_most(self.constants.tiny) {
                return self.constants.moved_a_little(old, a, a2);
            }
            if a2.are_at_most(Chunk::splat(SMALL)) {
                let little = self.constants.moved_a_little(old, a, a2);
                return a2.at_most(self.constants.tiny).choose(little, self.constants.moved(old, a, a2));
            }
        }
        let argument = law.rate * ((Chunk::load(&self.offset[k]) + gap) - law.min_headway);
        let mut next = self.shortfall[k];
        respond_rarely(&a.to_array(), &argument.to_array(), &law.max_speed.to_array(), refresh, &mut next);
        Chunk::load(&next)
    }
}

/// New shortfalls where not all have moved by a little, from −(λ/V)(h − d) as the exponential's `argument`. (Through
/// memory: the rare case must not take registers from the common one.)
#[cold]
#[inline(never)]
fn respond_rarely(
    a: &[f64; CHUNK],
    argument: &[f64; CHUNK],
    max_speed: &[f64; CHUNK],
    refresh: bool,
    shortfall: &mut [f64; CHUNK],
) {
    let in_full = Chunk::load(max_speed) * all_within(Chunk::load(argument));
    let (old, a) = (Chunk::load(shortfall), Chunk::load(a));
    let a2 = a * a;
    let next = if refresh {
        in_full
    } else {
        let constants = Constants::new();
        // Not at most anything: NaN, a vehicle without a valid shortfall.
        let next = a2.at_most(Chunk::splat(SMALL)).choose(constants.moved(old, a, a2), in_full);
        a2.at_most(constants.tiny).choose(constants.moved_a_little(old, a, a2), next)
    };
    next.store(shortfall);
}

kernel! {
    /// A whole step where the leader of j is j + 1 and all have one law: positions from `old` to `new`, then gaps in the row
    /// `seen`, which is not `new`, then speeds. `extremes` gets the smallest and the largest speed before.
    fn advance_alike(
        old: &[f64], seen: &[f64], offset: &[f64], law: Law, dt: f64, refresh: bool,
        state: &mut State, new: &mut [f64], extremes: &mut (f64, f64),
    ) {
        let mut drivers = Drivers::new(state, offset);
        let count = drivers.speed.len();
        let (old, new) = (&chunks(old)[..count], &mut chunks_mut(new)[..count]);
        let (seen, ahead) = (&chunks(seen)[..count], &chunks(&seen[1..])[..count]);
        let (law, dt) = (ChunkLaw::common(law), Chunk::splat(dt));
        let mut range = Extremes::of(Chunk::load(&drivers.speed[0]));
        for k in 0..count {
            let v = Chunk::load(&drivers.speed[k]);
            range.take(v);
            (Chunk::load(&old[k]) + v * dt).store(&mut new[k]);
            drivers.respond(k, Chunk::load(&ahead[k]) - Chunk::load(&seen[k]), law, refresh);
        }
        *extremes = range.reduced();
    }
}

kernel! {
    /// The same where drivers have laws of their own and one of a few delays: `seen` has a row for each delay, `chosen`
    /// says who sees which; see [`Delays::few`].
    fn advance_mixed(
        old: &[f64], scene: Scene<'_>, laws: &Laws, dt: f64, refresh: bool,
        state: &mut State, new: &mut [f64], extremes: &mut (f64, f64),
    ) {
        let Scene { offset, seen, chosen } = scene;
        let mut drivers = Drivers::new(state, offset);
        let count = drivers.speed.len();
        let (old, new) = (&chunks(old)[..count], &mut chunks_mut(new)[..count]);
        let dt = Chunk::splat(dt);
        let difference = |row: &[f64], k: usize| {
            Chunk::load(&chunks(&row[1..])[k]) - Chunk::load(&chunks(row)[k])
        };
        let mut range = Extremes::of(Chunk::load(&drivers.speed[0]));
        for k in 0..count {
            let v = Chunk::load(&drivers.speed[k]);
            range.take(v);
            (Chunk::load(&old[k]) + v * dt).store(&mut new[k]);
            let mut gap = difference(seen[0], k);
            for (row, mask) in seen[1..].iter().zip(chosen) {
                gap = Chunk::load(&chunks(mask)[k]).choose(difference(row, k), gap);
            }
            drivers.respond(k, gap, laws.at(k), refresh);
        }
        *extremes = range.reduced();
    }
}

/// Chunks that are driven on together: what is kept of them stays near the processor.
const BLOCK: usize = 512 / CHUNK;

kernel! {
    /// `steps` times [`advance_alike`], with one `delay` for all, after step `first`, block by block: within the delay
    /// nobody sees what is done meanwhile.
    fn drive_on(
        history: &mut History, delay: usize, offset: &[f64], law: Law, dt: f64, first: u64, steps: usize,
        state: &mut State,
    ) {
        let (law, dt) = (ChunkLaw::common(law), Chunk::splat(dt));
        let count = state.speed.len() / CHUNK;
        for begin in (0..count).step_by(BLOCK) {
            let end = count.min(begin + BLOCK);
            let mut drivers = Drivers::some(state, offset, begin, end);
            for step in 1..=steps {
                let refresh = (first + step as u64).is_multiple_of(REFRESH);
                let (new, past) = history.ahead(step);
                let seen = past.seen(delay);
                let (old, new) = (&chunks(past.seen(1))[begin..end], &mut chunks_mut(new)[begin..end]);
                let (seen, ahead) = (&chunks(seen)[begin..end], &chunks(&seen[1..])[begin..end]);
                for k in 0..end - begin {
                    (Chunk::load(&old[k]) + Chunk::load(&drivers.speed[k]) * dt).store(&mut new[k]);
                    drivers.respond(k, Chunk::load(&ahead[k]) - Chunk::load(&seen[k]), law, refresh);
                }
            }
        }
    }
}

kernel! {
    /// `least` gets the smallest true headway at the displacements `s`, where the leader of j is j + 1.
    fn find_least_headway(s: &[f64], offset: &[f64], least: &mut f64) {
        let count = offset.len() / CHUNK;
        let (ahead, s, offset) = (&chunks(&s[1..])[..count], &chunks(s)[..count], &chunks(offset)[..count]);
        let headway = |k: usize| Chunk::load(&offset[k]) + (Chunk::load(&ahead[k]) - Chunk::load(&s[k]));
        let mut extremes = Extremes::of(headway(0));
        for k in 1..count {
            extremes.take(headway(k));
        }
        *least = extremes.reduced().0;
    }
}

kernel! {
    /// Positions: x += v·dt. `extremes` gets the smallest and the largest speed.
    fn drive(old: &[f64], speed: &[f64], dt: f64, new: &mut [f64], extremes: &mut (f64, f64)) {
        let count = speed.len() / CHUNK;
        let (old, new, speed) = (&chunks(old)[..count], &mut chunks_mut(new)[..count], &chunks(speed)[..count]);
        let dt = Chunk::splat(dt);
        let mut range = Extremes::of(Chunk::load(&speed[0]));
        for k in 0..count {
            let v = Chunk::load(&speed[k]);
            range.take(v);
            (Chunk::load(&old[k]) + v * dt).store(&mut new[k]);
        }
        *extremes = range.reduced();
    }
}

kernel! {
    /// Speeds for the gaps to these leaders in the row `seen`; without leaders `seen` holds the gaps.
    fn respond_all(
        seen: &[f64], leaders: Option<&[u32]>, offset: &[f64], laws: &Laws, refresh: bool, state: &mut State,
    ) {
        let mut drivers = Drivers::new(state, offset);
        let count = drivers.speed.len();
        let own = &chunks(seen)[..count];
        let leaders = leaders.map(|leaders| &leaders.as_chunks::<CHUNK>().0[..count]);
        for k in 0..count {
            let own = Chunk::load(&own[k]);
            let gap = leaders.map_or(own, |leaders| Chunk::gather(seen, &leaders[k]) - own);
            drivers.respond(k, gap, laws.at(k), refresh);
        }
    }
}

impl CarFollowing {
    /// For these drivers, in arrays padded to `padded` numbers; no shortfall is valid yet.
    pub fn new(drivers: &[Driver], padded: usize) -> Self {
        let filled = |value| Aligned::filled(value, padded);
        let mut following = Self {
            width: Width::widest(),
            vehicles: drivers.len(),
            state: State { gap: filled(f64::NAN), shortfall: filled(0.0), speed: filled(0.0) },
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

    fn images(&self, j: usize) -> impl Iterator<Item = usize> + use<> {
        images(j, self.vehicles)
    }

    /// Takes over the law of a driver that has changed; the vehicle's shortfall is no longer valid.
    pub fn set_driver(&mut self, j: usize, driver: &Driver) {
        let law = Law::of(driver);
        for j in self.images(j) {
            self.laws.max_speed[j] = law.max_speed;
            self.laws.rate[j] = law.rate;
            self.laws.min_headway[j] = law.min_headway;
        }
        self.invalidate(j);
    }

    /// To be called after [`Self::set_driver`], once for all that changed.
    pub fn find_common_law(&mut self, drivers: &[Driver]) {
        let first = Law::of(&drivers[0]);
        self.common = drivers.iter().all(|d| Law::of(d) == first).then_some(first);
    }

    /// Whether all vehicles follow the same law.
    #[inline]
    pub(crate) fn has_one_law(&self) -> bool {
        self.common.is_some()
    }

    /// Has the vehicle's shortfall evaluated in full next time.
    pub fn invalidate(&mut self, j: usize) {
        for j in self.images(j) {
            self.state.gap[j] = f64::NAN;
        }
    }

    /// By how much more the leader of each vehicle has driven than the vehicle itself, as seen, m (padded).
    #[inline]
    pub fn gaps(&self) -> &[f64] {
        &self.state.gap
    }

    /// Speeds, m/s (padded).
    #[inline]
    pub fn speeds(&self) -> &[f64] {
        &self.state.speed
    }

    /// Overrules the law: a braked vehicle.
    pub fn set_speed(&mut self, j: usize, speed: f64) {
        for j in self.images(j) {
            self.state.speed[j] = speed;
        }
    }

    /// A whole step of `dt` seconds at once, where the leader of j is j + 1 and what is seen is there already.
    /// Displacements go from `old` to `new`; all shortfalls in full where `refresh` says so. Tells how far the slowest
    /// and the fastest have gone, m.
    pub(crate) fn advance_in_order(
        &mut self,
        old: &[f64],
        new: &mut [f64],
        scene: Scene<'_>,
        dt: f64,
        refresh: bool,
    ) -> (f64, f64) {
        let mut extremes = (0.0, 0.0);
        let (width, state, range) = (self.width, &mut self.state, &mut extremes);
        match (self.common, scene.seen) {
            (Some(law), [seen]) => {
                advance_alike(width, old, seen, scene.offset, law, dt, refresh, state, new, range);
            }
            _ => advance_mixed(width, old, scene, &self.laws, dt, refresh, state, new, range),
        }
        (extremes.0 * dt, extremes.1 * dt)
    }

    /// So many steps of `dt` seconds at once, no more than the `delay` that all have, after step `first`; the leader of
    /// j is j + 1, and all have one law: see [`Self::has_one_law`].
    pub(crate) fn drive_on(
        &mut self,
        history: &mut History,
        delay: usize,
        offset: &[f64],
        dt: f64,
        first: u64,
        steps: usize,
    ) {
        let law = self.common.expect("one law of all vehicles");
        debug_assert!(steps <= delay, "{steps} steps within a delay of {delay}");
        drive_on(self.width, history, delay, offset, law, dt, first, steps, &mut self.state);
        history.catch_up(steps);
    }

    /// The smallest true headway at the displacements `s`, m, where the leader of j is j + 1.
    pub(crate) fn least_headway(&self, s: &[f64], offset: &[f64]) -> f64 {
        let mut least = 0.0;
        find_least_headway(self.width, s, offset, &mut least);
        least
    }

    /// New displacements after a step of `dt` seconds; how far the slowest and the fastest have gone, m.
    pub fn drive(&self, old: &[f64], dt: f64, new: &mut [f64]) -> (f64, f64) {
        let mut extremes = (0.0, 0.0);
        drive(self.width, old, &self.state.speed, dt, new, &mut extremes);
        (extremes.0 * dt, extremes.1 * dt)
    }

    /// New speeds of drivers who all see the displacements `seen` (m, padded), with leaders at `offset`; all shortfalls
    /// in full where `refresh` says so.
    pub fn respond(&mut self, seen: &[f64], leaders: &[u32], offset: &[f64], refresh: bool) {
        respond_all(self.width, seen, Some(leaders), offset, &self.laws, refresh, &mut self.state);
    }

    /// The same for gaps (m, padded) that each driver has seen at another time.
    pub fn respond_to_gaps(&mut self, gaps: &[f64], offset: &[f64], refresh: bool) {
        respond_all(self.width, gaps, None, offset, &self.laws, refresh, &mut self.state);
    }

    /// The same for one vehicle that has another leader.
    pub fn respond_to_another(&mut self, j: usize, gap: f64, offset: f64) {
        let law = Law {
            max_speed: self.laws.max_speed[j],
            rate: self.laws.rate[j],
            min_headway: self.laws.min_headway[j],
        };
        let shortfall = law.max_speed * exp_within(law.rate * ((offset + gap) - law.min_headway));
        let v = law.max_speed - shortfall;
        for j in self.images(j) {
            self.state.gap[j] = gap;
            self.state.shortfall[j] = shortfall;
            self.state.speed[j] = if v > 0.0 { v } else { 0.0 };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::random::{Generator, Stream};

    /// Whole chunks, however long one is.
    const COUNT: usize = 8;
    const OFFSET: [f64; COUNT] = [20.0; COUNT];

    /// Over the corners of what the table of parameters allows: headways that wander as far as a step can take them,
    /// a million steps, moves that both polynomials serve and moves that none does.
    #[test]
    fn a_million_steps_stay_within_the_stated_error_of_the_exponential() {
        let mut generator = Generator::new(1, Stream::Start);
        let mut worst = 0.0_f64;
        for max_speed in [0.1, 40.0, 100.0] {
            for sensitivity in [0.01, 1.0, 20.0] {
                for (dt, steps) in [(0.001, 1_000_000_u64), (0.01, 100_000), (0.5, 10_000)] {
                    for share in [1.0, 0.1] {
                        let drivers = [Driver { max_speed, sensitivity, ..Driver::default() }; COUNT];
                        let mut following = CarFollowing::new(&drivers, COUNT);
                        let mut gap = [0.0; COUNT];
                        for step in 0..steps {
                            following.respond_to_gaps(&gap, &OFFSET, step.is_multiple_of(REFRESH));
                            if step % REFRESH == REFRESH - 1 {
                                for (j, driver) in drivers.iter().enumerate() {
                                    let error = (following.speeds()[j] - driver.speed(20.0 + gap[j])).abs();
                                    worst = worst.max(error / max_speed);
                                }
                            }
                            for g in &mut gap {
                                *g += (generator.uniform() - 0.5) * 2.0 * share * max_speed * dt;
                                *g = (20.0 + *g).abs() - 20.0;
                            }
                        }
                    }
                }
            }
        }
        println!("largest error: {worst:e} V");
        assert!(worst < 3e-14, "largest error {worst:e} V");
        assert!(worst > 0.0, "the shortfall is not evaluated anew at every step");
    }

    /// The polynomials against the exponential where they are used.
    #[test]
    fn one_step_of_the_shortfall_is_good_to_rounding() {
        for k in -10_000..=10_000 {
            let a = f64::from(k) * 1e-4;
            let error = |moved: f64, a: f64| (moved / exp_within(a) - 1.0).abs();
            let (little, much) = (a * TINY.sqrt(), a * SMALL.sqrt());
            assert!(
                error(Constants::new().moved_a_little(1.0, little, little * little), little) < 5e-16,
                "a = {little}"
            );
            assert!(error(Constants::new().moved(1.0, much, much * much), much) < 5e-16, "a = {much}");
        }
    }

    #[test]
    fn a_jump_is_evaluated_in_full_and_does_not_touch_the_others() {
        let driver = Driver::default();
        let mut following = CarFollowing::new(&[driver; COUNT], COUNT);
        let mut gap = [0.0; COUNT];
        following.respond_to_gaps(&gap, &OFFSET, true);
        gap[3] = -12.0;
        gap[4] = 1e-9;
        following.respond_to_gaps(&gap, &OFFSET, false);
        assert_eq!(following.speeds()[3], driver.speed(8.0));
        assert_eq!(following.speeds()[2], driver.speed(20.0));
        gap[3] = -1e6;
        gap[5] = 1e9;
        following.respond_to_gaps(&gap, &OFFSET, false);
        assert_eq!((following.speeds()[3], following.speeds()[5]), (0.0, 40.0));
        // Back from where the exponential would have overflowed.
        gap[3] = 0.0;
        following.respond_to_gaps(&gap, &OFFSET, false);
        assert_eq!(following.speeds()[3], driver.speed(20.0));
    }

    #[test]
    fn another_leader_is_as_good_as_a_start() {
        let driver = Driver { sensitivity: 1.3, ..Driver::default() };
        let mut one = CarFollowing::new(&[driver; 3], COUNT);
        one.respond_to_gaps(&[0.0; COUNT], &OFFSET, true);
        one.respond_to_another(1, 0.3, 17.0);
        let mut offset = OFFSET;
        let mut gap = [0.0; COUNT];
        for j in [1, 4, 7] {
            (offset[j], gap[j]) = (17.0, 0.3);
        }
        let mut all = CarFollowing::new(&[driver; 3], COUNT);
        all.respond_to_gaps(&gap, &offset, true);
        assert_eq!(one.speeds(), all.speeds(), "images included");
    }

    /// A whole step at once, for equal drivers and for drivers that differ, is driving first and responding then.
    #[test]
    fn a_step_at_once_gives_the_same_bits_as_one_after_the_other() {
        let mut generator = Generator::new(5, Stream::Start);
        for differ in [false, true] {
            for n in [2, 5, COUNT, 2 * COUNT + 3] {
                let padded = n.next_multiple_of(CHUNK);
                let mut drivers = vec![Driver::default(); n];
                if differ {
                    drivers[1].sensitivity = 2.0;
                }
                let image = |row: &[f64], j: usize| row[j % n];
                let offset: Vec<f64> = (0..n).map(|_| 20.0 + generator.uniform()).collect();
                let offset: Vec<f64> = (0..padded).map(|j| image(&offset, j)).collect();
                let (mut once, mut twice) =
                    (CarFollowing::new(&drivers, padded), CarFollowing::new(&drivers, padded));
                let mut mask = Aligned::filled(0.0, padded);
                for j in (1..padded).step_by(n) {
                    mask[j] = f64::from_bits(u64::MAX);
                }
                let mut old = vec![0.0; padded + CHUNK];
                for step in 0..200 {
                    let mut rows = [(); 2].map(|()| {
                        let row: Vec<f64> = (0..n).map(|_| generator.uniform()).collect();
                        (0..padded + CHUNK).map(|j| image(&row, j)).collect::<Vec<_>>()
                    });
                    if step % 3 == 0 {
                        rows[1] = rows[0].iter().map(|x| x + 1e-3).collect();
                    }
                    let count = if differ { 2 } else { 1 };
                    let seen = [rows[0].as_slice(), &rows[1]];
                    let mut new = [old.clone(), old.clone()];
                    let chosen = std::slice::from_ref(&mask);
                    let scene = Scene { offset: &offset, seen: &seen[..count], chosen };
                    let (left, right) = new.split_at_mut(1);
                    let ahead = [
                        once.advance_in_order(&old, &mut left[0], scene, 0.1, step == 0),
                        twice.drive(&old, 0.1, &mut right[0]),
                    ];
                    let gap: Vec<f64> = (0..padded)
                        .map(|j| {
                            let row = seen[usize::from(differ && j % n == 1)];
                            row[j + 1] - row[j]
                        })
                        .collect();
                    twice.respond_to_gaps(&gap, &offset, step == 0);
                    assert_eq!(ahead[0], ahead[1]);
                    assert_eq!(new[0], new[1]);
                    assert_eq!(once.gaps(), twice.gaps());
                    assert_eq!(once.speeds(), twice.speeds());
                    assert!((0..padded).all(|j| once.speeds()[j] == once.speeds()[j % n]), "images");
                    old.clone_from(&new[0]);
                }
            }
        }
    }
}
