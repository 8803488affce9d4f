//! IGES 5.3: the rational B-spline curves, entity 126, with the transformation matrices, entity 124, that they refer to.
//!
//! Files in fixed columns only: the compressed and the binary form are refused. Coordinates that are all 0 in z make a plane curve. A
//! curve that its parameter range V(0)…V(1) cuts short is cut there.

use std::collections::HashMap;

use super::build::{Point, spline};
use super::error::{ImportError, curve_fault};
use super::text::{number, small, whole};
use super::{Format, Imported, ImportedCurve, Options};
use crate::curve::{BSpline, Curve, Form, MAXIMUM_DEGREE};
use crate::number::Rational;

/// Columns before the section's letter.
const LETTER: usize = 72;
/// Columns of parameter data.
const PARAMETERS: usize = 64;
/// The most matrices that refer to each other.
const DEEPEST: usize = 16;

/// What the directory says of an entity.
struct Entry {
    kind: u64,
    /// The line of its parameters, counted from 1 in their section, and how many there are.
    first: usize,
    count: usize,
    matrix: u64,
}

struct File<'a> {
    /// In the order of the file; the numbers are odd.
    order: Vec<u64>,
    entries: HashMap<u64, Entry>,
    parameters: Vec<&'a str>,
    /// Between parameters, and at the end.
    delimiters: (char, char),
    options: &'a Options,
}

/// Reads all rational B-spline curves.
pub(super) fn read(text: &str, options: &Options) -> Result<Imported, ImportError> {
    let file = File::new(text, options)?;
    let mut curves = Vec::new();
    for number in &file.order {
        if file.entries.get(number).is_some_and(|entry| entry.kind == 126) {
            curves.push(ImportedCurve {
                name: format!("#{number}"),
                aliases: Vec::new(),
                curve: file.curve(*number)?,
                notes: Vec::new(),
            });
        }
    }
    Ok(Imported {
        format: Format::Iges,
        curves,
        notes: Vec::new(),
    })
}

/// The columns of a line; it may end before.
fn columns(line: &str, from: usize, to: usize) -> &str {
    line.get(from.min(line.len())..to.min(line.len())).unwrap_or("").trim()
}

