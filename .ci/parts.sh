# Parts of continuous integration, and the summary that ends a run. .ci/run and .ci/full source this file, say which parts they want, and
# call run_parts. The last lines of the output, 60 at most, name each part, each failed test with the first lines of its message, and the
# command that repeats it; the very last line is `N passed, N failed, N skipped`. The same text is in build/ci/summary, the whole output
# of a part in build/ci/PART.log.
cd "$(dirname "${BASH_SOURCE[0]}")/.."
started=$SECONDS
limit=${HOOKPOINT_CI_SECONDS:-4800} # the watchdog's, from the beginning
folder=build/ci
rm -rf "$folder"
mkdir -p "$folder/failed"
passed=0 failed=0 skipped=0
status=0  # of the last part that ran
reports=0 # files in failed/
insist=0 # 1: a test that is skipped and not in .ci/expected_skips fails
tidied=() # what tidy reads; all where it is empty
parsed=(--all) # what syntax reads
touched=() # tests with the label `full` that the change needs
lines=60 # of the summary
: >"$folder/parts"

# asked_for NAME: whether the part is among those wanted (array `wanted`).
asked_for() { [[ " ${wanted[*]} " == *" $1 "* ]]; }

# part NAME REPEAT COMMAND...: runs COMMAND until the watchdog's limit. REPEAT is the command that repeats a failure which is no test's; a
# failed test is repeated by the line `repeat: ` of scripts/run_tests. A part that is no test run counts as one; status 77 means that this
# machine cannot run it, for the reason in its last line.
part() {
  local name=$1 repeat=$2 log=$folder/$1.log begun=$SECONDS left=$((limit - SECONDS + started)) sum said pid
  shift 2
  asked_for "$name" || return 0
  printf '\n== %s: %s\n' "$name" "$*"
  : >"$log"
  status=0
  if [ "$left" -le 0 ]; then
    echo "not begun: $((limit / 60)) min had passed" | tee "$log"
    status=124
  else
    timeout --kill-after=30 "$left" "$@" >"$log" 2>&1 </dev/null &
    pid=$!
    tail -n +1 --pid="$pid" -s 0.2 -f "$log"
    wait "$pid" || status=$?
  fi
  sum=$(grep -E '^[0-9]+ passed, [0-9]+ failed, [0-9]+ skipped$' "$log" | tail -n 1 || true)
  if [ -z "$sum" ]; then
    case "$status" in
      0) sum="1 passed, 0 failed, 0 skipped" ;;
      77) sum="0 passed, 0 failed, 1 skipped" ;;
      *) sum="0 passed, 1 failed, 0 skipped" ;;
    esac
  elif [ "$status" -ne 0 ] && [[ $sum == *", 0 failed, "* ]]; then
    sum="${sum/, 0 failed/, 1 failed}"
  fi
  read -r -a said <<<"$sum"
  if [ "$insist" -ne 0 ]; then
    unexpected_skips "$log" >"$folder/unexpected"
    if [ -s "$folder/unexpected" ]; then
      cat "$folder/unexpected" >>"$log"
      said[2]=$((said[2] + $(wc -l <"$folder/unexpected")))
      sum="${said[0]} passed, ${said[2]} failed, ${said[4]} skipped"
    fi
  fi
  passed=$((passed + said[0])) failed=$((failed + said[2])) skipped=$((skipped + said[4]))
  if [ "$status" -eq 77 ]; then sum+=", $(tail -n 1 "$log")"; fi
  printf '%s: %s (%d min %02d s)\n' "$name" "$sum" $(((SECONDS - begun) / 60)) $(((SECONDS - begun) % 60)) >>"$folder/parts"
  sed -n "s/^flaky: /flaky: $name: /p" "$log" >>"$folder/parts"
  if [ "${said[2]}" -ne 0 ] || { [ "$status" -ne 0 ] && [ "$status" -ne 77 ]; }; then
    explain "$name" "$repeat" "$log" >"$folder/failed/$(printf %02d $((++reports)))_$name" || true
  fi
}

# unexpected_skips LOG: the tests of a part that were skipped though .ci/expected_skips does not expect it, a line each.
unexpected_skips() {
  grep -vE '^(#|$)' .ci/expected_skips >"$folder/expected_skips"
  sed -n 's/^skipped: //p' "$1" | sort -u | grep -vE -f "$folder/expected_skips" | sed 's/^/failed: skipped: /' || true
}

# part_with PROGRAM NAME REPEAT COMMAND...: where PROGRAM is installed.
part_with() {
  local program=$1
  shift
  if command -v "$program" >/dev/null; then
    part "$@"
  elif asked_for "$1"; then
    echo "$1: skipped, $program is not installed" >>"$folder/parts"
    skipped=$((skipped + 1))
  fi
}

