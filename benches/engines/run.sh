#!/bin/sh
# Installs the engines where tests/engines/run.sh has them, builds, measures all of them one after the other, and prints a table. Arguments go to run.py.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
engines="$here/../../tests/engines"
"$engines/run.sh" install
target=${CARGO_TARGET_DIR:-"$here/target"}
exec "$engines/.installed/python/bin/python" "$here/run.py" --criterion "$target/criterion" "$@"
