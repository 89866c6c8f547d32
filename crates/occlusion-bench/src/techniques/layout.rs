//! In what order families of cells lie in memory.

use super::switches::Layout;

/// The inner cells of a tree: for each, its inner children in order. The root is the first.
pub(super) type Inner = Vec<Vec<usize>>;

/// The inner cells, in the order in which their children are to lie.
pub(super) fn order(inner: &Inner, layout: Layout) -> Vec<usize> {
    let mut order = Vec::with_capacity(inner.len());
    if inner.is_empty() {
        return order;
    }
    match layout {
        Layout::BreadthFirst => {
            order.push(0);
            let mut next = 0;
            while next < order.len() {
                let cell = order[next];
                order.extend(&inner[cell]);
                next += 1;
            }
        }
        Layout::DepthFirst => depth_first(inner, 0, 0, &mut order),
        Layout::InOrder => depth_first(inner, 0, 4, &mut order),
        Layout::VanEmdeBoas => van_emde_boas(inner, 0, height(inner, 0), &mut order),
    }
    order
}

/// `before` children come before their parent.
fn depth_first(inner: &Inner, cell: usize, before: usize, order: &mut Vec<usize>) {
    let (first, last) = inner[cell].split_at(before.min(inner[cell].len()));
    for &child in first {
        depth_first(inner, child, before, order);
    }
    order.push(cell);
    for &child in last {
        depth_first(inner, child, before, order);
    }
}

fn height(inner: &Inner, cell: usize) -> usize {
    1 + inner[cell].iter().map(|&child| height(inner, child)).max().unwrap_or(0)
}

/// Lays out the first `height` levels below and with `cell`.
fn van_emde_boas(inner: &Inner, cell: usize, height: usize, order: &mut Vec<usize>) {
    if height == 1 {
        order.push(cell);
        return;
    }
    let top = height / 2;
    van_emde_boas(inner, cell, top, order);
    let mut roots = vec![cell];
    for _ in 0..top {
        roots = roots.iter().flat_map(|&root| inner[root].iter().copied()).collect();
    }
    for root in roots {
        van_emde_boas(inner, root, height - top, order);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A path of a cell with two children, of which the first has two and the second one.
    #[test]
    fn orders_written_by_hand() {
        let inner = vec![vec![1, 2], vec![3, 4], vec![5], vec![6], vec![], vec![], vec![]];
        assert_eq!(order(&inner, Layout::BreadthFirst), [0, 1, 2, 3, 4, 5, 6]);
        assert_eq!(order(&inner, Layout::DepthFirst), [0, 1, 3, 6, 4, 2, 5]);
        // Fewer than four children: all of them come first.
        assert_eq!(order(&inner, Layout::InOrder), [6, 3, 4, 1, 5, 2, 0]);
        // Four levels: the upper two, then each pair of lower ones.
        assert_eq!(order(&inner, Layout::VanEmdeBoas), [0, 1, 2, 3, 6, 4, 5]);
        for layout in [Layout::BreadthFirst, Layout::VanEmdeBoas] {
            assert!(order(&Vec::new(), layout).is_empty());
        }
    }
}
