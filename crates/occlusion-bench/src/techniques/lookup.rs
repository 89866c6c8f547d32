//! Leaves by their place: an array over the finest cells, or a hash table of all cells.

use super::build::{Cell, MAX_DEPTH};
use super::switches::Lookup;

/// A leaf and its level.
pub(super) type Found = (u32, u32);

/// The tables of the lookups that need one.
#[derive(Clone, Debug, Default)]
pub(super) struct Tables {
    depth: u32,
    /// By place at the finest level: the cell, and its level in the upper bits.
    array: Vec<u32>,
    /// Open addressing; key 0 is free.
    slots: Vec<Slot>,
}

#[derive(Clone, Copy, Debug, Default)]
struct Slot {
    key: u32,
    cell: u32,
}

/// Bits of a cell's number in the array.
const CELL_BITS: u32 = 28;

impl Tables {
    pub(super) fn new(lookup: Lookup, cells: &[Cell], depth: u32) -> Self {
        let mut tables = Self { depth, ..Self::default() };
        match lookup {
            Lookup::Ancestor | Lookup::Root => {}
            Lookup::Array => {
                tables.array = vec![0; 1 << (3 * depth)];
                visit(cells, &mut |cell, level, at| tables.paint(cells, cell, level, at));
            }
            Lookup::Hash => {
                tables.slots = vec![Slot::default(); (2 * cells.len()).next_power_of_two()];
                visit(cells, &mut |cell, level, at| tables.insert(cell, level, at));
            }
        }
        tables
    }

    /// Enters a leaf into the array, at every finest cell it covers.
    fn paint(&mut self, cells: &[Cell], cell: u32, level: u32, at: [u32; 3]) {
        if cells[cell as usize].children != 0 {
            return;
        }
        let up = self.depth - level;
        for k in 0..1 << up {
            for j in 0..1 << up {
                for i in 0..1 << up {
                    let [x, y, z] = at.map(|a| a << up);
                    let index = self.index([x + i, y + j, z + k]);
                    self.array[index] = cell | level << CELL_BITS;
                }
            }
        }
    }

    #[inline(always)]
    fn index(&self, at: [u32; 3]) -> usize {
        ((at[2] << self.depth | at[1]) << self.depth | at[0]) as usize
    }

    #[inline(always)]
    pub(super) fn in_array(&self, at: [u32; 3]) -> Found {
        let entry = self.array[self.index(at)];
        (entry & ((1 << CELL_BITS) - 1), entry >> CELL_BITS)
    }

    fn insert(&mut self, cell: u32, level: u32, at: [u32; 3]) {
        let key = key(level, at);
        let mut slot = self.first_slot(key);
        while self.slots[slot].key != 0 {
            slot = (slot + 1) & (self.slots.len() - 1);
        }
        self.slots[slot] = Slot { key, cell };
    }

    #[inline(always)]
    fn first_slot(&self, key: u32) -> usize {
        // Knuth's multiplicative hash; at least two slots.
        (key.wrapping_mul(0x9e37_79b1) >> ((self.slots.len() as u32).leading_zeros() + 1)) as usize
    }

    #[inline(always)]
    fn get(&self, key: u32) -> Option<u32> {
        let mut slot = self.first_slot(key);
        loop {
            let Slot { key: found, cell } = self.slots[slot];
            if found == key {
                return Some(cell);
            }
            if found == 0 {
                return None;
            }
            slot = (slot + 1) & (self.slots.len() - 1);
        }
    }

    /// Finds the deepest cell that exists by halving the levels, from that of the last leaf.
    #[inline(always)]
    pub(super) fn in_hash(&self, cells: &[Cell], at: [u32; 3], guess: u32) -> Found {
        let (mut least, mut most) = (0, self.depth);
        let mut level = guess;
        loop {
            let up = self.depth - level;
            match self.get(key(level, at.map(|a| a >> up))) {
                Some(cell) if cells[cell as usize].children == 0 => return (cell, level),
                Some(_) => least = level + 1,
                None => most = level - 1,
            }
            level = (least + most) / 2;
        }
    }
}

/// A cell's level and place as one number, not 0: a one in front of the places' bits.
#[inline(always)]
fn key(level: u32, at: [u32; 3]) -> u32 {
    const { assert!(3 * MAX_DEPTH < 32, "a key has 32 bits") };
    ((1 << level | at[2]) << level | at[1]) << level | at[0]
}

/// Shows every cell with its level and place at that level.
fn visit(cells: &[Cell], show: &mut impl FnMut(u32, u32, [u32; 3])) {
    let mut waiting = vec![(0_u32, 0_u32, [0_u32; 3])];
    while let Some((cell, level, at)) = waiting.pop() {
        show(cell, level, at);
        let children = cells[cell as usize].children;
        for child in 0..if children == 0 { 0 } else { 8 } {
            let bit = |axis: usize| at[axis] << 1 | child >> axis & 1;
            waiting.push((children + child, level + 1, [bit(0), bit(1), bit(2)]));
        }
    }
}
