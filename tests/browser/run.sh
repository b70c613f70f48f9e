#!/usr/bin/env bash
# A test of the window in a real browser: tests/browser/run.sh BUILD_FOLDER NAME_test.mjs, or another program of this folder with its
# arguments. Exit status 77 where Node, Chromium or npm's registry is missing: then the test is skipped, by name.
set -euo pipefail
build=$(cd "$1" && pwd)
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
skip() { echo "skipped: $1"; exit 77; }
browser=${HOOKPOINT_BROWSER:-$(command -v chromium || command -v google-chrome || true)}
[ -n "$browser" ] || skip "chromium is not installed (Debian: apt-get install chromium)"

# Beside the build, so that the sources stay as they are.
folder="$build/browser_tests"
mkdir -p "$folder"
exec 9>"$folder/.lock"
flock 9
cp "$here"/*.mjs "$here"/package.json "$here"/package-lock.json "$folder"
status=0
said=$("$here/../../scripts/npm_packages" "$folder" 2>&1) || status=$?
case "$status" in
  0) ;;
  3) skip "the packages of tests/browser: $(tail -n 1 <<<"$said")" ;;
  *) echo "$said"; exit 1 ;;
esac
flock -u 9
cd "$folder"
export HOOKPOINT_PROGRAM="$build/hookpoint" HOOKPOINT_CONFIGS="$here/../../configs" HOOKPOINT_BROWSER="$browser"
# A browser that the pinned playwright does not drive is no fault of the change.
drives() { said=$(node drives.mjs); }
drives || { sleep 2; drives; } || { sleep 10; drives; } || skip "$said"
case "$2" in
  *_test.mjs) exec node --test "$2" ;;
  *) exec node "${@:2}" ;;
esac
