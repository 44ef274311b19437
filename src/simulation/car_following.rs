//! Car following, all vehicles at once: from perceived headways to speeds.
//!
//! # The speed deficit
//!
//! v = max(V − w, 0), where the *speed deficit* w = V·exp(−(λ/V)(h − d)) is what is missing to the maximum speed before the
//! speed is clipped at 0. The perceived headway h is the offset of the leader, which stays as it is while the leader does,
//! plus the *relative displacement*: the displacement of the leader minus the vehicle's own, both as perceived. From one
//! step to the next the relative displacement changes by a little, so w changes by a factor e^a with a small
//! a = −(λ/V)·δ(relative displacement): |a| ≤ λ·dt for equal drivers. Where |a| ≤ 2⁻¹⁰ the deficit is multiplied by the
//! Taylor polynomial of degree 4, where |a| ≤ 2⁻⁶ by that of degree 6. Their remainders, about a⁵/5! and a⁷/7!, are below
//! 7.5·10⁻¹⁸ and 4.6·10⁻¹⁷ of e^a: less than half the distance from one number to the next. Where a is larger (a nudge, a
//! large λ·dt) and where the leader or the driver has changed, the deficit of that vehicle is evaluated in full. The choice
//! is made vehicle by vehicle, so that it does not depend on the width of the vectors.
//!
//! Equal drivers on one lane can be taken many steps on at once, up to their delay, one block of vehicles after the other:
//! it saves memory traffic, and every step computes the same bits as one by itself.
//!
//! **Accuracy.** One multiplication by a polynomial rounds like w·(1 + ε) with |ε| under 5·10⁻¹⁶, the
//! rounding of a itself included; every [`REFRESH`] steps all deficits are evaluated in full. So w stays within
//! 64·5·10⁻¹⁶ = 3.2·10⁻¹⁴ of V times the exponential, relatively, however long the run, over the whole range of the
//! parameters, and v with it. Arguments of the full evaluation are held to ±700: w then means "stand still" (V·e^700) or
//! "maximum speed" (V·e^−700) and stays so through [`REFRESH`] steps of at most 2⁻⁶ each.

#[cfg(doc)]
use super::delays::Delays;
use super::history::RowsAhead;
use super::padding::images;
use crate::numerics::exp::{all_within, exp_within};
use crate::numerics::simd::{Aligned, CHUNK, Chunk, Extremes, Real, Width, chunks, chunks_mut, kernel};
use crate::scenario::driver::Driver;

/// Steps between full evaluations of all speed deficits.
pub(crate) const REFRESH: u64 = 64;

/// Largest a² for which the polynomial of degree 4 is used.
const TINY: f64 = 1.0 / (1024.0 * 1024.0);
/// Largest a² for which the polynomial of degree 6 is used.
const SMALL: f64 = 1.0 / (64.0 * 64.0);

/// V, −λ/V and d of a driver.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Law {
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

/// What the drivers perceive on one lane, where the leader of j is j + 1; rows and arrays padded.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scene<'a> {
    /// Offsets of the leaders, m.
    pub(crate) offset: &'a [f64],
    /// For each of the different delays, the displacements (m) so many steps ago.
    pub(crate) rows: &'a [&'a [f64]],
    /// Which driver has which delay; see [`Delays::masks`].
    pub(crate) masks: &'a [Aligned],
}

/// Relative displacements, speed deficits and speeds of all vehicles; padded.
#[derive(Clone, Debug)]
pub(crate) struct CarFollowing {
    width: Width,
    vehicles: usize,
    state: State,
    laws: Laws,
    /// The law of all vehicles, if all have the same: its constants then need not be read vehicle by vehicle.
    common: Option<Law>,
}

#[derive(Clone, Debug)]
struct State {
    /// As perceived, m; NaN where the deficit is not valid, so that it is evaluated in full.
    relative: Aligned,
    /// m/s.
    deficit: Aligned,
    /// m/s.
    speed: Aligned,
}

#[derive(Clone, Debug)]
struct Laws {
    max_speed: Aligned,
    rate: Aligned,
    min_headway: Aligned,
}

