#!/usr/bin/env bash
# Tests the page in a real browser. Installs what it needs: the npm packages of the lock file and, where it is missing, Debian's
# chromium. With SCREENSHOTS=DIR the pictures of the page are written there. PERCUSS=PROGRAM tests that program, otherwise the
# release build is made and tested.
set -euo pipefail
cd "$(dirname "$0")"
root="$(cd ../../.. && pwd)"

chromium="${CHROMIUM:-$(command -v chromium || true)}"
if [ -z "$chromium" ]; then
    [ "$(id -u)" -eq 0 ] || { echo "chromium is missing: install it, or name a browser with CHROMIUM=PATH" >&2; exit 1; }
    apt-get update -qq
    apt-get -o DPkg::Lock::Timeout=600 install -y -qq chromium
    chromium=/usr/bin/chromium
fi
export CHROMIUM="$chromium"
command -v npm >/dev/null || { echo "npm is missing: install Node.js with npm to test the page" >&2; exit 1; }

# Packages that are those of the lock file stay.
cmp -s package-lock.json node_modules/.installed || {
    npm ci --no-audit --no-fund --loglevel=error
    cp package-lock.json node_modules/.installed
}
npx tsc --noEmit

# What is committed is what the sources give.
fresh="$(mktemp -d)"
trap 'rm -rf "$fresh"' EXIT
node build.mjs "$fresh"
diff -r dist "$fresh" || { echo "web/dist is not what its sources give: run \`npm run build\`" >&2; exit 1; }

if [ -z "${PERCUSS:-}" ]; then
    cargo build --manifest-path "$root/Cargo.toml" --release --locked
fi
node --test --test-concurrency=2 test/*.test.mjs
# Many clients at once, for a short time; docs/serve.md has the long one.
node load.mjs --seconds 3
