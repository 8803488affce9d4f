//! What the program says of itself.

use super::run::run;

#[test]
fn help_tells_subcommands_and_exit_codes() {
    let help = run(["--help"]).expect(0).out;
    for word in ["check", "Exit codes: 0", "2 wrong usage"] {
        assert!(help.contains(word), "{word:?} is not in {help}");
    }
    let check = run(["check", "--help"]).expect(0).out;
    for option in ["--curve", "--snap-joints", "--json", "--quiet"] {
        assert!(check.contains(option), "{option:?} is not in {check}");
    }
}

#[test]
fn version_is_the_package_version() {
    let version = concat!("knotproof ", env!("CARGO_PKG_VERSION"), "\n");
    assert_eq!(run(["--version"]).expect(0).out, version);
}

#[test]
fn nothing_to_do_is_wrong_usage() {
    for arguments in [&[][..], &["nonsense"], &["check"], &["check", "--nonsense", "x"]] {
        let run = run(arguments);
        assert_eq!((run.code, run.out.as_str()), (2, ""), "{run:?}");
        assert!(run.err.contains("Usage: knotproof"), "{run:?}");
    }
}

#[cfg(feature = "prove")]
#[test]
fn help_of_certify_tells_its_options() {
    assert!(run(["--help"]).expect(0).out.contains("certify"));
    let help = run(["certify", "msd", "--help"]).expect(0).out;
    let options = [
        "--convention",
        "--rel-width",
        "1e-30 to 1e-1",
        "--budget",
        "--threads",
        "--output",
        "--format",
        "\".bin\"",
        "--snap-joints",
        "--json",
        "--quiet",
        "exit code is 3",
    ];
    for option in options {
        assert!(help.contains(option), "{option:?} is not in {help}");
    }
}

#[cfg(not(feature = "prove"))]
#[test]
fn the_checker_alone_says_so() {
    let help = run(["--help"]).expect(0).out;
    assert!(help.contains("checker alone"), "{help}");
    assert!(!help.contains("certify"), "{help}");
    run(["certify", "msd", "certs/curves/square.json"]).expect_error(&["unrecognized subcommand 'certify'"]);
}
