//! Round numbers along an axis.

/// About `count` multiples of 1, 2 or 5 times a power of ten within [low, high], and how many decimals they have. None in an empty range.
pub(super) fn ticks(low: f64, high: f64, count: usize) -> (Vec<f64>, usize) {
    let range = high - low;
    if !(range.is_finite() && range > 0.0) {
        return (Vec::new(), 0);
    }
    let raw = range / count as f64;
    let exponent = raw.log10().floor();
    let power = 10f64.powf(exponent);
    let step = [1.0, 2.0, 5.0, 10.0]
        .into_iter()
        .map(|m| m * power)
        .find(|step| *step >= raw);
    let step = step.unwrap_or(10.0 * power);
    let decimals = if step >= 1.0 {
        0
    } else {
        (-step.log10().floor()) as usize
    };
    let first = (low / step).ceil() as i64;
    let last = (high / step).floor() as i64;
    // A range tiny beside its place leaves no room for numbers that differ.
    if last.saturating_sub(first) > 100 {
        return (Vec::new(), 0);
    }
    ((first..=last).map(|i| i as f64 * step).collect(), decimals)
}

#[cfg(test)]
mod tests {
    use super::ticks;

    #[test]
    fn ticks_are_round_and_inside() {
        assert_eq!(ticks(-0.1, 10.3, 5), (vec![0.0, 5.0, 10.0], 0));
        assert_eq!(
            ticks(0.0, 1.0, 5),
            (vec![0.0, 0.2, 0.4, 0.6000000000000001, 0.8, 1.0], 1)
        );
        assert_eq!(ticks(2.0, 2.0, 5), (vec![], 0));
        assert_eq!(ticks(f64::NAN, 1.0, 5), (vec![], 0));
        assert!(ticks(1e17, 1e17 + 64.0, 5).0.len() <= 101);
    }
}
