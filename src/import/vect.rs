//! Geomview VECT: polygonal curves in space, such as the knots of KnotPlot and of Rawdon and Scharein's tables.

use super::build::{Point, RawPath, catmull_rom, finish, polygon, without_repetitions};
use super::error::{ImportError, curve_fault};
use super::text::{decimals, number, unit};
use super::{Format, Imported, ImportedCurve, Note, Options};

/// The words of a file, without comments.
struct Words<'a> {
    text: &'a str,
    at: usize,
}

impl<'a> Words<'a> {
    /// The next word and where it starts.
    fn next(&mut self) -> Option<(usize, &'a str)> {
        loop {
            let rest = self.text[self.at..].trim_start();
            let start = self.text.len() - rest.len();
            if rest.starts_with('#') {
                self.at = start + rest.find('\n').unwrap_or(rest.len());
                continue;
            }
            let length = rest.find([' ', '\t', '\r', '\n', '#']).unwrap_or(rest.len());
            self.at = start + length;
            return (length > 0).then_some((start, &rest[..length]));
        }
    }

    fn expect(&mut self, what: &str) -> Result<(usize, &'a str), ImportError> {
        let end = self.text.len();
        self.next()
            .ok_or_else(|| ImportError::at(self.text, end, format!("found the end of the file, expected {what}")))
    }

    fn integer(&mut self, what: &str) -> Result<i64, ImportError> {
        let (at, word) = self.expect(what)?;
        let parsed = word.parse().ok();
        parsed.ok_or_else(|| ImportError::at(self.text, at, format!("found {word:?}, expected {what}")))
    }
}

/// Reads a file of polygonal curves.
pub(super) fn read(text: &str, options: &Options) -> Result<Imported, ImportError> {
    let mut words = Words { text, at: 0 };
    let (at, mut first) = words.expect("VECT")?;
    let mut first_at = at;
    for opening in ["{", "="] {
        if first == opening {
            (first_at, first) = words.expect("VECT")?;
        }
    }
    if first != "VECT" {
        return Err(ImportError::at(
            text,
            first_at,
            format!("found {first:?}, expected VECT"),
        ));
    }
    let header = words.at;
    let mut count = |what: &str| -> Result<usize, ImportError> {
        let value = words.integer(what)?;
        // Every one of them takes at least two bytes.
        usize::try_from(value)
            .ok()
            .filter(|value| *value <= text.len())
            .ok_or_else(|| {
                ImportError::at(
                    text,
                    header,
                    format!("found {value}, expected {what} that the file has room for"),
                )
            })
    };
    let polylines = count("the number of polylines")?;
    let vertices = count("the number of vertices")?;
    let colours = count("the number of colours")?;
    let lists = |words: &mut Words, what: &str| -> Result<Vec<i64>, ImportError> {
        (0..polylines).map(|_| words.integer(what)).collect()
    };
    let sizes = lists(&mut words, "the number of vertices of a polyline")?;
    let colour_counts = lists(&mut words, "the number of colours of a polyline")?;
    let sum = |list: &[i64]| list.iter().fold(0_u64, |sum, n| sum.saturating_add(n.unsigned_abs()));
    for (found, expected, what) in [
        (sum(&sizes), vertices, "vertices"),
        (sum(&colour_counts), colours, "colours"),
    ] {
        if found != expected as u64 {
            let message = format!("found {found} {what} in the polylines together, expected {expected}");
            return Err(ImportError::at(text, header, message));
        }
    }
    let mut curves = Vec::new();
    let mut empty = 0;
    for (i, size) in sizes.iter().enumerate() {
        let closed = *size < 0;
        let start = words.at;
        let mut points: Vec<Point> = Vec::new();
        let mut most = 0;
        for _ in 0..size.unsigned_abs() {
            let mut point = Point::new();
            for _ in 0..3 {
                let (at, word) = words.expect("a coordinate")?;
                most = most.max(decimals(word));
                point.push(number(word, options.meaning).map_err(|message| ImportError::at(text, at, message))?);
            }
            points.push(point);
        }
        let (points, dropped) = without_repetitions(points, closed);
        let path = RawPath {
            pieces: match options.smooth {
                true => catmull_rom(&points, closed),
                false => polygon(&points, closed),
            },
            closing_line: closed && !options.smooth && points.len() > 2,
            unit: Some(unit(most)),
            ..RawPath::default()
        };
        let finished = finish(path, options).map_err(|error| ImportError::at(text, start, curve_fault(&error)))?;
        match finished {
            None => empty += 1,
            Some((curve, mut notes)) => {
                if dropped > 0 {
                    notes.push(Note::Dropped { pieces: dropped });
                }
                if options.smooth {
                    notes.push(Note::Smoothed);
                }
                curves.push(ImportedCurve {
                    name: format!("polyline{i}"),
                    aliases: Vec::new(),
                    curve,
                    notes,
                });
            }
        }
    }
    // Colours, and the closing brace of a file in braces, follow; they are not read.
    Ok(Imported {
        format: Format::Vect,
        curves,
        notes: (empty > 0)
            .then(|| format!("polylines without length left out: {empty}"))
            .into_iter()
            .collect(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const TRIANGLE: &str =
        "VECT # a comment\n2 6 1\n-3 3\n1 0\n0 0 0\n1 0 0.5\n0 1e0 0\n5 5 5\n6 6 6\n6 6 6\n1 0 0 1\n";

    #[test]
    fn closed_and_open() {
        let read = read(TRIANGLE, &Options::default()).unwrap();
        assert_eq!(read.curves.len(), 2);
        assert!(read.curves[0].curve.is_closed());
        assert_eq!(read.curves[0].curve.chain().count(), 3);
        assert!(!read.curves[1].curve.is_closed());
        assert_eq!(read.curves[1].notes, [Note::Dropped { pieces: 1 }]);
        let options = Options {
            smooth: true,
            ..Options::default()
        };
        let smooth = super::read(TRIANGLE, &options).unwrap();
        assert_eq!(smooth.curves[0].notes, [Note::Smoothed]);
        assert_eq!(smooth.curves[0].curve.chain().pieces()[0].degree(), 3);
    }

    #[test]
    fn faults_with_line_and_column() {
        for (from, to, expected) in [
            ("VECT", "VEC", "line 1 column 1: found \"VEC\""),
            ("0.5", "x", "line 6 column 5: found 'x'"),
            ("2 6 1", "2 7 1", "found 6 vertices"),
            ("2 6 1", "2 -6 1", "found -6"),
            ("2 6 1", "99999999999 6 1", "room"),
            ("-3 3", "-3 y", "line 3 column 4: found \"y\""),
            ("-3 3", "-9223372036854775808 3", "vertices"),
            ("6 6 6\n6 6 6\n1 0 0 1\n", "", "line 9 column 1: found the end"),
        ] {
            let text = TRIANGLE.replace(from, to);
            assert_ne!(text, TRIANGLE);
            let error = read(&text, &Options::default()).unwrap_err().to_string();
            assert!(error.contains(expected), "{to}: {error}");
        }
    }
}
