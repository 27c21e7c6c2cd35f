//! How is work shared among the processors?
//!
//! `map` and `map_each` use rayon's pool, or do all the work themselves if no thread may be started or there is no
//! pool. `made` computes a value that many jobs need, once.

use std::cell::Cell;
use std::sync::OnceLock;

std::thread_local! {
    /// Whether this thread must not wait for others.
    static ALONE: Cell<bool> = const { Cell::new(false) };
}

/// The most threads that may be asked for.
pub const MOST: u16 = 1024;

/// The value in the cell; `make` makes it if the cell is empty.
///
/// The thread that makes the value shares no work. A thread of the pool takes up other jobs while it waits; if one of
/// them needed the same cell, the thread would wait for itself.
pub(crate) fn made<T>(cell: &OnceLock<T>, make: impl FnOnce() -> T) -> &T {
    struct Before(bool);
    impl Drop for Before {
        fn drop(&mut self) {
            ALONE.set(self.0);
        }
    }
    cell.get_or_init(|| {
        let _before = Before(ALONE.replace(true));
        make()
    })
}

/// The values of `of` at 0, 1, … below `count`, in that order.
pub fn map<T: Send>(count: usize, of: impl Fn(usize) -> T + Sync) -> Vec<T> {
    #[cfg(feature = "parallel")]
    if !ALONE.get() && pool::is_there() {
        return pool::map(count, of);
    }
    (0..count).map(of).collect()
}

/// The values of `of` for each item and its index, in that order.
pub(crate) fn map_each<S: Send, T: Send>(
    each: &mut [S],
    of: impl Fn(usize, &mut S) -> T + Sync,
) -> Vec<T> {
    #[cfg(feature = "parallel")]
    if each.len() > 1 && !ALONE.get() && pool::is_there() {
        return pool::map_each(each, of);
    }
    each.iter_mut().enumerate().map(|(k, one)| of(k, one)).collect()
}

/// Does the work on the given number of threads; by default one for each processor.
pub fn with<T: Send>(threads: Option<usize>, work: impl FnOnce() -> T + Send) -> T {
    #[cfg(feature = "parallel")]
    if let Some(threads) = threads
        && let Ok(pool) = rayon::ThreadPoolBuilder::new().num_threads(threads).build()
    {
        return pool.install(work);
    }
    let _ = threads;
    work()
}

/// Number of threads that share work here.
pub fn count() -> usize {
    #[cfg(feature = "parallel")]
    if pool::is_there() {
        return rayon::current_num_threads();
    }
    1
}

#[cfg(feature = "parallel")]
mod pool {
    use std::error::Error;
    use std::sync::LazyLock;

    use rayon::ThreadPoolBuilder;
    use rayon::prelude::*;

    /// The process that owns the pool, if there is one: the system may limit a user's processes.
    static SHARED: LazyLock<Option<u32>> = LazyLock::new(|| {
        let built = ThreadPoolBuilder::new().build_global();
        // The only error without a cause means that the pool was built before.
        let there = built.map_or_else(|error| error.source().is_none(), |()| true);
        there.then(std::process::id)
    });

    /// Whether there is a pool. A process forked from its owner has none of its threads.
    pub fn is_there() -> bool {
        rayon::current_thread_index().is_some() || *SHARED == Some(std::process::id())
    }

    pub fn map<T: Send>(count: usize, of: impl Fn(usize) -> T + Sync) -> Vec<T> {
        (0..count).into_par_iter().map(&of).collect()
    }

    pub fn map_each<S: Send, T: Send>(
        each: &mut [S],
        of: impl Fn(usize, &mut S) -> T + Sync,
    ) -> Vec<T> {
        each.par_iter_mut().enumerate().map(|(k, one)| of(k, one)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_order_is_kept() {
        assert_eq!(map(1000, |k| k * k), (0..1000).map(|k| k * k).collect::<Vec<_>>());
        let mut sums = vec![1; 1000];
        let places = map_each(&mut sums, |k, sum| {
            *sum += k;
            k
        });
        assert_eq!(places, (0..1000).collect::<Vec<_>>());
        assert_eq!(sums, (1..1001).collect::<Vec<_>>());
    }

    /// Many jobs need a value that one of them makes with many jobs. If that job waited in the pool, it would take up
    /// another one that needs the value, and both would wait for ever.
    #[cfg(feature = "parallel")]
    #[test]
    fn what_is_made_once_is_made_by_one_that_waits_for_nobody() {
        let slowly = |k: usize| {
            std::thread::sleep(std::time::Duration::from_micros(200));
            k
        };
        let pool = rayon::ThreadPoolBuilder::new().num_threads(8).build().unwrap();
        for _ in 0..4 {
            let cell = OnceLock::new();
            let ask = |_| *made(&cell, || map(64, slowly).into_iter().sum::<usize>());
            assert_eq!(pool.install(|| map(64, ask)), vec![2016; 64]);
        }
        // The thread that made the value shares work again.
        assert!(!ALONE.get());
    }
}
