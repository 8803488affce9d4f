//! Cases: a certificate and the verdict both checkers must reach.

use std::path::Path;

use knotproof::certificate::FormatError;
use knotproof::check::{Place, Reason, Rejection, Verdict, check};

use super::document::Certificate;
use super::python;

/// What the checker must say.
pub enum Expected {
    /// Accepted.
    Accepted,
    /// Well formed, but rejected, for the reason that the function recognises.
    Rejected(Box<dyn Fn(&Rejection) -> bool>),
    /// Not a certificate, for the reason that the function recognises.
    Malformed(Box<dyn Fn(&FormatError) -> bool>),
}

/// One certificate with its verdict.
pub struct Case {
    /// The rule or subject it belongs to; a folder of the corpus.
    pub subject: &'static str,
    /// What is special about it, in words joined by hyphens.
    pub name: String,
    /// The file.
    pub bytes: Vec<u8>,
    /// The verdict.
    pub expected: Expected,
}

impl Case {
    /// Is it accepted?
    pub fn accepted(&self) -> bool {
        matches!(self.expected, Expected::Accepted)
    }

    /// Its file in the corpus, relative to `certs`.
    pub fn path(&self) -> String {
        let verdict = if self.accepted() { "accept" } else { "reject" };
        let form = if self.bytes.starts_with(b"KNOTCRT") {
            "cert"
        } else {
            "json"
        };
        format!("{verdict}/{}/{}.{form}", self.subject, self.name)
    }
}

/// The cases of one subject.
pub struct Cases {
    subject: &'static str,
    list: Vec<Case>,
}

impl Cases {
    /// None yet.
    pub fn new(subject: &'static str) -> Self {
        let list = Vec::new();
        Cases { subject, list }
    }

    fn push(&mut self, name: &str, bytes: Vec<u8>, expected: Expected) {
        let (subject, name) = (self.subject, name.to_string());
        self.list.push(Case {
            subject,
            name,
            bytes,
            expected,
        });
    }

    /// A certificate that proves what it says.
    pub fn accept(&mut self, name: &str, certificate: &Certificate) {
        self.push(name, certificate.json(), Expected::Accepted);
    }

    /// The same, as a file.
    pub fn accept_bytes(&mut self, name: &str, bytes: Vec<u8>) {
        self.push(name, bytes, Expected::Accepted);
    }

    /// A certificate that does not.
    pub fn reject(&mut self, name: &str, certificate: &Certificate, why: impl Fn(&Rejection) -> bool + 'static) {
        self.push(name, certificate.json(), Expected::Rejected(Box::new(why)));
    }

    /// The same, as a file.
    pub fn reject_bytes(&mut self, name: &str, bytes: Vec<u8>, why: impl Fn(&Rejection) -> bool + 'static) {
        self.push(name, bytes, Expected::Rejected(Box::new(why)));
    }

    /// A file that is no certificate.
    pub fn malformed(&mut self, name: &str, bytes: Vec<u8>, why: impl Fn(&FormatError) -> bool + 'static) {
        self.push(name, bytes, Expected::Malformed(Box::new(why)));
    }

    /// All of them.
    pub fn list(self) -> Vec<Case> {
        self.list
    }
}

/// The obligation of a rule does not hold.
pub fn obligation(name: &'static str) -> impl Fn(&Rejection) -> bool + Clone {
    move |rejection| matches!(&rejection.reason, Reason::Obligation { rule, .. } if *rule == name)
}

/// The obligation of a rule does not hold, and it is this one.
pub fn expecting(name: &'static str, wish: &'static str) -> impl Fn(&Rejection) -> bool + Clone {
    move |rejection| matches!(&rejection.reason, Reason::Obligation { rule, failure } if *rule == name && failure.expected == wish)
}

/// The obligation of a rule does not hold at a token.
pub fn obligation_at(name: &'static str, number: usize) -> impl Fn(&Rejection) -> bool + Clone {
    move |rejection| obligation(name)(rejection) && at_token(rejection, number)
}

/// The rejection is about this token of the tree.
pub fn at_token(rejection: &Rejection, number: usize) -> bool {
    match &rejection.place {
        Place::Pair { token, .. } => *token == number as u64,
        Place::Token { number: token } => *token == number as u64,
        _ => false,
    }
}

/// The rejection has this reason.
pub fn reason(wish: Reason) -> impl Fn(&Rejection) -> bool + Clone {
    move |rejection| rejection.reason == wish
}

/// Both checkers reach the expected verdict on every case.
pub fn verify(cases: &[Case]) {
    let mut wrong = Vec::new();
    for case in cases {
        let verdict = check(case.bytes.as_slice());
        let right = match (&case.expected, &verdict) {
            (Expected::Accepted, Verdict::Accepted { .. }) => true,
            (Expected::Rejected(why), Verdict::Rejected { rejection, .. }) => why(rejection),
            (Expected::Malformed(why), Verdict::Malformed(error)) => why(error),
            _ => false,
        };
        if !right {
            wrong.push(format!("{}: {}", case.path(), describe(&verdict)));
        }
    }
    let files: Vec<&[u8]> = cases.iter().map(|case| case.bytes.as_slice()).collect();
    for (case, answer) in cases.iter().zip(python::check_bytes(&files)) {
        if answer.accepted != case.accepted() {
            wrong.push(format!("{}: check.py says {:?}", case.path(), answer));
        }
    }
    assert!(
        wrong.is_empty(),
        "{} unexpected verdicts:\n{}",
        wrong.len(),
        wrong.join("\n")
    );
}

/// A verdict in words.
pub fn describe(verdict: &Verdict) -> String {
    match verdict {
        Verdict::Accepted { leaves, .. } => format!("accepted with {leaves} leaves"),
        Verdict::Malformed(error) => format!("malformed: {error}"),
        Verdict::Rejected { rejection, .. } => format!("rejected: {rejection}"),
    }
}

/// The folder of certificates and curves.
pub fn certs() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/certs"))
}
