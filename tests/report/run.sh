#!/usr/bin/env bash
# Tests of HTML reports in a real browser. Needs Node.js with npm, and Chromium (Debian: chromium; or name another in CHROMIUM).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
browser=${CHROMIUM:-$(command -v chromium || command -v chromium-browser || command -v google-chrome)}
knotproof=${KNOTPROOF:-../../target/release/knotproof}
node wasm.mjs "$knotproof" ../../certs/accept ../../certs/reject
[ -d node_modules/playwright-core ] || npm install --no-audit --no-fund --silent
node report.test.mjs "$browser" "$knotproof" ../../certs/accept
