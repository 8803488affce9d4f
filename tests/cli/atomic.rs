//! The certificate's file is there whole or not at all.

use std::fs;

use tempfile::TempDir;

use super::run::{names, program, run, text};

const MP06: &str = "certs/curves/mp06-figure-1.json";

#[test]
fn nothing_but_the_certificate_is_left() {
    let directory = TempDir::new().expect("a directory");
    let path = directory.path().join("msd.cert.json");
    run(["certify", "msd", MP06, "-o", text(&path)]).expect(0);
    assert_eq!(names(directory.path()), ["msd.cert.json"]);
    // An older file is replaced, whatever it held.
    let first = fs::read(&path).expect("a certificate");
    fs::write(&path, "something longer than a certificate ".repeat(10_000)).expect("a file");
    run(["certify", "msd", MP06, "-o", text(&path)]).expect(0);
    assert_eq!(fs::read(&path).expect("a certificate"), first);
    assert_eq!(names(directory.path()), ["msd.cert.json"]);
}

#[test]
fn failures_leave_the_older_file() {
    let directory = TempDir::new().expect("a directory");
    let path = directory.path().join("msd.cert.json");
    fs::write(&path, "older").expect("a file");
    for curve in ["absent.json", "Cargo.toml"] {
        run(["certify", "msd", curve, "-o", text(&path)]).expect_error(&[curve]);
        assert_eq!(fs::read(&path).expect("the older file"), b"older");
        assert_eq!(names(directory.path()), ["msd.cert.json"]);
    }
}

#[cfg(unix)]
#[test]
fn a_certificate_is_as_readable_as_any_new_file() {
    use std::os::unix::fs::{MetadataExt, symlink};
    let directory = TempDir::new().expect("a directory");
    let (plain, path) = (directory.path().join("plain"), directory.path().join("msd.cert.json"));
    fs::write(&plain, "").expect("a file");
    run(["certify", "msd", MP06, "-o", text(&path)]).expect(0);
    let mode = |path| fs::metadata(path).expect("a file").mode();
    assert_eq!(mode(&plain), mode(&path));
    // What a link points to is replaced, the link stays.
    let link = directory.path().join("link");
    symlink(&plain, &link).expect("a link");
    run(["certify", "msd", MP06, "-o", text(&link)]).expect(0);
    assert!(fs::symlink_metadata(&link).expect("the link").is_symlink());
    assert_eq!(
        fs::read(&plain).expect("a certificate"),
        fs::read(&path).expect("a certificate")
    );
}

/// The system ends the program when a file of it exceeds a limit: in the middle of writing the certificate.
#[cfg(unix)]
#[test]
fn an_interrupted_run_leaves_nothing_that_looks_whole() {
    let directory = TempDir::new().expect("a directory");
    let path = directory.path().join("msd.cert.json");
    fs::write(&path, "older").expect("a file");
    let script = "ulimit -c 0; ulimit -f 1; exec \"$0\" certify msd \"$1\" -o \"$2\"";
    let status = std::process::Command::new("sh")
        .args(["-c", script, text(program().get_program().as_ref()), MP06, text(&path)])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .status()
        .expect("a shell");
    assert!(!status.success());
    assert_eq!(fs::read(&path).expect("the older file"), b"older");
    for name in names(directory.path()).iter().filter(|name| *name != "msd.cert.json") {
        assert!(name.starts_with(".knotproof-") && name.ends_with(".partial"), "{name}");
        run(["check", text(&directory.path().join(name))]).expect(1);
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_standard_output_is_told() {
    let full = fs::OpenOptions::new()
        .write(true)
        .open("/dev/full")
        .expect("a full device");
    let output = program()
        .args(["certify", "msd", MP06])
        .stdout(full)
        .output()
        .expect("the program runs");
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).starts_with("error: standard output: cannot be written"));
}
