//! The JSON form as `serde` reads it: texts, not yet numbers.

use std::borrow::Cow;

use serde::Deserialize;
use serde::de::{self, Deserializer, Visitor};
use serde_json::value::RawValue;

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

/// A list of at most `N` items, refused as soon as there are more.
pub struct AtMost<T, const N: usize>(pub Vec<T>);

impl<'de, T: Deserialize<'de>, const N: usize> Deserialize<'de> for AtMost<T, N> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Lists<T, const N: usize>(std::marker::PhantomData<T>);
        impl<'de, T: Deserialize<'de>, const N: usize> Visitor<'de> for Lists<T, N> {
            type Value = AtMost<T, N>;
            fn expecting(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
                write!(f, "a list of at most {N}")
            }
            fn visit_seq<A: de::SeqAccess<'de>>(self, mut items: A) -> Result<Self::Value, A::Error> {
                let mut list = Vec::new();
                while let Some(item) = items.next_element()? {
                    if list.len() == N {
                        return Err(de::Error::invalid_length(N + 1, &self));
                    }
                    list.push(item);
                }
                Ok(AtMost(list))
            }
        }
        deserializer.deserialize_seq(Lists(std::marker::PhantomData))
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
#[serde(deny_unknown_fields, bound(deserialize = "C: Deserialize<'de>"))]
pub struct RawDocument<'a, C> {
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
    /// Read when the claim is known.
    #[serde(borrow)]
    pub statement: &'a RawValue,
    /// Read when the claim is known.
    #[serde(borrow)]
    pub evidence: &'a RawValue,
}

/// The one field of a statement that every claim has.
#[derive(Deserialize)]
pub struct RawClaim<'a> {
    #[serde(borrow)]
    pub claim: Text<'a>,
}

/// A field that may be missing but not null.
pub fn optional<'de, D: Deserializer<'de>, T: Deserialize<'de>>(deserializer: D) -> Result<Option<T>, D::Error> {
    T::deserialize(deserializer).map(Some)
}

/// A field that may be null but not missing.
pub fn required<'de, D: Deserializer<'de>, T: Deserialize<'de>>(deserializer: D) -> Result<Option<T>, D::Error> {
    Option::deserialize(deserializer)
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
