//! What the readers accept and refuse.

use super::*;
use crate::engine::{write_cases, write_results};

const LINE: &str = r#""curve":{"degree":1,"knots":[0,0,1,1],"points":[[0,0],[2,1]]}"#;

fn one_case(fields: &str) -> Result<CasesFile, FileError> {
    read_cases(format!(
        r#"{{"knotproof":"cases/1","seed":7,"cases":[{{"id":"a",{fields},{LINE}}}]}}"#
    ))
}

fn one_result(fields: &str) -> Result<ResultsFile, FileError> {
    read_results(format!(
        r#"{{"knotproof":"results/1","engine":"e 1","results":[{{"id":"a",{fields}}}]}}"#
    ))
}

#[test]
fn every_operation_is_read_and_written_back() {
    for fields in [
        r#""operation":"point","parameter":0.1"#,
        r#""operation":"derivative","parameter":1,"order":2,"side":"left""#,
        r#""operation":"curvature","parameter":0,"side":"right""#,
        r#""operation":"insert_knot","parameter":0.30000000000000004,"times":1"#,
        r#""operation":"remove_knot","parameter":0.5,"times":1"#,
        r#""operation":"elevate_degree","times":3"#,
        r#""operation":"split","parameter":1e-300"#,
        r#""operation":"decompose""#,
        r#""operation":"nearest_point","target":[1,-0.5]"#,
        r#""operation":"curve_distance","other":{"degree":1,"knots":[0,0,1,1],"points":[[0,3],[2,3]],"weights":[1,2]}"#,
        r#""operation":"msd""#,
    ] {
        let read = one_case(fields).unwrap_or_else(|error| panic!("{fields}: {error}"));
        assert_eq!(read_cases(write_cases(&read)), Ok(read), "{fields}");
    }
}

#[test]
fn a_convex_domain_is_read_and_written_back() {
    let text = r#"{"knotproof":"cases/1","seed":7,"cases":[
{"id":"a","operation":"convex_domain","point":1,"box":0.25,"level":3,"sign":"-","curve":{"degree":2,"knots":[0,0,0,1,1,1],"points":[[0,0],[2,1],[3,0]]}}
]}
"#;
    let read = read_cases(text).expect("a case");
    let Operation::ConvexDomain { level, positive, .. } = read.cases[0].operation else {
        panic!("{read:?}");
    };
    assert_eq!((level, positive), (3, false));
    assert_eq!(read_cases(write_cases(&read)), Ok(read));
}

