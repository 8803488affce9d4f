#!/usr/bin/env bash
# What can be proved of the subpaths of real drawings and glyphs: all of feather-icons, 150 of simple-icons, 200 glyphs of a font.
# Prints a table and the reason for each subpath that is not certified. Usage: coverage.sh [PROGRAM] [PARALLEL] [K]; with K only
# every K-th file and glyph is taken. Run fetch.sh first.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
exec python3 tests/import/coverage.py "${1:-target/release/knotproof}" "${2:-2}" "${3:-1}"
