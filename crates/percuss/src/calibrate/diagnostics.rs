//! Whether a sample can be relied on: the split R-hat and the effective sample size.

/// Split R-hat of Gelman and others: between-chain and within-chain variance of the halves of all chains \[gelman1992, vehtari2021\].
///
/// Near 1 where all halves have the same distribution; not a number for chains of fewer than four states, infinite for chains that
/// stand still at different values.
pub fn split_r_hat(chains: &[Vec<f64>]) -> f64 {
    let halves: Vec<&[f64]> = chains
        .iter()
        .flat_map(|chain| {
            let half = chain.len() / 2;
            // The middle state of an odd number of them belongs to neither half.
            [&chain[..half], &chain[chain.len() - half..]]
        })
        .collect();
    let Some(spread) = Spread::of(&halves) else {
        return f64::NAN;
    };
    match (spread.within == 0.0, spread.between == 0.0) {
        (true, true) => 1.0,
        _ => (spread.pooled() / spread.within).sqrt(),
    }
}

/// Effective sample size of chains of equal length: their states over the integrated autocorrelation time.
///
/// Autocorrelations of all chains together, of which Geyer's initial monotone sequence is summed \[vehtari2021, geyer1992\]. Not a
/// number for chains of fewer than four states; 0 for chains that stand still.
pub fn effective_sample_size(chains: &[Vec<f64>]) -> f64 {
    let slices: Vec<&[f64]> = chains.iter().map(Vec::as_slice).collect();
    let Some(spread) = Spread::of(&slices) else {
        return f64::NAN;
    };
    let pooled = spread.pooled();
    if pooled == 0.0 {
        return 0.0;
    }
    let length = chains[0].len();
    let means: Vec<f64> = slices.iter().map(|chain| mean(chain)).collect();
    let correlation = |lag: usize| {
        let covariance = |(chain, mean): (&&[f64], &f64)| {
            let products = chain[lag..].iter().zip(chain.iter());
            products.map(|(a, b)| (a - mean) * (b - mean)).sum::<f64>() / length as f64
        };
        let sum: f64 = slices.iter().zip(&means).map(covariance).sum();
        // Biased covariances, as the variance within a chain is unbiased: at lag 0 they have to agree.
        let scale = length as f64 / (length as f64 - 1.0);
        1.0 - (spread.within - scale * sum / slices.len() as f64) / pooled
    };
    // Sums of neighbours are positive and fall for a reversible chain; beyond the first that is not there is noise only.
    let mut time = -1.0;
    let mut smallest = f64::INFINITY;
    for pair in 0..length / 2 {
        let sum = correlation(2 * pair) + correlation(2 * pair + 1);
        if sum <= 0.0 {
            break;
        }
        smallest = sum.min(smallest);
        time += 2.0 * smallest;
    }
    let states = (chains.len() * length) as f64;
    // Of chains that alternate the sum may be tiny; more than this would not be believed.
    states / time.max(1.0 / states.log10())
}

/// Mean of values.
pub(super) fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Unbiased variance of values.
pub(super) fn variance(values: &[f64]) -> f64 {
    let centre = mean(values);
    let squares: f64 = values.iter().map(|value| (value - centre).powi(2)).sum();
    squares / (values.len() as f64 - 1.0)
}

/// Variances of chains.
struct Spread {
    /// Mean of the variances of the chains.
    within: f64,
    /// Variance of their means.
    between: f64,
    length: f64,
}

impl Spread {
    fn of(chains: &[&[f64]]) -> Option<Self> {
        let length = chains.first()?.len();
        if length < 2 || chains.iter().any(|chain| chain.len() != length) {
            return None;
        }
        let variances: Vec<f64> = chains.iter().map(|chain| variance(chain)).collect();
        let means: Vec<f64> = chains.iter().map(|chain| mean(chain)).collect();
        let between = match means.len() {
            1 => 0.0,
            _ => variance(&means),
        };
        Some(Self {
            within: mean(&variances),
            between,
            length: length as f64,
        })
    }

