//! Rows of particles shared out among threads.

/// Rows that one task takes at least.
pub(super) const LEAST_ROWS: usize = 8;

/// Rows that one task takes: all of them where the body has fewer places than `small`.
pub(super) fn rows_at_once(rows: usize, stride: usize, small: usize) -> usize {
    match rows * stride < small {
        true => rows,
        false => rows
            .div_ceil(4 * rayon::current_num_threads())
            .max(LEAST_ROWS),
    }
}