/// The numbers that most steps need, kept in registers.
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
    /// The values are hidden from the compiler: JavaScript engines load a constant anew wherever it is used, also in a loop.
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

    /// A new deficit from the old one, where `a2` = a² ≤ [`TINY`].
    #[inline(always)]
    fn changed_a_little(&self, deficit: T, a: T, a2: T) -> T {
        // Taylor's polynomial, Estrin's scheme: short chains, so that a vector unit stays busy.
        let high = (self.half + a * self.sixth) + a2 * self.twenty_fourth;
        deficit * ((self.one + a) + high * a2)
    }

    /// The same where a² ≤ [`SMALL`].
    #[inline(always)]
    fn changed(&self, deficit: T, a: T, a2: T) -> T {
        let low = self.one + a;
        let middle = self.half + a * self.sixth;
        let high = (self.twenty_fourth + a * T::all(1.0 / 120.0)) + a2 * T::all(1.0 / 720.0);
        deficit * ((low + middle * a2) + high * (a2 * a2))
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
    /// The laws of chunk `k`.
    #[inline(always)]
    fn at(&self, k: usize) -> ChunkLaw {
        let at = |numbers: &[f64]| Chunk::load(&chunks(numbers)[k]);
        ChunkLaw { max_speed: at(&self.max_speed), rate: at(&self.rate), min_headway: at(&self.min_headway) }
    }
}

/// A [`State`] chunk by chunk, and what the response needs.
struct Drivers<'a> {
    relative: &'a mut [[f64; CHUNK]],
    deficit: &'a mut [[f64; CHUNK]],
    speed: &'a mut [[f64; CHUNK]],
    offset: &'a [[f64; CHUNK]],
    constants: Constants<Chunk>,
}

impl<'a> Drivers<'a> {
    #[inline(always)]
    fn new(state: &'a mut State, offset: &'a [f64]) -> Self {
        let end = state.speed.len() / CHUNK;
        Self::part(state, offset, 0, end)
    }

    /// The chunks `begin..end` only.
    #[inline(always)]
    fn part(state: &'a mut State, offset: &'a [f64], begin: usize, end: usize) -> Self {
        Self {
            relative: &mut chunks_mut(&mut state.relative)[begin..end],
            deficit: &mut chunks_mut(&mut state.deficit)[begin..end],
            speed: &mut chunks_mut(&mut state.speed)[begin..end],
            offset: &chunks(offset)[begin..end],
            constants: Constants::new(),
        }
    }

    /// Speeds of chunk `k`, for the relative displacements perceived now.
    #[inline(always)]
    fn respond(&mut self, k: usize, relative: Chunk, law: ChunkLaw, refresh: bool) {
        let deficit = self.deficit(k, relative, law, refresh);
        relative.store(&mut self.relative[k]);
        deficit.store(&mut self.deficit[k]);
        self.constants.zero.most(law.max_speed - deficit).store(&mut self.speed[k]);
    }

    #[inline(always)]
    fn deficit(&self, k: usize, relative: Chunk, law: ChunkLaw, refresh: bool) -> Chunk {
        let old = Chunk::load(&self.deficit[k]);
        let a = law.rate * (relative - Chunk::load(&self.relative[k]));
        let a2 = a * a;
        if !refresh {
            if a2.are_at_most(self.constants.tiny) {
                return self.constants.changed_a_little(old, a, a2);
            }
            if a2.are_at_most(Chunk::splat(SMALL)) {
                let little = self.constants.changed_a_little(old, a, a2);
                return a2.at_most(self.constants.tiny).choose(little, self.constants.changed(old, a, a2));
            }
        }
        let argument = law.rate * ((Chunk::load(&self.offset[k]) + relative) - law.min_headway);
        let mut next = self.deficit[k];
        deficit_in_general(
            &a.to_array(),
            &argument.to_array(),
            &law.max_speed.to_array(),
            refresh,
            &mut next,
        );
        Chunk::load(&next)
    }
}

