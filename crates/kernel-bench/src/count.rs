//! The one function through which every kernel runs, so that a profiler can be told what counts.

use std::hint::black_box;

/// Calls a kernel, once. Callgrind counts while it is inside: `--toggle-collect='*measured_kernel*'`.
///
/// It takes a reference to a trait object, so that it is compiled once, under one name, and no
/// compiler can foresee what it calls. Its name is its own: where callgrind meets another that
/// fits, it stops counting, or starts.
#[inline(never)]
fn measured_kernel(kernel: &mut dyn FnMut()) {
    kernel();
}

/// Runs a kernel where it counts. What it gives is dropped by the caller, where it does not; what
/// it borrows is made by the caller, too.
pub(crate) fn count<T>(kernel: impl FnOnce() -> T) -> T {
    let (mut kernel, mut given) = (Some(kernel), None);
    measured_kernel(black_box(&mut || given = kernel.take().map(|kernel| black_box(kernel()))));
    given.expect("`measured_kernel` calls it")
}

#[cfg(test)]
mod tests {
    #[test]
    fn a_kernel_runs_once_and_gives_what_it_makes() {
        let mut runs = 0;
        let given = super::count(|| {
            runs += 1;
            vec![7; 3]
        });
        assert_eq!((runs, given), (1, vec![7; 3]));
    }
}
