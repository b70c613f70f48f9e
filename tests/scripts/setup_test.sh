#!/usr/bin/env bash
# scripts/setup on machines that are made up: what it installs in which mode, and what it says where it cannot.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/support.sh"
mkdir -p "$work/clone/scripts"
cp "$root/scripts/setup" "$work/clone/scripts/"
setup="$work/clone/scripts/setup"

# The machine: packages it has in $work/has, packages that can be had in $work/mirror (empty: all), calls of apt-get in $work/calls.
stand_in dpkg-query <<'S'
for name in "$@"; do ! grep -qxF "$name" "$WORK/has" || echo "installed $name 1.0"; done | if [[ "$*" == *Version* ]]; then cat; else sed 's/ 1.0$//'; fi
S
stand_in apt-get <<'S'
echo "${DEBIAN_FRONTEND:-asks} $*" >>"$WORK/calls"
[[ " $* " == *" install "* ]] || exit 0
if [ "$(cat "$WORK/failures" 2>/dev/null)" = x ]; then rm "$WORK/failures"; exit 100; fi
for name in "$@"; do
  case "$name" in -*|install|DPkg*) continue ;; esac
  if [ -s "$WORK/mirror" ] && ! grep -qxF "$name" "$WORK/mirror"; then echo "E: no $name"; exit 100; fi
done
for name in "$@"; do case "$name" in -*|install|DPkg*) ;; *) echo "$name" >>"$WORK/has" ;; esac; done
S
stand_in apt-cache <<<'exit 0'
stand_in sleep <<<'exit 0'
stand_in id <<<'echo "${USER_ID:-0}"'
stand_in npm <<<'exit 0'
# run MODE: its status, with what it said in $said; only stand-ins and the tools of a bare machine are on PATH.
mkdir -p "$work/tools"
for tool in bash env dirname cat grep sed rm mkdir mktemp; do ln -sf "$(command -v "$tool")" "$work/tools/$tool"; done
run() {
  local status=0
  said=$(WORK=$work PATH="$work/bin:$work/tools" TMPDIR="$work" bash "$setup" "$1" 2>&1) || status=$?
  return "$status"
}
bare() { : >"$work/has"; : >"$work/mirror"; : >"$work/calls"; rm -rf "$work/clone/build"; unset USER_ID; rm -f "$work/bin/sudo"; }
installed() { grep -cxF "$1" "$work/has" || true; }

bare
run run || expect "setup run" "$said" "status 0"
for package in g++ libode-dev libxxhash-dev libsqlite3-dev; do expect "run needs $package" "$(installed $package)" 1; done
for package in libgtest-dev libdart-dev libsimbody-dev libmujoco-dev octave pybind11-dev; do expect "run needs no $package" "$(installed $package)" 0; done
expect "apt-get asks nothing" "$(grep -c '^asks' "$work/calls" || true)" 0
bare
echo x >"$work/failures"
run run || expect "setup run where a mirror fails once" "$said" "status 0"
expect "it is tried again" "$(installed g++)" 1
: >"$work/calls"
run run || expect "setup run again" "$said" "status 0"
expect "a second run installs nothing" "$(cat "$work/calls")$said" ""

run engines || expect "setup engines" "$said" "status 0"
expect "engines adds DART" "$(installed libdart-dev)" 1
expect "engines adds no test package" "$(installed libgtest-dev)" 0
run test || expect "setup test" "$said" "status 0"
expect "test adds GoogleTest" "$(installed libgtest-dev)" 1
expect "test adds Chromium" "$(installed chromium)" 1
expect "test adds Slurm" "$(installed slurm-wlm)$(installed munge)" 11

# An engine that the mirror lacks is told of once and not tried again.
bare
run run
printf 'libdart-dev\nlibsimbody-dev\n' >"$work/mirror"
run engines || expect "an engine that cannot be had" "$said" "status 0"
expect "the others are there" "$(installed libdart-dev)$(installed libsimbody-dev)" 11
expect "it is named" "$(grep -c 'going on without libmujoco-dev' <<<"$said")" 1
: >"$work/calls"
run engines || expect "once more" "$said" "status 0"
expect "no second attempt" "$(cat "$work/calls")$said" ""

# Neither root nor sudo: one line, and status 3.
bare
export USER_ID=1000
status=0
run run || status=$?
expect "without rights: status" "$status" 3
expect "without rights: one line" "$(wc -l <<<"$said"): ${said%%:*}" "1: setup"

# sudo resets the environment: apt-get is told not to ask all the same.
stand_in sudo <<<'exec env -u DEBIAN_FRONTEND "$@"'
run run || expect "with sudo" "$said" "status 0"
expect "by sudo, apt-get asks nothing" "$(grep -c '^noninteractive' "$work/calls")" "$(wc -l <"$work/calls")"

# No network: one line more than what it set out to do, and status 3.
bare
echo nothing >"$work/mirror"
status=0
run run || status=$?
expect "without a mirror: status" "$status" 3
expect "without a mirror: it says so" "$(tail -n 1 <<<"$said" | cut -d: -f2)" " these packages cannot be had"
finish
