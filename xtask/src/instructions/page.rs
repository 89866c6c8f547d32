//! The table of docs/performance/instructions.md.

use super::baseline::{Baseline, Counted};
use crate::precision::blocks::{self, table};
use crate::precision::numbers::grouped;

/// The block of the page that is written here.
const BLOCK: &str = "counts";

/// The page with its table renewed.
pub(super) fn renewed(page: &str, baseline: &Baseline) -> Result<String, String> {
    let Baseline { toolchain, kernels } = baseline;
    let head = format!(
        "{} for {}, {}, {}.",
        toolchain.rustc, toolchain.host, toolchain.valgrind, toolchain.libc
    );
    let row = |Counted { name, instructions }: &Counted| {
        vec![format!("`{name}`"), grouped(*instructions)]
    };
    let rows = table(&["kernel", "instructions"], kernels.iter().map(row));
    blocks::replace(page, BLOCK, &format!("{head}\n\n{rows}"))
}

#[cfg(test)]
mod tests {
    use super::super::baseline::sample;
    use super::*;

    #[test]
    fn the_table_has_the_toolchain_and_a_row_for_each_kernel() {
        let page = "# A\n<!-- begin: counts -->\n<!-- end: counts -->\n";
        let expected = "\
# A
<!-- begin: counts -->

rustc 1.95.0 (59807616e 2026-04-14) for x86_64-unknown-linux-gnu, valgrind-3.19.0, glibc 2.36.

| kernel | instructions |
|---|---|
| `a/one` | 1,234,567 |
| `a/two` | 1,000 |
| `b/three` | 20,000 |

<!-- end: counts -->
";
        assert_eq!(renewed(page, &sample()).unwrap(), expected);
        assert!(renewed("# A\n", &sample()).is_err());
    }
}
