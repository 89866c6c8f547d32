//! Kernels under callgrind: each in a process of its own, as many at once as there are cores.

use std::path::Path;
use std::process::Command;
use std::sync::Mutex;
use std::thread;

use super::baseline::Counted;

/// The function that counts, by a name that no other has.
const COUNTS: &str = "--toggle-collect=*measured_kernel*";

/// Features of the processor that glibc chooses its functions by. Without them it takes those that
/// every x86-64 processor has, so that copies, comparisons and arc tangents take the same
/// instructions everywhere. It also keeps `rep stosb` out, which callgrind counts once a byte.
/// The names with `_Usable` are those of glibc before 2.33; unknown ones are passed over, and other
/// processors and libraries have no such choice to make.
const WITHOUT: [&str; 16] = [
    "AVX2",
    "AVX2_Usable",
    "AVX",
    "AVX_Usable",
    "AVX_Fast_Unaligned_Load",
    "FMA",
    "FMA_Usable",
    "FMA4",
    "FMA4_Usable",
    "BMI2",
    "ERMS",
    "FSRM",
    "SSSE3",
    "SSE4_1",
    "SSE4_2",
    "Fast_Unaligned_Copy",
];

/// Counts the instructions of each kernel.
///
/// # Errors
/// Names the first kernel that fails, with what it said.
pub(super) fn count(program: &Path, kernels: &[String]) -> Result<Vec<Counted>, String> {
    let cores = thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let waiting = Mutex::new(kernels.iter().enumerate());
    let counts = thread::scope(|scope| {
        let work = || {
            let mut done = Vec::new();
            // The lock is given back before the kernel runs.
            let next = || waiting.lock().expect("no thread panics while it holds it").next();
            while let Some((place, kernel)) = next() {
                done.push((place, instructions(program, kernel)));
            }
            done
        };
        let threads: Vec<_> = (0..cores).map(|_| scope.spawn(work)).collect();
        let mut all: Vec<_> = threads
            .into_iter()
            .flat_map(|thread| thread.join().expect("counting returns its errors"))
            .collect();
        all.sort_by_key(|(place, _)| *place);
        all
    });
    let counted = kernels.iter().zip(counts).map(|(name, (_, instructions))| {
        Ok(Counted { name: name.clone(), instructions: instructions? })
    });
    counted.collect()
}

/// Runs one kernel under callgrind.
fn instructions(program: &Path, kernel: &str) -> Result<u64, String> {
    let mut command = Command::new("valgrind");
    // No options from the user's own file or environment.
    command.args(["--command-line-only=yes", "--tool=callgrind"]);
    command.args(["--callgrind-out-file=/dev/null", COUNTS]);
    command.arg(program).arg(kernel).env("GLIBC_TUNABLES", tunables());
    let output = command.output().map_err(|e| format!("valgrind: {e}"))?;
    let said = String::from_utf8_lossy(&output.stderr);
    if !output.status.success() {
        return Err(format!("{kernel}: {}: {}", output.status, said.trim_end()));
    }
    match collected(&said) {
        Some(0) => Err(format!("{kernel}: nothing was counted: is `measured_kernel` inlined?")),
        Some(count) => Ok(count),
        None => Err(format!("{kernel}: valgrind states no count, but: {}", said.trim_end())),
    }
}

fn tunables() -> String {
    let without: Vec<_> = WITHOUT.iter().map(|feature| format!("-{feature}")).collect();
    format!("glibc.cpu.hwcaps={}", without.join(","))
}

/// The number after `Collected :`.
fn collected(said: &str) -> Option<u64> {
    let (_, rest) = said.split_once("Collected :")?;
    rest.split_whitespace().next()?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_count_is_found_among_what_valgrind_says() {
        let said = "\
==7== Callgrind, a call-graph generating cache profiler
==7== Command: target/release/kernels tri-io/parse
==7==
==7== Events    : Ir
==7== Collected : 4758268
==7==
==7== I   refs:      4,758,268
";
        assert_eq!(collected(said), Some(4_758_268));
        assert_eq!(collected("==7== Collected : many"), None);
        assert_eq!(collected("valgrind: no such program"), None);
    }

    #[test]
    fn features_are_taken_away_by_name() {
        let text = tunables();
        assert!(text.starts_with("glibc.cpu.hwcaps=-AVX2,-AVX2_Usable,") && !text.contains(' '));
    }
}