impl<'a> File<'a> {
    fn new(text: &'a str, options: &'a Options) -> Result<File<'a>, ImportError> {
        let mut sections: HashMap<u8, Vec<(usize, &str)>> = HashMap::new();
        let mut offset = 0;
        for line in text.split_inclusive('\n') {
            let content = line.trim_end_matches(['\r', '\n']);
            match content.as_bytes().get(LETTER) {
                Some(letter @ (b'S' | b'G' | b'D' | b'P' | b'T')) if content.is_ascii() => {
                    sections.entry(*letter).or_default().push((offset, content));
                }
                _ if content.trim().is_empty() => {}
                _ => {
                    let what = "found no section's letter S, G, D, P or T in column 73, expected lines of 80 columns";
                    return Err(ImportError::at(text, offset, what));
                }
            }
            offset += line.len();
        }
        let mut take = |letter| sections.remove(&letter).unwrap_or_default();
        let (global, directory, parameters) = (take(b'G'), take(b'D'), take(b'P'));
        let mut entries = HashMap::new();
        let mut order = Vec::new();
        for pair in directory.chunks(2) {
            let [(at, first), (_, second)] = pair else {
                return Err(ImportError::at(
                    text,
                    pair[0].0,
                    "found one line of an entity in the directory, expected two",
                ));
            };
            let field = |line: &str, index: usize, what: &str| -> Result<u64, ImportError> {
                let word = columns(line, 8 * index, 8 * index + 8);
                // An empty field is 0; matrices may not be negative.
                let value = if word.is_empty() { Some(0) } else { word.parse().ok() };
                value.ok_or_else(|| ImportError::at(text, at + 8 * index, format!("found {word:?}, expected {what}")))
            };
            let number = 2 * order.len() as u64 + 1;
            let kind = field(first, 0, "an entity's type")?;
            // Fields that only these entities need are not looked at in others.
            let needed = matches!(kind, 124 | 126);
            let get = |line: &str, index, what: &str| if needed { field(line, index, what) } else { Ok(0) };
            order.push(number);
            entries.insert(
                number,
                Entry {
                    kind,
                    first: get(first, 1, "a line of parameters")? as usize,
                    count: get(second, 3, "a number of lines")? as usize,
                    matrix: get(first, 6, "a transformation matrix")?,
                },
            );
        }
        let global: String = global.iter().map(|(_, line)| columns_untrimmed(line, LETTER)).collect();
        Ok(File {
            order,
            entries,
            parameters: parameters.iter().map(|(_, line)| *line).collect(),
            delimiters: delimiters(&global),
            options,
        })
    }

    /// The parameters of an entity, its type first.
    fn parameters(&self, entity: u64) -> Result<Vec<Rational>, ImportError> {
        let fault = |message: String| ImportError::entity(entity, message);
        let entry = self
            .entries
            .get(&entity)
            .ok_or_else(|| fault("found a reference to it, expected it in the directory".into()))?;
        let lines = entry
            .first
            .checked_sub(1)
            .and_then(|start| self.parameters.get(start..start.checked_add(entry.count)?));
        let lines = lines.ok_or_else(|| fault("found parameters outside of the file".into()))?;
        let text: String = lines.iter().map(|line| columns_untrimmed(line, PARAMETERS)).collect();
        let (comma, end) = self.delimiters;
        let record = text
            .split_once(end)
            .ok_or_else(|| fault(format!("found no {end:?} at the end of the parameters")))?
            .0;
        let value = |(k, word): (usize, &str)| {
            let word = word.trim();
            if word.is_empty() {
                return Ok(whole(0));
            }
            let word = word.replace(['D', 'd'], "E");
            number(&word, self.options.meaning).map_err(|message| fault(format!("parameter {k}: {message}")))
        };
        record.split(comma).enumerate().map(value).collect()
    }

    fn curve(&self, entity: u64) -> Result<Curve, ImportError> {
        let fault = |message: String| ImportError::entity(entity, message);
        let values = self.parameters(entity)?;
        let integer = |k: usize, what: &str| {
            let value = values.get(k).filter(|value| value.is_integer());
            let value = value
                .and_then(|value| value.numer().to_i64())
                .and_then(|value| usize::try_from(value).ok());
            value.ok_or_else(|| fault(format!("expected {what} as parameter {k}")))
        };
        let (last, degree) = (
            integer(1, "the index of the last control point")?,
            integer(2, "the degree")?,
        );
        if degree == 0 || degree > MAXIMUM_DEGREE {
            return Err(fault(format!(
                "found the degree {degree}, expected 1 to {MAXIMUM_DEGREE}"
            )));
        }
        let polynomial = integer(5, "the flag of polynomial curves")? == 1;
        let count = last.checked_add(1).filter(|count| *count <= values.len());
        let count = count.ok_or_else(|| fault(format!("found {} parameters, expected more", values.len())))?;
        // The type and six numbers stand before the knots.
        let knots_end = 7 + count + degree + 1;
        let weights_end = knots_end + count;
        let points_end = weights_end + 3 * count;
        if values.len() < points_end {
            return Err(fault(format!(
                "found {} parameters, expected at least {points_end}",
                values.len()
            )));
        }
        let knots = &values[7..knots_end];
        let weights = &values[knots_end..weights_end];
        let mut points: Vec<Point> = values[weights_end..points_end]
            .chunks(3)
            .map(<[Rational]>::to_vec)
            .collect();
        let mut matrix = self.entries.get(&entity).map_or(0, |entry| entry.matrix);
        for depth in 0.. {
            if matrix == 0 {
                break;
            }
            if depth == DEEPEST {
                return Err(fault("found matrices that refer to each other without end".into()));
            }
            matrix = self.transform(matrix, &mut points)?;
        }
        if points.iter().all(|point| point[2].numer().is_zero()) {
            points.iter_mut().for_each(|point| point.truncate(2));
        }
        let weights = Some(weights).filter(|_| !polynomial);
        let curve = spline(degree, knots, &points, weights).map_err(|error| fault(curve_fault(&error)))?;
        match (values.get(points_end), values.get(points_end + 1)) {
            (Some(from), Some(to)) => cut(curve, from, to).map_err(fault),
            _ => Ok(curve),
        }
    }

    /// Applies a matrix, and returns the one to apply next, 0 for none.
    fn transform(&self, entity: u64, points: &mut [Point]) -> Result<u64, ImportError> {
        let fault = |message: &str| ImportError::entity(entity, message);
        let values = self.parameters(entity)?;
        let entry = &self.entries[&entity];
        if entry.kind != 124 || values.len() < 13 {
            return Err(fault("expected a transformation matrix, entity 124, of 12 numbers"));
        }
        let matrix = &values[1..13];
        for point in points {
            let row = |i: usize| (0..3).fold(matrix[4 * i + 3].clone(), |sum, j| sum + &matrix[4 * i + j] * &point[j]);
            *point = vec![row(0), row(1), row(2)];
            if !point.iter().all(small) {
                return Err(fault("found a matrix of too long numbers"));
            }
        }
        Ok(entry.matrix)
    }
}

fn columns_untrimmed(line: &str, to: usize) -> &str {
    &line[..to.min(line.len())]
}

/// The delimiters of parameters and records, which the global section writes first, as 1H, and a character.
fn delimiters(global: &str) -> (char, char) {
    let first = global.strip_prefix("1H").and_then(|rest| rest.chars().next());
    let comma = first.unwrap_or(',');
    let rest = match first {
        Some(_) => global.get(4..).unwrap_or(""),
        None => global.strip_prefix(',').unwrap_or(""),
    };
    let end = rest.strip_prefix("1H").and_then(|rest| rest.chars().next());
    (comma, end.unwrap_or(';'))
}

