#!/usr/bin/env bash
# scripts/npm_packages: tries the registry three times, and tells a registry that is not reached from another fault.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/support.sh"
stand_in node </dev/null
stand_in sleep </dev/null
# npm fails as often as $work/failures says, with the words of $work/words.
stand_in npm <<TEXT
echo tried >>"$work/tries"
left=\$(cat "$work/failures")
[ "\$left" -gt 0 ] || { mkdir -p node_modules; exit 0; }
echo \$((left - 1)) >"$work/failures"
cat "$work/words"
exit 1
TEXT
folder="$work/folder"
# run FAILURES WORDS: brings the packages of a new folder.
run() {
  rm -rf "$folder" "$work/tries"
  mkdir "$folder"
  echo lock >"$folder/package-lock.json"
  echo "$1" >"$work/failures"
  echo "$2" >"$work/words"
  status=0
  said=$(PATH="$work/bin:$PATH" "$root/scripts/npm_packages" "$folder" 2>&1) || status=$?
  tries=$(wc -l <"$work/tries")
}

run 0 ""
expect "all well" "$status $tries" "0 1"
said=$(PATH="$work/bin:$PATH" "$root/scripts/npm_packages" "$folder" 2>&1)
expect "what is there is not brought again" "$(wc -l <"$work/tries")" 1
run 2 "npm ERR! code ECONNRESET"
expect "a registry that is reached the third time" "$status $tries" "0 3"
for code in ENOTFOUND E503 "socket hang up"; do
  run 9 "npm ERR! $code"
  expect "no registry ($code)" "$status $tries" "3 3"
  expect "no registry ($code): the reason" "$(tail -n 1 <<<"$said")" "npm reaches no registry that has the packages ($code)"
done
run 9 "npm ERR! code EUSAGE: the lock is another"
expect "another fault is not tried again" "$status $tries" "1 1"
expect "another fault is shown" "$(tail -n 1 <<<"$said")" "npm ERR! code EUSAGE: the lock is another"
finish
