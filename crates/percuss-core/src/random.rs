//! Random bits that are pure functions of a stream and an index: no state, so that any of them can be drawn at any time.

/// The finaliser of the generator SplitMix64 (Steele, Lea and Flood 2014): every bit of the result depends on every bit of `z`.
pub fn mix(z: u64) -> u64 {
    let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// Bits drawn for an index of a stream.
pub fn bits(stream: u64, index: u64) -> u64 {
    mix(stream ^ mix(index.wrapping_add(0x9e37_79b9_7f4a_7c15)))
}

/// Number from 0 to below 1 drawn for an index of a stream.
pub fn unit(stream: u64, index: u64) -> f64 {
    const BITS: u32 = 53;
    (bits(stream, index) >> (u64::BITS - BITS)) as f64 / (1_u64 << BITS) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_fill_the_unit_interval_evenly() {
        let count = 100_000;
        let numbers = (0..count).map(|index| unit(7, index));
        let (mut sum, mut squares) = (0.0, 0.0);
        for number in numbers {
            assert!((0.0..1.0).contains(&number));
            sum += number;
            squares += number * number;
        }
        let mean = sum / count as f64;
        let variance = squares / count as f64 - mean * mean;
        assert!((mean - 0.5).abs() < 3e-3, "{mean}");
        assert!((variance - 1.0 / 12.0).abs() < 1e-3, "{variance}");
    }
}
