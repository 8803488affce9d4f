//! The judgements of all answers of one engine.

use std::collections::{BTreeMap, HashMap};

use super::{Tolerances, Truth, Verdict, judge};
use crate::engine::{Answer, Case, OPERATIONS, ResultsFile};

/// The judgement of one case.
#[derive(Debug, Clone, PartialEq)]
pub struct Finding {
    /// The id of the case.
    pub id: String,
    /// The name of the operation.
    pub operation: &'static str,
    /// What the judge says.
    pub verdict: Verdict,
}

/// How often each verdict was given.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Counts {
    /// Cases.
    pub cases: usize,
    /// Right answers.
    pub right: usize,
    /// Wrong answers.
    pub wrong: usize,
    /// Refusals.
    pub refused: usize,
    /// Operations not offered.
    pub not_offered: usize,
    /// Cases without an answer.
    pub missing: usize,
    /// Answers that there is nothing exact to hold against.
    pub unjudged: usize,
    /// The worst deviation of a right answer in units; 0 when there is none.
    pub worst_ulps: f64,
}

impl Counts {
    /// Counts one verdict.
    pub fn add(&mut self, verdict: &Verdict) {
        self.cases += 1;
        match verdict {
            Verdict::Right { ulps } => {
                self.right += 1;
                self.worst_ulps = self.worst_ulps.max(*ulps);
            }
            Verdict::Wrong(_) => self.wrong += 1,
            Verdict::Refused(_) => self.refused += 1,
            Verdict::NotOffered => self.not_offered += 1,
            Verdict::Missing => self.missing += 1,
            Verdict::Unjudged(_) => self.unjudged += 1,
        }
    }
}

/// What becomes of all answers of an engine.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// At least one right answer, none wrong or missing.
    Passed,
    /// A wrong answer or a missing one.
    Failed,
    /// Neither: nothing was judged.
    NothingJudged,
}

/// The judgements of an engine's answers.
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    /// The engine's name and version.
    pub engine: String,
    /// One finding for each case.
    pub findings: Vec<Finding>,
}

/// An id in the results that no case has.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UnknownId {
    /// Its index in the results.
    pub index: usize,
    /// The id.
    pub id: String,
}

impl Report {
    /// Judges results. `truth` is asked for the exact result of each case that has an answer.
    ///
    /// # Errors
    /// The first result whose id no case has.
    pub fn new(
        cases: &[Case],
        results: &ResultsFile,
        tolerances: &Tolerances,
        mut truth: impl FnMut(&Case) -> Truth,
    ) -> Result<Report, UnknownId> {
        let ids: HashMap<&str, usize> = cases
            .iter()
            .enumerate()
            .map(|(i, case)| (case.id.as_str(), i))
            .collect();
        let mut answers: Vec<Option<&Answer>> = vec![None; cases.len()];
        for (index, entry) in results.results.iter().enumerate() {
            match ids.get(entry.id.as_str()) {
                Some(i) => answers[*i] = Some(&entry.answer),
                None => {
                    return Err(UnknownId {
                        index,
                        id: entry.id.clone(),
                    });
                }
            }
        }
        let findings = cases.iter().zip(answers).map(|(case, answer)| Finding {
            id: case.id.clone(),
            operation: case.operation.name(),
            verdict: match answer {
                None => Verdict::Missing,
                // No exact result is needed to count these.
                Some(Answer::Refused(message)) => Verdict::Refused(message.clone()),
                Some(Answer::NotOffered) => Verdict::NotOffered,
                Some(answer) => judge(&case.operation, &truth(case), answer, tolerances),
            },
        });
        Ok(Report {
            engine: results.engine.clone(),
            findings: findings.collect(),
        })
    }

    /// Counts for each operation that occurs, in the order of [`OPERATIONS`].
    pub fn by_operation(&self) -> Vec<(&'static str, Counts)> {
        let mut counts: BTreeMap<usize, Counts> = BTreeMap::new();
        for finding in &self.findings {
            let place = OPERATIONS.iter().position(|name| *name == finding.operation);
            counts
                .entry(place.unwrap_or(OPERATIONS.len()))
                .or_default()
                .add(&finding.verdict);
        }
        let name = |place: usize| OPERATIONS.get(place).copied().unwrap_or("other");
        counts
            .into_iter()
            .map(|(place, counts)| (name(place), counts))
            .collect()
    }

    /// Counts of everything.
    pub fn total(&self) -> Counts {
        let mut total = Counts::default();
        for finding in &self.findings {
            total.add(&finding.verdict);
        }
        total
    }

    /// Whether the engine passes.
    pub fn outcome(&self) -> Outcome {
        let total = self.total();
        if total.wrong + total.missing > 0 {
            Outcome::Failed
        } else if total.right == 0 {
            Outcome::NothingJudged
        } else {
            Outcome::Passed
        }
    }
}