# explain NAME REPEAT LOG: why a part failed. A line that begins with two spaces is a detail, which the summary may leave out.
explain() {
  local name=$1 repeat=$2 log=$3
  if [ "$status" -eq 124 ] || [ "$status" -eq 137 ]; then
    echo "failed: $name: stopped by the watchdog, $limit s after the beginning"
    awk '/^ *Start +[0-9]+: / { running[$NF] = 1 }
         match($0, /Test +#[0-9]+: +[^ ]+/) { name = substr($0, RSTART, RLENGTH); sub(/.* /, "", name); delete running[name]
           if (/\*\*\*/) print "failed: '"$name"': " name }
         END { for (name in running) print "failed: '"$name"': " name ": was running" }' "$log"
    echo "repeat: $repeat"
  elif grep -q '^failed: ' "$log"; then
    # The list that scripts/run_tests ends with.
    awk '/^failed: / { on = 1; sub(/^failed: /, "failed: '"$name"': ") } /^[0-9]+ passed, / { on = 0 } on' "$log"
  else
    echo "failed: $name: ended with status $status"
    first_error "$log" | sed 's/^/  /'
    echo "repeat: $repeat"
  fi
}

# first_error LOG: the lines that say what went wrong, the first ones; the log's end where none is known.
first_error() {
  local known=': (fatal )?error: |: warning: |^CMake Error|undefined reference|multiple definition|^setup: .*(cannot be had|needs root)|^E: |status [1-9]|code should be clang-formatted'
  if grep -qE "$known" "$1"; then
    # A configuration's reason stands below its first line.
    grep -E -A 3 "$known" "$1" | grep -vE '^--$|^ *\^?~*$|^ *[0-9]* \|' | sed "s|$PWD/||g" | awk '!seen[$0]++ && ++count <= 12'
  else
    grep -v '^ *$' "$1" | tail -n 8
  fi
}

# fitted LINES: the failures in as many lines, each test with as much of its message as fits.
fitted() {
  local most=$1 details
  for details in 6 4 3 2 1 0; do
    cat "$folder"/failed/* 2>/dev/null | awk -v most="$details" '/^  / { if (++count > most) next } !/^  / { count = 0 } 1' >"$folder/fitted"
    if [ "$(wc -l <"$folder/fitted")" -le "$most" ]; then
      cat "$folder/fitted"
      return 0
    fi
  done
  # Too many for a line each: the commands are more use than the last names.
  grep '^repeat: ' "$folder/fitted" >"$folder/repeats"
  grep -v '^repeat: ' "$folder/fitted" | sed -n "1,$((most - $(wc -l <"$folder/repeats") - 1))p"
  echo "... and $(($(wc -l <"$folder/fitted") - most + 1)) more failures: $folder/failed"
  cat "$folder/repeats"
}

# summary [WHY]: ends the run; with WHY, where it ends before its last part.
summary() {
  set +e
  {
    cat "$folder/parts"
    [ $# -eq 0 ] || echo "ended early: $1"
    fitted $((lines - $(wc -l <"$folder/parts") - $# - 1))
    echo "$passed passed, $failed failed, $skipped skipped"
  } | cut -c1-200 >"$folder/summary"
  echo
  cat "$folder/summary"
  [ "$failed" -eq 0 ] && [ "$passed" -gt 0 ]
}

# run_parts change|everything: all parts that are wanted, in order. Of a change each test runs once: tests of parts under the sanitizers, the
# others as released, without those that have the label `full`.
run_parts() {
  local released=() checked=() arguments=()
  if [ "$1" = change ]; then
    released=(--share released) checked=(--share checked) arguments=(-LE full)
  else
    insist=1
    export HOOKPOINT_KILLS=50
  fi
  bash scripts/setup checks || true
  part_with clang-format format 'scripts/check_format --fix' bash scripts/check_format
  part release "./test${arguments[*]:+ ${arguments[*]}}" bash ./test "${released[@]}" "${arguments[@]}"
  # Status 3: a package cannot be had, the configuration or the compiler failed.
  if [ "$status" -eq 3 ]; then
    summary "what follows needs the release build"
    return
  fi
  local pattern
  pattern="^($(local IFS='|'; echo "${touched[*]}"))\$"
  part touched "./test -R '$pattern'" bash scripts/run_tests build/release -R "$pattern"
  # With assertions, under the address and undefined-behaviour sanitizers.
  part sanitizers "./test --preset ci${arguments[*]:+ ${arguments[*]}}" bash ./test --preset ci "${checked[@]}" "${arguments[@]}"
  part_with run-clang-tidy tidy 'scripts/tidy FILE' bash scripts/tidy "${tidied[@]}"
  # Each file by itself, as preset dev compiles it: the other builds read a dozen as one.
  part syntax 'scripts/check_syntax FILE' bash -c 'scripts/check_presets && scripts/check_syntax "$@"' syntax "${parsed[@]}"
  # What a user sees first, where nothing is installed.
  local bare=('./run --help' './run study configs/studies/creep.hook --quick')
  part_with mmdebstrap clean_room '.ci/full clean_room' bash scripts/clean_room "${bare[@]}"
  part_with mmdebstrap clean_room_trixie '.ci/full clean_room_trixie' bash scripts/clean_room --suite trixie "${bare[@]}"
  # What runs in several threads, under the thread sanitizer.
  part threads './test --preset tsan' bash ./test --preset tsan
  summary
}
