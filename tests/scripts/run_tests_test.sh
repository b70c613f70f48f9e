#!/usr/bin/env bash
# scripts/run_tests on a folder of made-up tests: cases are counted, and those that skip themselves are named.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/support.sh"
folder="$work/folder"
mkdir "$folder"

# gtest NAME STATUS CASE...: a test program that leaves the XML of GoogleTest; a CASE is NAME, NAME=skipped or NAME=failed.
gtest() {
  local name=$1 status=$2 case result inside
  shift 2
  {
    echo '#!/bin/bash'
    echo 'cat >"${GTEST_OUTPUT#xml:}'"$name"'.xml" <<XML'
    echo '<testsuites name="AllTests"> <testsuite name="Suite">'
    for case in "$@"; do
      result=completed inside="/>"
      case "$case" in
        *=skipped) result=skipped inside=$'>\n<skipped message="/a/file.cpp:3&#x0A;no &apos;DART&apos; here"><![CDATA[...]]></skipped>\n</testcase>' ;;
        *=failed) inside=$'>\n<failure message="'"$root"'/a.cpp:3&#x0A;a &lt; b&#x0A;  Actual: 1" type=""><![CDATA[wrong]]></failure>\n</testcase>' ;;
      esac
      echo "<testcase name=\"${case%=*}\" file=\"/a/file.cpp\" line=\"3\" status=\"run\" result=\"$result\" time=\"0.\" classname=\"Suite\" $inside"
    done
    echo '</testsuite> </testsuites>'
    echo XML
    echo "exit $status"
  } >"$folder/$name"
  chmod +x "$folder/$name"
  echo "add_test($name $folder/$name)" >>"$folder/CTestTestfile.cmake"
}
# plain NAME COMMAND: a test that is no GoogleTest program.
plain() {
  printf '#!/bin/bash\n%s\n' "$2" >"$folder/$1"
  chmod +x "$folder/$1"
  echo "add_test($1 $folder/$1)" >>"$folder/CTestTestfile.cmake"
}
run() {
  local status=0
  said=$(bash "$root/scripts/run_tests" "$folder" 2>&1) || status=$?
  return "$status"
}
begin() { : >"$folder/CTestTestfile.cmake"; }
last() { tail -n 1 <<<"$said"; }

begin
gtest all_well 0 One Two
gtest skips_one 0 Three Four=skipped
plain good true
run || expect "nothing fails" "$said" "status 0"
expect "cases are counted" "$(last)" "4 passed, 0 failed, 1 skipped"
expect "a skipped case is named, with its reason" "$(grep '^skipped' <<<"$said")" "skipped: skips_one: Suite.Four: no 'DART' here"

begin
gtest all_well 0 One
gtest fails_one 1 Two Three=failed
plain bad false
plain crashes 'echo "[ RUN      ] Suite.First"; echo "[       OK ] Suite.First (0 ms)"; echo "[ RUN      ] Suite.Second"; kill -SEGV $$'
plain tells 'for i in 1 2 3 4 5 6 7; do echo line $i; done; echo "AssertionError: 1 is not 2"; false'
status=0
run || status=$?
expect "failures: status" "$([ $status -ne 0 ] && echo not 0)" "not 0"
expect "failures: count" "$(last)" "2 passed, 4 failed, 0 skipped"
expect "failures: names" "$(grep '^failed' <<<"$said" | sort | cut -d: -f2,3 | tr '\n' ';')" " bad: Failed; crashes: Exception; fails_one: Suite.Three; tells: Failed;"
# after NAME: what the list of failures says of it.
after() { awk -v begin="failed: $1" 'index($0, begin) == 1 { on = 1; next } !/^  / { on = 0 } on' <<<"$said" | tr '\n' ';'; }
expect "failures: message of a case, from the project's root" "$(after fails_one)" "  a.cpp:3;  a < b;    Actual: 1;"
expect "failures: the case that ran" "$(after crashes)" "  while running: Suite.Second;"
expect "failures: what a program says of errors" "$(after tells)" "  AssertionError: 1 is not 2;"
expect "failures: how to repeat them" "$(grep '^repeat' <<<"$said")" "repeat: ./test --preset folder -R '^(bad|crashes|fails_one|tells)\$'"

begin
gtest dies_late 139 One Two
plain missing true
rm "$folder/missing"
status=0
run || status=$?
expect "a program that dies after its cases" "$(last)" "2 passed, 2 failed, 0 skipped"

begin
plain twice "[ -e '$work/tried' ] || { touch '$work/tried'; false; }"
plain never false
plain other true
echo 'set_tests_properties(twice never PROPERTIES LABELS clock)' >>"$folder/CTestTestfile.cmake"
status=0
run || status=$?
expect "the clock's tests: one that passes again is flaky" "$(grep '^flaky' <<<"$said")" "flaky: twice"
expect "the clock's tests: one that never passes has failed" "$(last)" "2 passed, 1 failed, 0 skipped"
expect "the clock's tests: it was tried three times" "$(grep -c 'Test #2: never .*Failed' <<<"$said")" 3

begin
plain one true
plain two true
plain three true
echo 'set_tests_properties(one PROPERTIES LABELS full)' >>"$folder/CTestTestfile.cmake"
echo 'set_tests_properties(two PROPERTIES LABELS "clock;full")' >>"$folder/CTestTestfile.cmake"
said=$(bash "$root/scripts/run_tests" "$folder" -LE full 2>&1)
expect "a label that is left out, whatever others there are" "$(last)" "1 passed, 0 failed, 0 skipped"

begin
plain apart 'echo skipped here'
echo 'set_tests_properties(apart PROPERTIES SKIP_REGULAR_EXPRESSION "skipped")' >>"$folder/CTestTestfile.cmake"
run || expect "a skipped program" "$said" "status 0"
expect "a skipped program" "$(last)" "0 passed, 0 failed, 1 skipped"

begin
status=0
run || status=$?
expect "no test at all is no success" "$status" 1
finish
