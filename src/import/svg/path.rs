//! Path data, the attribute `d`.

use super::angle::rotation;
use super::arc::{Arc, Drawn, draw};
use super::transform::Fault;
use crate::import::build::{Point, RawPath, RawPiece};
use crate::import::text::{decimals, number, small, unit, whole};
use crate::number::{Meaning, Rational};

/// Reads path data: one path for each subpath that has a piece, and how many have none.
pub(super) fn parse(text: &str, meaning: Meaning, exact: bool) -> Result<(Vec<RawPath>, usize), Fault> {
    let mut builder = Builder::new(exact);
    let mut tokens = Tokens {
        text,
        at: 0,
        meaning,
        decimals: 0,
    };
    tokens.skip_spaces();
    let mut first = true;
    while let Some(command) = tokens.command()? {
        let start = tokens.at - 1;
        if first && !matches!(command, 'M' | 'm') {
            return Err((
                start,
                format!("found {command:?}, expected the path to begin with M or m"),
            ));
        }
        first = false;
        builder.run(command, &mut tokens)?;
    }
    let unit = unit(tokens.decimals);
    builder.flush();
    for path in &mut builder.done {
        path.unit = Some(unit.clone());
    }
    Ok((builder.done, builder.empty))
}

/// The text, read from the left.
struct Tokens<'a> {
    text: &'a str,
    at: usize,
    meaning: Meaning,
    /// The most decimals met.
    decimals: u32,
}

impl Tokens<'_> {
    fn peek(&self) -> Option<u8> {
        self.text.as_bytes().get(self.at).copied()
    }

    fn skip_spaces(&mut self) {
        while matches!(self.peek(), Some(b' ' | b'\t' | b'\r' | b'\n' | 0x0c)) {
            self.at += 1;
        }
    }

    /// Spaces, with a comma among them if there is one.
    fn skip_separator(&mut self) {
        self.skip_spaces();
        if self.peek() == Some(b',') {
            self.at += 1;
            self.skip_spaces();
        }
    }

    fn found(&self) -> String {
        match self.text[self.at..].chars().next() {
            Some(c) => format!("found {c:?}"),
            None => "found the end of the path".into(),
        }
    }

    /// The next command; nothing at the end.
    fn command(&mut self) -> Result<Option<char>, Fault> {
        self.skip_spaces();
        match self.peek().map(char::from) {
            None => Ok(None),
            Some(c) if "MmLlHhVvCcSsQqTtAaZz".contains(c) => {
                self.at += 1;
                self.skip_spaces();
                Ok(Some(c))
            }
            Some(_) => Err((
                self.at,
                format!("{}, expected a command such as L or a number", self.found()),
            )),
        }
    }

    fn digits(&mut self) -> usize {
        let start = self.at;
        while self.peek().is_some_and(|b| b.is_ascii_digit()) {
            self.at += 1;
        }
        self.at - start
    }

    /// Whether a number begins here.
    fn at_number(&self) -> bool {
        matches!(self.peek(), Some(b'0'..=b'9' | b'+' | b'-' | b'.'))
    }

    fn number(&mut self) -> Result<Rational, Fault> {
        let start = self.at;
        if matches!(self.peek(), Some(b'+' | b'-')) {
            self.at += 1;
        }
        let mut digits = self.digits();
        if self.peek() == Some(b'.') {
            self.at += 1;
            digits += self.digits();
        }
        if digits == 0 {
            self.at = start;
            return Err((start, format!("{}, expected a number", self.found())));
        }
        if matches!(self.peek(), Some(b'e' | b'E')) {
            let before = self.at;
            self.at += 1;
            if matches!(self.peek(), Some(b'+' | b'-')) {
                self.at += 1;
            }
            if self.digits() == 0 {
                self.at = before;
            }
        }
        let text = &self.text[start..self.at];
        self.decimals = self.decimals.max(decimals(text));
        let value = number(text, self.meaning).map_err(|message| (start, message))?;
        self.skip_separator();
        Ok(value)
    }

    fn flag(&mut self) -> Result<bool, Fault> {
        let flag = match self.peek() {
            Some(b'0') => false,
            Some(b'1') => true,
            _ => return Err((self.at, format!("{}, expected an arc's flag, 0 or 1", self.found()))),
        };
        self.at += 1;
        self.skip_separator();
        Ok(flag)
    }
}

/// What curve the piece before was, for the smooth commands.
enum Before {
    Cubic(Point),
    Quadratic(Point),
    Other,
}

/// The subpaths so far.
struct Builder {
    exact: bool,
    done: Vec<RawPath>,
    empty: usize,
    open: Option<RawPath>,
    start: Point,
    at: Point,
    before: Before,
}

