# What the tests of scripts share: a work folder that goes at the end, stand-ins for programs, and expectations.
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0

# stand_in NAME: a program of that name, its text from standard input, before all others on PATH.
stand_in() {
  mkdir -p "$work/bin"
  { echo '#!/bin/bash'; cat; } >"$work/bin/$1"
  chmod +x "$work/bin/$1"
}

# expect WHAT ACTUAL WANTED
expect() {
  if [ "$2" != "$3" ]; then
    printf 'FAILED: %s\n  is:        %s\n  should be: %s\n' "$1" "$2" "$3"
    failures=$((failures + 1))
  fi
}

finish() { [ "$failures" -eq 0 ] || exit 1; }
