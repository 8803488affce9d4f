//! The syntax of STEP files, ISO 10303-21.

use std::collections::HashMap;

use crate::import::error::ImportError;

/// How deep lists may be nested.
const DEEPEST: usize = 16;

/// A parameter of an entity.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Value<'a> {
    /// A number, as it is written.
    Number(&'a str),
    /// `#12`
    Reference(u64),
    /// `'text'`, as it is written inside the quotes.
    Text(&'a str),
    /// `.NAME.`, without the points.
    Enumeration(&'a str),
    /// `(…)`
    List(Vec<Value<'a>>),
    /// `$`, `*`, `NAME(…)` and binary values, of which no curve is made.
    Other,
}

/// An entity: its records, one, or several of a complex entity, by name.
pub(super) type Records<'a> = Vec<(&'a str, Vec<Value<'a>>)>;

/// Where the entities of the data sections are: the byte after `=`.
pub(super) struct Index<'a> {
    text: &'a str,
    starts: HashMap<u64, usize>,
    /// In the order of the file.
    pub(super) order: Vec<u64>,
}

/// A place in the text.
struct Cursor<'a> {
    text: &'a str,
    at: usize,
}

impl<'a> Cursor<'a> {
    fn peek(&self) -> Option<u8> {
        self.text.as_bytes().get(self.at).copied()
    }

    fn error(&self, expected: &str) -> ImportError {
        let found = match self.text.get(self.at..).and_then(|rest| rest.chars().next()) {
            Some(c) => format!("{c:?}"),
            None => "the end of the file".into(),
        };
        ImportError::at(self.text, self.at, format!("found {found}, expected {expected}"))
    }

    /// Passes spaces and comments.
    fn skip(&mut self) -> Result<(), ImportError> {
        loop {
            while self.peek().is_some_and(|b| b.is_ascii_whitespace()) {
                self.at += 1;
            }
            if !self.text.as_bytes()[self.at..].starts_with(b"/*") {
                return Ok(());
            }
            match self.text.as_bytes()[self.at..].windows(2).position(|w| w == b"*/") {
                Some(length) => self.at += length + 2,
                None => return Err(self.error("a comment that ends")),
            }
        }
    }

    fn take(&mut self, byte: u8) -> Result<bool, ImportError> {
        self.skip()?;
        let there = self.peek() == Some(byte);
        self.at += usize::from(there);
        Ok(there)
    }

    fn expect(&mut self, byte: u8, expected: &str) -> Result<(), ImportError> {
        match self.take(byte)? {
            true => Ok(()),
            false => Err(self.error(expected)),
        }
    }

    fn run(&mut self, accept: impl Fn(u8) -> bool) -> &'a str {
        let start = self.at;
        while self.peek().is_some_and(&accept) {
            self.at += 1;
        }
        // Only ASCII was passed.
        self.text.get(start..self.at).unwrap_or("")
    }

    /// The inside of quotes; a doubled quote stands for one.
    fn quoted(&mut self, quote: u8) -> Result<&'a str, ImportError> {
        let opening = self.at;
        self.at += 1;
        let start = self.at;
        loop {
            match self.peek() {
                None => {
                    self.at = opening;
                    return Err(self.error("quotes that end"));
                }
                Some(b) if b == quote => {
                    if self.text.as_bytes().get(self.at + 1) != Some(&quote) {
                        self.at += 1;
                        return Ok(self.text.get(start..self.at - 1).unwrap_or(""));
                    }
                    self.at += 2;
                }
                Some(_) => self.at += 1,
            }
        }
    }

    fn name(&mut self) -> &'a str {
        self.run(|b| b.is_ascii_alphanumeric() || b == b'_' || b == b'!' || b == b'-')
    }

    fn number_of_entity(&mut self) -> Result<u64, ImportError> {
        self.at += 1;
        let digits = self.run(|b| b.is_ascii_digit());
        digits.parse().map_err(|_| self.error("the number of an entity"))
    }

    /// The values between parentheses, the first of which is passed already.
    fn values(&mut self, depth: usize) -> Result<Vec<Value<'a>>, ImportError> {
        let mut values = Vec::new();
        if self.take(b')')? {
            return Ok(values);
        }
        loop {
            values.push(self.value(depth)?);
            if self.take(b')')? {
                return Ok(values);
            }
            self.expect(b',', "\",\" or \")\"")?;
        }
    }

    fn value(&mut self, depth: usize) -> Result<Value<'a>, ImportError> {
        self.skip()?;
        let depth = depth
            .checked_sub(1)
            .ok_or_else(|| self.error("lists that are not nested so deep"))?;
        match self.peek() {
            Some(b'#') => Ok(Value::Reference(self.number_of_entity()?)),
            Some(b'\'') => Ok(Value::Text(self.quoted(b'\'')?)),
            Some(b'"') => {
                self.quoted(b'"')?;
                Ok(Value::Other)
            }
            Some(b'$' | b'*') => {
                self.at += 1;
                Ok(Value::Other)
            }
            Some(b'(') => {
                self.at += 1;
                Ok(Value::List(self.values(depth)?))
            }
            Some(b'.') => {
                self.at += 1;
                let name = self.name();
                self.expect(b'.', "\".\"")?;
                Ok(Value::Enumeration(name))
            }
            Some(b'0'..=b'9' | b'+' | b'-') => Ok(Value::Number(
                self.run(|b| matches!(b, b'0'..=b'9' | b'+' | b'-' | b'.' | b'E' | b'e')),
            )),
            Some(b) if b.is_ascii_alphabetic() => {
                self.name();
                self.expect(b'(', "\"(\"")?;
                self.values(depth)?;
                Ok(Value::Other)
            }
            _ => Err(self.error("a value")),
        }
    }
}

