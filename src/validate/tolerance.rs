//! How far an answer may be off.

use std::collections::BTreeMap;

use serde::Deserialize;

use crate::engine::{FileError, OPERATIONS};

/// The version of files of tolerances.
pub const TOLERANCES_VERSION: &str = "tolerances/1";

/// The largest deviation of each operation, in units in the last place (see [`Truth`](super::Truth)), that is not wrong.
#[derive(Debug, Clone, PartialEq)]
pub struct Tolerances(BTreeMap<&'static str, f64>);

impl Default for Tolerances {
    /// 2^20 units, 10 significant digits, where the result is a formula of the input; 2^32 units, 6 digits, for distances and polygons, which engines find
    /// by iteration to a precision of their choice.
    fn default() -> Self {
        let ulps = |name: &str| match name {
            "nearest_point" | "curve_distance" | "msd" | "convex_domain" => 2_f64.powi(32),
            _ => 2_f64.powi(20),
        };
        Tolerances(OPERATIONS.iter().map(|name| (*name, ulps(name))).collect())
    }
}

impl Tolerances {
    /// The tolerance of an operation, one of [`OPERATIONS`]; 0 for any other name.
    pub fn ulps(&self, operation: &str) -> f64 {
        self.0.get(operation).copied().unwrap_or(0.0)
    }

    /// Reads a file of tolerances, version `tolerances/1`; operations that it does not name keep their defaults.
    ///
    /// # Errors
    /// Other versions, unknown fields and operations, numbers that are negative or not finite.
    pub fn read(json: impl AsRef<[u8]>) -> Result<Tolerances, FileError> {
        #[derive(Deserialize)]
        #[serde(deny_unknown_fields)]
        struct Raw {
            knotproof: String,
            ulps: BTreeMap<String, f64>,
        }
        let error = |path: String, what: String| FileError { path, what };
        let mut deserializer = serde_json::Deserializer::from_slice(json.as_ref());
        let raw: Raw = serde_path_to_error::deserialize(&mut deserializer)
            .map_err(|found| error(found.path().to_string(), found.inner().to_string()))?;
        deserializer
            .end()
            .map_err(|found| error(String::new(), found.to_string()))?;
        if raw.knotproof != TOLERANCES_VERSION {
            let what = format!("found version {:?}, expected {TOLERANCES_VERSION:?}", raw.knotproof);
            return Err(error("knotproof".into(), what));
        }
        let mut tolerances = Tolerances::default();
        for (name, ulps) in raw.ulps {
            let Some(slot) = tolerances.0.get_mut(name.as_str()) else {
                let what = format!("is no operation, expected one of {}", OPERATIONS.join(", "));
                return Err(error(format!("ulps.{name}"), what));
            };
            if ulps < 0.0 {
                return Err(error(
                    format!("ulps.{name}"),
                    format!("found {ulps}, expected 0 or more"),
                ));
            }
            *slot = ulps;
        }
        Ok(tolerances)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_changes_what_it_names() {
        let read = Tolerances::read(r#"{"knotproof":"tolerances/1","ulps":{"point":4}}"#).unwrap();
        assert_eq!(read.ulps("point"), 4.0);
        assert_eq!(read.ulps("msd"), Tolerances::default().ulps("msd"));
        for (json, part) in [
            (r#"{"knotproof":"tolerances/2","ulps":{}}"#, "tolerances/2"),
            (r#"{"knotproof":"tolerances/1","ulps":{"points":4}}"#, "ulps.points"),
            (r#"{"knotproof":"tolerances/1","ulps":{"point":-1}}"#, "0 or more"),
            (r#"{"knotproof":"tolerances/1","ulps":{"point":"4"}}"#, "ulps.point"),
            (r#"{"knotproof":"tolerances/1","ulps":{},"x":1}"#, "unknown field"),
            (r#"{"knotproof":"tolerances/1","ulps":{}} x"#, "trailing"),
        ] {
            let error = Tolerances::read(json).expect_err(json).to_string();
            assert!(error.contains(part), "{json}: {error}");
        }
    }
}