#[test]
fn faults_of_cases_are_told_with_their_path() {
    for (fields, path, part) in [
        (
            r#""operation":"points","parameter":0"#,
            "cases[0].operation",
            "\"points\"",
        ),
        (r#""operation":"point""#, "cases[0].parameter", "missing"),
        (
            r#""operation":"point","parameter":0,"times":1"#,
            "cases[0].times",
            "not a parameter",
        ),
        (
            r#""operation":"point","parameter":1.5"#,
            "cases[0].parameter",
            "domain 0 to 1",
        ),
        (r#""operation":"point","parameter":"0""#, "cases[0].parameter", "string"),
        (r#""operation":"elevate_degree","times":0"#, "cases[0].times", "1 to 64"),
        (
            r#""operation":"derivative","parameter":0,"order":1,"side":"up""#,
            "cases[0].side",
            "up",
        ),
        (
            r#""operation":"torsion","parameter":0,"side":"left""#,
            "cases[0].curve",
            "planar",
        ),
        (
            r#""operation":"nearest_point","target":[1]"#,
            "cases[0].target",
            "expected 2",
        ),
        (
            r#""operation":"convex_domain","point":2,"box":1,"level":0,"sign":"+""#,
            "cases[0].point",
            "below 2",
        ),
        (
            r#""operation":"convex_domain","point":1,"box":0,"level":0,"sign":"+""#,
            "cases[0].box",
            "positive",
        ),
        (
            r#""operation":"convex_domain","point":1,"box":1,"level":17,"sign":"-""#,
            "cases[0].level",
            "0 to 16",
        ),
        (
            r#""operation":"convex_domain","point":1,"box":1,"level":1,"sign":"-""#,
            "cases[0].curve.degree",
            "at least 2",
        ),
        (
            r#""operation":"convex_domain","point":1,"box":1,"level":1,"sign":"0""#,
            "cases[0].sign",
            "variant",
        ),
        (
            r#""operation":"convex_domain","point":1,"box":1,"sign":"+""#,
            "cases[0].level",
            "missing",
        ),
        (r#""operation":"msd","colour":1"#, "cases[0].colour", "colour"),
        (
            r#""operation":"curve_distance","other":{"degree":1,"knots":[0,1,0,1],"points":[[0,3],[2,3]]}"#,
            "cases[0].other.knots[2]",
            "",
        ),
    ] {
        let error = one_case(fields).expect_err(fields);
        assert_eq!(error.path, path, "{fields}: {error}");
        assert!(error.what.contains(part), "{fields}: {error}");
    }
    for (json, part) in [
        (r#"{"knotproof":"cases/2","cases":[]}"#.to_string(), "cases/2"),
        (r#"{"knotproof":"cases/2","colour":1}"#.to_string(), "cases/2"),
        (r#"{"knotproof":"cases/1","cases":[]}"#.to_string(), "empty list"),
        (
            format!(
                r#"{{"knotproof":"cases/1","cases":[{{"id":"a","operation":"msd",{LINE}}},{{"id":"a","operation":"msd",{LINE}}}]}}"#
            ),
            "each id once",
        ),
        (String::new(), "EOF"),
    ] {
        let error = read_cases(&json).expect_err(&json).to_string();
        assert!(error.contains(part), "{json}: {error}");
    }
}

#[test]
fn every_result_is_read_and_written_back() {
    for fields in [
        r#""status":"ok","point":[0.1,"-0x1.8p-3"]"#,
        r#""status":"ok","vector":[1e300,-0.0,5e-324]"#,
        r#""status":"ok","value":"Infinity""#,
        r#""status":"ok","curve":{"degree":1,"knots":[0,0,1,1],"points":[[0,3],[2,"-Infinity"]],"weights":[1,2]}"#,
        r#""status":"ok","curves":[]"#,
        r#""status":"ok","distance":null"#,
        r#""status":"ok","distance":0.25,"parameter":0.5"#,
        r#""status":"ok","distance":0.25,"parameters":[0.5,1]"#,
        r#""status":"ok","vertices":[[0,0],[1,0],[0,1]]"#,
        r#""status":"refused","message":"unclamped""#,
        r#""status":"not_offered""#,
    ] {
        let read = one_result(fields).unwrap_or_else(|error| panic!("{fields}: {error}"));
        assert_eq!(read_results(write_results(&read)), Ok(read), "{fields}");
    }
    let nan = one_result(r#""status":"ok","value":"NaN""#).expect("NaN by its name");
    assert!(matches!(&nan.results[0].answer, Answer::Ok(Returned::Value(x)) if x.is_nan()));
}

#[test]
fn faults_of_results_are_told_with_their_path() {
    for (fields, path, part) in [
        (r#""status":"ok""#, "results[0]", "without a result"),
        (
            r#""status":"ok","point":[1],"value":1"#,
            "results[0]",
            "point and value",
        ),
        (r#""status":"refused","value":1"#, "results[0]", "not \"ok\""),
        (r#""status":"done","value":1"#, "results[0].status", "done"),
        (r#""status":"ok","value":"1.5""#, "results[0].value", "hexadecimal"),
        (
            r#""status":"ok","value":"0x1.00000000000001p0""#,
            "results[0].value",
            "binary64 holds",
        ),
        (r#""status":"ok","value":1e999"#, "results[0].value", "range"),
        (r#""status":"ok","value":NaN"#, "results[0].value", "expected value"),
        (r#""status":"ok","point":[1,null]"#, "results[0].point[1]", "null"),
        (
            r#""status":"ok","distance":1,"parameter":1,"parameters":[1]"#,
            "results[0]",
            "both",
        ),
    ] {
        let error = one_result(fields).expect_err(fields);
        assert_eq!(error.path, path, "{fields}: {error}");
        assert!(error.what.contains(part), "{fields}: {error}");
    }
    for (json, part) in [
        (r#"{"knotproof":"results/1","engine":"e","results":[]}"#, "empty list"),
        (r#"{"knotproof":"results/1","results":[]}"#, "engine"),
        (
            r#"{"knotproof":"results/1","engine":"e","results":[{"id":"a","status":"not_offered"},{"id":"a","status":"not_offered"}]}"#,
            "each id once",
        ),
    ] {
        let error = read_results(json).expect_err(json).to_string();
        assert!(error.contains(part), "{json}: {error}");
    }
}
