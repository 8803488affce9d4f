//! Every rule of the format on certificates made by hand: accepted and rejected side by side, by both checkers.

#[path = "../common/mod.rs"]
mod common;
mod subjects;

use common::case::{Case, verify};

macro_rules! verified {
    ($($subject:ident),* $(,)?) => {
        $(#[test]
        fn $subject() {
            let cases: Vec<Case> = subjects::$subject::cases();
            assert!(cases.iter().any(Case::accepted), "no accepted twin");
            assert!(cases.iter().any(|case| !case.accepted()), "nothing is rejected");
            verify(&cases);
        })*

        #[test]
        fn every_subject_is_tested() {
            let names = [$(stringify!($subject)),*];
            let listed: Vec<&str> = subjects::all().into_iter().map(|(name, _)| name).collect();
            assert_eq!(listed, names);
        }
    };
}

verified!(
    far,
    not_normal,
    cone,
    bend,
    turn,
    pedal,
    miranda,
    root,
    touch,
    crossing,
    critical_root,
    critical_interval,
    tree,
    statement,
    curve,
    text,
    binary,
    numbers,
    domain,
    sandwich,
    empty,
    nearest,
    change,
    ball,
    separate,
    monotone,
    embedding,
    curvature,
    deviation,
    thickness,
    motion,
    values,
);

#[test]
fn names_are_unique() {
    let mut paths: Vec<String> = subjects::all()
        .into_iter()
        .flat_map(|(_, cases)| cases())
        .map(|case| case.path())
        .collect();
    paths.sort();
    let twice: Vec<&[String]> = paths.windows(2).filter(|pair| pair[0] == pair[1]).collect();
    assert!(twice.is_empty(), "{twice:?}");
}
