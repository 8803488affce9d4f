#!/bin/sh
# Installs lrslib, cddlib, CGAL (from the system's packages, as root on Debian and its like) and pplpy (into a virtual environment beside this
# script, or in $PEERS_VENV), and times them on the systems of `cargo bench --bench polytope`. Prints a Markdown table. A peer that cannot be
# had is left out.
set -eu

here=$(cd "$(dirname "$0")" && pwd)
repository=$(cd "$here/../.." && pwd)
venv=${PEERS_VENV:-"$here/.venv"}
python=${PYTHON:-python3}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

if [ "$(id -u)" = 0 ] && command -v apt-get >/dev/null; then
    for package in lrslib libcdd-tools libcgal-dev libgmp-dev libmpfr-dev libppl-dev; do
        dpkg -s "$package" >/dev/null 2>&1 ||
            DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends "$package" >&2 ||
            echo "polytope.sh: $package could not be installed" >&2
    done
fi
[ -x "$venv/bin/python" ] || "$python" -m venv "$venv"
"$venv/bin/python" -m pip install --quiet --disable-pip-version-check pplpy ||
    echo "polytope.sh: pplpy could not be installed" >&2
${CXX:-g++} -O2 -DNDEBUG -std=c++17 "$here/polytope_cgal.cpp" -o "$work/polytope_cgal" -lgmp -lmpfr ||
    echo "polytope.sh: the program for CGAL could not be built" >&2

cargo bench --quiet --manifest-path "$repository/Cargo.toml" --bench polytope -- --write "$work" >"$work/knotproof.tsv"
"$venv/bin/python" "$here/polytope.py" "$work"
