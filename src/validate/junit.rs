//! JUnit XML.

use quick_junit::{NonSuccessKind, SerializeError, TestCase, TestCaseStatus, TestSuite};

use super::{Report, Verdict};

/// The report as JUnit XML: one suite for each operation, one test for each case.
///
/// Wrong answers are failures, missing ones errors; refusals, operations not offered and cases without an exact result are skipped.
///
/// # Errors
/// What the XML writer says.
pub fn junit(report: &Report) -> Result<String, SerializeError> {
    let mut document = quick_junit::Report::new("knotproof validate");
    for (operation, _) in report.by_operation() {
        let mut suite = TestSuite::new(format!("{}: {operation}", report.engine));
        for finding in report.findings.iter().filter(|finding| finding.operation == operation) {
            let status = match &finding.verdict {
                Verdict::Right { .. } => TestCaseStatus::success(),
                Verdict::Wrong(wrong) => {
                    let mut status = TestCaseStatus::non_success(NonSuccessKind::Failure);
                    status.set_type(wrong.kind.name()).set_message(wrong.to_string());
                    status
                }
                Verdict::Missing => {
                    let mut status = TestCaseStatus::non_success(NonSuccessKind::Error);
                    status.set_message("the results have no answer to this case");
                    status
                }
                other => {
                    let mut status = TestCaseStatus::skipped();
                    status.set_message(other.to_string());
                    status
                }
            };
            let mut case = TestCase::new(finding.id.as_str(), status);
            case.set_classname(operation);
            suite.add_test_case(case);
        }
        document.add_test_suite(suite);
    }
    document.to_string()
}
