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

/// The subcommands that the help lists.
fn subcommands() -> Vec<String> {
    let help = run(["--help"]).expect(0).out;
    let commands = help.split("Commands:\n").nth(1).expect("a list of subcommands");
    let names = commands.lines().take_while(|line| line.starts_with("  "));
    let names = names
        .filter(|line| !line.starts_with("   "))
        .filter_map(|line| line.split_whitespace().next());
    names.map(String::from).filter(|name| name != "help").collect()
}

#[test]
fn completions_know_every_subcommand() {
    let names = subcommands();
    assert!(names.len() >= 3, "{names:?}");
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let script = run(["completions", shell]).expect(0).out;
        for name in &names {
            assert!(script.contains(name.as_str()), "{name} is not in the script of {shell}");
        }
        assert!(script.contains("snap-joints"), "{shell}");
    }
    run(["completions", "tcsh"]).expect_error(&["tcsh", "bash"]);
}

#[test]
fn manual_pages_know_every_subcommand() {
    let names = subcommands();
    let page = run(["man"]).expect(0).out;
    assert!(page.starts_with(".ie") || page.contains(".TH knotproof 1"), "{page}");
    let folder = tempfile::TempDir::new().expect("a folder");
    let pages = folder.path().join("pages");
    run(["man", "-o", pages.to_str().expect("UTF-8")]).expect(0);
    for name in &names {
        assert!(page.contains(&format!("knotproof\\-{name}")), "{name} is not in {page}");
        let page = std::fs::read_to_string(pages.join(format!("knotproof-{name}.1"))).expect("a page");
        assert!(page.contains(&format!(".TH knotproof-{name} 1")), "{page}");
    }
    let check = std::fs::read_to_string(pages.join("knotproof-check.1")).expect("a page");
    assert!(check.contains("\\-\\-snap\\-joints"), "{check}");
    #[cfg(feature = "prove")]
    assert!(pages.join("knotproof-certify-msd.1").exists());
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
