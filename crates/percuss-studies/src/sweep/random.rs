//! Random numbers that are pure functions of a seed and an index: no state, so that any run can be made at any time.

pub(crate) use percuss_core::random::bits;
use percuss_core::random::mix;

/// A stream of its own for every purpose and dimension.
pub(crate) fn stream(seed: u64, purpose: u64, dimension: usize) -> u64 {
    bits(bits(seed, purpose), dimension as u64)
}

/// Rounds of the Feistel network below.
const ROUNDS: u64 = 6;

/// Where an index comes to stand in a random order of `0..count`.
///
/// A Feistel network permutes the numbers of an even count of bits that holds `count`; it is applied until the result is one
/// of the numbers wanted ("cycle walking"), so that no table of the order is kept.
pub(crate) fn permuted(stream: u64, index: u64, count: u64) -> u64 {
    let half = (64 - count.saturating_sub(1).leading_zeros())
        .div_ceil(2)
        .max(1);
    let mask = (1_u64 << half) - 1;
    let mut at = index;
    loop {
        let (mut left, mut right) = (at >> half, at & mask);
        for round in 0..ROUNDS {
            let next = left ^ (bits(stream ^ mix(round), right) & mask);
            left = right;
            right = next;
        }
        at = (left << half) | right;
        if at < count {
            return at;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_permutation_has_every_number_once() {
        for count in [1, 2, 3, 7, 8, 100, 1023, 1025] {
            let mut seen: Vec<u64> = (0..count).map(|i| permuted(5, i, count)).collect();
            seen.sort_unstable();
            assert_eq!(seen, (0..count).collect::<Vec<_>>(), "{count}");
        }
        let order = |stream| {
            (0..100)
                .map(|i| permuted(stream, i, 100))
                .collect::<Vec<_>>()
        };
        assert_ne!(order(1), order(2));
        assert_ne!(order(1), (0..100).collect::<Vec<_>>());
    }

    #[test]
    fn bits_are_even_and_streams_do_not_follow_each_other() {
        let count = 100_000;
        let mut ones = [0_i64; 64];
        let mut equal = 0_i64;
        for i in 0..count {
            let (a, b) = (bits(stream(1, 0, 0), i), bits(stream(1, 0, 1), i));
            for (bit, ones) in ones.iter_mut().enumerate() {
                *ones += i64::from((a >> bit) & 1 == 1);
            }
            equal += i64::from((a ^ b).count_zeros());
        }
        // Five standard deviations of a fair coin.
        let far = |found: i64, tosses: i64| {
            (found - tosses / 2).abs() as f64 > 2.5 * (tosses as f64).sqrt()
        };
        assert!(
            ones.iter().all(|ones| !far(*ones, count as i64)),
            "{ones:?}"
        );
        assert!(!far(equal, 64 * count as i64), "{equal}");
    }
}