/// New deficits of a chunk in which not all have changed by a little; `argument` is that of the exponential, −(λ/V)(h − d).
/// (All goes through memory: the rare case must not take registers from the common one.)
#[cold]
#[inline(never)]
fn deficit_in_general(
    a: &[f64; CHUNK],
    argument: &[f64; CHUNK],
    max_speed: &[f64; CHUNK],
    refresh: bool,
    deficit: &mut [f64; CHUNK],
) {
    let in_full = Chunk::load(max_speed) * all_within(Chunk::load(argument));
    let (old, a) = (Chunk::load(deficit), Chunk::load(a));
    let a2 = a * a;
    let next = if refresh {
        in_full
    } else {
        let constants = Constants::new();
        // A comparison with NaN, the deficit of a vehicle that has no valid one yet, is false.
        let next = a2.at_most(Chunk::splat(SMALL)).choose(constants.changed(old, a, a2), in_full);
        a2.at_most(constants.tiny).choose(constants.changed_a_little(old, a, a2), next)
    };
    next.store(deficit);
}

kernel! {
    /// A whole step where the leader of j is j + 1 and all have one law and one delay: displacements from `old` to `new`, then
    /// relative displacements in the row `perceived`, which is not `new`, then speeds. `extremes` gets the smallest and the
    /// largest speed before.
    fn advance_homogeneous(
        old: &[f64], perceived: &[f64], offset: &[f64], law: Law, dt: f64, refresh: bool,
        state: &mut State, new: &mut [f64], extremes: &mut (f64, f64),
    ) {
        let mut drivers = Drivers::new(state, offset);
        let count = drivers.speed.len();
        let (old, new) = (&chunks(old)[..count], &mut chunks_mut(new)[..count]);
        let (own, ahead) = (&chunks(perceived)[..count], &chunks(&perceived[1..])[..count]);
        let (law, dt) = (ChunkLaw::common(law), Chunk::splat(dt));
        let mut range = Extremes::of(Chunk::load(&drivers.speed[0]));
        for k in 0..count {
            let v = Chunk::load(&drivers.speed[k]);
            range.take(v);
            (Chunk::load(&old[k]) + v * dt).store(&mut new[k]);
            drivers.respond(k, Chunk::load(&ahead[k]) - Chunk::load(&own[k]), law, refresh);
        }
        *extremes = range.reduced();
    }
}

kernel! {
    /// The same where drivers differ: each has a law of its own and one of a few delays; see [`Delays::distinct`].
    fn advance_heterogeneous(
        old: &[f64], scene: Scene<'_>, laws: &Laws, dt: f64, refresh: bool,
        state: &mut State, new: &mut [f64], extremes: &mut (f64, f64),
    ) {
        let Scene { offset, rows, masks } = scene;
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
            let mut relative = difference(rows[0], k);
            for (row, mask) in rows[1..].iter().zip(masks) {
                relative = Chunk::load(&chunks(mask)[k]).choose(difference(row, k), relative);
            }
            drivers.respond(k, relative, laws.at(k), refresh);
        }
        *extremes = range.reduced();
    }
}

/// Chunks of a block that is taken many steps on at once: so few that their state stays in the nearest cache.
const BLOCK: usize = 512 / CHUNK;

kernel! {
    /// `steps` times [`advance_homogeneous`] after step `first`, block by block. With at most `delay` steps no driver responds
    /// to a displacement that is computed here.
    fn advance_blocks(
        rows: &mut RowsAhead<'_>, delay: usize, offset: &[f64], law: Law, dt: f64, first: u64, steps: usize,
        state: &mut State,
    ) {
        let (law, dt) = (ChunkLaw::common(law), Chunk::splat(dt));
        let count = state.speed.len() / CHUNK;
        for begin in (0..count).step_by(BLOCK) {
            let end = count.min(begin + BLOCK);
            let mut drivers = Drivers::part(state, offset, begin, end);
            for step in 1..=steps {
                let refresh = (first + step as u64).is_multiple_of(REFRESH);
                let (new, past) = rows.row(step);
                let perceived = past.row(delay);
                let (old, new) = (&chunks(past.row(1))[begin..end], &mut chunks_mut(new)[begin..end]);
                let (own, ahead) = (&chunks(perceived)[begin..end], &chunks(&perceived[1..])[begin..end]);
                for k in 0..end - begin {
                    (Chunk::load(&old[k]) + Chunk::load(&drivers.speed[k]) * dt).store(&mut new[k]);
                    drivers.respond(k, Chunk::load(&ahead[k]) - Chunk::load(&own[k]), law, refresh);
                }
            }
        }
    }
}

