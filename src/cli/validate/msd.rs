//! Shortest double normals for the judge, found and proved on the spot.

use knotproof::claim::msd::Lower;
use knotproof::curve::Curve;
use knotproof::number::Rational;
use knotproof::prove::msd::{Options, certify};
use knotproof::validate::MsdBounds;

/// The most pairs of parts looked at for one curve.
const BUDGET: u64 = 200_000;

/// Bounds of the shortest double normal that the checker accepts the evidence of.
pub fn bounds(curve: &Curve) -> Result<MsdBounds, String> {
    let options = Options {
        relative_width: Rational::new(1.into(), 1_000_000_000_000_i64.into()),
        budget: Some(BUDGET),
        ..Options::default()
    };
    let mut certified = certify(curve, &options, &|_| ()).map_err(|error| error.to_string())?;
    let mut nowhere = std::io::Cursor::new(Vec::new());
    certified
        .write_checked(knotproof::certificate::Encoding::Binary, &mut nowhere)
        .map_err(|error| error.to_string())?;
    let statement = &certified.document.claim.statement;
    match (&statement.lower_squared, &statement.upper_squared) {
        (Lower::Infinite, _) => Ok(MsdBounds::None),
        (Lower::Finite(lower), Some(upper)) => Ok(MsdBounds::Squared {
            lower: lower.clone(),
            upper: upper.clone(),
        }),
        (Lower::Finite(_), None) => Err("the shortest double normal is not bounded above".into()),
    }
}
