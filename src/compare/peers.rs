//! Interval methods of other projects, where they are installed: Codac and python-flint, each in a Python process of its own.
//!
//! The scripts are those of `benches/peers`. A peer that is missing, refuses the curve, fails, or takes too long is a row that says so.

use std::io::{Read, Write};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use serde::Deserialize;

use super::{Row, Standing, Value};
use crate::curve::{Curve, write_curve};
use crate::number::{Integer, Meaning, Rational, parse_number};

/// A module of the scripts: its name and its text.
type Module = (&'static str, &'static str);

const SHARED: [Module; 2] = [
    ("curve", include_str!("../../benches/peers/curve.py")),
    ("pairs", include_str!("../../benches/peers/pairs.py")),
];
const MAIN: &str = include_str!("../../benches/peers/one.py");
/// How often a running peer is looked at.
const NAP: Duration = Duration::from_millis(10);
/// So many letters of a message at most.
const MESSAGE: usize = 200;

struct Peer {
    /// As its script is named.
    name: &'static str,
    /// As people name it.
    title: &'static str,
    /// What is to be installed.
    packages: &'static str,
    script: Module,
    sigma: &'static str,
    seconds: &'static str,
    quantity: &'static str,
}

const PEERS: [Peer; 2] = [
    Peer {
        name: "codac",
        title: "Codac",
        packages: "codac numpy",
        script: ("peer_codac", include_str!("../../benches/peers/peer_codac.py")),
        sigma: "codac.sigma",
        seconds: "codac.seconds",
        quantity: "σ by contractors, bisection and interval Newton",
    },
    Peer {
        name: "flint",
        title: "python-flint",
        packages: "python-flint numpy",
        script: ("peer_flint", include_str!("../../benches/peers/peer_flint.py")),
        sigma: "flint.sigma",
        seconds: "flint.seconds",
        quantity: "σ by resultants and ball arithmetic",
    },
];

/// How peers are run.
#[derive(Clone, Debug)]
pub struct PeerOptions {
    /// The Python interpreter: a name that the system finds, or a path.
    pub python: String,
    /// A peer that takes longer is ended.
    pub limit: Duration,
}

/// What a peer's process prints.
#[derive(Deserialize)]
#[serde(untagged, deny_unknown_fields)]
enum Answer {
    Found {
        seconds: f64,
        lower: String,
        upper: Option<String>,
        normals: u64,
        version: String,
        note: String,
    },
    Missing {
        missing: String,
    },
    Refused {
        refused: String,
    },
}

/// The rows of all peers.
pub(super) fn rows(curve: &Curve, options: &PeerOptions) -> Vec<Row> {
    PEERS.iter().flat_map(|peer| peer_rows(peer, curve, options)).collect()
}

fn peer_rows(peer: &Peer, curve: &Curve, options: &PeerOptions) -> Vec<Row> {
    let none = |why: String| {
        vec![Row::new(peer.title, peer.sigma, peer.quantity, Value::None, Standing::Interval).remark(why)]
    };
    let output = match run(peer, curve, options) {
        Ok(output) => output,
        Err(why) => return none(why),
    };
    match serde_json::from_str(&output) {
        Err(_) => none(format!("failed: its answer is not understood: {}", short(&output))),
        Ok(Answer::Missing { missing }) => none(format!(
            "not installed: Python has no module {} (pip install {})",
            short(&missing),
            peer.packages
        )),
        Ok(Answer::Refused { refused }) => none(short(&refused)),
        Ok(Answer::Found {
            seconds,
            lower,
            upper,
            normals,
            version,
            note,
        }) => {
            let Some(value) = enclosure(&lower, upper.as_deref()) else {
                return none("failed: its bounds are not understood".into());
            };
            let mut remark = format!("{} {}, double normals: {normals}", peer.title, short(&version));
            if !note.is_empty() {
                remark = format!("{remark}, {}", short(&note));
            }
            let sigma = Row::new(peer.title, peer.sigma, peer.quantity, value, Standing::Interval).remark(remark);
            let milliseconds = Integer::from((seconds.max(0.0) * 1e3).round() as u64);
            let seconds = Value::Number(Rational::new(milliseconds, Integer::from(1000)));
            let time = Row::new(
                peer.title,
                peer.seconds,
                "its seconds, one thread",
                seconds,
                Standing::Measured,
            );
            vec![sigma, time]
        }
    }
}

fn enclosure(lower: &str, upper: Option<&str>) -> Option<Value> {
    if lower == "inf" {
        return upper.is_none().then_some(Value::Infinite);
    }
    let number = |text: &str| parse_number(text, Meaning::Decimal).ok();
    let lower = number(lower)?;
    let upper = match upper {
        None => None,
        Some(upper) => Some(number(upper)?),
    };
    let right = upper.as_ref().is_none_or(|upper| lower <= *upper);
    right.then_some(Value::Between(lower, upper))
}

/// One line, not too long.
fn short(text: &str) -> String {
    let line: String = text
        .trim()
        .chars()
        .map(|c| if c.is_control() { ' ' } else { c })
        .collect();
    match line.char_indices().nth(MESSAGE) {
        Some((end, _)) => format!("{}…", &line[..end]),
        None => line,
    }
}

/// The text of the program. JSON's strings are strings of Python too.
fn program(peer: &Peer, curve: &Curve) -> String {
    let quoted = |text: &str| serde_json::Value::from(text).to_string();
    let modules = SHARED.iter().chain([&peer.script]);
    let sources: Vec<String> = modules
        .map(|(name, text)| format!("{}: {}", quoted(name), quoted(text)))
        .collect();
    let curve = quoted(&write_curve(curve, None));
    format!(
        "SOURCES = {{{}}}\nPEER = {}\nCURVE = {curve}\n{MAIN}",
        sources.join(", "),
        quoted(peer.name)
    )
}

