//! Sobol' points, scrambled after Owen.
//!
//! Direction numbers: the set `new-joe-kuo-6` of Joe and Kuo (2008) [joe2008]. Nested uniform scrambling: Owen (1995)
//! [owen1995]; every bit is flipped or not by a hash of the bits before it.

use super::random::bits;

/// Most dimensions there are points for.
pub(crate) const MAX_DIMENSIONS: usize = 1 + POLYNOMIALS.len();
/// Bits of a Sobol' point before scrambling, which bounds the number of points.
const BITS: u32 = 32;
/// Bits of a coordinate after scrambling: with the half that is added it fits a 64-bit float exactly.
const FINE_BITS: u32 = 52;

/// A primitive polynomial over the field of two elements and the first direction numbers.
struct Polynomial {
    /// Its coefficients between the first and the last, as bits.
    inner: u32,
    /// As many as its degree.
    first: &'static [u32],
}

const fn polynomial(inner: u32, first: &'static [u32]) -> Polynomial {
    Polynomial { inner, first }
}

/// Dimensions 2 to 21; dimension 1 is the sequence of van der Corput.
const POLYNOMIALS: &[Polynomial] = &[
    polynomial(0, &[1]),
    polynomial(1, &[1, 3]),
    polynomial(1, &[1, 3, 1]),
    polynomial(2, &[1, 1, 1]),
    polynomial(1, &[1, 1, 3, 3]),
    polynomial(4, &[1, 3, 5, 13]),
    polynomial(2, &[1, 1, 5, 5, 17]),
    polynomial(4, &[1, 1, 5, 5, 5]),
    polynomial(7, &[1, 1, 7, 11, 19]),
    polynomial(11, &[1, 1, 5, 1, 1]),
    polynomial(13, &[1, 1, 1, 3, 11]),
    polynomial(14, &[1, 3, 5, 5, 31]),
    polynomial(1, &[1, 3, 3, 9, 7, 49]),
    polynomial(13, &[1, 1, 1, 15, 21, 21]),
    polynomial(16, &[1, 3, 1, 13, 27, 49]),
    polynomial(19, &[1, 1, 1, 15, 7, 5]),
    polynomial(22, &[1, 3, 1, 15, 13, 25]),
    polynomial(25, &[1, 1, 5, 5, 19, 61]),
    polynomial(1, &[1, 3, 7, 11, 23, 15, 103]),
    polynomial(4, &[1, 3, 7, 13, 13, 15, 69]),
];

/// Direction numbers of one dimension.
#[derive(Debug, Clone)]
pub(super) struct Directions([u32; BITS as usize]);

impl Directions {
    /// Those of a dimension, counted from 0.
    pub(super) fn of(dimension: usize) -> Self {
        let mut v = [0; BITS as usize];
        let Some(polynomial) = dimension.checked_sub(1).and_then(|i| POLYNOMIALS.get(i)) else {
            for (bit, v) in v.iter_mut().enumerate() {
                *v = 1 << (BITS as usize - 1 - bit);
            }
            return Self(v);
        };
        let degree = polynomial.first.len();
        for bit in 0..v.len() {
            v[bit] = match polynomial.first.get(bit) {
                Some(first) => first << (BITS as usize - 1 - bit),
                None => {
                    let before = v[bit - degree];
                    let inner = (1..degree)
                        .filter(|k| (polynomial.inner >> (degree - 1 - k)) & 1 == 1)
                        .fold(0, |sum, k| sum ^ v[bit - k]);
                    before ^ (before >> degree) ^ inner
                }
            };
        }
        Self(v)
    }

    /// The coordinate of a point as a binary fraction of 32 bits.
    fn fraction(&self, index: u32) -> u32 {
        let set = |bit: &usize| (index >> bit) & 1 == 1;
        (0..BITS as usize)
            .filter(set)
            .fold(0, |sum, bit| sum ^ self.0[bit])
    }

