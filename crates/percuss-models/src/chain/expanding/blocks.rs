//! Nodes, slices or springs in blocks of eight lanes.

use serde::{Serialize, de::DeserializeOwned};

use crate::{
    Error,
    lanes::{LANES, Lanes, PerLane, lanes, settled},
    solver::archive::Archive,
};

/// A row of structs in blocks of lanes. Lanes behind the last struct are inert, so that a loop over blocks needs no remainder.
#[derive(Debug)]
pub(super) struct Blocks<T: PerLane> {
    blocks: Vec<T>,
    count: usize,
    inert: T::One,
}

impl<T> Blocks<T>
where
    T: PerLane + Copy + Default,
    T::One: Copy,
{
    /// Of some structs, and what stands in lanes without one.
    pub(super) fn new(all: impl IntoIterator<Item = T::One>, inert: T::One) -> Self {
        let mut row = Self {
            blocks: Vec::new(),
            count: 0,
            inert,
        };
        for one in all {
            if row.count.is_multiple_of(LANES) {
                row.add_block();
            }
            row.set(row.count, one);
            row.count += 1;
        }
        row
    }

    fn add_block(&mut self) {
        let mut block = T::default();
        for lane in 0..LANES {
            block.set_lane(lane, self.inert);
        }
        self.blocks.push(block);
    }

    /// A row with the same inert struct and other ones.
    pub(super) fn like(&self, all: impl IntoIterator<Item = T::One>) -> Self {
        Self::new(all, self.inert)
    }

    /// Number of structs.
    pub(super) fn len(&self) -> usize {
        self.count
    }

    pub(super) fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// All blocks.
    #[inline(always)]
    pub(super) fn blocks(&self) -> &[T] {
        &self.blocks
    }

    /// The blocks one by one: a compiler sees no loop over numbers that are far from each other, and works on those of a block at once.
    #[inline(always)]
    pub(super) fn each(&self) -> impl Iterator<Item = &T> {
        self.blocks.iter().map(settled)
    }

    /// The same, to be changed.
    #[inline(always)]
    pub(super) fn each_mut(&mut self) -> impl Iterator<Item = &mut T> {
        self.blocks.iter_mut().map(settled)
    }

    #[inline(always)]
    pub(super) fn get(&self, i: usize) -> T::One {
        self.blocks[i / LANES].lane(i % LANES)
    }

    #[inline(always)]
    pub(super) fn set(&mut self, i: usize, one: T::One) {
        self.blocks[i / LANES].set_lane(i % LANES, one);
    }

    #[inline(always)]
    pub(super) fn first(&self) -> Option<T::One> {
        (self.count > 0).then(|| self.get(0))
    }

    #[inline(always)]
    pub(super) fn last(&self) -> Option<T::One> {
        (self.count > 0).then(|| self.get(self.count - 1))
    }

    /// Replaces the last struct, if there is one.
    #[inline(always)]
    pub(super) fn set_last(&mut self, one: T::One) {
        if self.count > 0 {
            self.set(self.count - 1, one);
        }
    }

    /// All structs in their order.
    pub(super) fn iter(&self) -> impl DoubleEndedIterator<Item = T::One> + ExactSizeIterator + '_ {
        (0..self.count).map(|i| self.get(i))
    }

    /// Changes all structs in their order.
    pub(super) fn change(&mut self, mut change: impl FnMut(usize, &mut T::One)) {
        for i in 0..self.count {
            let mut one = self.get(i);
            change(i, &mut one);
            self.set(i, one);
        }
    }

    /// Takes the last struct out.
    pub(super) fn pop(&mut self) -> Option<T::One> {
        let last = self.last()?;
        self.truncate(self.count - 1);
        Some(last)
    }

    /// Keeps the first structs only.
    pub(super) fn truncate(&mut self, count: usize) {
        for i in count..self.count {
            self.set(i, self.inert);
        }
        self.count = count.min(self.count);
        self.blocks.truncate(self.count.div_ceil(LANES));
    }

    /// Sum of a number over all structs, of which what is inert has 0.
    #[inline(always)]
    pub(super) fn sum(&self, number: impl Fn(&T) -> Lanes) -> f64 {
        // In memory: what a loop adds to would be taken apart into single numbers.
        let mut total = Lanes::all(0.0);
        let total = settled(&mut total);
        for block in self.each() {
            let (more, before) = (number(block), *total);
            *total = lanes(|l| before[l] + more[l]);
        }
        sum(total)
    }

    /// Writes or reads the structs.
    pub(super) fn archive(&mut self, archive: &mut Archive<'_>) -> Result<(), Error>
    where
        T::One: Serialize + DeserializeOwned,
    {
        let mut all: Vec<T::One> = self.iter().collect();
        archive.item(&mut all)?;
        if archive.is_read() {
            *self = self.like(all);
        }
        Ok(())
    }
}

/// 1 in the first so many lanes, 0 in the others.
#[inline(always)]
pub(super) fn first_lanes(count: usize) -> &'static Lanes {
    const TABLE: [Lanes; LANES + 1] = {
        let mut table = [Lanes::all(0.0); LANES + 1];
        let mut count = 1;
        while count <= LANES {
            let mut lane = 0;
            while lane < count {
                table[count].0[lane] = 1.0;
                lane += 1;
            }
            count += 1;
        }
        table
    };
    settled(&TABLE[count.min(LANES)])
}

/// Sum over the lanes, as a tree of fixed shape.
#[inline(always)]
pub(super) fn sum(numbers: &Lanes) -> f64 {
    let [a, b, c, d, e, f, g, h] = numbers.0;
    ((a + e) + (c + g)) + ((b + f) + (d + h))
}

/// Numbers of the structs one place ahead, where `next` is the first of the next block.
#[inline(always)]
pub(super) fn ahead(numbers: &Lanes, next: f64) -> Lanes {
    let mut shifted = [next; LANES];
    shifted[..LANES - 1].copy_from_slice(&numbers.0[1..]);
    Lanes(shifted)
}

/// Numbers of the structs one place behind, where `last` is the last of the block before.
#[inline(always)]
pub(super) fn behind(numbers: &Lanes, last: f64) -> Lanes {
    let mut shifted = [last; LANES];
    shifted[1..].copy_from_slice(&numbers.0[..LANES - 1]);
    Lanes(shifted)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_behind_the_last_number_is_inert() {
        for count in [0_u32, 1, 7, 8, 9, 23, 24] {
            let numbers: Vec<f64> = (0..count).map(f64::from).collect();
            let mut row: Blocks<Lanes> = Blocks::new(numbers.iter().copied(), -1.0);
            for left in (0..=count as usize).rev() {
                assert_eq!(row.iter().collect::<Vec<_>>(), numbers[..left]);
                let all: Vec<f64> = row.blocks().iter().flat_map(|block| block.0).collect();
                assert!(all.len() >= left && all.len() < left + LANES);
                assert!(all[left..].iter().all(|number| *number == -1.0));
                assert_eq!(row.pop(), left.checked_sub(1).map(|last| numbers[last]));
            }
        }
    }

    #[test]
    fn neighbours_are_those_across_blocks() {
        let row: Blocks<Lanes> = Blocks::new((0..24).map(f64::from), -1.0);
        let [first, middle, last] = [0, 1, 2].map(|b| row.blocks()[b]);
        for i in 0..LANES {
            let own = (LANES + i) as f64;
            assert_eq!(ahead(&middle, last[0])[i], own + 1.0);
            assert_eq!(behind(&middle, first[LANES - 1])[i], own - 1.0);
        }
    }
}
