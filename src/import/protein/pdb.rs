//! The fixed columns of the PDB format, version 3.3.

use super::{Chains, Residue};
use crate::import::error::ImportError;
use crate::import::text::number;
use crate::import::{Format, Imported, Options};

/// The columns of a line, counted from 1 as the format does.
fn columns(line: &str, from: usize, to: usize) -> &str {
    line.get(from - 1..to.min(line.len())).unwrap_or("")
}

/// Reads the backbones.
pub(in crate::import) fn read(text: &str, options: &Options) -> Result<Imported, ImportError> {
    let mut chains = Chains::default();
    let mut model = "1".to_string();
    let mut offset = 0;
    for full in text.split_inclusive('\n') {
        let line = full.trim_end_matches(['\r', '\n']);
        let start = offset;
        offset += full.len();
        if columns(line, 1, 6) == "MODEL " {
            model = columns(line, 7, 14).trim().to_string();
        }
        // A residue that is changed stands among HETATM; calcium is written one column to the left.
        if !matches!(columns(line, 1, 6), "ATOM  " | "HETATM") || columns(line, 13, 16) != " CA " {
            continue;
        }
        let mut point = Vec::new();
        for (from, to) in [(31, 38), (39, 46), (47, 54)] {
            let word = columns(line, from, to);
            let value = number(word.trim(), options.meaning);
            let at = start + from - 1 + (word.len() - word.trim_start().len());
            point.push(
                value.map_err(|message| ImportError::at(text, at, format!("a coordinate of an atom: {message}")))?,
            );
        }
        let name = columns(line, 22, 22).trim();
        let residue = Residue {
            number: columns(line, 23, 26).trim().parse().ok(),
            insertion: columns(line, 27, 27).trim().to_string(),
        };
        chains.add(&model, if name.is_empty() { "_" } else { name }, residue, point);
    }
    chains.finish(Format::Pdb, options)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::import::Note;
    use crate::import::text::{ratio, whole};

    fn atom(record: &str, name: &str, place: char, chain: char, residue: i64, at: [&str; 3]) -> String {
        let [x, y, z] = at;
        format!(
            "{record:6}{:5} {name:4}{place}ALA {chain}{residue:4}    {x:>8}{y:>8}{z:>8}  1.00  0.00           C\n",
            1
        )
    }

    fn file() -> String {
        let mut text = "HEADER    HYDROLASE\n".to_string();
        text += &atom("ATOM", " N  ", ' ', 'A', 1, ["0.5", "0.5", "0.5"]);
        text += &atom("ATOM", " CA ", 'A', 'A', 1, ["0.000", "0.000", "0.100"]);
        text += &atom("ATOM", " CA ", 'B', 'A', 1, ["0.100", "0.000", "0.000"]);
        text += &atom("HETATM", " CA ", ' ', 'A', 2, ["3.800", "0.000", "0.000"]);
        text += &atom("HETATM", "CA  ", ' ', 'A', 90, ["9.0", "9.0", "9.0"]);
        text += &atom("ATOM", " CA ", ' ', 'A', 5, ["3.800", "3.800", "0.000"]);
        text += &atom("ATOM", " CA ", ' ', 'B', 1, ["1.0", "1.0", "1.0"]);
        text
    }

    #[test]
    fn chains_of_residues() {
        let read = read(&file(), &Options::default()).unwrap();
        assert_eq!(read.curves.len(), 1);
        let curve = &read.curves[0];
        assert_eq!(curve.name, "A");
        assert_eq!(curve.notes, [Note::Bridged { gaps: 1 }, Note::Smoothed]);
        let chain = curve.curve.chain();
        assert_eq!(chain.count(), 2);
        assert_eq!(chain.evaluate(&whole(0)).unwrap(), [whole(0), whole(0), ratio(1, 10)]);
        assert_eq!(read.notes, ["chains of a single residue left out: 1"]);
    }

    #[test]
    fn models_are_named_when_there_are_several() {
        let text = format!("MODEL        1\n{0}ENDMDL\nMODEL        2\n{0}ENDMDL\n", file());
        let read = read(&text, &Options::default()).unwrap();
        let names: Vec<&str> = read.curves.iter().map(|curve| curve.name.as_str()).collect();
        assert_eq!(names, ["1/A", "2/A"]);
        assert_eq!(read.select("2"), [1]);
        assert_eq!(read.select("A"), [0, 1]);
    }

    #[test]
    fn faults_with_line_and_column() {
        for (from, to, expected) in [
            ("   3.800   3.800", "   3.8x0   3.800", "line 7 column 34"),
            (
                "   3.800   3.800",
                "           3.800",
                "line 7 column 39: a coordinate of an atom: found an empty",
            ),
        ] {
            let text = file().replace(from, to);
            assert_ne!(text, file());
            let error = read(&text, &Options::default()).unwrap_err().to_string();
            assert!(error.contains(&expected[..14]), "{error}");
        }
        let cut: String = file()
            .lines()
            .take(3)
            .map(|line| line.chars().take(40).collect::<String>() + "\n")
            .collect();
        assert!(read(&cut, &Options::default()).is_err());
    }
}
