//! Work on many things at once.

use std::any::Any;
use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::channel;
use std::thread::{self, Builder};

/// As large as the main thread's usually is.
const STACK: usize = 1 << 23;

/// How many workers: those asked for, else one for each core.
pub fn workers(asked: Option<u16>) -> usize {
    match asked {
        Some(asked) => usize::from(asked.max(1)),
        None => thread::available_parallelism().map_or(1, usize::from),
    }
}

/// Does `work` for the numbers below `count`, several at a time, and calls `done` in this thread with each result as it comes.
pub fn each<R: Send>(count: usize, workers: usize, work: impl Fn(usize) -> R + Sync, mut done: impl FnMut(usize, R)) {
    let next = AtomicUsize::new(0);
    let (sender, receiver) = channel();
    thread::scope(|scope| {
        let mut started = 0;
        for _ in 0..workers.min(count) {
            let (sender, next, work) = (sender.clone(), &next, &work);
            let run = move || {
                loop {
                    let i = next.fetch_add(1, Ordering::Relaxed);
                    if i >= count || sender.send((i, work(i))).is_err() {
                        break;
                    }
                }
            };
            started += usize::from(Builder::new().stack_size(STACK).spawn_scoped(scope, run).is_ok());
        }
        drop(sender);
        if started == 0 {
            // Where no thread can be had, this one does it.
            (0..count).for_each(|i| done(i, work(i)));
        }
        for (i, result) in receiver {
            done(i, result);
        }
    });
}

/// As [`each`], but `done` is called in the order of the numbers.
pub fn in_order<R: Send>(
    count: usize,
    workers: usize,
    work: impl Fn(usize) -> R + Sync,
    mut done: impl FnMut(usize, R),
) {
    let mut waiting = BTreeMap::new();
    let mut next = 0;
    each(count, workers, work, |i, result| {
        waiting.insert(i, result);
        while let Some(result) = waiting.remove(&next) {
            done(next, result);
            next += 1;
        }
    });
}

/// Runs something whose panic must not end everything else; gives the panic's message.
pub fn guarded<R>(work: impl FnOnce() -> R) -> Result<R, String> {
    catch_unwind(AssertUnwindSafe(work)).map_err(|panic| message(panic.as_ref()))
}

fn message(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(|text| (*text).to_string());
    let text = text.or_else(|| panic.downcast_ref::<String>().cloned());
    format!(
        "internal error, please report it: {}",
        text.unwrap_or_else(|| "a panic without words".into())
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn everything_is_done_once_and_told_in_order() {
        for (count, workers) in [(0, 4), (1, 4), (100, 1), (100, 7)] {
            let mut told = Vec::new();
            in_order(count, workers, |i| i * i, |i, square| told.push((i, square)));
            assert_eq!(told, (0..count).map(|i| (i, i * i)).collect::<Vec<_>>());
            let mut sum = 0;
            each(count, workers, |i| i, |_, i| sum += i);
            assert_eq!(sum, (0..count).sum::<usize>());
        }
    }

    #[test]
    fn a_panic_becomes_words() {
        assert_eq!(guarded(|| 7), Ok(7));
        let quiet = std::panic::take_hook();
        std::panic::set_hook(Box::new(|_| ()));
        let told = guarded(|| panic!("piece {}", 3));
        std::panic::set_hook(quiet);
        assert_eq!(told, Err::<(), _>("internal error, please report it: piece 3".into()));
    }
}
