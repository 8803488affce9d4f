//! Writes a benchmark chain as a `curve/1` file:
//! `cargo run --release --example generate -- KIND PIECES SEED OUTPUT`, where OUTPUT `-` is standard output.
//! Kinds and what they mean: `chains.rs`. Coordinates of the decimal kinds are JSON numbers with up to three places,
//! the others exact hexadecimal floating-point strings.

mod chains;

use chains::{Kind, Piece, chain};
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match run(&arguments) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("generate: {message}");
            ExitCode::from(2)
        }
    }
}

fn run(arguments: &[String]) -> Result<(), String> {
    let names: Vec<&str> = Kind::NAMES.iter().map(|(name, _)| *name).collect();
    let [kind, pieces, seed, output] = arguments else {
        return Err(format!("usage: generate {} PIECES SEED OUTPUT", names.join("|")));
    };
    let kind =
        Kind::from_name(kind).ok_or_else(|| format!("unknown kind {kind:?}, expected one of {}", names.join(", ")))?;
    let count = pieces.parse().map_err(|error| format!("PIECES {pieces:?}: {error}"))?;
    let seed = seed.parse().map_err(|error| format!("SEED {seed:?}: {error}"))?;
    let chain = chain(kind, count, seed)?;
    let name = format!("{kind:?}, {count} cubic pieces, seed {seed}");
    let written = match output.as_str() {
        "-" => write_curve(io::stdout().lock(), kind, &name, &chain),
        path => File::create(path).and_then(|file| write_curve(file, kind, &name, &chain)),
    };
    written.map_err(|error| format!("{output}: {error}"))
}

/// Writes the chain piece by piece, one line each.
fn write_curve(sink: impl Write, kind: Kind, name: &str, chain: &[Piece]) -> io::Result<()> {
    let mut out = BufWriter::with_capacity(1 << 16, sink);
    writeln!(
        out,
        "{{\"knotproof\":\"curve/1\",\"name\":\"{name}\",\"numbers\":\"decimal\","
    )?;
    if kind.closed() {
        writeln!(out, "\"closed\":true,")?;
    }
    writeln!(out, "\"bezier\":{{\"pieces\":[")?;
    for (i, piece) in chain.iter().enumerate() {
        write!(out, "{}{{\"points\":[", if i == 0 { "" } else { ",\n" })?;
        for (j, point) in piece.iter().enumerate() {
            write!(out, "{}[", if j == 0 { "" } else { "," })?;
            for (k, &x) in point.iter().enumerate() {
                let comma = if k == 0 { "" } else { "," };
                if kind.decimal() {
                    // The shortest decimal that reads back as x: the three-place decimal x was made from.
                    write!(out, "{comma}{x}")?;
                } else {
                    write!(out, "{comma}\"{}\"", hexadecimal(x))?;
                }
            }
            write!(out, "]")?;
        }
        write!(out, "]}}")?;
    }
    writeln!(out, "\n]}}}}")?;
    out.flush()
}

/// The exact value of a finite binary64 in the notation of C99 `%a`, such as `-0x1.8p-3`.
fn hexadecimal(x: f64) -> String {
    let bits = x.to_bits();
    let sign = if bits >> 63 == 1 { "-" } else { "" };
    let fraction = bits & ((1 << 52) - 1);
    let (lead, exponent) = match (bits >> 52) & 0x7ff {
        0 if fraction == 0 => return format!("{sign}0x0p0"),
        0 => (0, -1022),
        biased => (1, biased as i64 - 1023),
    };
    let digits = format!("{fraction:013x}");
    match digits.trim_end_matches('0') {
        "" => format!("{sign}0x{lead}p{exponent}"),
        digits => format!("{sign}0x{lead}.{digits}p{exponent}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hexadecimal_of_known_values() {
        let cases = [
            (0.0, "0x0p0"),
            (1.0, "0x1p0"),
            (-0.1875, "-0x1.8p-3"),
            (0.1, "0x1.999999999999ap-4"),
            (f64::MAX, "0x1.fffffffffffffp1023"),
            (f64::from_bits(1), "0x0.0000000000001p-1022"),
        ];
        for (x, expected) in cases {
            assert_eq!(hexadecimal(x), expected);
        }
    }

    #[test]
    fn decimal_kinds_print_at_most_three_places() {
        let chain = chain(Kind::CAlpha, 300, 1).expect("accepted size");
        for x in chain.iter().flatten().flatten() {
            let text = x.to_string();
            assert!(
                text.split_once('.').is_none_or(|(_, places)| places.len() <= 3),
                "{text}"
            );
            assert_ne!(text, "-0");
        }
    }

    #[test]
    fn written_curves_are_json_of_the_right_shape() {
        for (_, kind) in Kind::NAMES {
            let chain = chain(kind, 5, 9).expect("accepted size");
            let mut text = Vec::new();
            write_curve(&mut text, kind, "test", &chain).expect("writes to memory");
            let value: serde_json::Value = serde_json::from_slice(&text).expect("JSON");
            assert_eq!(value["knotproof"], "curve/1");
            let pieces = value["bezier"]["pieces"].as_array().expect("pieces");
            assert_eq!(pieces.len(), 5);
            for (piece, json) in chain.iter().zip(pieces) {
                assert_eq!(json["points"].as_array().map(Vec::len), Some(4));
                if kind.decimal() {
                    assert_eq!(json["points"][2][1].as_f64(), Some(piece[2][1]));
                } else {
                    assert_eq!(json["points"][2][1], hexadecimal(piece[2][1]));
                }
            }
        }
    }

    #[test]
    fn bad_arguments_are_errors() {
        for line in [
            "",
            "calpha 5 1",
            "spiral 5 1 -",
            "calpha x 1 -",
            "calpha 5 -1 -",
            "closed-polygon 2 1 -",
        ] {
            let arguments: Vec<String> = line.split_whitespace().map(String::from).collect();
            assert!(run(&arguments).is_err(), "{line}");
        }
    }
}
