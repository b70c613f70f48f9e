#!/usr/bin/env bash
# .ci/run on made-up commands: the last lines name each fault, with the first lines of its message and the command that repeats it.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/support.sh"
project="$work/project"
mkdir -p "$project/.ci" "$project/scripts"
cp "$root"/.ci/{run,full,quick,parts.sh,expected_skips} "$project/.ci/"
export GIT_AUTHOR_NAME=a GIT_AUTHOR_EMAIL=a@b GIT_COMMITTER_NAME=a GIT_COMMITTER_EMAIL=a@b GIT_CONFIG_GLOBAL=/dev/null
git init -q "$project"
echo build >"$project/.gitignore"
# commit: all that is there.
commit() {
  git -C "$project" add -A
  git -C "$project" commit -q --allow-empty -m change
}
commit

# says FILE STATUS TEXT: a command of the project that prints a text and ends so.
says() {
  printf '#!/bin/bash\ncat <<"TEXT"\n%s\nTEXT\nexit %s\n' "$3" "$2" >"$project/$1"
  chmod +x "$project/$1"
}
# What passes, until a case says otherwise.
begin() {
  says scripts/setup 0 ""
  says scripts/check_format 0 ""
  says scripts/tidy 0 ""
  says scripts/check_presets 0 ""
  says scripts/check_syntax 0 ""
  says scripts/clean_room 0 "clean_room: all fine"
  says test 0 "10 passed, 0 failed, 0 skipped"
  limit=4800
}
stand_in clang-format </dev/null
stand_in run-clang-tidy </dev/null
stand_in mmdebstrap </dev/null
# run SCRIPT [PART...]: the summary is in `said`, the status in `status`.
run() {
  local script=$1
  shift
  status=0
  all=$(PATH="$work/bin:$PATH" HOOKPOINT_CI_SECONDS=$limit bash "$project/.ci/$script" "$@" 2>&1 </dev/null) || status=$?
  said=$(cat "$project/build/ci/summary")
  expect "$script: the summary ends the output" "$(tail -n "$(wc -l <<<"$said")" <<<"$all")" "$said"
  expect "$script: at most sixty lines" "$([ "$(wc -l <<<"$said")" -le 60 ] && echo yes)" yes
}
# says_line WHAT LINE: the summary has the line, times left out.
says_line() { expect "$1" "$(sed -E 's/ \([0-9]+ min [0-9]+ s\)//' <<<"$said" | grep -Fx -- "$2")" "$2"; }

begin
commit
run run
expect "all well: status" "$status" 0
expect "all well: last line" "$(tail -n 1 <<<"$said")" "21 passed, 0 failed, 0 skipped"
says_line "all well: a part" "release: 10 passed, 0 failed, 0 skipped"
run full
expect "all well, everything: last line" "$(tail -n 1 <<<"$said")" "35 passed, 0 failed, 0 skipped"
# row PART: what is recorded of it.
row() { sed -nE "s/^\| $1 \| (.*) \| [0-9]+ min [0-9]+ s \|$/\1/p" "$project/.ci/last_full.md"; }
head() { git -C "$project" rev-parse HEAD; }
first=$(head)
expect "each part's result is recorded" "$(row release)" "$first | 10 | 0 | 0"
expect "each part has a row" "$(grep -c "$first" "$project/.ci/last_full.md")" 8

# What changed since then decides which of its parts are added.
commit
run run
expect "no change: parts" "$(grep -cE '^(tidy|clean_room)' <<<"$said" || true)" 0
mkdir "$project/studies"
echo 'int a;' >"$project/studies/a.cpp"
commit
run run
expect "a changed source: it is read by clang-tidy" "$(grep -c '^tidy: 1 passed' <<<"$said")" 1
expect "a changed source: it is parsed by itself" "$(grep -c '^syntax: 1 passed' <<<"$said")" 1
expect "a changed source: no bare machine" "$(grep -c '^clean_room' <<<"$said" || true)" 0
echo '#include <zlib.h>' >>"$project/studies/a.cpp"
commit
run run
expect "a new header: a bare machine" "$(grep -c '^clean_room: 1 passed' <<<"$said")" 1

