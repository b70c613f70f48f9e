#!/usr/bin/env bash
# ./run says how it is used before it installs or builds anything.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/support.sh"
mkdir -p "$work/clone"
cp "$root/run" "$work/clone/"  # without scripts/, so that to build would be an error

for option in --help -h; do
  status=0
  said=$(bash "$work/clone/run" "$option" 2>&1) || status=$?
  expect "status of run $option" "$status" 0
  expect "first line of run $option" "$(head -n 1 <<<"$said")" "Usage: ./run [--engines] [FILE.hook | COMMAND] [ARGUMENTS]"
done

mkdir -p "$work/clone/build/release"
printf '#!/bin/bash\necho "the commands: $*"\n' >"$work/clone/build/release/hookpoint"
chmod +x "$work/clone/build/release/hookpoint"
expect "with a program its own help follows" "$(bash "$work/clone/run" --help | tail -n 1)" "the commands: --help"
finish