impl<'a> Index<'a> {
    /// Finds all entities. Their parameters are not read yet.
    pub(super) fn new(text: &'a str) -> Result<Index<'a>, ImportError> {
        let mut cursor = Cursor { text, at: 0 };
        let mut index = Index {
            text,
            starts: HashMap::new(),
            order: Vec::new(),
        };
        cursor.skip()?;
        if !text.as_bytes()[cursor.at..].starts_with(b"ISO-10303-21") {
            return Err(cursor.error("ISO-10303-21"));
        }
        loop {
            cursor.skip()?;
            if cursor.peek().is_none() {
                return Ok(index);
            }
            if cursor.peek() == Some(b'#') {
                let at = cursor.at;
                let number = cursor.number_of_entity()?;
                cursor.expect(b'=', "\"=\"")?;
                cursor.skip()?;
                if index.starts.insert(number, cursor.at).is_some() {
                    return Err(ImportError::at(
                        text,
                        at,
                        format!("found the entity #{number} a second time"),
                    ));
                }
                index.order.push(number);
            }
            // To the end of the statement.
            loop {
                cursor.skip()?;
                match cursor.peek() {
                    None => return Err(cursor.error("\";\"")),
                    Some(b';') => break,
                    Some(quote @ (b'\'' | b'"')) => {
                        cursor.quoted(quote)?;
                    }
                    Some(_) => cursor.at += 1,
                }
            }
            cursor.at += 1;
        }
    }

    /// Whether an entity is, or has among its records, one of a name that `test` accepts; a quick look without reading it.
    pub(super) fn mentions(&self, number: u64, test: impl Fn(&str) -> bool) -> bool {
        let Some(start) = self.starts.get(&number) else {
            return false;
        };
        let mut cursor = Cursor {
            text: self.text,
            at: *start,
        };
        if cursor.peek() != Some(b'(') {
            return test(cursor.name());
        }
        self.records(number)
            .is_ok_and(|records| records.iter().any(|(name, _)| test(name)))
    }

    /// The records of an entity.
    pub(super) fn records(&self, number: u64) -> Result<Records<'a>, ImportError> {
        let Some(start) = self.starts.get(&number) else {
            return Err(ImportError::entity(
                number,
                "found a reference to it, expected it in the file",
            ));
        };
        let mut cursor = Cursor {
            text: self.text,
            at: *start,
        };
        let several = cursor.take(b'(')?;
        let mut records = Vec::new();
        loop {
            cursor.skip()?;
            let name = cursor.name();
            if name.is_empty() {
                return Err(cursor.error("the name of an entity"));
            }
            cursor.expect(b'(', "\"(\"")?;
            records.push((name, cursor.values(DEEPEST)?));
            if !several || cursor.take(b')')? {
                return Ok(records);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entities_and_their_values() {
        let text = "ISO-10303-21; /* ; */ DATA;\n#1 = A ( 'it''s; (', #2, .T., $, (1., -2.5E3), B(1), \"0F\" ) ;\n#2=(X()Y(1,2));END";
        let error = Index::new(text).err().expect("no last semicolon").to_string();
        assert!(error.starts_with("line 3 column"), "{error}");
        let text = text.to_string() + ";";
        let index = Index::new(&text).unwrap();
        assert_eq!(index.order, [1, 2]);
        let records = index.records(1).unwrap();
        let numbers = vec![Value::Number("1."), Value::Number("-2.5E3")];
        let expected = vec![
            Value::Text("it''s; ("),
            Value::Reference(2),
            Value::Enumeration("T"),
            Value::Other,
            Value::List(numbers),
            Value::Other,
            Value::Other,
        ];
        assert_eq!(records, [("A", expected)]);
        let records = index.records(2).unwrap();
        assert_eq!(records[0], ("X", vec![]));
        assert_eq!(records[1].1.len(), 2);
        assert!(index.mentions(2, |name| name == "Y"));
        assert!(!index.mentions(1, |name| name == "Y"));
        assert!(index.records(3).is_err());
    }

    #[test]
    fn faults_are_found() {
        for (data, expected) in [
            ("#1=A(1;", "found ';', expected \",\" or \")\""),
            ("#1=A(1,);", "expected a value"),
            ("#1=(A(1)", "\";\""),
            ("#1=A('x);", "quotes"),
            ("#1=A(((((((((((((((((((1)))))))))))))))))));", "nested"),
            ("#=A(1);", "number of an entity"),
            ("#1=A();#1=B();", "a second time"),
            ("/* ", "comment"),
            ("#1=;", "name of an entity"),
        ] {
            let text = format!("ISO-10303-21;{data}");
            let error = match Index::new(&text) {
                Err(error) => error.to_string(),
                Ok(index) => index.records(1).expect_err(data).to_string(),
            };
            assert!(error.contains(expected), "{data}: {error}");
            assert!(error.contains("line 1 column"), "{error}");
        }
    }
}