impl Builder {
    fn new(exact: bool) -> Builder {
        Builder {
            exact,
            done: Vec::new(),
            empty: 0,
            open: None,
            start: vec![whole(0), whole(0)],
            at: vec![whole(0), whole(0)],
            before: Before::Other,
        }
    }

    /// Ends the subpath.
    fn flush(&mut self) {
        match self.open.take() {
            Some(path) if path.pieces.is_empty() => self.empty += 1,
            Some(path) => self.done.push(path),
            None => {}
        }
    }

    fn push(&mut self, piece: RawPiece) {
        self.open.get_or_insert_default().pieces.push(piece);
    }

    fn point(&self, relative: bool, tokens: &mut Tokens) -> Result<Point, Fault> {
        let start = tokens.at;
        let (mut x, mut y) = (tokens.number()?, tokens.number()?);
        if relative {
            x += &self.at[0];
            y += &self.at[1];
        }
        match small(&x) && small(&y) {
            true => Ok(vec![x, y]),
            false => Err((start, "found a coordinate of too many digits".into())),
        }
    }

    /// The point opposite to `control` with respect to the current one.
    fn reflected(&self, control: &Point) -> Point {
        self.at.iter().zip(control).map(|(at, c)| whole(2) * at - c).collect()
    }

    fn line_to(&mut self, to: Point) {
        let from = std::mem::replace(&mut self.at, to.clone());
        self.push(RawPiece::polynomial([from, to]));
        self.before = Before::Other;
    }

    /// One command with all its repetitions.
    fn run(&mut self, command: char, tokens: &mut Tokens) -> Result<(), Fault> {
        let relative = command.is_ascii_lowercase();
        let mut kind = command.to_ascii_uppercase();
        if kind == 'Z' {
            self.close();
            return Ok(());
        }
        loop {
            self.step(kind, relative, tokens)?;
            if kind == 'M' {
                // Further pairs after a move are lines.
                kind = 'L';
            }
            if !tokens.at_number() {
                return Ok(());
            }
        }
    }

    fn step(&mut self, kind: char, relative: bool, tokens: &mut Tokens) -> Result<(), Fault> {
        match kind {
            'M' => {
                let to = self.point(relative, tokens)?;
                self.flush();
                self.open = Some(RawPath::default());
                (self.start, self.at) = (to.clone(), to);
                self.before = Before::Other;
            }
            'L' => {
                let to = self.point(relative, tokens)?;
                self.line_to(to);
            }
            'H' | 'V' => {
                let axis = usize::from(kind == 'V');
                let start = tokens.at;
                let mut to = self.at.clone();
                let value = tokens.number()?;
                to[axis] = if relative { value + &to[axis] } else { value };
                if !small(&to[axis]) {
                    return Err((start, "found a coordinate of too many digits".into()));
                }
                self.line_to(to);
            }
            'C' | 'S' => {
                let first = match (kind, &self.before) {
                    ('C', _) => self.point(relative, tokens)?,
                    (_, Before::Cubic(control)) => self.reflected(control),
                    _ => self.at.clone(),
                };
                let second = self.point(relative, tokens)?;
                let to = self.point(relative, tokens)?;
                let from = std::mem::replace(&mut self.at, to.clone());
                self.push(RawPiece::polynomial([from, first, second.clone(), to]));
                self.before = Before::Cubic(second);
            }
            'Q' | 'T' => {
                let control = match (kind, &self.before) {
                    ('Q', _) => self.point(relative, tokens)?,
                    (_, Before::Quadratic(control)) => self.reflected(control),
                    _ => self.at.clone(),
                };
                let to = self.point(relative, tokens)?;
                let from = std::mem::replace(&mut self.at, to.clone());
                self.push(RawPiece::polynomial([from, control.clone(), to]));
                self.before = Before::Quadratic(control);
            }
            _ => self.arc(relative, tokens)?,
        }
        Ok(())
    }

    fn arc(&mut self, relative: bool, tokens: &mut Tokens) -> Result<(), Fault> {
        let start = tokens.at;
        let radii = [tokens.number()?, tokens.number()?];
        let degrees = tokens.number()?;
        let (large, sweep) = (tokens.flag()?, tokens.flag()?);
        let to = self.point(relative, tokens)?;
        let Drawn { pieces, bound } = draw(&Arc {
            start: &self.at,
            end: &to,
            radii: [&radii[0], &radii[1]],
            rotation: &rotation(&degrees),
            large,
            sweep,
        })
        .map_err(|message| (start, message))?;
        let path = self.open.get_or_insert_default();
        path.pieces.extend(pieces);
        if let Some(bound) = bound {
            if self.exact {
                let what = "found an arc whose centre or axes are no fractions, expected arcs that are exact (--exact)";
                return Err((start, what.into()));
            }
            path.arcs += 1;
            if path.bound.as_ref().is_none_or(|before| *before < bound) {
                path.bound = Some(bound);
            }
        }
        self.at = to;
        self.before = Before::Other;
        Ok(())
    }

