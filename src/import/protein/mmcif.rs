//! The loop `_atom_site` of mmCIF files.

use super::{Chains, Residue};
use crate::import::error::ImportError;
use crate::import::text::number;
use crate::import::{Format, Imported, Options};

/// A word of a file, and whether it was quoted: a quoted word is a value whatever it says.
struct Word<'a> {
    at: usize,
    text: &'a str,
    quoted: bool,
}

/// The words of a CIF file.
struct Words<'a> {
    text: &'a str,
    at: usize,
}

impl<'a> Words<'a> {
    fn next(&mut self) -> Result<Option<Word<'a>>, ImportError> {
        loop {
            let rest = self.text[self.at..].trim_start();
            let start = self.text.len() - rest.len();
            let line_start = start == 0 || self.text.as_bytes()[start - 1] == b'\n';
            let Some(first) = rest.bytes().next() else {
                self.at = start;
                return Ok(None);
            };
            let word = |from: usize, to: usize, quoted| {
                Ok(Some(Word {
                    at: start,
                    text: &self.text[from..to],
                    quoted,
                }))
            };
            match first {
                b'#' => self.at = start + rest.find('\n').unwrap_or(rest.len()),
                b';' if line_start => {
                    let length = rest
                        .find("\n;")
                        .ok_or_else(|| ImportError::at(self.text, start, "found a text field that does not end"))?;
                    self.at = start + length + 2;
                    return word(start + 1, start + length, true);
                }
                quote @ (b'\'' | b'"') => {
                    // Quotes inside of a word do not end it.
                    let bytes = rest.as_bytes();
                    let ends = |i: usize| bytes[i] == quote && bytes.get(i + 1).is_none_or(u8::is_ascii_whitespace);
                    let line = rest.find('\n').unwrap_or(rest.len());
                    let end = (1..line).find(|i| ends(*i)).ok_or_else(|| {
                        ImportError::at(self.text, start, "found quotes that do not end in their line")
                    })?;
                    self.at = start + end + 1;
                    return word(start + 1, start + end, true);
                }
                _ => {
                    let length = rest.find(char::is_whitespace).unwrap_or(rest.len());
                    self.at = start + length;
                    return word(start, start + length, false);
                }
            }
        }
    }
}

fn is_keyword(word: &Word) -> bool {
    let begins = |prefix: &str| {
        let start = word.text.as_bytes().get(..prefix.len());
        start.is_some_and(|start| start.eq_ignore_ascii_case(prefix.as_bytes()))
    };
    !word.quoted
        && (word.text.starts_with('_') || ["data_", "save_", "loop_", "stop_", "global_"].into_iter().any(begins))
}

/// The columns of the loop that are read.
struct Columns {
    atom: usize,
    coordinates: [usize; 3],
    chain: Option<usize>,
    residue: Option<usize>,
    insertion: Option<usize>,
    model: Option<usize>,
    element: Option<usize>,
}

impl Columns {
    fn new(names: &[&str]) -> Result<Columns, String> {
        let find = |name: &str| names.iter().position(|found| found.eq_ignore_ascii_case(name));
        let must = |name: &str| find(name).ok_or_else(|| format!("found no column {name} in the loop _atom_site"));
        let site = |name: &str| format!("_atom_site.{name}");
        // Names of authors where there are any: they are those that articles and viewers use.
        let either = |a: &str, b: &str| find(&site(a)).or_else(|| find(&site(b)));
        Ok(Columns {
            atom: must(&site("label_atom_id"))?,
            coordinates: [
                must(&site("Cartn_x"))?,
                must(&site("Cartn_y"))?,
                must(&site("Cartn_z"))?,
            ],
            chain: either("auth_asym_id", "label_asym_id"),
            residue: either("auth_seq_id", "label_seq_id"),
            insertion: find(&site("pdbx_PDB_ins_code")),
            model: find(&site("pdbx_PDB_model_num")),
            element: find(&site("type_symbol")),
        })
    }
}

