//! Files of other formats: the curves that come out, exactly, and errors that name the place.
#![cfg(feature = "import")]

use std::path::{Path, PathBuf};

use knotproof::curve::{Curve, Form, read_curve, write_curve};
use knotproof::import::{Format, Imported, Note, Options, detect, import, import_as};
use knotproof::number::{Integer, Meaning, Rational, RationalExt};
use proptest::prelude::*;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/import")
}

/// The files made by hand, by name, with the format that each shows.
const SAMPLES: [(&str, Format); 9] = [
    ("drawing.svg", Format::Svg),
    ("curve.geomdl.json", Format::Geomdl),
    ("square.vect", Format::Vect),
    ("curves.step", Format::Step),
    ("curves.igs", Format::Iges),
    ("residues.pdb", Format::Pdb),
    ("residues.cif", Format::Mmcif),
    ("letters.ttf", Format::Font),
    ("letters.otf", Format::Font),
];

fn bytes(name: &str) -> Vec<u8> {
    std::fs::read(folder().join(name)).expect("a sample")
}

fn read_with(name: &str, options: &Options) -> Imported {
    import(&bytes(name), options).unwrap_or_else(|error| panic!("{name}: {error}"))
}

fn read(name: &str) -> Imported {
    read_with(name, &Options::default())
}

/// The curve of a name.
fn curve<'i>(imported: &'i Imported, name: &str) -> &'i Curve {
    let [i] = imported.select(name)[..] else {
        panic!("{name} among {:?}", names(imported))
    };
    &imported.curves[i].curve
}

fn names(imported: &Imported) -> Vec<&str> {
    imported.curves.iter().map(|curve| curve.name.as_str()).collect()
}

/// The control points of all pieces, and weights in brackets where there are any.
fn points(curve: &Curve) -> String {
    let chain = curve.chain();
    let pieces = chain.pieces().iter().map(|piece| {
        let point = |k| {
            piece
                .point(k)
                .iter()
                .map(Rational::format)
                .collect::<Vec<_>>()
                .join(",")
        };
        let mut text = (0..=piece.degree()).map(point).collect::<Vec<_>>().join(" ");
        if let Some(weights) = piece.weights() {
            text += &format!(
                " [{}]",
                weights.iter().map(|w| w.format()).collect::<Vec<_>>().join(" ")
            );
        }
        text
    });
    pieces.collect::<Vec<_>>().join("; ")
}

#[test]
fn every_sample_shows_its_format() {
    for (name, format) in SAMPLES {
        assert_eq!(detect(&bytes(name)), Some(format), "{name}");
        assert_eq!(read(name).format, format);
    }
}

#[test]
fn a_drawing() {
    let drawing = read("drawing.svg");
    assert_eq!(
        names(&drawing),
        ["wave", "two/0", "two/1", "ring", "path2", "slanted", "almost"]
    );
    assert_eq!(
        points(curve(&drawing, "wave")),
        "0,1/10 0,1 1,1 1,1/10; 1,1/10 1,-4/5 2,-4/5 2,1/10"
    );
    assert_eq!(points(curve(&drawing, "two/0")), "0,0 4,0; 4,0 4,4; 4,4 0,0");
    assert_eq!(points(curve(&drawing, "two/1")), "10,10 11,12 12,10; 12,10 13,8 14,10");
    assert_eq!(drawing.select("two"), [1, 2]);
    assert_eq!(
        points(curve(&drawing, "ring")),
        "13,2 13,3 12,3 [1 1 2]; 12,3 11,3 11,2 [1 1 2]; 11,2 11,1 12,1 [1 1 2]; 12,1 13,1 13,2 [1 1 2]"
    );
    assert_eq!(points(curve(&drawing, "path2")), "26,12 26,16 22,16 [1 1 2]");
    let slanted = &drawing.curves[5];
    let [Note::Approximated { arcs: 1, bound }] = &slanted.notes[..] else {
        panic!("{:?}", slanted.notes)
    };
    assert!(bound.to_f64() > 0.0 && bound.to_f64() < 1e-9);
    assert!(
        slanted
            .title()
            .starts_with("slanted [1 arc approximated, distance at most ")
    );
    assert_eq!(
        drawing.notes,
        [
            "subpaths without length left out: 1",
            "shapes inside of defs and the like left out: 1",
            "elements use, text, image and foreignObject not read: 1"
        ]
    );
    // Numbers below one unit of the last decimal may be rounding; the polygon's last point is one such unit from the first.
    let welded = read_with(
        "drawing.svg",
        &Options {
            weld: true,
            ..Options::default()
        },
    );
    assert_eq!(points(curve(&welded, "almost")), "0,0 3,0; 3,0 3,3; 3,3 0,0");
    assert_eq!(
        points(curve(&drawing, "almost")),
        "0,0 3,0; 3,0 3,3; 3,3 1/10,0; 1/10,0 0,0"
    );
    let options = Options {
        exact: true,
        ..Options::default()
    };
    let error = import(&bytes("drawing.svg"), &options).unwrap_err().to_string();
    assert!(
        error.starts_with("line 11 column 56: path transform: found a rotation"),
        "{error}"
    );
}