kernel! {
    /// `smallest` gets the smallest true headway at the displacements `s`, where the leader of j is j + 1.
    fn find_smallest_headway(s: &[f64], offset: &[f64], smallest: &mut f64) {
        let count = offset.len() / CHUNK;
        let (ahead, s, offset) = (&chunks(&s[1..])[..count], &chunks(s)[..count], &chunks(offset)[..count]);
        let headway = |k: usize| Chunk::load(&offset[k]) + (Chunk::load(&ahead[k]) - Chunk::load(&s[k]));
        let mut extremes = Extremes::of(headway(0));
        for k in 1..count {
            extremes.take(headway(k));
        }
        *smallest = extremes.reduced().0;
    }
}

kernel! {
    /// Displacements: s += v·dt. `extremes` gets the smallest and the largest speed.
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
    /// Speeds for the displacements relative to these leaders in the row `perceived`; without leaders `perceived` holds the
    /// relative displacements themselves.
    fn respond_all(
        perceived: &[f64], leaders: Option<&[u32]>, offset: &[f64], laws: &Laws, refresh: bool, state: &mut State,
    ) {
        let mut drivers = Drivers::new(state, offset);
        let count = drivers.speed.len();
        let own = &chunks(perceived)[..count];
        let leaders = leaders.map(|leaders| &leaders.as_chunks::<CHUNK>().0[..count]);
        for k in 0..count {
            let own = Chunk::load(&own[k]);
            let relative = leaders.map_or(own, |leaders| Chunk::gather(perceived, &leaders[k]) - own);
            drivers.respond(k, relative, laws.at(k), refresh);
        }
    }
}

impl CarFollowing {
    /// For these drivers, in arrays padded to `padded` numbers; no speed is valid before the first response.
    pub(crate) fn new(drivers: &[Driver], padded: usize) -> Self {
        let filled = |value| Aligned::filled(value, padded);
        let mut following = Self {
            width: Width::widest(),
            vehicles: drivers.len(),
            state: State { relative: filled(f64::NAN), deficit: filled(0.0), speed: filled(0.0) },
            laws: Laws { max_speed: filled(1.0), rate: filled(-1.0), min_headway: filled(1.0) },
            common: None,
        };
        for (j, driver) in drivers.iter().enumerate() {
            following.set_law(j, Law::of(driver));
        }
        following.find_common_law(drivers);
        following
    }

    /// Uses vectors of another width; results stay the same.
    pub(crate) fn set_width(&mut self, width: Width) {
        self.width = width;
    }

    fn images(&self, j: usize) -> impl Iterator<Item = usize> + use<> {
        images(j, self.vehicles)
    }

    /// Takes over the laws of the drivers that have `changed`.
    pub(crate) fn set_drivers(&mut self, drivers: &[Driver], changed: &[usize]) {
        for &j in changed {
            self.set_law(j, Law::of(&drivers[j]));
        }
        self.find_common_law(drivers);
    }

    fn set_law(&mut self, j: usize, law: Law) {
        for j in self.images(j) {
            self.laws.max_speed[j] = law.max_speed;
            self.laws.rate[j] = law.rate;
            self.laws.min_headway[j] = law.min_headway;
        }
        self.invalidate(j);
    }

    fn find_common_law(&mut self, drivers: &[Driver]) {
        let first = Law::of(&drivers[0]);
        self.common = drivers.iter().all(|d| Law::of(d) == first).then_some(first);
    }

    /// The law of all vehicles, if all have the same.
    #[inline]
    pub(crate) fn common_law(&self) -> Option<Law> {
        self.common
    }

    /// Has the speed deficit of a vehicle evaluated in full next time.
    pub(crate) fn invalidate(&mut self, j: usize) {
        for j in self.images(j) {
            self.state.relative[j] = f64::NAN;
        }
    }

    /// The displacement of the leader of each vehicle minus the vehicle's own, as perceived, m (padded).
    #[inline]
    pub(crate) fn relative_displacements(&self) -> &[f64] {
        &self.state.relative
    }