    /// Variance that all chains together point to.
    fn pooled(&self) -> f64 {
        self.within * (self.length - 1.0) / self.length + self.between
    }
}

#[cfg(test)]
mod tests {
    use rand_distr::{Distribution, StandardNormal};
    use rand_pcg::{Pcg64, rand_core::SeedableRng};

    use super::*;

    /// Chains of `x' = φ x + √(1 − φ²) e`, with the standard normal distribution throughout.
    fn autoregressive(phi: f64, chains: u64, length: usize) -> Vec<Vec<f64>> {
        let chain = |seed| {
            let mut random = Pcg64::seed_from_u64(seed);
            let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
            let mut x = normal();
            (0..length)
                .map(|_| {
                    x = phi * x + (1.0 - phi * phi).sqrt() * normal();
                    x
                })
                .collect()
        };
        (0..chains).map(chain).collect()
    }

    /// By hand: the halves 1 2, 3 4, 2 3, 5 6 have variances 1/2 and means 1.5, 3.5, 2.5, 5.5, whose variance is 8.75/3.
    #[test]
    fn r_hat_of_a_few_numbers_is_the_one_by_hand() {
        let chains = [vec![1.0, 2.0, 3.0, 4.0], vec![2.0, 3.0, 5.0, 6.0]];
        let exact: f64 = (0.5 * 0.5 + 8.75 / 3.0) / 0.5;
        assert!((split_r_hat(&chains) - exact.sqrt()).abs() < 1e-14);
    }

    #[test]
    fn r_hat_tells_one_distribution_from_two() {
        let mut chains = autoregressive(0.0, 4, 2000);
        let same = split_r_hat(&chains);
        assert!((same - 1.0).abs() < 2e-3, "{same}");
        // Means 0, 0, 3, 3 of halves with unit variance: R² = 1 + variance of the means, 9/4 · 8/7.
        for chain in &mut chains[2..] {
            chain.iter_mut().for_each(|x| *x += 3.0);
        }
        let exact = (1.0 + 9.0 / 4.0 * 8.0 / 7.0_f64).sqrt();
        assert!((split_r_hat(&chains) / exact - 1.0).abs() < 0.03);
        // A drift within the chains is seen by their halves: means ±0.75, variances 1 and that of an even spread over 1.5.
        let drift = |x: (usize, f64)| x.1 + 3.0 * x.0 as f64 / 2000.0;
        let drifting = autoregressive(0.0, 4, 2000)
            .into_iter()
            .map(|chain| chain.into_iter().enumerate().map(drift).collect());
        let exact = (1.0 + 0.75 * 0.75 * 8.0 / 7.0 / (1.0 + 1.5 * 1.5 / 12.0_f64)).sqrt();
        let found = split_r_hat(&drifting.collect::<Vec<_>>());
        assert!((found / exact - 1.0).abs() < 0.03, "{found} {exact}");
    }

    #[test]
    fn chains_that_stand_still_have_no_sample() {
        assert_eq!(split_r_hat(&[vec![1.0; 8], vec![1.0; 8]]), 1.0);
        assert_eq!(split_r_hat(&[vec![1.0; 8], vec![2.0; 8]]), f64::INFINITY);
        assert_eq!(effective_sample_size(&[vec![1.0; 8]]), 0.0);
        assert!(split_r_hat(&[vec![1.0]]).is_nan());
    }

    /// An autoregressive process has the integrated autocorrelation time (1 + φ)/(1 − φ).
    #[test]
    fn sample_size_of_an_autoregressive_process_is_the_analytic_one() {
        for (phi, allowed) in [(-0.5, 0.1), (0.0, 0.1), (0.5, 0.1), (0.9, 0.15)] {
            let chains = autoregressive(phi, 4, 40_000);
            let exact = 160_000.0 * (1.0 - phi) / (1.0 + phi);
            let found = effective_sample_size(&chains);
            assert!(
                (found / exact - 1.0).abs() < allowed,
                "{phi}: {found} {exact}"
            );
        }
    }
}