#[test]
fn binary64_is_asked_for() {
    let options = Options {
        meaning: Meaning::Binary64,
        ..Options::default()
    };
    let tenth = Rational::from_f64(0.1).expect("finite");
    let drawing = read_with("drawing.svg", &options);
    assert_eq!(curve(&drawing, "wave").chain().pieces()[0].point(0)[1], tenth);
    let exact = Rational::new(Integer::from(1), Integer::from(10));
    for name in ["residues.pdb", "residues.cif"] {
        assert_eq!(curve(&read(name), "A").chain().pieces()[0].point(0)[2], exact);
        assert_eq!(
            curve(&read_with(name, &options), "A").chain().pieces()[0].point(0)[2],
            tenth
        );
    }
}

#[test]
fn splines() {
    let geomdl = read("curve.geomdl.json");
    let Form::BSpline(spline) = geomdl.curves[0].curve.form() else {
        panic!("a spline")
    };
    assert_eq!((spline.degree(), spline.dimension()), (2, 3));
    assert_eq!(spline.knots().get(3).format(), "2/5");
    assert_eq!(spline.points().get(0).format(), "1/10");
    assert_eq!(spline.weights().expect("weights").get(1).format(), "1/2");
    let step = read("curves.step");
    assert_eq!(names(&step), ["#10", "#11", "#12"]);
    assert_eq!(points(curve(&step, "seam")), "0,0,0 1,2,1/10 2,-2,1/5 3,0,3/10");
    assert_eq!(
        points(curve(&step, "half circle")),
        "1,0 1,1 0,1 [1 1 2]; 0,1 -1,1 -1,0 [2 1 1]"
    );
    assert_eq!(curve(&step, "#12").chain().count(), 2);
    let iges = read("curves.igs");
    assert_eq!(names(&iges), ["#1", "#3"]);
    assert_eq!(points(curve(&iges, "#1")), "0,0 1,2 2,-2 3,0");
    // Cut to the first half by its parameters.
    let Form::BSpline(half) = curve(&iges, "#3").form() else {
        panic!("a spline")
    };
    assert_eq!(half.domain().1.format(), "1/2");
    assert_eq!(half.dimension(), 3);
}

#[test]
fn polygons_and_backbones() {
    let vect = read("square.vect");
    assert_eq!(names(&vect), ["polyline0", "polyline1"]);
    assert_eq!(
        points(curve(&vect, "0")),
        "0,0,0 1,0,1/2; 1,0,1/2 1,1,0; 1,1,0 0,1,1/2; 0,1,1/2 0,0,0"
    );
    let pdb = read("residues.pdb");
    assert_eq!(names(&pdb), ["A", "B"]);
    assert_eq!(pdb.curves[0].notes, [Note::Bridged { gaps: 1 }, Note::Smoothed]);
    assert_eq!(points(curve(&pdb, "B")), "9,9,9 9,9,154/15 9,9,173/15 9,9,64/5");
    let cif = read("residues.cif");
    assert_eq!(
        cif.curves.iter().map(|c| &c.curve).collect::<Vec<_>>(),
        pdb.curves.iter().map(|c| &c.curve).collect::<Vec<_>>()
    );
}

#[test]
fn glyphs() {
    let font = read("letters.ttf");
    assert_eq!(names(&font), ["D/0", "A/0", "A/1", "Aacute/0", "Aacute/1", "Aacute/2"]);
    assert_eq!(
        points(curve(&font, "D")),
        "0,0 100,0; 100,0 150,0 150,50; 150,50 150,100 100,100; 100,100 0,0"
    );
    assert_eq!(points(curve(&font, "A/1")), "20,20 40,60; 40,60 60,20; 60,20 20,20");
    // Half as wide, a quarter as high and upside down, moved by (7, 9).
    assert_eq!(
        points(curve(&font, "Aacute/2")),
        "7,9 57,9; 57,9 82,9 82,-7/2; 82,-7/2 82,-16 57,-16; 57,-16 7,9"
    );
    assert_eq!(font.select("Á"), [3, 4, 5]);
    assert_eq!(font.select("U+00C1"), [3, 4, 5]);
    let cubic = read("letters.otf");
    assert_eq!(names(&cubic), ["D/0", "A/0", "A/1", "Aacute/0"]);
    assert_eq!(
        points(curve(&cubic, "D")),
        "0,0 100,0; 100,0 150,0 150,50 100,100; 100,100 0,0"
    );
}

