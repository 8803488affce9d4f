//! Which format a file has, by its first bytes.

/// A format that curves are read from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// A curve file of this project, `curve/1`.
    Curve,
    /// The JSON files of geomdl (NURBS-Python).
    Geomdl,
    /// Scalable Vector Graphics.
    Svg,
    /// A TrueType or OpenType font.
    Font,
    /// Geomview's lists of polylines.
    Vect,
    /// STEP, ISO 10303-21.
    Step,
    /// IGES in fixed columns.
    Iges,
    /// A protein structure in the columns of the Protein Data Bank.
    Pdb,
    /// A protein structure in the Crystallographic Information Format.
    Mmcif,
}

impl Format {
    /// All formats.
    pub const ALL: [Format; 9] = [
        Format::Curve,
        Format::Geomdl,
        Format::Svg,
        Format::Font,
        Format::Vect,
        Format::Step,
        Format::Iges,
        Format::Pdb,
        Format::Mmcif,
    ];

    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Format::Curve => "curve",
            Format::Geomdl => "geomdl",
            Format::Svg => "svg",
            Format::Font => "font",
            Format::Vect => "vect",
            Format::Step => "step",
            Format::Iges => "iges",
            Format::Pdb => "pdb",
            Format::Mmcif => "mmcif",
        }
    }

    /// Its name for people.
    pub fn description(self) -> &'static str {
        match self {
            Format::Curve => "curve/1 JSON",
            Format::Geomdl => "geomdl JSON",
            Format::Svg => "SVG",
            Format::Font => "TrueType or OpenType font",
            Format::Vect => "Geomview VECT",
            Format::Step => "STEP",
            Format::Iges => "IGES",
            Format::Pdb => "PDB",
            Format::Mmcif => "mmCIF",
        }
    }
}

/// What PDB files begin with: the records of the title section, and those of files cut out of others.
const PDB_RECORDS: [&[u8]; 16] = [
    b"HEADER", b"OBSLTE", b"TITLE ", b"SPLIT ", b"CAVEAT", b"COMPND", b"SOURCE", b"KEYWDS", b"EXPDTA", b"AUTHOR",
    b"REVDAT", b"REMARK", b"CRYST1", b"MODEL ", b"ATOM  ", b"HETATM",
];

/// The format that the first bytes of a file show; nothing when they show none.
pub fn detect(bytes: &[u8]) -> Option<Format> {
    if [&b"\0\x01\0\0"[..], b"OTTO", b"true", b"ttcf"]
        .iter()
        .any(|tag| bytes.starts_with(tag))
    {
        return Some(Format::Font);
    }
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let start = bytes.trim_ascii_start();
    match start.first()? {
        b'<' => return Some(Format::Svg),
        b'{' => {
            let inside = start[1..].trim_ascii_start();
            let inside = inside.strip_prefix(b"=").unwrap_or(inside).trim_ascii_start();
            let mentions = |word: &[u8]| start.windows(word.len()).any(|window| window == word);
            return Some(match inside.starts_with(b"VECT") {
                true => Format::Vect,
                false if mentions(b"\"shape\"") && !mentions(b"\"knotproof\"") => Format::Geomdl,
                false => Format::Curve,
            });
        }
        _ => {}
    }
    if start.starts_with(b"ISO-10303-21") {
        return Some(Format::Step);
    }
    if start.starts_with(b"VECT") {
        return Some(Format::Vect);
    }
    if start.get(..5).is_some_and(|word| word.eq_ignore_ascii_case(b"data_")) {
        return Some(Format::Mmcif);
    }
    if PDB_RECORDS.iter().any(|record| start.starts_with(record)) {
        return Some(Format::Pdb);
    }
    // Comments may stand before these.
    if start.starts_with(b"#") {
        let after = start
            .split(|b| *b == b'\n')
            .map(<[u8]>::trim_ascii)
            .find(|line| !line.is_empty() && !line.starts_with(b"#"))?;
        let is_data = after.get(..5).is_some_and(|word| word.eq_ignore_ascii_case(b"data_"));
        return match is_data {
            true => Some(Format::Mmcif),
            false => after.starts_with(b"VECT").then_some(Format::Vect),
        };
    }
    // The section's letter stands in column 73 of every line, and its number in the columns after it.
    let line = bytes.split(|b| *b == b'\n').next()?;
    let number = line.get(73..80)?.trim_ascii();
    (line[72] == b'S' && !number.is_empty() && number.iter().all(u8::is_ascii_digit)).then_some(Format::Iges)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formats_by_their_first_bytes() {
        let iges = format!("{:72}S{:7}\n", "a title", 1);
        for (start, expected) in [
            (&b"\0\x01\0\0\0\x0c"[..], Some(Format::Font)),
            (b"OTTO\0", Some(Format::Font)),
            (b"\xef\xbb\xbf <?xml version='1.0'?>", Some(Format::Svg)),
            (b"<svg>", Some(Format::Svg)),
            (b"{ \"knotproof\": \"curve/1\" }", Some(Format::Curve)),
            (b"{ \"name\": 1 }", Some(Format::Curve)),
            (b"{\"shape\": {}}", Some(Format::Geomdl)),
            (b"{ = VECT 1 2 3", Some(Format::Vect)),
            (b"VECT\n1 2", Some(Format::Vect)),
            (b"# knot\nVECT\n1 2", Some(Format::Vect)),
            (b"ISO-10303-21;", Some(Format::Step)),
            (b"data_1UBQ\n", Some(Format::Mmcif)),
            (b"# x\n#\ndata_1UBQ\n", Some(Format::Mmcif)),
            (b"HEADER    CHROMOSOMAL", Some(Format::Pdb)),
            (b"ATOM      1  N", Some(Format::Pdb)),
            (iges.as_bytes(), Some(Format::Iges)),
            (b"wOF2", None),
            (b"knots", None),
            (b"", None),
        ] {
            assert_eq!(detect(start), expected, "{}", String::from_utf8_lossy(start));
        }
        for format in Format::ALL {
            assert!(!format.name().is_empty() && !format.description().is_empty());
        }
    }
}
