#!/usr/bin/env bash
# scripts/build with made-up cmake and ninja: when it configures, whether tests are part of it, and what it says.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/support.sh"
mkdir -p "$work/clone/scripts"
cp "$root/scripts/build" "$work/clone/scripts/"
clone="$work/clone"
echo '{}' >"$clone/CMakePresets.json"

# Packages that are installed, in $work/has.
cat >"$clone/scripts/setup" <<'S'
cat "$WORK/has"
S
stand_in cmake <<'S'
echo "$*" >>"$WORK/configured"
mkdir -p build/release
[ -e build/release/CMakeCache.txt ] || echo "HOOKPOINT_ISA:STRING=portable" >build/release/CMakeCache.txt
touch build/release/build.ninja
[ ! -e "$WORK/cmake_fails" ] || { echo "CMake Error: no ODE"; exit 1; }
S
stand_in ninja <<'S'
[ ! -e "$WORK/compiles" ] || echo "[1/2] Building CXX object a.o"
[ ! -e "$WORK/ninja_fails" ] || { cat "$WORK/ninja_fails"; exit 1; }
[ -e "$WORK/compiles" ] || echo "ninja: no work to do."
S
build() {
  local status=0
  rm -f "$work/configured"
  said=$(WORK=$work PATH="$work/bin:$PATH" bash "$clone/scripts/build" "$@" 2>&1) || status=$?
  configured=$(cat "$work/configured" 2>/dev/null || true)
  return "$status"
}
bare='installed g++ 1'
with_tests=$bare$'\ninstalled libgtest-dev 1\ninstalled librapidcheck-dev 1'

echo "$bare" >"$work/has"
touch "$work/compiles"
build release hookpoint
expect "the first time it configures, without tests" "$configured" "--preset release -DBUILD_TESTING=OFF"
expect "it says that it compiles" "$(tail -n 1 <<<"$said")" "build (release): compiling hookpoint (a few minutes the first time)"
rm "$work/compiles"
build release hookpoint
expect "nothing to do, nothing said" "$said$configured" ""

echo "$with_tests" >"$work/has"
build --tests release
expect "tests when asked for; what was asked for by hand stays" "$configured" "--preset release -DBUILD_TESTING=ON --fresh -DHOOKPOINT_ISA:STRING=portable"
build release hookpoint
expect "the program alone leaves the tests in" "$said$configured" ""
build --tests release
expect "and they are still there" "$said$configured" ""

echo "$with_tests"$'\ninstalled libdart-dev 6' >"$work/has"
build release hookpoint
expect "an engine that came is seen" "$(grep -c 'BUILD_TESTING=ON --fresh' <<<"$configured")" 1
echo "$with_tests"$'\ninstalled libdart-dev 7' >"$work/has"
build release hookpoint
expect "another version is seen" "$(grep -c 'BUILD_TESTING=ON --fresh' <<<"$configured")" 1
echo "$bare" >"$work/has"
build release hookpoint
expect "without their libraries no tests" "$(grep -c 'BUILD_TESTING=OFF --fresh' <<<"$configured")" 1

: >"$work/has"
build release hookpoint
build release hookpoint
expect "without dpkg it configures once" "$said$configured" ""

echo '{"version": 3}' >"$clone/CMakePresets.json"
build release hookpoint
expect "presets that changed are seen" "$(grep -c -- '--fresh' <<<"$configured")" 1
build release hookpoint
expect "once" "$said$configured" ""

echo "a.cpp:1: error: no" >"$work/ninja_fails"
status=0
build release hookpoint || status=$?
expect "a build that fails: status" "$status" 3
expect "a build that fails: the error" "$(head -n 1 <<<"$said")" "a.cpp:1: error: no"
printf 'studies/Unity/unity_0.cxx.o\na.cpp:1: error: redefinition of tell\n' >"$work/ninja_fails"
status=0
build release hookpoint || status=$?
expect "a clash of names in files that are read as one: what to do" "$(grep -c 'rename one of the two' <<<"$said")" 1
rm "$work/ninja_fails"
echo "$with_tests" >"$work/has"
touch "$work/cmake_fails"
status=0
build release hookpoint || status=$?
expect "a configuration that fails: status" "$status" 3
rm "$work/cmake_fails"
build release hookpoint
expect "is tried again" "$(grep -c . <<<"$configured")" 1
finish
