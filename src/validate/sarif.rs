//! SARIF 2.1.0 (OASIS).

use serde_json::{Value, json};

use super::{Kind, Report, Verdict};

const KINDS: [Kind; 4] = [Kind::NotFinite, Kind::NotACurve, Kind::OtherForm, Kind::OtherValue];

/// The report as a SARIF 2.1.0 log: one result for every wrong or missing answer, located in the file `results` (a relative path or a URI).
pub fn sarif(report: &Report, results: &str) -> String {
    let rule = |id: &str, text: &str| json!({ "id": id, "shortDescription": { "text": text } });
    let mut rules: Vec<Value> = KINDS
        .iter()
        .map(|kind| {
            rule(
                &rule_id(*kind),
                &format!("An engine's answer is wrong: {}", kind.name()),
            )
        })
        .collect();
    rules.push(rule("missing", "The results have no answer to a case"));
    let found = report.findings.iter().filter_map(|finding| {
        let (id, text) = match &finding.verdict {
            Verdict::Wrong(wrong) => (rule_id(wrong.kind), wrong.to_string()),
            Verdict::Missing => ("missing".to_string(), "the results have no answer to this case".to_string()),
            _ => return None,
        };
        Some(json!({
            "ruleId": id,
            "level": "error",
            "message": { "text": format!("{}, {}: {text}", report.engine, finding.id) },
            "locations": [{
                "physicalLocation": { "artifactLocation": { "uri": uri(results) } },
                "logicalLocations": [{ "name": finding.id, "fullyQualifiedName": format!("{}/{}", finding.operation, finding.id) }]
            }],
            "partialFingerprints": { "case/v1": format!("{}/{}", report.engine, finding.id) }
        }))
    });
    let found: Vec<Value> = found.collect();
    let log = json!({
        "$schema": "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json",
        "version": "2.1.0",
        "runs": [{
            "tool": { "driver": {
                "name": "knotproof",
                "semanticVersion": env!("CARGO_PKG_VERSION"),
                "rules": rules
            } },
            "results": found
        }]
    });
    format!("{log:#}\n")
}

fn rule_id(kind: Kind) -> String {
    kind.name().replace(' ', "-")
}

/// A path as the path of a URI: what is not allowed there in its hexadecimal form.
fn uri(path: &str) -> String {
    let mut uri = String::new();
    for byte in path.bytes() {
        match byte {
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'-' | b'.' | b'_' | b'~' | b'/' => uri.push(char::from(byte)),
            b'\\' => uri.push('/'),
            other => uri.push_str(&format!("%{other:02X}")),
        }
    }
    uri
}