/// Reads the backbones.
pub(in crate::import) fn read(text: &str, options: &Options) -> Result<Imported, ImportError> {
    let mut words = Words { text, at: 0 };
    let mut chains = Chains::default();
    let mut next = words.next()?;
    while let Some(word) = next {
        next = words.next()?;
        if word.quoted || !word.text.eq_ignore_ascii_case("loop_") {
            continue;
        }
        let mut names = Vec::new();
        while let Some(name) = next.take_if(|word| !word.quoted && word.text.starts_with('_')) {
            names.push(name.text);
            next = words.next()?;
        }
        if !names
            .first()
            .is_some_and(|name| name.to_ascii_lowercase().starts_with("_atom_site."))
        {
            continue;
        }
        let columns = Columns::new(&names).map_err(|message| ImportError::at(text, word.at, message))?;
        let mut row: Vec<Word> = Vec::with_capacity(names.len());
        while let Some(value) = next.take_if(|word| !is_keyword(word)) {
            row.push(value);
            if row.len() == names.len() {
                add(&mut chains, &columns, &row, text, options)?;
                row.clear();
            }
            next = words.next()?;
        }
        if let Some(first) = row.first() {
            let message = format!(
                "found {} values in a row of _atom_site, expected {}",
                row.len(),
                names.len()
            );
            return Err(ImportError::at(text, first.at, message));
        }
    }
    chains.finish(Format::Mmcif, options)
}

/// Adds the atom of a row if it is a Cα.
fn add(chains: &mut Chains, columns: &Columns, row: &[Word], text: &str, options: &Options) -> Result<(), ImportError> {
    let get = |column: Option<usize>| column.map_or("", |column| row[column].text);
    // An atom "CA" of another element is calcium.
    if row[columns.atom].text != "CA" || !matches!(get(columns.element), "C" | "" | "." | "?") {
        return Ok(());
    }
    let mut point = Vec::new();
    for column in columns.coordinates {
        let word = &row[column];
        let value = number(word.text, options.meaning);
        point.push(
            value.map_err(|message| ImportError::at(text, word.at, format!("a coordinate of an atom: {message}")))?,
        );
    }
    let residue = Residue {
        number: get(columns.residue).parse().ok(),
        insertion: get(columns.insertion).to_string(),
    };
    let model = match get(columns.model) {
        "" => "1",
        model => model,
    };
    chains.add(model, get(columns.chain), residue, point);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::import::text::ratio;

    const FILE: &str = "data_TEST\n_cell.a 1\n_struct.title\n;A text; loop_\n_atom_site.x\n;\nloop_\n_other.a\n_other.b\n1 'it''s x' \"2\" '_y'\n\
        loop_\n_atom_site.group_PDB\n_atom_site.type_symbol\n_atom_site.label_atom_id\n_atom_site.label_asym_id\n_atom_site.auth_asym_id\n_atom_site.label_seq_id\n\
        _atom_site.Cartn_x\n_atom_site.Cartn_y\n_atom_site.Cartn_z\n_atom_site.pdbx_PDB_model_num\n\
        ATOM C CA A X 1 0.1 0.0 0.0 1\nATOM N N A X 2 9 9 9 1 # comment\nATOM C 'CA' A X 2 3.8 0.0 0.0 1\nHETATM CA CA B Y . 5 5 5 1\nATOM C CA A X 3 3.8 3.8 0.0 1\n#\n";

    #[test]
    fn the_loop_of_atoms() {
        let read = read(FILE, &Options::default()).unwrap();
        assert_eq!(read.curves.len(), 1);
        assert_eq!(read.curves[0].name, "X");
        let chain = read.curves[0].curve.chain();
        assert_eq!(chain.count(), 2);
        assert_eq!(chain.pieces()[0].point(0)[0], ratio(1, 10));
    }

    #[test]
    fn faults_with_line_and_column() {
        for (from, to, expected) in [
            ("3.8 0.0 0.0 1", "3.8 zero 0.0 1", "line 24 column 23: a coordinate"),
            ("3.8 3.8 0.0 1", "3.8 3.8 0.0", "line 26 column 1: found 9 values"),
            ("_atom_site.Cartn_z\n", "", "found no column _atom_site.Cartn_z"),
            ("'CA'", "'CA", "line 24 column 8: found quotes"),
            ("\n;\n", "\n", "line 4 column 1: found a text field"),
        ] {
            let text = FILE.replace(from, to);
            assert_ne!(text, FILE);
            let error = read(&text, &Options::default()).unwrap_err().to_string();
            assert!(error.contains(expected), "{to}: {error}");
        }
    }
}
