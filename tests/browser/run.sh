#!/usr/bin/env bash
# A test of the window in a real browser: tests/browser/run.sh BUILD_FOLDER NAME_test.mjs, or another program of this folder with its
# arguments. Exit status 77 where Node, Chromium or npm's registry is missing: then the test is skipped, by name.
set -euo pipefail
build=$(cd "$1" && pwd)
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
skip() { echo "skipped: $1"; exit 77; }
for needed in node npm; do command -v "$needed" >/dev/null || skip "$needed is not installed (Debian: apt-get install nodejs npm)"; done
browser=${HOOKPOINT_BROWSER:-$(command -v chromium || command -v google-chrome || true)}
[ -n "$browser" ] || skip "chromium is not installed (Debian: apt-get install chromium)"

# Beside the build, so that the sources stay as they are; npm brings the packages once for each package-lock.json.
folder="$build/browser_tests"
mkdir -p "$folder"
exec 9>"$folder/.lock"
flock 9
cp "$here"/*.mjs "$here"/package.json "$here"/package-lock.json "$folder"
if ! cmp -s "$folder/package-lock.json" "$folder/node_modules/.installed"; then
  if ! said=$(cd "$folder" && npm ci --prefer-offline --no-audit --no-fund --fetch-retries=1 --fetch-retry-mintimeout=1000 2>&1); then
    rm -rf "$folder/node_modules"
    case "$said" in
      *ENOTFOUND* | *EAI_AGAIN* | *ECONNREFUSED* | *ECONNRESET* | *ECONNABORTED* | *ENETUNREACH* | *EHOSTUNREACH* | *ETIMEDOUT* | *ERR_SOCKET_TIMEOUT* | *ENOTCACHED* | *SELF_SIGNED_CERT_IN_CHAIN* | *UNABLE_TO_GET_ISSUER_CERT*)
        skip "the packages of tests/browser, for which npm reaches no registry" ;;
    esac
    echo "$said"
    exit 1
  fi
  cp "$folder/package-lock.json" "$folder/node_modules/.installed"
fi
flock -u 9
cd "$folder"
export HOOKPOINT_PROGRAM="$build/hookpoint" HOOKPOINT_CONFIGS="$here/../../configs" HOOKPOINT_BROWSER="$browser"
case "$2" in
  *_test.mjs) exec node --test "$2" ;;
  *) exec node "${@:2}" ;;
esac