/// The last line that the process prints, or why there is none.
fn run(peer: &Peer, curve: &Curve, options: &PeerOptions) -> Result<String, String> {
    let mut child = Command::new(&options.python)
        .arg("-")
        .env("OMP_NUM_THREADS", "1")
        .env("OPENBLAS_NUM_THREADS", "1")
        .env("PYTHONIOENCODING", "utf-8")
        .env("PYTHONUTF8", "1")
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .map_err(|error| format!("not run: {} cannot be started ({error})", short(&options.python)))?;
    let text = program(peer, curve);
    let input = child.stdin.take();
    // A process that ends early closes its input; its exit tells why.
    let writer = thread::spawn(move || input.is_some_and(|mut input| input.write_all(text.as_bytes()).is_ok()));
    let (output, errors) = (gather(child.stdout.take()), gather(child.stderr.take()));
    let status = wait(&mut child, options.limit);
    // The pipes are closed with the process.
    let [output, errors] = [output, errors].map(|thread| thread.join().unwrap_or_default());
    let _ = writer.join();
    let last = |text: &str| short(text.trim_end().lines().next_back().unwrap_or_default());
    match status {
        Ok(None) => Err(format!("more than {} s", options.limit.as_secs_f64())),
        Ok(Some(status)) if status.success() => Ok(output.trim_end().lines().next_back().unwrap_or_default().into()),
        Ok(Some(status)) => match last(&errors) {
            why if why.is_empty() => Err(format!("failed: {status}")),
            why => Err(format!("failed: {why}")),
        },
        Err(error) => Err(format!("failed: {error}")),
    }
}

/// Reads all of a pipe, so that the process never waits for it.
fn gather(pipe: Option<impl Read + Send + 'static>) -> thread::JoinHandle<String> {
    thread::spawn(move || {
        let mut bytes = Vec::new();
        if let Some(mut pipe) = pipe {
            // What came before an error is still worth telling.
            let _ = pipe.read_to_end(&mut bytes);
        }
        String::from_utf8_lossy(&bytes).into_owned()
    })
}

/// Waits for the process to end; ends it at the limit, and returns nothing then.
fn wait(child: &mut Child, limit: Duration) -> std::io::Result<Option<ExitStatus>> {
    let start = Instant::now();
    loop {
        if let Some(status) = child.try_wait()? {
            return Ok(Some(status));
        }
        if start.elapsed() >= limit {
            child.kill()?;
            child.wait()?;
            return Ok(None);
        }
        thread::sleep(NAP);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve() -> Curve {
        let text = r#"{"knotproof":"curve/1","bezier":{"pieces":[{"points":[[0,0],[1,2],[2,0]]}]}}"#;
        crate::curve::read_curve(text).expect("a curve").curve
    }

    #[test]
    fn enclosures_are_read_exactly() {
        let third = Rational::new(Integer::ONE, Integer::from(3));
        assert_eq!(
            enclosure("1/3", Some("1")),
            Some(Value::Between(
                third.clone(),
                Some(Rational::from_integer(Integer::ONE))
            ))
        );
        assert_eq!(enclosure("1/3", None), Some(Value::Between(third, None)));
        assert_eq!(enclosure("inf", None), Some(Value::Infinite));
        for (lower, upper) in [("2", Some("1")), ("inf", Some("1")), ("x", None), ("1", Some("nan"))] {
            assert_eq!(enclosure(lower, upper), None, "{lower} {upper:?}");
        }
    }

    #[test]
    fn a_peer_that_cannot_run_is_a_row() {
        let options = |python: &str| PeerOptions {
            python: python.into(),
            limit: Duration::from_millis(300),
        };
        for (python, why) in [("no-such-python", "cannot be started"), ("", "cannot be started")] {
            let rows = rows(&curve(), &options(python));
            assert_eq!(rows.len(), PEERS.len());
            for row in rows {
                assert_eq!(row.value, Value::None);
                assert!(
                    row.remark.as_ref().is_some_and(|remark| remark.contains(why)),
                    "{row:?}"
                );
            }
        }
    }

    #[cfg(unix)]
    #[test]
    fn programs_that_are_no_python() {
        // `cat -` prints the program back, `false` fails.
        for (python, why) in [("cat", "not understood"), ("false", "failed: exit status: 1")] {
            let options = PeerOptions {
                python: python.into(),
                limit: Duration::from_secs(20),
            };
            let rows = peer_rows(&PEERS[0], &curve(), &options);
            assert_eq!(rows.len(), 1);
            let remark = rows[0].remark.clone().unwrap_or_default();
            assert!(remark.contains(why), "{remark}");
        }
    }

    #[cfg(unix)]
    #[test]
    fn a_peer_that_takes_too_long_is_ended() {
        let mut child = Command::new("sleep").arg("60").spawn().expect("sleep");
        let start = Instant::now();
        assert_eq!(wait(&mut child, Duration::from_millis(50)).expect("waits"), None);
        assert!(start.elapsed() < Duration::from_secs(30));
    }

    #[test]
    fn long_messages_are_cut_at_a_letter() {
        assert_eq!(short(" a\nb "), "a b");
        assert_eq!(short(&"é".repeat(300)).chars().count(), MESSAGE + 1);
    }
}
