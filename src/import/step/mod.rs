//! STEP (ISO 10303-21): the B-spline curves of ISO 10303-42, in the plane and in space.
//!
//! Read are `B_SPLINE_CURVE_WITH_KNOTS`, `BEZIER_CURVE`, `QUASI_UNIFORM_CURVE`, `UNIFORM_CURVE` and their rational forms, each as the entity
//! gives it: placements of assemblies and trimming by other entities are not applied. Knots of the forms without knots are those of
//! ISO 10303-42: the integers, clamped except in `UNIFORM_CURVE`, each degree times inside a `BEZIER_CURVE`.

mod parse;

use self::parse::{Index, Records, Value};
use super::build::{Point, spline};
use super::error::{ImportError, curve_fault};
use super::text::{number, whole};
use super::{Format, Imported, ImportedCurve, Options};
use crate::curve::MAXIMUM_DEGREE;
use crate::number::Rational;

const WITH_KNOTS: &str = "B_SPLINE_CURVE_WITH_KNOTS";
/// The forms, in the order in which they are looked for.
const FORMS: [&str; 4] = [WITH_KNOTS, "BEZIER_CURVE", "QUASI_UNIFORM_CURVE", "UNIFORM_CURVE"];

/// Reads all B-spline curves.
pub(super) fn read(text: &str, options: &Options) -> Result<Imported, ImportError> {
    let index = Index::new(text)?;
    let mut curves = Vec::new();
    for &entity in &index.order {
        if !index.mentions(entity, |name| FORMS.contains(&name)) {
            continue;
        }
        let records = index.records(entity)?;
        let reader = Reader {
            index: &index,
            entity,
            options,
        };
        curves.push(reader.curve(&records)?);
    }
    let notes = match index.order.len() {
        0 => vec!["found no entity".to_string()],
        _ => Vec::new(),
    };
    Ok(Imported {
        format: Format::Step,
        curves,
        notes,
    })
}

struct Reader<'r, 'a> {
    index: &'r Index<'a>,
    entity: u64,
    options: &'r Options,
}

/// The parameters of the record of this name.
fn record<'r, 'a>(records: &'r Records<'a>, name: &str) -> Option<&'r [Value<'a>]> {
    let found = records.iter().find(|(found, _)| *found == name);
    found.map(|(_, values)| values.as_slice())
}

impl Reader<'_, '_> {
    fn fault(&self, message: impl Into<String>) -> ImportError {
        ImportError::entity(self.entity, message)
    }

