//! The JSON form as `serde` reads it: texts, not yet numbers.

use std::borrow::Cow;

use serde::Deserialize;
use serde::de::{self, Deserializer, Visitor};

/// A JSON string, borrowed where it has no escapes.
pub struct Text<'a>(pub Cow<'a, str>);

impl<'de: 'a, 'a> Deserialize<'de> for Text<'a> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Strings;
        impl<'de> Visitor<'de> for Strings {
            type Value = Text<'de>;
            fn expecting(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
                f.write_str("a string")
            }
            fn visit_borrowed_str<E: de::Error>(self, text: &'de str) -> Result<Self::Value, E> {
                Ok(Text(Cow::Borrowed(text)))
            }
            fn visit_str<E: de::Error>(self, text: &str) -> Result<Self::Value, E> {
                Ok(Text(Cow::Owned(text.to_owned())))
            }
        }
        deserializer.deserialize_str(Strings)
    }
}

/// A JSON object; a structure alone would also be read from an array.
pub struct Object<T>(pub T);

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Object<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Maps<T>(std::marker::PhantomData<T>);
        impl<'de, T: Deserialize<'de>> Visitor<'de> for Maps<T> {
            type Value = Object<T>;
            fn expecting(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
                f.write_str("an object")
            }
            fn visit_map<A: de::MapAccess<'de>>(self, map: A) -> Result<Self::Value, A::Error> {
                T::deserialize(de::value::MapAccessDeserializer::new(map)).map(Object)
            }
        }
        deserializer.deserialize_map(Maps(std::marker::PhantomData))
    }
}

/// `"binary"` in the header of the binary form.
pub struct InBlock;

impl<'de> Deserialize<'de> for InBlock {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = Text::deserialize(deserializer)?;
        if text.0 == "binary" {
            Ok(InBlock)
        } else {
            Err(de::Error::custom("expected \"binary\""))
        }
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, bound(deserialize = "C: Deserialize<'de>, T: Deserialize<'de>"))]
pub struct RawDocument<'a, C, T> {
    #[serde(borrow)]
    pub knotproof: Text<'a>,
    #[serde(borrow)]
    pub tool: Text<'a>,
    #[serde(default, borrow, deserialize_with = "optional")]
    pub name: Option<Text<'a>>,
    #[serde(default, deserialize_with = "optional")]
    pub snapped_joints: Option<u64>,
    pub curve: C,
    #[serde(borrow)]
    pub curve_sha256: Text<'a>,
    #[serde(borrow)]
    pub statement: Object<RawStatement<'a>>,
    #[serde(borrow, bound(deserialize = "T: Deserialize<'de>"))]
    pub evidence: Object<RawEvidence<'a, T>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RawStatement<'a> {
    #[serde(borrow)]
    pub claim: Text<'a>,
    #[serde(borrow)]
    pub convention: Text<'a>,
    #[serde(borrow)]
    pub lower_squared: Text<'a>,
    #[serde(borrow, deserialize_with = "required")]
    pub upper_squared: Option<Text<'a>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, bound(deserialize = "T: Deserialize<'de>"))]
pub struct RawEvidence<'a, T> {
    pub grid: u32,
    #[serde(deserialize_with = "required")]
    pub tree: Option<T>,
    #[serde(borrow, deserialize_with = "required")]
    pub upper: Option<Object<RawUpper<'a>>>,
}

/// A field that may be missing but not null.
fn optional<'de, D: Deserializer<'de>, T: Deserialize<'de>>(deserializer: D) -> Result<Option<T>, D::Error> {
    T::deserialize(deserializer).map(Some)
}

/// A field that may be null but not missing.
fn required<'de, D: Deserializer<'de>, T: Deserialize<'de>>(deserializer: D) -> Result<Option<T>, D::Error> {
    Option::deserialize(deserializer)
}

