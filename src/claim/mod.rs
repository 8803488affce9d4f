//! Claims: statements and their evidence, as plain data. Nothing here computes.

pub mod curvature;
pub mod deviation;
pub mod domain;
pub mod embedding;
pub mod motion;
pub mod msd;
pub mod thickness;
pub mod tree;
pub mod values;

/// What a certificate says and why, of one of the claims.
#[allow(clippy::large_enum_variant, reason = "there is one for each file, not many")]
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Claim {
    /// The minimum separation distance.
    Msd(msd::Content),
    /// The convex domain of a control point.
    Domain(domain::Content),
    /// The greatest curvature.
    Curvature(curvature::Content),
    /// The distance from the control polygon.
    Deviation(deviation::Content),
    /// The curve is embedded.
    Embedding(embedding::Content),
    /// The thickness.
    Thickness(thickness::Content),
    /// A moving curve.
    Motion(Box<motion::Content>),
    /// Results of the basic operations.
    Values(values::Content),
}

/// A borrowed [`Claim`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ClaimRef<'a> {
    /// The minimum separation distance.
    Msd(&'a msd::Content),
    /// The convex domain of a control point.
    Domain(&'a domain::Content),
    /// The greatest curvature.
    Curvature(&'a curvature::Content),
    /// The distance from the control polygon.
    Deviation(&'a deviation::Content),
    /// The curve is embedded.
    Embedding(&'a embedding::Content),
    /// The thickness.
    Thickness(&'a thickness::Content),
    /// A moving curve.
    Motion(&'a motion::Content),
    /// Results of the basic operations.
    Values(&'a values::Content),
}

/// The content of a certificate, of one claim or of any.
pub trait AsClaim {
    /// Which claim it is.
    fn as_claim(&self) -> ClaimRef<'_>;
}

impl AsClaim for Claim {
    fn as_claim(&self) -> ClaimRef<'_> {
        match self {
            Claim::Msd(content) => ClaimRef::Msd(content),
            Claim::Domain(content) => ClaimRef::Domain(content),
            Claim::Curvature(content) => ClaimRef::Curvature(content),
            Claim::Deviation(content) => ClaimRef::Deviation(content),
            Claim::Embedding(content) => ClaimRef::Embedding(content),
            Claim::Thickness(content) => ClaimRef::Thickness(content),
            Claim::Motion(content) => ClaimRef::Motion(content),
            Claim::Values(content) => ClaimRef::Values(content),
        }
    }
}

impl AsClaim for msd::Content {
    fn as_claim(&self) -> ClaimRef<'_> {
        ClaimRef::Msd(self)
    }
}

impl AsClaim for domain::Content {
    fn as_claim(&self) -> ClaimRef<'_> {
        ClaimRef::Domain(self)
    }
}

impl AsClaim for deviation::Content {
    fn as_claim(&self) -> ClaimRef<'_> {
        ClaimRef::Deviation(self)
    }
}

impl AsClaim for curvature::Content {
    fn as_claim(&self) -> ClaimRef<'_> {
        ClaimRef::Curvature(self)
    }
}

impl AsClaim for motion::Content {
    fn as_claim(&self) -> ClaimRef<'_> {
        ClaimRef::Motion(self)
    }
}

impl AsClaim for embedding::Content {
    fn as_claim(&self) -> ClaimRef<'_> {
        ClaimRef::Embedding(self)
    }
}

impl AsClaim for thickness::Content {
    fn as_claim(&self) -> ClaimRef<'_> {
        ClaimRef::Thickness(self)
    }
}

impl AsClaim for values::Content {
    fn as_claim(&self) -> ClaimRef<'_> {
        ClaimRef::Values(self)
    }
}

impl Claim {
    /// The content of the claim `msd`, if it is that.
    pub fn msd(&self) -> Option<&msd::Content> {
        match self {
            Claim::Msd(content) => Some(content),
            _ => None,
        }
    }

    /// The content of the claim `domain`, if it is that.
    pub fn domain(&self) -> Option<&domain::Content> {
        match self {
            Claim::Domain(content) => Some(content),
            _ => None,
        }
    }

    /// The content of the claim `deviation`, if it is that.
    pub fn deviation(&self) -> Option<&deviation::Content> {
        match self {
            Claim::Deviation(content) => Some(content),
            _ => None,
        }
    }

    /// The content of the claim `curvature`, if it is that.
    pub fn curvature(&self) -> Option<&curvature::Content> {
        match self {
            Claim::Curvature(content) => Some(content),
            _ => None,
        }
    }

    /// The content of the claim `embedding`, if it is that.
    pub fn embedding(&self) -> Option<&embedding::Content> {
        match self {
            Claim::Embedding(content) => Some(content),
            _ => None,
        }
    }

    /// The content of the claim `motion`, if it is that.
    pub fn motion(&self) -> Option<&motion::Content> {
        match self {
            Claim::Motion(content) => Some(content),
            _ => None,
        }
    }

    /// The content of the claim `thickness`, if it is that.
    pub fn thickness(&self) -> Option<&thickness::Content> {
        match self {
            Claim::Thickness(content) => Some(content),
            _ => None,
        }
    }

    /// The content of the claim `values`, if it is that.
    pub fn values(&self) -> Option<&values::Content> {
        match self {
            Claim::Values(content) => Some(content),
            _ => None,
        }
    }
}