    fn list<'v, 'a>(&self, value: Option<&'v Value<'a>>, what: &str) -> Result<&'v [Value<'a>], ImportError> {
        match value {
            Some(Value::List(list)) => Ok(list),
            _ => Err(self.fault(format!("expected a list of {what}"))),
        }
    }

    fn number(&self, value: &Value, what: &str) -> Result<Rational, ImportError> {
        match value {
            Value::Number(text) => {
                number(text, self.options.meaning).map_err(|message| self.fault(format!("{what}: {message}")))
            }
            _ => Err(self.fault(format!("{what}: expected a number"))),
        }
    }

    fn numbers(&self, values: &[Value], what: &str) -> Result<Vec<Rational>, ImportError> {
        values.iter().map(|value| self.number(value, what)).collect()
    }

    fn integer(&self, value: Option<&Value>, what: &str) -> Result<usize, ImportError> {
        match value {
            Some(Value::Number(text)) => text.parse().ok(),
            _ => None,
        }
        .ok_or_else(|| self.fault(format!("{what}: expected a number that is not negative")))
    }

    /// The curve of an entity, given by one record or by several.
    fn curve(&self, records: &Records) -> Result<ImportedCurve, ImportError> {
        let form = FORMS.into_iter().find(|form| record(records, form).is_some());
        let form = form.ok_or_else(|| self.fault("expected a B-spline curve"))?;
        let own = record(records, form).unwrap_or_default();
        // One record begins with the name, of several each has its own parameters only.
        let (name, common, knots) = match record(records, "B_SPLINE_CURVE") {
            Some(common) => (record(records, "REPRESENTATION_ITEM"), common, own),
            None => (
                Some(own),
                own.get(1..).unwrap_or_default(),
                own.get(6..).unwrap_or_default(),
            ),
        };
        let degree = self.integer(common.first(), "degree")?;
        if degree == 0 || degree > MAXIMUM_DEGREE {
            return Err(self.fault(format!("found the degree {degree}, expected 1 to {MAXIMUM_DEGREE}")));
        }
        let points = self.list(common.get(1), "control points")?;
        let points: Result<Vec<Point>, ImportError> = points.iter().map(|value| self.point(value)).collect();
        let points = points?;
        let weights = match record(records, "RATIONAL_B_SPLINE_CURVE") {
            Some(values) => Some(self.numbers(self.list(values.first(), "weights")?, "weights")?),
            None => None,
        };
        let (multiplicities, values) = match form {
            WITH_KNOTS => {
                let list = self.list(knots.first(), "multiplicities")?;
                let multiplicities: Result<Vec<usize>, ImportError> = list
                    .iter()
                    .map(|value| self.integer(Some(value), "multiplicities"))
                    .collect();
                let values = self.numbers(self.list(knots.get(1), "knots")?, "knots")?;
                (multiplicities?, values)
            }
            _ => self.implied(form, degree, points.len())?,
        };
        let knots = self.knots(&multiplicities, &values, degree + 1 + points.len())?;
        let curve = spline(degree, &knots, &points, weights.as_deref());
        let label = match name.and_then(<[Value]>::first) {
            Some(Value::Text(label)) if !label.is_empty() => vec![label.to_string()],
            _ => Vec::new(),
        };
        Ok(ImportedCurve {
            name: format!("#{}", self.entity),
            aliases: label,
            curve: curve.map_err(|error| self.fault(curve_fault(&error)))?,
            notes: Vec::new(),
        })
    }

    /// Every knot as often as its multiplicity says.
    fn knots(
        &self,
        multiplicities: &[usize],
        values: &[Rational],
        expected: usize,
    ) -> Result<Vec<Rational>, ImportError> {
        if multiplicities.len() != values.len() {
            let found = (multiplicities.len(), values.len());
            return Err(self.fault(format!("found {} multiplicities for {} knots", found.0, found.1)));
        }
        let count = multiplicities.iter().fold(0_usize, |sum, m| sum.saturating_add(*m));
        if count != expected {
            return Err(self.fault(format!(
                "found {count} knots by their multiplicities, expected {expected}, the control points and the degree and 1"
            )));
        }
        let repeated = multiplicities.iter().zip(values);
        Ok(repeated
            .flat_map(|(m, value)| std::iter::repeat_n(value.clone(), *m))
            .collect())
    }

    /// The knots of a form that does not write them.
    fn implied(&self, form: &str, degree: usize, points: usize) -> Result<(Vec<usize>, Vec<Rational>), ImportError> {
        let integers = |from: i64, to: i64| (from..=to).map(whole).collect::<Vec<_>>();
        let most = |n: usize| i64::try_from(n).map_err(|_| self.fault("found too many control points"));
        if points <= degree {
            let message = format!("found {points} control points, expected at least {}", degree + 1);
            return Err(self.fault(message));
        }
        Ok(match form {
            "UNIFORM_CURVE" => {
                let values = integers(-most(degree)?, most(points)?);
                (vec![1; values.len()], values)
            }
            "BEZIER_CURVE" => {
                if !(points - 1).is_multiple_of(degree) {
                    let message =
                        format!("found {points} control points, expected a multiple of {degree} and one more");
                    return Err(self.fault(message));
                }
                let pieces = (points - 1) / degree;
                let mut multiplicities = vec![degree; pieces + 1];
                multiplicities[0] += 1;
                multiplicities[pieces] += 1;
                (multiplicities, integers(0, most(pieces)?))
            }
            _ => {
                let spans = points - degree;
                let mut multiplicities = vec![1; spans + 1];
                multiplicities[0] += degree;
                multiplicities[spans] += degree;
                (multiplicities, integers(0, most(spans)?))
            }
        })
    }

    /// The coordinates of a control point.
    fn point(&self, value: &Value) -> Result<Point, ImportError> {
        let Value::Reference(number) = value else {
            return Err(self.fault("control points: expected references to points"));
        };
        let records = self.index.records(*number)?;
        let at_point = Reader {
            entity: *number,
            ..*self
        };
        let coordinates = match records.as_slice() {
            [("CARTESIAN_POINT", values)] => values.get(1),
            _ => record(&records, "CARTESIAN_POINT").and_then(<[Value]>::first),
        };
        let coordinates = at_point.list(coordinates, "coordinates, as CARTESIAN_POINT has them")?;
        if !(2..=3).contains(&coordinates.len()) {
            let message = format!("found {} coordinates, expected 2 or 3", coordinates.len());
            return Err(at_point.fault(message));
        }
        at_point.numbers(coordinates, "coordinates")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::Form;
    use crate::import::text::ratio;

    const POINTS: &str = "#1=CARTESIAN_POINT('',(0.,0.));#2=CARTESIAN_POINT('',(1.,2.));#3=CARTESIAN_POINT('',(3.,2.5E-1));\
                          #4=CARTESIAN_POINT('',(4.,0.));#5=CARTESIAN_POINT('',(5.,1.));";

    fn read(data: &str) -> Result<Imported, ImportError> {
        let text = format!("ISO-10303-21;HEADER;ENDSEC;DATA;{POINTS}{data}ENDSEC;END-ISO-10303-21;");
        super::read(&text, &Options::default())
    }

    fn knots(data: &str) -> Vec<Rational> {
        let read = read(data).unwrap();
        let Form::BSpline(spline) = read.curves[0].curve.form() else {
            panic!()
        };
        spline.knots().iter().collect()
    }

    #[test]
    fn forms() {
        let with = "#9=B_SPLINE_CURVE_WITH_KNOTS('seam',2,(#1,#2,#3,#4),.UNSPECIFIED.,.F.,.F.,(3,1,3),(0.,0.5,1.),.UNSPECIFIED.);";
        let file = read(with).unwrap();
        assert_eq!(file.curves[0].name, "#9");
        assert_eq!(file.select("seam"), [0]);
        assert_eq!(knots(with)[3], ratio(1, 2));
        let complex = "#9=(BOUNDED_CURVE()B_SPLINE_CURVE(2,(#1,#2,#3),.UNSPECIFIED.,.F.,.F.)B_SPLINE_CURVE_WITH_KNOTS((3,3),(0.,1.),.PIECEWISE_BEZIER_KNOTS.)\
                       CURVE()GEOMETRIC_REPRESENTATION_ITEM()RATIONAL_B_SPLINE_CURVE((1.,0.7,1.))REPRESENTATION_ITEM('arc'));";
        let file = read(complex).unwrap();
        let Form::BSpline(spline) = file.curves[0].curve.form() else {
            panic!()
        };
        assert_eq!(spline.weights().unwrap().get(1), ratio(7, 10));
        assert_eq!(file.curves[0].aliases, ["arc"]);
        let integers = |list: &[i64]| list.iter().map(|n| whole(*n)).collect::<Vec<_>>();
        let simple =
            |form: &str, degree: usize| format!("#9={form}('',{degree},(#1,#2,#3,#4,#5),.UNSPECIFIED.,.F.,.F.);");
        assert_eq!(knots(&simple("BEZIER_CURVE", 2)), integers(&[0, 0, 0, 1, 1, 2, 2, 2]));
        assert_eq!(
            knots(&simple("QUASI_UNIFORM_CURVE", 2)),
            integers(&[0, 0, 0, 1, 2, 3, 3, 3])
        );
        assert_eq!(
            knots(&simple("UNIFORM_CURVE", 2)),
            integers(&[-2, -1, 0, 1, 2, 3, 4, 5])
        );
        assert_eq!(read("").unwrap().curves, []);
    }

    #[test]
    fn faults_by_entity() {
        let good =
            "#9=B_SPLINE_CURVE_WITH_KNOTS('',2,(#1,#2,#3,#4),.UNSPECIFIED.,.F.,.F.,(3,1,3),(0.,0.5,1.),.UNSPECIFIED.);";
        for (from, to, expected) in [
            ("#3,#4", "#3,#77", "entity #77: found a reference"),
            ("#3,#4", "#3,#9", "entity #9: expected a list of coordinates"),
            ("#3,#4", "#3,5", "entity #9: control points: expected references"),
            ("(3,1,3)", "(3,3)", "found 2 multiplicities for 3 knots"),
            ("(3,1,3)", "(3,99999999999999,3)", "expected 7"),
            ("(3,1,3)", "(3,1,-3)", "multiplicities"),
            ("'',2", "'',0", "degree 0"),
            ("'',2", "'',$", "degree: expected"),
            ("0.5", "1.5", "entity #9: not a curve: knots"),
            ("0.5", ".T.", "knots: expected a number"),
            ("0.5", "0.5E99999", "knots: the exponent"),
        ] {
            let text = good.replace(from, to);
            assert_ne!(text, good);
            let error = read(&text).unwrap_err().to_string();
            assert!(error.contains(expected), "{to}: {error}");
        }
        let bezier = "#9=BEZIER_CURVE('',3,(#1,#2,#3,#4,#5),.UNSPECIFIED.,.F.,.F.);";
        assert!(read(bezier).unwrap_err().to_string().contains("multiple of 3"));
    }
}
