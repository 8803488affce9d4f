#!/usr/bin/env bash
# Compiles the checker for HTML reports: src/show/html/checker.wasm.gz.
# Needs the target wasm32-unknown-unknown (rustup target add wasm32-unknown-unknown), or a compiler with its library sources: BUILD_STD=1.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
target=${CARGO_TARGET_DIR:-$PWD/target}
options=()
if [ "${BUILD_STD:-0}" = 1 ]; then
    export RUSTC_BOOTSTRAP=1
    options=(-Zbuild-std=std,panic_abort)
fi
# No path of this machine belongs into the file.
flags="--remap-path-prefix=$(cd ../../.. && pwd)=knotproof --remap-path-prefix=$("${RUSTC:-rustc}" --print sysroot)=rust"
for crates in "${CARGO_HOME:-$HOME/.cargo}"/registry/src/*; do
    flags+=" --remap-path-prefix=$crates=crates"
done
RUSTFLAGS=$flags \
    cargo build --release --locked --target wasm32-unknown-unknown --target-dir "$target" "${options[@]}"
gzip -9n <"$target/wasm32-unknown-unknown/release/knotproof_checker.wasm" >../../../src/show/html/checker.wasm.gz
ls -l ../../../src/show/html/checker.wasm.gz