    /// A line to the start, unless the path is there already.
    fn close(&mut self) {
        if self.at != self.start {
            let start = self.start.clone();
            self.line_to(start);
            self.open.get_or_insert_default().closing_line = true;
        }
        self.flush();
        self.at.clone_from(&self.start);
        self.before = Before::Other;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The end points and control points of all subpaths, as text.
    fn read(text: &str) -> String {
        let (paths, empty) = parse(text, Meaning::Decimal, false).unwrap();
        let mut out: Vec<String> = paths
            .iter()
            .map(|path| {
                let pieces = path.pieces.iter().map(|piece| {
                    let points = piece.points.iter().map(|p| format!("{},{}", p[0], p[1]));
                    points.collect::<Vec<_>>().join(" ")
                });
                pieces.collect::<Vec<_>>().join("; ")
            })
            .collect();
        if empty > 0 {
            out.push(format!("{empty} empty"));
        }
        out.join(" | ")
    }

    #[test]
    fn commands() {
        for (text, expected) in [
            ("M1 2L3 4", "1,2 3,4"),
            ("m1 2 3 4", "1,2 4,6"),
            ("M1,2,3,4", "1,2 3,4"),
            ("M1 2h1v2H0V0", "1,2 2,2; 2,2 2,4; 2,4 0,4; 0,4 0,0"),
            ("M0 0.5.5-1", "0,1/2 1/2,-1"),
            ("M1-1l.5.5z", "1,-1 3/2,-1/2; 3/2,-1/2 1,-1"),
            ("M0 0L1 0L0 0z", "0,0 1,0; 1,0 0,0"),
            ("M0 0l1 0zl0 1z", "0,0 1,0; 1,0 0,0 | 0,0 0,1; 0,1 0,0"),
            ("M1 1zM2 2", "2 empty"),
            ("M0 0C0 1 1 1 1 0S2-1 2 0", "0,0 0,1 1,1 1,0; 1,0 1,-1 2,-1 2,0"),
            ("M0 0c0 1 1 1 1 0s1-1 1 0", "0,0 0,1 1,1 1,0; 1,0 1,-1 2,-1 2,0"),
            ("M0 0S2-1 2 0", "0,0 0,0 2,-1 2,0"),
            ("M0 0Q1 1 2 0T4 0t2 0", "0,0 1,1 2,0; 2,0 3,-1 4,0; 4,0 5,1 6,0"),
            ("M0 0T4 0", "0,0 0,0 4,0"),
            ("M0 0a1 1 0 011 1", "0,0 1,0 1,1"),
            ("M0 0a1 1 0 0 1 1 1", "0,0 1,0 1,1"),
            ("M 1e1 , 1E-1 L 0 0 ", "10,1/10 0,0"),
            ("", ""),
            ("  ", ""),
        ] {
            assert_eq!(read(text), expected, "{text}");
        }
    }

    #[test]
    fn faults_with_their_byte() {
        for (text, at, expected) in [
            ("L1 1", 0, "begin with M"),
            ("M1", 2, "end of the path"),
            ("M1 1 L", 6, "end of the path"),
            ("M1 1 X", 5, "'X'"),
            ("M1 1 L2 é", 8, "'é'"),
            ("M0 0a1 1 0 2 1 1 1", 11, "flag"),
            ("M0 0a1e20 1 30 0 1 .866025403784438647 .5", 5, "elliptic arc"),
            ("M1e9000 0", 1, "bits"),
            ("M1 1e99999 0", 3, "exponent"),
            ("M1,,2", 3, "','"),
        ] {
            let (offset, message) = parse(text, Meaning::Decimal, false).unwrap_err();
            assert_eq!(offset, at, "{text}: {message}");
            assert!(message.contains(expected), "{text}: {message}");
        }
        let arc = "M0 0a3 3 0 0 1 1 0";
        assert_eq!(parse(arc, Meaning::Decimal, true).unwrap_err().0, 5);
        let (paths, _) = parse(arc, Meaning::Decimal, false).unwrap();
        assert_eq!(paths[0].arcs, 1);
        assert!(paths[0].bound.is_some());
    }
}
