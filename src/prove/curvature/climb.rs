//! From a parameter up to a local maximum of the curvature, with exact values.

use crate::check::curvature::Field;
use crate::number::{Integer, Rational, RationalExt, simplest_between};

/// Differences of values are taken with so many leading bits.
const VALUE_BITS: i64 = 640;
/// The first step is this power of 1/2.
const FIRST_STEP: u32 = 6;
/// Each round divides the step by this power of 2.
const SHRINKING: u32 = 3;
/// Steps of one length at most.
const MOST_STEPS: usize = 64;
/// Parameters are rounded to this power of 1/2 of a step.
const GRID_BITS: u32 = 8;

/// A parameter and its curvature.
pub struct Peak {
    /// The piece.
    pub piece: usize,
    /// The local parameter.
    pub u: Rational,
    /// κ² there.
    pub squared: Rational,
}

fn power_of_half(exponent: u32) -> Rational {
    Rational::new(Integer::ONE, Integer::ONE << exponent)
}

/// Climbs from `start`, where D does not vanish unless at the end of a piece; `bits` are those that the value needs.
pub fn climb(field: &Field, piece: usize, start: Rational, bits: u32) -> Peak {
    let zero = Rational::from_integer(Integer::ZERO);
    let one = Rational::from_integer(Integer::ONE);
    let at = |u: &Rational| field.squared_at(u).unwrap_or_else(|| zero.clone());
    let mut u = start;
    let mut squared = at(&u);
    // An error of the parameter counts squared in the value; six more bits for a sharply bent maximum.
    let last = bits / 2 + 6;
    let mut exponent = FIRST_STEP;
    while exponent < last + SHRINKING {
        let step = power_of_half(exponent);
        let mut sides = [None, None];
        for _ in 0..MOST_STEPS {
            let places = [&u - &step, &u + &step];
            sides = places.map(|place| (place >= zero && place <= one).then(|| (at(&place), place)));
            let greatest = sides.iter().flatten().max_by(|a, b| a.0.cmp(&b.0));
            match greatest {
                Some((value, place)) if *value > squared => (squared, u) = (value.clone(), place.clone()),
                _ => break,
            }
        }
        if let [Some((before, _)), Some((after, _))] = &sides
            && let Some(place) = vertex(&u, &step, [before, &squared, after], exponent + GRID_BITS)
        {
            let value = at(&place);
            if place >= zero && place <= one && value > squared {
                (squared, u) = (value, place);
            }
        }
        exponent += SHRINKING;
    }
    // A shorter parameter nearby that is as good: symmetric curves have their maxima there.
    let near = power_of_half(last);
    let (low, high) = ((&u - &near).max(zero.clone()), (&u + &near).min(one.clone()));
    let simple = simplest_between(&low, &high);
    if simple != u {
        let value = at(&simple);
        if value >= squared {
            (squared, u) = (value, simple);
        }
    }
    Peak { piece, u, squared }
}

/// The vertex of the parabola through three values around u, on a grid.
fn vertex(u: &Rational, step: &Rational, values: [&Rational; 3], grid: u32) -> Option<Rational> {
    let size = values[1].numer().bits() as i64 - values[1].denom().bits() as i64;
    let shift = u32::try_from(VALUE_BITS - size).unwrap_or(0);
    let [a, b, c] = values.map(|value| value.floor_shifted(shift));
    let bend = &a + &c - &b - &b;
    if !bend.is_negative() {
        return None;
    }
    let two = Integer::from(2);
    let offset = step * Rational::new(a - c, bend * two);
    let on_grid = (u + offset).floor_shifted(grid);
    Some(Rational::new(on_grid, Integer::ONE << grid))
}