/// The part of a spline between two of its parameters.
fn cut(curve: Curve, from: &Rational, to: &Rational) -> Result<Curve, String> {
    let Form::BSpline(spline) = curve.form() else {
        return Ok(curve);
    };
    let (start, end) = spline.domain();
    if *from == start && *to == end {
        return Ok(curve);
    }
    if !(start <= *from && from < to && *to <= end) {
        return Err(format!(
            "found the parameters {from} to {to}, expected a part of {start} to {end}"
        ));
    }
    let part = |spline: &BSpline, at: &Rational| spline.split(at).map_err(|error| error.to_string());
    let mut spline = spline.clone();
    if *to != end {
        spline = part(&spline, to)?.0;
    }
    if *from != start {
        spline = part(&spline, from)?.1;
    }
    Ok(spline.into())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::import::text::ratio;

    /// A file of entities given by type, matrix and parameters.
    fn file(entities: &[(u64, u64, &str)]) -> String {
        let mut out = format!("{:72}S{:7}\n{:72}G{:7}\n", "made by hand", 1, "1H,,1H;,4Htest;", 1);
        let (mut directory, mut parameters) = (Vec::new(), Vec::new());
        for (kind, matrix, text) in entities {
            let lines: Vec<&[u8]> = text.as_bytes().chunks(64).collect();
            directory.push(format!(
                "{kind:8}{:8}{:24}{:8}{matrix:8}{:8}{:8}",
                parameters.len() + 1,
                "",
                "",
                "",
                ""
            ));
            directory.push(format!("{kind:8}{:8}{:8}{:8}{:40}", 0, 0, lines.len(), ""));
            parameters.extend(lines.iter().map(|line| String::from_utf8_lossy(line).into_owned()));
        }
        for (letter, lines, width) in [('D', directory, 72), ('P', parameters, 72)] {
            for (i, line) in lines.iter().enumerate() {
                out += &format!("{line:width$}{letter}{:7}\n", i + 1);
            }
        }
        out + &format!("{:72}T{:7}\n", "S      1G      1", 1)
    }

    const QUADRATIC: &str = "126,2,2,0,0,0,0,0.,0.,0.,1.,1.,1.,1.,0.5D0,1.,0.,0.,0.,1.,2.5,0.,2.,0.,0.,0.,1.,0.,0.,1.;";

    fn read(entities: &[(u64, u64, &str)]) -> Result<Imported, ImportError> {
        super::read(&file(entities), &Options::default())
    }

    #[test]
    fn curves_and_their_matrices() {
        let found = read(&[(110, 0, "110,0.,0.,0.,1.,1.,1.;"), (126, 0, QUADRATIC)]).unwrap();
        assert_eq!(found.curves.len(), 1);
        assert_eq!(found.curves[0].name, "#3");
        let Form::BSpline(spline) = found.curves[0].curve.form() else {
            panic!()
        };
        assert_eq!((spline.dimension(), spline.weights().unwrap().get(1)), (2, ratio(1, 2)));
        assert_eq!(spline.points().get(3), ratio(5, 2));
        let turn = "124,0.,-1.,0.,10.,1.,0.,0.,0.,0.,0.,1.,7.;";
        let found = read(&[(126, 3, QUADRATIC), (124, 0, turn)]).unwrap();
        let Form::BSpline(spline) = found.curves[0].curve.form() else {
            panic!()
        };
        let points: Vec<Rational> = spline.points().iter().collect();
        assert_eq!(points[3..6], [ratio(15, 2), whole(1), whole(7)]);
    }

    #[test]
    fn cut_by_its_range() {
        let part = QUADRATIC
            .replace("1.,0.,0.,1.;", "0.5,0.,0.,1.;")
            .replace("0.,0.5,", "0.25,0.5,");
        let found = read(&[(126, 0, &part)]).unwrap();
        let Form::BSpline(spline) = found.curves[0].curve.form() else {
            panic!()
        };
        assert_eq!(spline.domain(), (ratio(1, 4), ratio(1, 2)));
        let bad = part.replace("0.25,0.5,", "0.25,1.5,");
        assert!(
            read(&[(126, 0, &bad)])
                .unwrap_err()
                .to_string()
                .contains("entity #1: found the parameters 1/4 to 3/2")
        );
    }

    #[test]
    fn faults_by_entity_or_line() {
        for (text, expected) in [
            ("126,2,2,0,0,0,0,0.;", "found 8 parameters, expected at least"),
            ("126,9999999999,2,0,0,0,0,0.;", "expected more"),
            ("126,2,0,0,0,0,0,0.;", "degree 0"),
            ("126,2,x;", "entity #1: parameter 2: found 'x'"),
            ("126,2,2", "found no ';'"),
            ("126,2.5,2;", "index of the last control point"),
        ] {
            let error = read(&[(126, 0, text)]).unwrap_err().to_string();
            assert!(error.contains(expected), "{text}: {error}");
        }
        let error = read(&[(126, 5, QUADRATIC)]).unwrap_err().to_string();
        assert!(error.contains("entity #5: found a reference"), "{error}");
        let error = read(&[(126, 3, QUADRATIC), (124, 3, "124,1,0,0,0,0,1,0,0,0,0,1,0;")])
            .unwrap_err()
            .to_string();
        assert!(error.contains("without end"), "{error}");
        let error = super::read("S 1\n", &Options::default()).unwrap_err().to_string();
        assert!(error.contains("line 1 column 1"), "{error}");
    }
}
