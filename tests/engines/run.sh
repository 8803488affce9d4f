#!/bin/sh
# Installs the engines into folders that git ignores, runs all of them on generated cases, and writes docs/ENGINES.md.
#   tests/engines/run.sh install     only installs
#   tests/engines/run.sh [options]   installs what is missing and runs; options of the report: --seed, --count, --rounds, …
# Needed: cargo, python3 (3.10 to 3.13) with venv, node 20 or newer with npm.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
cd "$here"

python=.installed/python/bin/python
if [ ! -x "$python" ]; then
    python3 -m venv .installed/python
fi
"$python" -m pip install --quiet --requirement python/requirements.txt
(cd javascript && npm install --no-audit --no-fund --silent)
(cd rust && CARGO_TARGET_DIR="$here/.installed/rust" cargo build --quiet --release)
[ "${1:-}" = install ] && exit 0

export PYTHONDONTWRITEBYTECODE=1
cd "$here/../.."
cargo run --quiet --release --example engines -- \
    --curves certs/curves/*.json \
    --engine ".installed/rust/release/kurbo" \
    --engine ".installed/rust/release/curvo" \
    --engine ".installed/rust/release/truck" \
    --engine "$python python/scipy_engine.py" \
    --engine "$python python/geomdl_engine.py" \
    --engine "$python python/splipy_engine.py" \
    --engine "$python python/bezier_engine.py" \
    --engine "$python python/tinyspline_engine.py" \
    --engine "$python python/occt_engine.py" \
    --engine "node javascript/three.mjs" \
    --engine "node javascript/verb.mjs" \
    --output docs/ENGINES.md \
    "$@"