#[derive(Deserialize)]
#[serde(tag = "rule", rename_all = "snake_case", deny_unknown_fields)]
pub enum RawUpper<'a> {
    Miranda {
        #[serde(borrow)]
        s: [Text<'a>; 2],
        #[serde(borrow)]
        t: [Text<'a>; 2],
        #[serde(borrow)]
        first: [Text<'a>; 2],
        #[serde(borrow)]
        second: [Text<'a>; 2],
        #[serde(borrow)]
        regular: [Vec<Text<'a>>; 2],
        subdivisions: u32,
    },
    Root {
        #[serde(borrow)]
        s: Text<'a>,
        #[serde(borrow)]
        s_side: Text<'a>,
        #[serde(borrow)]
        t: Text<'a>,
        #[serde(borrow)]
        t_side: Text<'a>,
    },
    Touch {
        #[serde(borrow)]
        s: Text<'a>,
        #[serde(borrow)]
        t: Text<'a>,
    },
    Crossing {
        #[serde(borrow)]
        s: [Text<'a>; 2],
        #[serde(borrow)]
        t: [Text<'a>; 2],
        #[serde(borrow)]
        first: Vec<Text<'a>>,
        #[serde(borrow)]
        second: Vec<Text<'a>>,
    },
    CriticalRoot {
        #[serde(borrow)]
        s: Text<'a>,
        #[serde(borrow)]
        t: Text<'a>,
    },
    CriticalInterval {
        #[serde(borrow)]
        s: Text<'a>,
        #[serde(borrow)]
        t: [Text<'a>; 2],
        #[serde(borrow)]
        regular: Vec<Text<'a>>,
    },
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RawCurve<'a> {
    #[serde(default, borrow, deserialize_with = "optional")]
    pub bspline: Option<Object<RawSpline<'a>>>,
    #[serde(default, borrow, deserialize_with = "optional")]
    pub bezier: Option<Object<RawPieces<'a>>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RawSpline<'a> {
    pub degree: usize,
    #[serde(borrow)]
    pub knots: Vec<Text<'a>>,
    #[serde(borrow)]
    pub points: Vec<Vec<Text<'a>>>,
    #[serde(default, borrow, deserialize_with = "optional")]
    pub weights: Option<Vec<Text<'a>>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RawPieces<'a> {
    #[serde(borrow)]
    pub pieces: Vec<Object<RawPiece<'a>>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RawPiece<'a> {
    #[serde(borrow)]
    pub points: Vec<Vec<Text<'a>>>,
    #[serde(default, borrow, deserialize_with = "optional")]
    pub weights: Option<Vec<Text<'a>>>,
}

impl RawUpper<'_> {
    /// The same without borrowing.
    pub fn into_owned(self) -> RawUpper<'static> {
        fn one(text: Text) -> Text<'static> {
            Text(Cow::Owned(text.0.into_owned()))
        }
        fn two(texts: [Text; 2]) -> [Text<'static>; 2] {
            texts.map(one)
        }
        fn many(texts: Vec<Text>) -> Vec<Text<'static>> {
            texts.into_iter().map(one).collect()
        }
        match self {
            RawUpper::Miranda {
                s,
                t,
                first,
                second,
                regular,
                subdivisions,
            } => RawUpper::Miranda {
                s: two(s),
                t: two(t),
                first: two(first),
                second: two(second),
                regular: regular.map(many),
                subdivisions,
            },
            RawUpper::Root { s, s_side, t, t_side } => RawUpper::Root {
                s: one(s),
                s_side: one(s_side),
                t: one(t),
                t_side: one(t_side),
            },
            RawUpper::Touch { s, t } => RawUpper::Touch { s: one(s), t: one(t) },
            RawUpper::Crossing { s, t, first, second } => RawUpper::Crossing {
                s: two(s),
                t: two(t),
                first: many(first),
                second: many(second),
            },
            RawUpper::CriticalRoot { s, t } => RawUpper::CriticalRoot { s: one(s), t: one(t) },
            RawUpper::CriticalInterval { s, t, regular } => RawUpper::CriticalInterval {
                s: one(s),
                t: two(t),
                regular: many(regular),
            },
        }
    }
}
