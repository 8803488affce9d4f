//! The command line as a user meets it: the built program, its output, its exit codes, the files it leaves.

#[cfg(feature = "prove")]
#[path = "cli/atomic.rs"]
mod atomic;
#[cfg(feature = "prove")]
#[path = "cli/batch.rs"]
mod batch;
#[cfg(feature = "prove")]
#[path = "cli/certify.rs"]
mod certify;
#[path = "cli/check.rs"]
mod check;
#[cfg(feature = "prove")]
#[path = "cli/compare.rs"]
mod compare;
#[cfg(feature = "prove")]
#[path = "cli/curvature.rs"]
mod curvature;
#[cfg(feature = "prove")]
#[path = "cli/deviation.rs"]
mod deviation;
#[cfg(feature = "prove")]
#[path = "cli/domain.rs"]
mod domain;
#[cfg(feature = "prove")]
#[path = "cli/embedding.rs"]
mod embedding;
#[path = "cli/help.rs"]
mod help;
#[cfg(all(feature = "import", feature = "prove"))]
#[path = "cli/import.rs"]
mod import;
#[cfg(feature = "prove")]
#[path = "cli/motion.rs"]
mod motion;
#[path = "cli/run.rs"]
mod run;
#[cfg(feature = "prove")]
#[path = "cli/show.rs"]
mod show;
#[cfg(feature = "prove")]
#[path = "cli/usage.rs"]
mod usage;
#[cfg(feature = "prove")]
#[path = "cli/validate.rs"]
mod validate;
#[cfg(feature = "prove")]
#[path = "cli/values.rs"]
mod values;
