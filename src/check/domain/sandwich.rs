//! Outcome `sandwich`: a polytope in K ∩ B and one around it.

use super::star::{StarError, measure};
use super::{Checked, Context, fails};
use crate::check::polynomial::Bound;
use crate::claim::domain::{Evidence, Star};
use crate::number::{Integer, Rational, RationalExt};

pub fn check(context: &Context, evidence: &Evidence, inner_measure: &Rational, outer_measure: &Rational) -> Checked {
    let Evidence::Sandwich {
        denominator,
        center,
        inner,
        outer,
        rows,
        cell_rows,
    } = evidence
    else {
        return fails("the evidence of a sandwich", "that of another outcome");
    };
    if !denominator.is_positive() {
        return fails("a positive denominator", denominator.to_string());
    }
    if !inner_measure.numer().is_positive() {
        return fails("a positive inner measure", inner_measure.format());
    }
    if !context.in_box(center, denominator) {
        return fails("the center in the box", "a center outside");
    }
    context.shown(center, denominator, Bound::Positive, || "center".into())?;
    let star = |star: &Star, name: &str| {
        measure(star, center, denominator).or_else(|error| fails("a star around the center", describe(name, &error)))
    };
    let found = star(inner, "inner")?;
    if found < *inner_measure {
        return fails(
            "an inner measure at most that of the inner star",
            inner_measure.format(),
        );
    }
    let found = star(outer, "outer")?;
    if found > *outer_measure {
        return fails(
            "an outer measure at least that of the outer star",
            outer_measure.format(),
        );
    }
    for (i, point) in inner.points.iter().enumerate() {
        if !context.in_box(point, denominator) {
            return fails("inner points in the box", format!("point {i} outside"));
        }
        context.shown(point, denominator, Bound::NonNegative, || format!("inner point {i}"))?;
    }
    let rows = context.rows(rows)?;
    let at_center: Vec<Integer> = rows.iter().map(|row| row.affine.at(center, denominator)).collect();
    for (number, (cell, row)) in outer.cells.iter().zip(cell_rows).enumerate() {
        if *row >= rows.len() {
            return fails("a row for every outer cell", format!("row {row} for cell {number}"));
        }
        if !at_center[*row].is_positive() {
            return fails("rows positive at the center", format!("row {row} of cell {number}"));
        }
        let beyond = |v: &usize| !rows[*row].affine.at(&outer.points[*v], denominator).is_positive();
        if !cell.iter().all(beyond) {
            return fails("rows at most 0 at their cells", format!("row {row} at cell {number}"));
        }
    }
    Ok(())
}

fn describe(name: &str, error: &StarError) -> String {
    match error {
        StarError::NoCells => format!("{name}: no cells"),
        StarError::Point { cell } => format!("{name}: cell {cell} names a point that is missing or named twice"),
        StarError::Orientation { cell } => format!("{name}: cell {cell} without positive determinant"),
        StarError::Boundary { cell } => format!("{name}: the boundary of cell {cell} does not cancel"),
        StarError::Covered { cell } => format!("{name}: cell {cell} in front of or behind cell 0"),
    }
}
