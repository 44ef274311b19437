//! Bisection: where a condition that holds at one end of an interval and fails at the other changes, if it changes once.
//!
//! Over floating-point numbers the interval is halved until no number lies between its ends: then each end is known to
//! the last bit, usually after some 55 halvings (2100 at most, from the largest to the smallest). Over whole numbers the
//! ends become neighbours.
//! Where the condition changes several times, one of the changes is found.
//!
//! ```
//! use ringroad::numerics::bisection::{last_bit, Whole};
//!
//! let (below, above) = last_bit(1.0, 2.0, |x| x * x < 2.0);
//! assert!(below * below < 2.0 && above * above >= 2.0 && above == below.next_up());
//!
//! // The largest whole number with a square of at most 1000.
//! assert_eq!(Whole::new(0, 1000).until(|n| n * n <= 1000).holds, 31);
//! ```

/// The two neighbouring numbers between which the condition changes: it holds at the first and fails at the second. It is
/// taken to hold at `holds` and to fail at `fails`, and is not evaluated there; either may be the larger.
///
/// The middle of the two, `0.5 * (a + b)`, is one of them. Ends whose sum is not finite are returned at once.
pub fn last_bit(holds: f64, fails: f64, mut condition: impl FnMut(f64) -> bool) -> (f64, f64) {
    let (mut holds, mut fails) = (holds, fails);
    loop {
        let middle = 0.5 * (holds + fails);
        // Also where the middle is not a number.
        let between = middle > holds.min(fails) && middle < holds.max(fails);
        if !between {
            return (holds, fails);
        }
        if condition(middle) {
            holds = middle;
        } else {
            fails = middle;
        }
    }
}

/// Whole numbers from `holds`, where a condition holds, to the larger `fails`, where it fails.
///
/// Either end may be a number where the condition has no meaning, such as 0 vehicles: the ends are never tried.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Whole {
    /// The largest number where the condition is known to hold.
    pub holds: usize,
    /// The smallest number where it is known to fail.
    pub fails: usize,
}

impl Whole {
    /// The numbers between an end where the condition holds and one where it fails.
    pub fn new(holds: usize, fails: usize) -> Self {
        Self { holds, fails }
    }

    /// The number to try next; none when the ends are neighbours.
    pub fn middle(&self) -> Option<usize> {
        (self.fails.saturating_sub(self.holds) > 1).then(|| usize::midpoint(self.holds, self.fails))
    }

    /// Moves one end to `number`, where the condition was found to hold or not.
    pub fn narrow(&mut self, number: usize, holds: bool) {
        if holds {
            self.holds = number;
        } else {
            self.fails = number;
        }
    }

    /// The neighbours between which the condition changes.
    #[must_use]
    pub fn until(mut self, mut condition: impl FnMut(usize) -> bool) -> Self {
        while let Some(middle) = self.middle() {
            self.narrow(middle, condition(middle));
        }
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn floats_are_found_to_the_last_bit_in_both_directions() {
        for edge in [1e-300, 0.1, 1.0, 1.5, 123.456, 1e300] {
            let (below, above) = last_bit(0.0, f64::MAX, |x| x < edge);
            assert_eq!((below, above), (edge.next_down(), edge));
            let (above, below) = last_bit(f64::MAX, 0.0, |x| x >= edge);
            assert_eq!((below, above), (edge.next_down(), edge));
        }
        assert_eq!(last_bit(3.0, 3.0, |_| unreachable!()), (3.0, 3.0));
        assert_eq!(last_bit(0.0, f64::INFINITY, |_| unreachable!()), (0.0, f64::INFINITY));
        assert!(last_bit(0.0, f64::NAN, |_| unreachable!()).1.is_nan());
    }

    #[test]
    fn whole_numbers_end_as_neighbours_and_the_ends_are_never_tried() {
        for last in 1..40 {
            for edge in 1..=last {
                let found = Whole::new(0, last).until(|n| {
                    assert!((1..last).contains(&n));
                    n < edge
                });
                assert_eq!(found, Whole { holds: edge - 1, fails: edge });
            }
        }
        assert_eq!(Whole::new(5, 5).middle(), None);
    }
}