#[test]
fn errors_name_the_place() {
    for (format, text, expected) in [
        (
            Format::Svg,
            "<svg>\n <path d='M0 0\n L1 x'/></svg>",
            "line 3 column 5: path d: found 'x'",
        ),
        (Format::Svg, "<svg><path d='M0 0'></svg>", "line 1 column"),
        (Format::Svg, "<html/>", "line 1 column 1: found the element \"html\""),
        (
            Format::Svg,
            "<svg>\n<g transform='skewX(3)'/></svg>",
            "line 2 column 15: g transform: found skewX by 3 degrees",
        ),
        (
            Format::Svg,
            "<svg><rect width='1%' height='2'/></svg>",
            "line 1 column 19: rect width: found '%'",
        ),
        (
            Format::Step,
            "ISO-10303-21;#1=BEZIER_CURVE('',2,(#2),.U.,.F.,.F.);",
            "entity #2: found a reference",
        ),
        (Format::Vect, "VECT\n1 1 0\n1\n0\n1 2 z", "line 5 column 5: found 'z'"),
        (
            Format::Geomdl,
            "{\"shape\":{\"type\":\"surface\",\"data\":[]}}",
            "shape.type: found \"surface\"",
        ),
        (Format::Font, "OTTO", "not a readable font"),
        (Format::Curve, "{\"knotproof\":\"curve/2\"}", "knotproof: found version"),
    ] {
        let error = import_as(format, text.as_bytes(), &Options::default())
            .unwrap_err()
            .to_string();
        assert!(error.contains(expected), "{text}: {error}");
    }
    let error = import_as(Format::Svg, b"<svg>\n\xff</svg>", &Options::default()).unwrap_err();
    assert!(
        error
            .to_string()
            .starts_with("line 2 column 1: found bytes that are not UTF-8"),
        "{error}"
    );
    assert!(
        import(b"wOF2", &Options::default())
            .unwrap_err()
            .to_string()
            .contains("compressed web font")
    );
    assert!(
        import(b"hello", &Options::default())
            .unwrap_err()
            .to_string()
            .contains("expected one of curve/1 JSON")
    );
}

/// What is read of any bytes is written and read back the same.
fn survives(format: Format, bytes: &[u8]) {
    for options in [
        Options::default(),
        Options {
            meaning: Meaning::Binary64,
            weld: true,
            smooth: true,
            exact: true,
        },
    ] {
        match import_as(format, bytes, &options) {
            Err(error) => {
                // The reader of fonts finds no table, that of proteins names the chain; all others name line, entity, glyph or JSON path.
                let whole = matches!(format, Format::Font) && error.message.starts_with("not a readable font")
                    || matches!(format, Format::Pdb | Format::Mmcif) && error.message.starts_with("chain ");
                assert!(error.place.is_some() || whole, "{format:?}: {error}");
                assert!(!error.message.is_empty());
            }
            Ok(imported) => {
                for curve in imported.curves.iter().take(20) {
                    let text = write_curve(&curve.curve, Some(&curve.title()));
                    assert_eq!(read_curve(text).expect("written by us").curve, curve.curve);
                }
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(150))]

    /// Bytes replaced, left out, doubled or cut off: an error or curves, never a panic.
    #[test]
    fn damaged_files_are_read_or_refused(
        sample in 0..SAMPLES.len(),
        edits in prop::collection::vec((any::<prop::sample::Index>(), 0..5u8, any::<u8>()), 1..4),
    ) {
        let (name, format) = SAMPLES[sample];
        let mut bytes = bytes(name);
        for (at, kind, value) in edits {
            let at = at.index(bytes.len().max(1));
            match kind {
                _ if bytes.is_empty() => {}
                0 => bytes[at] = value,
                // A byte of the kind that the formats are made of.
                1 => bytes[at] = b"0123456789.-+eE(),;#'\" \nMzLa"[usize::from(value) % 28],
                2 => drop(bytes.remove(at)),
                3 => {
                    let end = (at + usize::from(value)).min(bytes.len());
                    let part = bytes[at..end].to_vec();
                    bytes.splice(at..at, part);
                }
                _ => bytes.truncate(at),
            }
        }
        survives(format, &bytes);
        if let Some(shown) = detect(&bytes) {
            survives(shown, &bytes);
        }
    }
}
