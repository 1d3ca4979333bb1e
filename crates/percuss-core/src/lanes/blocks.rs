//! A list in blocks of eight: what a step does with all of it works on a block at a time.

use std::ops::Range;

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::{LANES, LaneFlags, PerLane};

/// A list of structs of one run, each in a lane of a block `B` of eight. Lanes beyond the last one repeat it.
#[derive(Debug, Clone)]
pub struct Blocks<B> {
    blocks: Vec<B>,
    count: usize,
}

impl<B> Default for Blocks<B> {
    fn default() -> Self {
        Self {
            blocks: Vec::new(),
            count: 0,
        }
    }
}

impl<B> Blocks<B> {
    /// Structs in it.
    pub fn len(&self) -> usize {
        self.count
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// The blocks.
    pub fn blocks(&self) -> &[B] {
        &self.blocks
    }

    /// The blocks, to be changed.
    pub fn blocks_mut(&mut self) -> &mut [B] {
        &mut self.blocks
    }

    /// Something of one, of what its block has of eight.
    #[inline(always)]
    pub fn part<T: PerLane>(&self, i: usize, of: impl Fn(&B) -> &T) -> T::One {
        of(&self.blocks[i / LANES]).lane(i % LANES)
    }
}

impl<B: PerLane> Blocks<B> {
    /// A copy of one.
    #[inline(always)]
    pub fn get(&self, i: usize) -> B::One {
        self.blocks[i / LANES].lane(i % LANES)
    }

    /// Puts another one in its place.
    #[inline(always)]
    pub fn set(&mut self, i: usize, one: B::One) {
        self.blocks[i / LANES].set_lane(i % LANES, one);
    }

    /// Changes one.
    #[inline(always)]
    pub fn change<T>(&mut self, i: usize, change: impl FnOnce(&mut B::One) -> T) -> T {
        let mut one = self.get(i);
        let given = change(&mut one);
        self.set(i, one);
        given
    }

    /// Copies of some, in their order.
    pub fn iter(&self, range: Range<usize>) -> impl DoubleEndedIterator<Item = B::One> + '_ {
        range.map(|i| self.get(i))
    }
}

impl<B: PerLane + Default> Blocks<B>
where
    B::One: Copy,
{
    /// Puts one behind the last one.
    pub fn push(&mut self, one: B::One) {
        if self.count.is_multiple_of(LANES) {
            self.blocks.push(B::default());
        }
        for i in self.count..self.blocks.len() * LANES {
            self.set(i, one);
        }
        self.count += 1;
    }
}

impl<B: PerLane + Default> FromIterator<B::One> for Blocks<B>
where
    B::One: Copy,
{
    fn from_iter<I: IntoIterator<Item = B::One>>(all: I) -> Self {
        let mut blocks = Self::default();
        all.into_iter().for_each(|one| blocks.push(one));
        blocks
    }
}

impl<B: PerLane> Serialize for Blocks<B>
where
    B::One: Serialize,
{
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.iter(0..self.count))
    }
}

impl<'de, B: PerLane + Default> Deserialize<'de> for Blocks<B>
where
    B::One: Copy + Deserialize<'de>,
{
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let all = Vec::<B::One>::deserialize(deserializer)?;
        Ok(all.into_iter().collect())
    }
}

/// Blocks that have something of a range, and which of their lanes do.
#[inline(always)]
pub fn blocks_of(range: Range<usize>) -> impl Iterator<Item = (usize, LaneFlags)> {
    let last = if range.is_empty() {
        0
    } else {
        range.end.div_ceil(LANES)
    };
    let blocks = range.start / LANES..last;
    blocks.map(move |block| {
        let mut own = [false; LANES];
        for (l, own) in own.iter_mut().enumerate() {
            let i = block * LANES + l;
            *own = (range.start <= i) & (i < range.end);
        }
        (block, LaneFlags(own))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::Lanes;

    #[test]
    fn a_list_in_blocks_is_a_list() {
        let mut blocks: Blocks<Lanes> = (0..19).map(f64::from).collect();
        assert_eq!((blocks.len(), blocks.blocks().len()), (19, 3));
        blocks.change(9, |number| *number += 0.5);
        blocks.push(19.0);
        let found: Vec<f64> = blocks.iter(7..20).rev().collect();
        assert_eq!(found[..2], [19.0, 18.0]);
        assert_eq!(found[9..], [10.0, 9.5, 8.0, 7.0]);
        assert_eq!(
            blocks.blocks()[2].0,
            [16.0, 17.0, 18.0, 19.0, 19.0, 19.0, 19.0, 19.0]
        );
        let text = serde_json::to_string(&blocks).unwrap();
        let read: Blocks<Lanes> = serde_json::from_str(&text).unwrap();
        assert_eq!(read.blocks(), blocks.blocks());
    }

    #[test]
    fn a_range_has_its_own_lanes() {
        let found: Vec<_> = blocks_of(6..17).collect();
        assert_eq!(found.len(), 3);
        let lanes = |own: &LaneFlags| own.0.map(u8::from);
        assert_eq!(lanes(&found[0].1), [0, 0, 0, 0, 0, 0, 1, 1]);
        assert_eq!(lanes(&found[1].1), [1; 8]);
        assert_eq!(lanes(&found[2].1), [1, 0, 0, 0, 0, 0, 0, 0]);
        assert_eq!(blocks_of(9..9).count(), 0);
    }
}