    /// Speeds, m/s (padded).
    #[inline]
    pub(crate) fn speeds(&self) -> &[f64] {
        &self.state.speed
    }

    /// Sets a speed against the law, for a braked vehicle.
    pub(crate) fn set_speed(&mut self, j: usize, speed: f64) {
        for j in self.images(j) {
            self.state.speed[j] = speed;
        }
    }

    /// A whole step of `dt` seconds at once, where the leader of j is j + 1 and what is perceived after it is known before.
    /// Displacements go from `old` to `new`; all deficits are evaluated in full where `refresh` says so. Returns how far
    /// the slowest and the fastest vehicle have moved, m.
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
        match (self.common, scene.rows) {
            (Some(law), [perceived]) => {
                advance_homogeneous(width, old, perceived, scene.offset, law, dt, refresh, state, new, range);
            }
            _ => advance_heterogeneous(width, old, scene, &self.laws, dt, refresh, state, new, range),
        }
        (extremes.0 * dt, extremes.1 * dt)
    }

    /// So many steps of `dt` seconds at once after step `first`, no more than the `delay` of all drivers; the leader of j is
    /// j + 1, and `law` is that of all: see [`Self::common_law`]. Writes one row of displacements a step.
    #[allow(clippy::too_many_arguments)] // the arguments of a kernel
    pub(crate) fn advance_many(
        &mut self,
        law: Law,
        rows: &mut RowsAhead<'_>,
        delay: usize,
        offset: &[f64],
        dt: f64,
        first: u64,
        steps: usize,
    ) {
        debug_assert!(steps <= delay, "{steps} steps within a delay of {delay}");
        advance_blocks(self.width, rows, delay, offset, law, dt, first, steps, &mut self.state);
    }

    /// The smallest true headway at the displacements `s`, m, where the leader of j is j + 1.
    pub(crate) fn smallest_headway(&self, s: &[f64], offset: &[f64]) -> f64 {
        let mut smallest = 0.0;
        find_smallest_headway(self.width, s, offset, &mut smallest);
        smallest
    }

    /// New displacements after a step of `dt` seconds; returns how far the slowest and the fastest vehicle have moved, m.
    pub(crate) fn drive(&self, old: &[f64], dt: f64, new: &mut [f64]) -> (f64, f64) {
        let mut extremes = (0.0, 0.0);
        drive(self.width, old, &self.state.speed, dt, new, &mut extremes);
        (extremes.0 * dt, extremes.1 * dt)
    }

    /// New speeds of drivers that all perceive the displacements `perceived` (m, padded), with leaders at `offset` (m); all
    /// deficits are evaluated in full where `refresh` says so.
    pub(crate) fn respond(&mut self, perceived: &[f64], leaders: &[u32], offset: &[f64], refresh: bool) {
        respond_all(self.width, perceived, Some(leaders), offset, &self.laws, refresh, &mut self.state);
    }

    /// The same for perceived relative displacements (m, padded), where delays differ.
    pub(crate) fn respond_to_relative(&mut self, relative: &[f64], offset: &[f64], refresh: bool) {
        respond_all(self.width, relative, None, offset, &self.laws, refresh, &mut self.state);
    }

    /// The same for one vehicle that has got another leader, at another offset.
    pub(crate) fn respond_to_new_leader(&mut self, j: usize, relative: f64, offset: f64) {
        let law = Law {
            max_speed: self.laws.max_speed[j],
            rate: self.laws.rate[j],
            min_headway: self.laws.min_headway[j],
        };
        let deficit = law.max_speed * exp_within(law.rate * ((offset + relative) - law.min_headway));
        let v = law.max_speed - deficit;
        for j in self.images(j) {
            self.state.relative[j] = relative;
            self.state.deficit[j] = deficit;
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

    /// At the corners of what the table of parameters allows: headways that change at random by as much as a step can change
    /// them, a million steps, changes that either polynomial is used for and changes that need the exponential.
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
                        let mut relative = [0.0; COUNT];
                        for step in 0..steps {
                            following.respond_to_relative(&relative, &OFFSET, step.is_multiple_of(REFRESH));
                            if step % REFRESH == REFRESH - 1 {
                                for (j, driver) in drivers.iter().enumerate() {
                                    let error =
                                        (following.speeds()[j] - driver.speed(20.0 + relative[j])).abs();
                                    worst = worst.max(error / max_speed);
                                }
                            }
                            for g in &mut relative {
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
        assert!(worst > 0.0, "the deficit is not evaluated in full at every step");
    }

    /// The polynomials against the exponential where they are used.
    #[test]
    fn one_step_of_the_deficit_is_good_to_rounding() {
        for k in -10_000..=10_000 {
            let a = f64::from(k) * 1e-4;
            let error = |factor: f64, a: f64| (factor / exp_within(a) - 1.0).abs();
            let (little, much) = (a * TINY.sqrt(), a * SMALL.sqrt());
            assert!(
                error(Constants::new().changed_a_little(1.0, little, little * little), little) < 5e-16,
                "a = {little}"
            );
            assert!(error(Constants::new().changed(1.0, much, much * much), much) < 5e-16, "a = {much}");
        }
    }

    #[test]
    fn a_jump_is_evaluated_in_full_and_does_not_touch_the_others() {
        let driver = Driver::default();
        let mut following = CarFollowing::new(&[driver; COUNT], COUNT);
        let mut relative = [0.0; COUNT];
        following.respond_to_relative(&relative, &OFFSET, true);
        relative[3] = -12.0;
        relative[4] = 1e-9;
        following.respond_to_relative(&relative, &OFFSET, false);
        assert_eq!(following.speeds()[3], driver.speed(8.0));
        assert_eq!(following.speeds()[2], driver.speed(20.0));
        relative[3] = -1e6;
        relative[5] = 1e9;
        following.respond_to_relative(&relative, &OFFSET, false);
        assert_eq!((following.speeds()[3], following.speeds()[5]), (0.0, 40.0));
        // Back from where the exponential would have overflowed.
        relative[3] = 0.0;
        following.respond_to_relative(&relative, &OFFSET, false);
        assert_eq!(following.speeds()[3], driver.speed(20.0));
    }

    #[test]
    fn a_new_leader_gives_the_same_bits_as_a_start() {
        let driver = Driver { sensitivity: 1.3, ..Driver::default() };
        let mut one = CarFollowing::new(&[driver; 3], COUNT);
        one.respond_to_relative(&[0.0; COUNT], &OFFSET, true);
        one.respond_to_new_leader(1, 0.3, 17.0);
        let mut offset = OFFSET;
        let mut relative = [0.0; COUNT];
        for j in [1, 4, 7] {
            (offset[j], relative[j]) = (17.0, 0.3);
        }
        let mut all = CarFollowing::new(&[driver; 3], COUNT);
        all.respond_to_relative(&relative, &offset, true);
        assert_eq!(one.speeds(), all.speeds(), "images included");
    }

    /// A whole step at once is moving first and responding then, for homogeneous and for heterogeneous drivers.
    #[test]
    fn a_whole_step_at_once_gives_the_same_bits_as_its_two_parts() {
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
                    let rows = [rows[0].as_slice(), &rows[1]];
                    let mut new = [old.clone(), old.clone()];
                    let masks = std::slice::from_ref(&mask);
                    let scene = Scene { offset: &offset, rows: &rows[..count], masks };
                    let (left, right) = new.split_at_mut(1);
                    let ahead = [
                        once.advance_in_order(&old, &mut left[0], scene, 0.1, step == 0),
                        twice.drive(&old, 0.1, &mut right[0]),
                    ];
                    let relative: Vec<f64> = (0..padded)
                        .map(|j| {
                            let row = rows[usize::from(differ && j % n == 1)];
                            row[j + 1] - row[j]
                        })
                        .collect();
                    twice.respond_to_relative(&relative, &offset, step == 0);
                    assert_eq!(ahead[0], ahead[1]);
                    assert_eq!(new[0], new[1]);
                    assert_eq!(once.relative_displacements(), twice.relative_displacements());
                    assert_eq!(once.speeds(), twice.speeds());
                    assert!((0..padded).all(|j| once.speeds()[j] == once.speeds()[j % n]), "images");
                    old.clone_from(&new[0]);
                }
            }
        }
    }
}