# A part run by itself moves its own row alone.
run full clean_room
expect "one part: its row" "$(row clean_room)" "$(head) | 1 | 0 | 0"
expect "one part: the others' rows" "$(row tidy)" "$first | 1 | 0 | 0"
commit
run run
expect "one part: it is not run again" "$(grep -c '^clean_room' <<<"$said" || true)" 0
expect "one part: the others are" "$(grep -c '^tidy: 1 passed' <<<"$said")" 1
echo 'int b;' >>"$project/studies/a.cpp"
recorded=$(row clean_room)
run full clean_room
expect "files that differ from the commit leave no row" "$(row clean_room)" "$recorded"
commit
says scripts/tidy 1 "a.cpp:1:1: error: no"
commit
run full tidy
run run
expect "a part that failed is no base" "$(grep -c '^tidy' <<<"$said" || true)" 0

begin
says test 1 "failed: a_test: Suite.Case
  tests/unit/a_test.cpp:12
  Expected equality
repeat: ./test -R '^(a_test)\$'
9 passed, 1 failed, 0 skipped"
run run release
expect "a failed test: status" "$status" 1
says_line "a failed test: named" "failed: release: a_test: Suite.Case"
says_line "a failed test: message" "  Expected equality"
says_line "a failed test: repeated" "repeat: ./test -R '^(a_test)\$'"
expect "a failed test: last line" "$(tail -n 1 <<<"$said")" "9 passed, 1 failed, 0 skipped"

begin
says test 3 "build (release): configuring
FAILED: studies/a.o
$project/studies/a.cpp:7:3: error: 'x' was not declared in this scope
build (release): failed (log: build/release/build.log)"
run run
says_line "a compile error: shown" "  studies/a.cpp:7:3: error: 'x' was not declared in this scope"
says_line "a compile error: repeated" "repeat: ./test -LE full"
says_line "a compile error: ends the run" "ended early: what follows needs the release build"
expect "a compile error: no later part" "$(grep -c '^sanitizers' <<<"$said")" 0
expect "a compile error: status" "$status" 1

begin
says test 3 "setup: installing libeigen3-dev
setup: these packages cannot be had: libeigen3-dev (log: /tmp/log)"
run run
says_line "a missing package" "  setup: these packages cannot be had: libeigen3-dev (log: /tmp/log)"

begin
says scripts/check_format 1 "studies/a.cpp:3:1: error: code should be clang-formatted [-Wclang-format-violations]"
run run
says_line "format: named" "  studies/a.cpp:3:1: error: code should be clang-formatted [-Wclang-format-violations]"
says_line "format: repeated" "repeat: scripts/check_format --fix"

begin
printf '#!/bin/bash\necho "    Start 1: a_test"\necho "    Start 2: b_test"\necho "1/2 Test #1: a_test ...   Passed    0.01 sec"\nsleep 60\n' >"$project/test"
limit=3
run run release
says_line "a hang: what was running" "failed: release: b_test: was running"
says_line "a hang: the watchdog" "failed: release: stopped by the watchdog, 3 s after the beginning"
expect "a hang: status" "$status" 1

begin
says test 0 "skipped: a_test: Suite.Case: it is raining
skipped: b_test: Suite.Case: engine dart is not found
9 passed, 0 failed, 2 skipped"
run full
says_line "everything: an unexpected skip fails" "failed: release: skipped: a_test: Suite.Case: it is raining"
expect "everything: an expected skip does not" "$(grep -c b_test <<<"$said" || true)" 0

begin
says scripts/clean_room 77 "clean_room: no bare root can be made here: mmdebstrap failed"
run full clean_room
expect "what cannot run here is skipped" "$(tail -n 1 <<<"$said")" "0 passed, 0 failed, 1 skipped"
expect "what cannot run here: the reason" "$(grep -c 'mmdebstrap failed' <<<"$said")" 1

begin
says test 1 "$(for i in $(seq 100); do printf 'failed: test_%s: Suite.Case\n  a.cpp:1\n  wrong\n' "$i"; done)
repeat: ./test -R 'many'
0 passed, 100 failed, 0 skipped"
run run release
says_line "very many failures: the command is there" "repeat: ./test -R 'many'"
says_line "very many failures: the first is named" "failed: release: test_1: Suite.Case"
expect "very many failures: that there are more" "$(grep -c 'more failures: build/ci/failed$' <<<"$said")" 1
finish