    /// The scrambled coordinate of a point, between 0 and 1 and never either.
    pub(super) fn scrambled(&self, index: u32, stream: u64) -> f64 {
        let plain = u64::from(self.fraction(index));
        let mut coarse = plain;
        for bit in 0..BITS {
            // The bits before this one, with their count.
            let prefix = (u64::from(bit) << 32) | (plain >> (BITS - bit));
            coarse ^= (bits(stream, prefix) & 1) << (BITS - 1 - bit);
        }
        let rest = FINE_BITS - BITS;
        let fine = bits(stream, (u64::from(BITS) << 32) | plain) >> (64 - rest);
        let number = (coarse << rest) | fine;
        (number as f64 + 0.5) / (1_u64 << FINE_BITS) as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sweep::random::stream;

    #[test]
    fn first_points_are_the_published_ones() {
        // Output of the authors' program for three dimensions, which goes through the points in Gray code.
        let published = [
            [0.0, 0.0, 0.0],
            [0.5, 0.5, 0.5],
            [0.75, 0.25, 0.25],
            [0.25, 0.75, 0.75],
            [0.375, 0.375, 0.625],
            [0.875, 0.875, 0.125],
            [0.625, 0.125, 0.875],
            [0.125, 0.625, 0.375],
            [0.1875, 0.3125, 0.9375],
            [0.6875, 0.8125, 0.4375],
        ];
        for (i, point) in published.iter().enumerate() {
            let gray = (i ^ (i >> 1)) as u32;
            for (dimension, coordinate) in point.iter().enumerate() {
                let found = f64::from(Directions::of(dimension).fraction(gray)) / 2_f64.powi(32);
                assert_eq!(found, *coordinate, "point {i}, dimension {dimension}");
            }
        }
    }

    #[test]
    fn polynomials_are_primitive() {
        for (i, polynomial) in POLYNOMIALS.iter().enumerate() {
            let degree = polynomial.first.len();
            let modulus = (1_u32 << degree) | (polynomial.inner << 1) | 1;
            let mut power = 1_u32;
            let mut order = 0;
            while order == 0 || power != 1 {
                power <<= 1;
                if power >> degree == 1 {
                    power ^= modulus;
                }
                order += 1;
            }
            assert_eq!(order, (1 << degree) - 1, "dimension {}", i + 2);
            let odd = |(j, m): (usize, &u32)| m % 2 == 1 && *m < 2 << j;
            assert!(polynomial.first.iter().enumerate().all(odd), "{}", i + 2);
        }
    }

    /// Sobol's property A: of the first 2^s points, one lies in each of the 2^s octants of s dimensions. That holds when the first
    /// bits of the direction numbers are linearly independent.
    #[test]
    fn property_a_holds_in_all_dimensions() {
        for s in 1..=MAX_DIMENSIONS {
            let mut rows: Vec<u32> = (0..s)
                .map(|dimension| {
                    let v = Directions::of(dimension).0;
                    (0..s).fold(0, |row, bit| row | ((v[bit] >> 31) << bit))
                })
                .collect();
            for column in 0..s {
                let pivot = (column..s).find(|row| (rows[*row] >> column) & 1 == 1);
                let pivot = pivot.unwrap_or_else(|| panic!("{s} dimensions are dependent"));
                rows.swap(column, pivot);
                for row in column + 1..s {
                    if (rows[row] >> column) & 1 == 1 {
                        rows[row] ^= rows[column];
                    }
                }
            }
        }
    }

    #[test]
    fn two_dimensions_are_a_net_after_scrambling() {
        for seed in [0, 1, 77] {
            let [a, b] = [0, 1].map(|d| (Directions::of(d), stream(seed, 0, d)));
            for m in 0..=10_u32 {
                // A block of points further on is a net as well.
                let first = 3 << m;
                for p in 0..=m {
                    let mut hit = vec![0; 1 << m];
                    for i in first..first + (1 << m) {
                        let x = a.0.scrambled(i, a.1) * f64::from(1 << p);
                        let y = b.0.scrambled(i, b.1) * f64::from(1 << (m - p));
                        hit[((x as usize) << (m - p)) + y as usize] += 1;
                    }
                    assert!(hit.iter().all(|hit| *hit == 1), "m {m}, p {p}: {hit:?}");
                }
            }
        }
    }

    #[test]
    fn every_margin_is_stratified_and_scrambling_is_random() {
        for dimension in 0..MAX_DIMENSIONS {
            let directions = Directions::of(dimension);
            let stream = stream(3, 0, dimension);
            let mut seen = vec![false; 1024];
            let mut sum = 0.0;
            for i in 0..1024 {
                let x = directions.scrambled(i, stream);
                assert!(x > 0.0 && x < 1.0);
                let stratum = (x * 1024.0) as usize;
                assert!(!std::mem::replace(&mut seen[stratum], true), "{dimension}");
                sum += x;
            }
            assert!((sum / 1024.0 - 0.5).abs() < 1.0 / 2048.0, "{dimension}");
            assert_ne!(directions.scrambled(1, 1), directions.scrambled(1, 2));
        }
    }

    /// Over many scramblings the mean of a product is exact, and its variance far below that of random points.
    #[test]
    fn scrambled_points_integrate_without_bias() {
        let seeds = 200;
        let count = 256;
        let mut means = Vec::new();
        for seed in 0..seeds {
            let dimensions: Vec<_> = (0..4)
                .map(|d| (Directions::of(d), stream(seed, 0, d)))
                .collect();
            let value = |i| {
                let factor = |(v, s): &(Directions, u64)| 2.0 * v.scrambled(i, *s);
                dimensions.iter().map(factor).product::<f64>()
            };
            means.push((0..count).map(value).sum::<f64>() / f64::from(count));
        }
        let mean = means.iter().sum::<f64>() / seeds as f64;
        let variance = means.iter().map(|m| (m - 1.0).powi(2)).sum::<f64>() / seeds as f64;
        // Random points: (4/3)^4 - 1 over the count.
        let random = ((4.0_f64 / 3.0).powi(4) - 1.0) / f64::from(count);
        assert!(variance < random / 50.0, "{variance} against {random}");
        assert!(
            (mean - 1.0).abs() < 4.0 * (variance / seeds as f64).sqrt(),
            "{mean}"
        );
    }
}
