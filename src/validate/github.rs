//! Annotations of GitHub Actions.

use super::{Report, Verdict};

/// One workflow command for every wrong or missing answer, located in the file `results`; the runner shows at most ten of a step.
pub fn annotations(report: &Report, results: &str) -> String {
    let mut lines = String::new();
    for finding in &report.findings {
        let text = match &finding.verdict {
            Verdict::Wrong(wrong) => wrong.to_string(),
            Verdict::Missing => "the results have no answer to this case".to_string(),
            _ => continue,
        };
        let title = format!("{}: {} {}", report.engine, finding.operation, finding.id);
        lines.push_str(&format!(
            "::error file={},title={}::{}\n",
            property(results),
            property(&title),
            data(&text)
        ));
    }
    lines
}

fn data(text: &str) -> String {
    text.replace('%', "%25").replace('\r', "%0D").replace('\n', "%0A")
}

fn property(text: &str) -> String {
    data(text).replace(':', "%3A").replace(',', "%2C")
}
