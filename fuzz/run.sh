#!/usr/bin/env bash
# Fuzzes every reader for some seconds each: fuzz/run.sh [SECONDS [TARGET...]]. Needs nightly Rust and cargo-fuzz (cargo install cargo-fuzz).
# Starts from the repository's own small files; what is found stays in fuzz/corpus and fuzz/artifacts, which git ignores.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
seconds=${1:-60}
shift || true

if ! cargo +nightly fuzz --version >/dev/null 2>&1; then
    echo "fuzz/run.sh: cargo-fuzz or nightly Rust is missing (rustup toolchain install nightly; cargo install cargo-fuzz)" >&2
    exit 2
fi

seeds() {
    case $1 in
    read_curve) echo certs/curves/*.json ;;
    check_certificate) find certs/accept certs/reject -name '*.json' -size -8k ;;
    check_binary) find certs/accept certs/reject -name '*.cert' -size -8k ;;
    import_svg) echo tests/import/*.svg ;;
    import_font) echo tests/import/*.ttf tests/import/*.otf ;;
    import_geomdl) echo tests/import/*.geomdl.json ;;
    import_vect) echo tests/import/*.vect ;;
    import_step) echo tests/import/*.step ;;
    import_iges) echo tests/import/*.igs ;;
    import_pdb) echo tests/import/*.pdb ;;
    import_mmcif) echo tests/import/*.cif ;;
    *) echo fuzz/seeds/"$1"/* ;;
    esac
}

if [ $# -eq 0 ]; then
    mapfile -t targets < <(basename -s .rs -a fuzz/fuzz_targets/*.rs)
    set -- "${targets[@]}"
fi
failed=0
for target in "$@"; do
    corpus=fuzz/corpus/$target
    mkdir -p "$corpus"
    # shellcheck disable=SC2046
    for seed in $(seeds "$target"); do
        cp "$seed" "$corpus/seed-$(echo "$seed" | tr / -)"
    done
    dictionary=()
    [ "$target" = read_curve ] && dictionary=(-dict=fuzz/curve.dict)
    echo "== $target"
    cargo +nightly fuzz run "$target" "$corpus" -- -max_total_time="$seconds" -max_len=16384 -timeout=20 -rss_limit_mb=4096 "${dictionary[@]}" 2>&1 |
        grep -E '^(Done|SUMMARY|thread|ERROR|==[0-9]+==|artifact|Test unit)|panicked|crash-|timeout-|oom-' || failed=1
done
exit $failed
