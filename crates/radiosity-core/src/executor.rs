//! How to run a loop: the only parallel seam.

/// Runs the same function over independent items.
///
/// An implementation may call `f` in any order and on any thread, once per item. Each item
/// owns all that `f` may write, so every executor gives the same bits.
pub trait Executor: Sync {
    /// Calls `f` once for each item.
    fn for_each<T: Send, F: Fn(&mut T) + Sync>(&self, items: &mut [T], f: F);

    /// How many threads take part.
    fn threads(&self) -> usize {
        1
    }
}

/// One item after the other, on the caller's thread.
#[derive(Clone, Copy, Debug, Default)]
pub struct Sequential;

impl Executor for Sequential {
    fn for_each<T: Send, F: Fn(&mut T) + Sync>(&self, items: &mut [T], f: F) {
        items.iter_mut().for_each(f);
    }
}
