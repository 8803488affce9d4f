//! A claim with its options, to be certified of many curves.

use std::ffi::OsString;

use clap::parser::ValueSource;
use clap::{ArgMatches, Args, Command};

use super::Arguments;

/// Arguments that say what to certify it of, and where to put what comes out. They are no part of the claim.
const OUTSIDE: [&str; 18] = [
    "curve",
    "motion",
    "output",
    "format",
    "snap_joints",
    "all",
    "jobs",
    "time_limit",
    "resume",
    "jsonl",
    "show",
    "select",
    "numbers",
    "weld",
    "exact",
    "smooth",
    "json",
    "quiet",
];

/// A claim with its options.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Specification {
    /// The name of the claim.
    pub claim: String,
    /// Its options, as `certify` takes them.
    pub options: Vec<OsString>,
}

/// The command `certify`, with its claims.
fn certify() -> Command {
    Arguments::augment_args(Command::new("certify")).no_binary_name(true)
}

impl Specification {
    /// The options as text.
    pub fn shown(&self) -> Vec<String> {
        self.options
            .iter()
            .map(|option| option.to_string_lossy().into_owned())
            .collect()
    }

    /// The claim that a command line of `certify` is about.
    pub fn of(claim: &str, matches: &ArgMatches) -> Specification {
        let mut options: Vec<OsString> = Vec::new();
        let certify = certify();
        let arguments = certify
            .find_subcommand(claim)
            .into_iter()
            .flat_map(Command::get_arguments);
        for argument in arguments {
            let id = argument.get_id().as_str();
            let Some(long) = argument.get_long() else { continue };
            // Of the names of the program's own help and version there is no value.
            let given = matches.try_contains_id(id).unwrap_or(false)
                && matches.value_source(id) == Some(ValueSource::CommandLine);
            if !given || OUTSIDE.contains(&id) {
                continue;
            }
            if !argument.get_action().takes_values() {
                options.push(format!("--{long}").into());
                continue;
            }
            for values in matches.get_raw_occurrences(id).into_iter().flatten() {
                let values: Vec<_> = values.collect();
                if let [value] = values[..] {
                    let mut option = OsString::from(format!("--{long}="));
                    option.push(value);
                    options.push(option);
                } else {
                    options.push(format!("--{long}").into());
                    options.extend(values.into_iter().map(OsString::from));
                }
            }
        }
        Specification {
            claim: claim.into(),
            options,
        }
    }

    /// Reads a claim with options, as in "msd --rel-width 1e-9".
    ///
    /// # Errors
    /// What `certify` would say of it, and options that belong to the whole batch.
    pub fn parse(text: &str) -> Result<Specification, String> {
        let words: Vec<&str> = text.split_whitespace().collect();
        if words.is_empty() {
            return Err("expected the name of a claim".into());
        }
        let matches = certify()
            .try_get_matches_from(words.iter().copied().chain(["-"]))
            .map_err(|error| {
                let text = error.to_string();
                let first = text.lines().next().unwrap_or_default();
                first.strip_prefix("error: ").unwrap_or(first).to_string()
            })?;
        let Some((claim, matches)) = matches.subcommand() else {
            return Err("expected the name of a claim".into());
        };
        let files = ["curve", "motion"].map(|id| matches.try_get_raw(id).ok().flatten().map_or(0, Iterator::count));
        if files.iter().sum::<usize>() > 1 {
            return Err("found a file among the options of a claim".into());
        }
        let foreign = OUTSIDE.iter().find(|id| {
            !matches!(**id, "curve" | "motion")
                && matches.try_contains_id(id).unwrap_or(false)
                && matches.value_source(id) == Some(ValueSource::CommandLine)
        });
        match foreign {
            Some(id) => {
                let option = id.replace('_', "-");
                Err(format!("--{option} is an option of the whole batch, not of a claim"))
            }
            None => Ok(Specification::of(claim, matches)),
        }
    }

    /// Reads several, separated by commas. A comma is a separator where the name of a claim follows.
    ///
    /// # Errors
    /// As [`Specification::parse`].
    pub fn parse_all(text: &str) -> Result<Vec<Specification>, String> {
        let certify = certify();
        let mut texts: Vec<String> = Vec::new();
        for part in text.split(',') {
            let first = part.split_whitespace().next().unwrap_or_default();
            match texts.last_mut() {
                Some(last) if certify.find_subcommand(first).is_none() => {
                    last.push(',');
                    last.push_str(part);
                }
                _ => texts.push(part.into()),
            }
        }
        texts
            .iter()
            .map(|text| Specification::parse(text).map_err(|error| format!("{text:?}: {error}")))
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(text: &str) -> Vec<(String, Vec<OsString>)> {
        let all = Specification::parse_all(text).unwrap_or_else(|error| panic!("{error}"));
        all.into_iter().map(|each| (each.claim, each.options)).collect()
    }

    #[test]
    fn claims_with_options() {
        assert_eq!(parsed("embedding"), [("embedding".into(), vec![])]);
        let several = parsed(
            "embedding, msd --rel-width 1e-9 --convention=critical,domain --point 1 --box 20 --nearest -1,2 --exact-measure",
        );
        assert_eq!(several.len(), 3);
        assert_eq!(several[1].0, "msd");
        assert_eq!(several[1].1, ["--convention=critical", "--rel-width=1e-9"]);
        assert_eq!(
            several[2].1,
            ["--point=1", "--box=20", "--nearest=-1,2", "--exact-measure"]
        );
        let interval = parsed("domain --point 1 --box 20 --interval 0 1/2");
        assert_eq!(interval[0].1, ["--point=1", "--box=20", "--interval", "0", "1/2"]);
        // What comes out is read back the same.
        for each in Specification::parse_all("msd --budget 7,domain --point 1 --box 20 --interval -1 2").unwrap() {
            let words: Vec<_> = each.options.iter().map(|word| word.to_str().unwrap()).collect();
            let again = Specification::parse(&format!("{} {}", each.claim, words.join(" ")));
            assert_eq!(again.as_ref(), Ok(&each));
        }
    }

    #[test]
    fn what_is_no_claim_is_refused() {
        for (text, part) in [
            ("", "claim"),
            ("distance", "distance"),
            ("msd --rel-width 2", "1e-30 to 1e-1"),
            ("msd --nonsense", "--nonsense"),
            ("msd -o x", "--output is an option of the whole batch"),
            ("msd --time-limit 3", "--time-limit is an option of the whole batch"),
            ("embedding extra", "found a file"),
        ] {
            let error = Specification::parse_all(text).expect_err(text);
            assert!(error.contains(part), "{error}");
        }
    }
}
