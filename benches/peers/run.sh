#!/bin/sh
# Installs the peers into a virtual environment beside this script (or in $PEERS_VENV), builds the generator and, unless
# KNOTPROOF=none, the tool itself, and measures. Arguments are passed on to run.py: ./run.sh --limit 60 --output table.md
set -eu

here=$(cd "$(dirname "$0")" && pwd)
repository=$(cd "$here/../.." && pwd)
venv=${PEERS_VENV:-"$here/.venv"}
python=${PYTHON:-python3}

if [ ! -x "$venv/bin/python" ]; then
    "$python" -m venv "$venv"
fi
# One by one: a peer without a wheel for this platform does not keep the others out.
grep -v '^#' "$here/requirements.txt" | while read -r requirement; do
    "$venv/bin/python" -m pip install --quiet --disable-pip-version-check "$requirement" ||
        echo "run.sh: $requirement could not be installed" >&2
done

target=${CARGO_TARGET_DIR:-"$repository/target"}
cargo build --quiet --release --manifest-path "$repository/Cargo.toml" --example generate
set -- --generator "$target/release/examples/generate" "$@"
if [ "${KNOTPROOF:-}" != none ]; then
    if [ -z "${KNOTPROOF:-}" ]; then
        cargo build --quiet --release --manifest-path "$repository/Cargo.toml" --bin knotproof
    fi
    set -- --knotproof "${KNOTPROOF:-"$target/release/knotproof"}" "$@"
fi
exec "$venv/bin/python" "$here/run.py" "$@"
