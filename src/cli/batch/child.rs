//! One claim about one curve, certified by a process of its own: whatever becomes of it, the batch goes on.

use std::env;
use std::ffi::OsStr;
use std::io::{self, Read, Write};
use std::process::{Command, ExitStatus, Stdio};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use super::interrupt;

/// How often is looked whether the batch is to end.
const LOOK: Duration = Duration::from_millis(100);

/// What a process came to.
pub struct Ran {
    /// Its exit code, or the signal.
    pub status: ExitStatus,
    /// Its standard output.
    pub out: String,
    /// Its standard error.
    pub err: String,
}

/// Runs this program again, with `input` on its standard input; nothing when the batch was to end before.
///
/// # Errors
/// The process cannot be started.
pub fn run<S: AsRef<OsStr>>(arguments: &[S], input: &[u8], threads: usize) -> io::Result<Option<Ran>> {
    let mut child = Command::new(env::current_exe()?)
        .args(arguments)
        .env("RAYON_NUM_THREADS", threads.to_string())
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()?;
    let (stdin, stdout, stderr) = (child.stdin.take(), child.stdout.take(), child.stderr.take());
    thread::scope(|scope| {
        let (done, wait) = channel::<()>();
        scope.spawn(move || {
            // A process that stops early need not read all of it.
            let _ = stdin.map(|mut pipe| pipe.write_all(input));
        });
        let err = scope.spawn(move || text(stderr));
        let out = scope.spawn(move || {
            let text = text(stdout);
            drop(done);
            text
        });
        while wait.recv_timeout(LOOK) == Err(RecvTimeoutError::Timeout) {
            if interrupt::asked() {
                // It may have ended by itself meanwhile.
                let _ = child.kill();
                break;
            }
        }
        let status = child.wait()?;
        let (out, err) = (out.join().unwrap_or_default(), err.join().unwrap_or_default());
        Ok((!interrupt::asked() || status.code().is_some()).then_some(Ran { status, out, err }))
    })
}

/// All that comes out of a pipe.
fn text(pipe: Option<impl Read>) -> String {
    let mut bytes = Vec::new();
    if let Some(mut pipe) = pipe {
        // What came before an error is kept.
        let _ = pipe.read_to_end(&mut bytes);
    }
    String::from_utf8_lossy(&bytes).into_owned()
}
