//! The cases made cover what they should, and are valid.

use super::*;
use crate::engine::{read_cases, write_cases};
use crate::number::{Rational, RationalExt};

fn made(count: usize) -> CasesFile {
    generate(&Options {
        seed: 1,
        count,
        operations: Vec::new(),
        curves: Vec::new(),
    })
}

#[test]
fn the_reader_accepts_them_and_the_seed_names_them() {
    let cases = made(600);
    assert_eq!(read_cases(write_cases(&cases)).as_ref(), Ok(&cases));
    assert_eq!(made(100).cases[..], cases.cases[..100]);
    let other = Options {
        seed: 2,
        count: 100,
        operations: Vec::new(),
        curves: Vec::new(),
    };
    assert_ne!(generate(&other).cases[..], cases.cases[..100]);
}

#[test]
fn every_kind_occurs() {
    let cases = made(1200).cases;
    let any = |what: &str, is: &dyn Fn(&Case) -> bool| assert!(cases.iter().any(is), "no case with {what}");
    for name in GENERATED.into_iter().filter(|name| *name != ONLY_NAMED) {
        any(name, &|case| case.operation.name() == name);
    }
    assert!(cases.iter().all(|case| case.operation.name() != ONLY_NAMED));
    let named = |curves: Vec<FloatCurve>| {
        let cases = generate(&Options {
            seed: 1,
            count: 60,
            operations: vec![ONLY_NAMED],
            curves,
        });
        assert_eq!(
            crate::engine::read_cases(crate::engine::write_cases(&cases)),
            Ok(cases.clone())
        );
        let is = |case: &&Case| case.operation.name() == ONLY_NAMED;
        cases
            .cases
            .iter()
            .filter(is)
            .map(|case| case.curve.dimension())
            .collect::<Vec<_>>()
    };
    let made = named(Vec::new());
    assert!(made.len() == 60 && made.contains(&2) && made.contains(&3));
    // Of a corpus without a curve that turns, points are asked for.
    let line = FloatCurve::bezier(vec![vec![0.0, 0.0], vec![1.0, 1.0]], None);
    assert_eq!(named(vec![line]), Vec::<usize>::new());
    for degree in 1..=9 {
        any("every degree", &|case| {
            case.curve.degree == degree && !case.curve.is_bezier()
        });
    }
    any("a high degree", &|case| case.curve.degree > 20);
    any("unclamped knots", &|case| !case.curve.is_clamped());
    any("clustered knots", &|case| {
        case.curve
            .knots
            .windows(2)
            .any(|pair| pair[1] - pair[0] > 0.0 && pair[1] - pair[0] < 1e-6)
    });
    any("a knot of full multiplicity", &|case| {
        let (p, knots) = (case.curve.degree, &case.curve.knots);
        let inner = &knots[p + 1..knots.len() - p - 1];
        p > 2
            && inner
                .windows(p)
                .any(|run| run.iter().all(|t| *t == run[0] && *t > knots[p]))
    });
    any("weights over six orders of magnitude", &|case| {
        let weights = case.curve.weights.as_deref().unwrap_or_default();
        let least = weights.iter().copied().fold(f64::INFINITY, f64::min);
        weights.iter().any(|w| *w >= 1e5 * least)
    });
    any("large coordinates", &|case| {
        case.curve.points.iter().flatten().any(|x| x.abs() > 1e11)
    });
    any("a parameter at a knot", &|case| {
        case.operation
            .parameter()
            .is_some_and(|t| case.curve.knots.contains(&t))
    });
    any("a parameter beside a knot", &|case| {
        case.operation.parameter().is_some_and(|t| {
            let knots = &case.curve.knots;
            !knots.contains(&t) && (knots.contains(&t.next_up()) || knots.contains(&t.next_down()))
        })
    });
}

#[test]
fn removable_knots_are_removable() {
    let removals = generate(&Options {
        seed: 3,
        count: 40,
        operations: vec!["remove_knot"],
        curves: Vec::new(),
    });
    for case in removals.cases {
        let Operation::RemoveKnot { parameter, times } = case.operation else {
            panic!("{case:?}");
        };
        // At `degree − order` continuous derivatives the two sides agree.
        let spline = case.curve.exact().expect("a curve");
        let t = Rational::from_f64(parameter).expect("finite");
        let order = case.curve.degree - (spline.multiplicity(&t) - times);
        use crate::curve::Side::{After, Before};
        let sides = [Before, After].map(|side| spline.derivatives(&t, side, order).expect("inside"));
        assert_eq!(sides[0], sides[1], "{:?}", case.curve);
    }
}

#[test]
fn a_corpus_is_used() {
    let corpus = vec![FloatCurve::bezier(vec![vec![0.0, 0.0, 0.0], vec![1.0, 2.0, 3.0]], None)];
    let cases = generate(&Options {
        seed: 1,
        count: 60,
        operations: Vec::new(),
        curves: corpus.clone(),
    });
    let about = cases.cases.iter().filter(|case| case.curve == corpus[0]).count();
    assert!(about >= 50, "{about}");
    assert!(read_cases(write_cases(&cases)).is_ok());
}
