//! Convergence of a sample: R-hat and effective sample sizes of ranks instead of values \[vehtari2021\].
//!
//! Chains are lists of equal length. Ranks do not care about heavy tails, nor about the scale a parameter is measured on.

use crate::{
    statistics::{mean, quantile, sorted, variance},
    sweep,
};

/// R-hat of chains \[vehtari2021\]: near 1 where they agree, more than 1.01 where more has to be sampled.
///
/// The larger of the split R-hat of the normal scores of the ranks, which finds chains at different places, and that of the distances
/// from the median, which finds chains that spread differently. Not a number for chains of fewer than four states, infinite for
/// chains that stand still at different values.
pub fn r_hat(chains: &[Vec<f64>]) -> f64 {
    let located = split_r_hat(&normal_scores(chains));
    if located.is_nan() {
        return located;
    }
    located.max(split_r_hat(&normal_scores(&folded(chains))))
}

/// Effective sample size for means and medians: that of the normal scores of the ranks \[vehtari2021\].
///
/// `together` neighbours of a chain belong to one step and depend on each other, such as the walkers of an ensemble; 1 for chains
/// of single states. Not a number for chains of fewer than four steps; 0 for chains that stand still.
pub fn bulk_effective_size(chains: &[Vec<f64>], together: usize) -> f64 {
    effective_size(&normal_scores(chains), together)
}

/// Effective sample size for the ends of intervals: the smaller of those of being below the 5 % and below the 95 % quantile
/// \[vehtari2021\]. The rest as for [`bulk_effective_size`].
pub fn tail_effective_size(chains: &[Vec<f64>], together: usize) -> f64 {
    let all = sorted(chains.concat());
    let of = |probability| {
        let end = quantile(&all, probability);
        let is_below = map(chains, |value| f64::from(u8::from(value <= end)));
        effective_size(&is_below, together)
    };
    match all.is_empty() {
        true => f64::NAN,
        false => of(0.05).min(of(0.95)),
    }
}

/// Normal quantiles of the ranks among the states of all chains, `(r − 3/8)/(S + 1/4)`; equal states share the mean of their ranks.
fn normal_scores(chains: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let mut places: Vec<(usize, usize)> = Vec::new();
    for (i, chain) in chains.iter().enumerate() {
        places.extend((0..chain.len()).map(|j| (i, j)));
    }
    places.sort_by(|a, b| chains[a.0][a.1].total_cmp(&chains[b.0][b.1]));
    let mut scores: Vec<Vec<f64>> = chains.iter().map(|chain| vec![0.0; chain.len()]).collect();
    let mut before = 0;
    for equal in places.chunk_by(|a, b| chains[a.0][a.1] == chains[b.0][b.1]) {
        let rank = before as f64 + 0.5 * (equal.len() + 1) as f64;
        let score = sweep::score((rank - 0.375) / (places.len() as f64 + 0.25));
        for &(i, j) in equal {
            scores[i][j] = score;
        }
        before += equal.len();
    }
    scores
}

/// Distances from the median of all chains.
fn folded(chains: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let median = quantile(&sorted(chains.concat()), 0.5);
    map(chains, |value| (value - median).abs())
}

fn map(chains: &[Vec<f64>], of: impl Fn(f64) -> f64) -> Vec<Vec<f64>> {
    let mapped = |chain: &Vec<f64>| chain.iter().map(|&value| of(value)).collect();
    chains.iter().map(mapped).collect()
}

/// First and second halves of all chains. The middle state of an odd number of them belongs to neither.
fn halves(chains: &[Vec<f64>]) -> Vec<&[f64]> {
    let of = |chain: &'_ Vec<f64>| chain.len() / 2;
    chains
        .iter()
        .flat_map(|chain| [&chain[..of(chain)], &chain[chain.len() - of(chain)..]])
        .collect()
}

/// Between-chain and within-chain variance of the halves of all chains \[gelman1992\].
fn split_r_hat(chains: &[Vec<f64>]) -> f64 {
    let Some(spread) = Spread::of(&halves(chains)) else {
        return f64::NAN;
    };
    match (spread.within == 0.0, spread.between == 0.0) {
        (true, true) => 1.0,
        _ => (spread.pooled() / spread.within).sqrt(),
    }
}

/// Effective size of the series of the means of what belongs together, times how much less they vary than a single value
/// \[goodman2010\].
fn effective_size(chains: &[Vec<f64>], together: usize) -> f64 {
    let means = |chain: &Vec<f64>| chain.chunks(together).map(mean).collect();
    let series: Vec<Vec<f64>> = chains.iter().map(means).collect();
    let size = series_size(&halves(&series));
    match together == 1 || size == 0.0 {
        true => size,
        false => size * variance(&chains.concat()) / variance(&series.concat()),
    }
}

/// Effective size of series of equal length: their states over the integrated autocorrelation time, by autocorrelations of all
/// series together, of which Geyer's initial monotone sequence is summed \[vehtari2021, geyer1992\].
fn series_size(series: &[&[f64]]) -> f64 {
    let Some(spread) = Spread::of(series) else {
        return f64::NAN;
    };
    let pooled = spread.pooled();
    if pooled == 0.0 {
        return 0.0;
    }
    let length = series[0].len();
    let means: Vec<f64> = series.iter().map(|states| mean(states)).collect();
    let correlation = |lag: usize| {
        let covariance = |(states, mean): (&&[f64], &f64)| {
            let products = states[lag..].iter().zip(states.iter());
            products.map(|(a, b)| (a - mean) * (b - mean)).sum::<f64>() / length as f64
        };
        let sum: f64 = series.iter().zip(&means).map(covariance).sum();
        // Biased covariances, as the variance within a chain is unbiased: at lag 0 they have to agree.
        let scale = length as f64 / (length as f64 - 1.0);
        1.0 - (spread.within - scale * sum / series.len() as f64) / pooled
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
    let states = (series.len() * length) as f64;
    // Of chains that alternate the sum may be tiny; more than this would not be believed.
    states / time.max(1.0 / states.log10())
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
#[path = "diagnostics_tests.rs"]
mod tests;
