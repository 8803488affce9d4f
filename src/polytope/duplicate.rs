//! Rows that are equal up to a positive factor.

use super::fixed::to_binary64;
use crate::number::Integer;

/// A row with its index.
pub(super) type Indexed<'a> = (usize, [&'a Integer; 4]);

/// Of each class of rows equal up to a positive factor, the one with the least index. No row is zero throughout.
pub(super) fn without_duplicates<'a>(rows: &[Indexed<'a>]) -> Vec<Indexed<'a>> {
    // Coefficients over the greatest magnitude, and a sum of them that is rarely the same for different rows. The quotients are off by less than
    // 2^-50, those of equal rows differ by less than 2^-49 and the sums by less than 2^-46.
    const FACTORS: [f64; 4] = [0.618_033_988_75, 0.754_877_666_25, 0.819_172_513_4, 0.856_674_883_85];
    const NEAR: f64 = 1.0 / (1_u64 << 49) as f64;
    const NEAR_KEY: f64 = 8.0 * NEAR;
    struct Keyed {
        key: f64,
        unit: [f64; 4],
        row: usize,
    }
    let mut keyed: Vec<Keyed> = rows
        .iter()
        .enumerate()
        .map(|(row, (_, coefficients))| {
            let rounded = to_binary64(*coefficients);
            let greatest = rounded.iter().fold(0.0_f64, |greatest, x| greatest.max(x.abs()));
            let unit = rounded.map(|x| x / greatest);
            let key = (0..4).map(|i| FACTORS[i] * unit[i]).sum();
            Keyed { key, unit, row }
        })
        .collect();
    keyed.sort_unstable_by(|a, b| a.key.total_cmp(&b.key));
    let mut kept: Vec<bool> = vec![true; keyed.len()];
    let mut found = Vec::with_capacity(rows.len());
    for i in 0..keyed.len() {
        if !kept[i] {
            continue;
        }
        let mut first = rows[keyed[i].row];
        for j in i + 1..keyed.len() {
            if keyed[j].key - keyed[i].key > NEAR_KEY {
                break;
            }
            let near = (0..4).all(|k| (keyed[i].unit[k] - keyed[j].unit[k]).abs() <= NEAR);
            let other = rows[keyed[j].row];
            if kept[j] && near && equal_up_to_factor(first.1, other.1) {
                kept[j] = false;
                if other.0 < first.0 {
                    first = other;
                }
            }
        }
        found.push(first);
    }
    found
}

/// Whether a = λb for some λ > 0; a and b are not zero throughout.
fn equal_up_to_factor(a: [&Integer; 4], b: [&Integer; 4]) -> bool {
    let Some(pivot) = (0..4).find(|i| !a[*i].is_zero()) else {
        return false;
    };
    a[pivot].sign() == b[pivot].sign() && (0..4).all(|i| a[i] * b[pivot] == a[pivot] * b[i])
}
