//! One loop over independent tasks, on all cores where the target has threads.
//!
//! With the feature `parallel` (rayon) tasks run on several threads; without it, and in a browser, they run one after
//! another. The results are the same in both cases, since each task gets its index and nothing else.
//!
//! Progress and cancellation belong to the task: it may report what it has done to whatever it shares with the caller,
//! and it returns an error to stop.
//!
//! ```
//! use ringroad::numerics::parallel::try_map;
//!
//! let squares = try_map(4, None, |k| Ok::<_, String>(k * k));
//! assert_eq!(squares.unwrap(), [0, 1, 4, 9]);
//!
//! let cancelled = try_map(4, None, |k| if k == 2 { Err("cancelled") } else { Ok(k) });
//! assert_eq!(cancelled, Err("cancelled"));
//! ```

/// Calls `task` with every index from 0 to `count` − 1 and gives the results in the order of the indices.
///
/// `threads` is the number of threads; `None` means one for each core. Where the system refuses so many threads, those
/// of the default are used.
///
/// # Errors
/// The error of a task. No further task begins after it; tasks that are running on other threads come to their end
/// first. When several tasks fail at the same time, it is the error of any one of them.
pub fn try_map<R: Send, E: Send>(
    count: usize,
    threads: Option<usize>,
    task: impl Fn(usize) -> Result<R, E> + Sync + Send,
) -> Result<Vec<R>, E> {
    run(count, threads, task)
}

#[cfg(all(feature = "parallel", not(target_arch = "wasm32")))]
fn run<R: Send, E: Send>(
    count: usize,
    threads: Option<usize>,
    task: impl Fn(usize) -> Result<R, E> + Sync + Send,
) -> Result<Vec<R>, E> {
    use rayon::prelude::*;
    // Tasks differ in length by orders of magnitude; so a thread takes one at a time.
    let all = || (0..count).into_par_iter().with_max_len(1).map(&task).collect();
    match threads.map(|n| rayon::ThreadPoolBuilder::new().num_threads(n).build()) {
        Some(Ok(pool)) => pool.install(all),
        Some(Err(_)) | None => all(),
    }
}

#[cfg(not(all(feature = "parallel", not(target_arch = "wasm32"))))]
fn run<R, E>(
    count: usize,
    _threads: Option<usize>,
    task: impl Fn(usize) -> Result<R, E>,
) -> Result<Vec<R>, E> {
    (0..count).map(task).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicUsize, Ordering};

    #[test]
    fn results_are_in_order_on_any_number_of_threads() {
        for threads in [None, Some(1), Some(3)] {
            let results = try_map(100, threads, |k| Ok::<_, ()>(3 * k)).unwrap();
            assert!(results.iter().enumerate().all(|(k, &result)| result == 3 * k), "{threads:?}");
        }
        assert_eq!(try_map(0, None, Ok::<_, ()>), Ok(Vec::new()));
    }

    #[test]
    fn no_task_begins_after_an_error() {
        let begun = AtomicUsize::new(0);
        let task = |k| {
            begun.fetch_add(1, Ordering::Relaxed);
            if k == 0 { Err("stop") } else { Ok(()) }
        };
        assert_eq!(try_map(1000, Some(1), task), Err("stop"));
        assert!(begun.into_inner() < 1000);
    }
}
