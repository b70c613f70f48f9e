#!/usr/bin/env bash
# scripts/page: the committed page is what its sources give, its unit tests pass, and what is wrong or missing is told.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/support.sh"
# run PAGE ARGUMENTS: its status, with what it said in $said.
run() {
  local status=0
  said=$("$@" 2>&1) || status=$?
  return "$status"
}
page=$root/scripts/page

status=0; run "$page" --chekc || status=$?
expect "status of a wrong argument" "$status" 2
expect "it names the argument" "$(grep -c 'no such argument: --chekc' <<<"$said")" 1
mkdir -p "$work/tools"
for tool in bash env dirname cat grep; do ln -sf "$(command -v "$tool")" "$work/tools/$tool"; done
status=0; run env PATH="$work/tools" "$page" --check || status=$?
expect "status without node" "$status" 3
expect "it says what installs node" "$(grep -c 'node is missing: scripts/setup test installs it' <<<"$said")" 1
[ "$failures" -eq 0 ] || exit 1

status=0; run "$page" --check || status=$?
if [ "$status" -eq 3 ]; then
  echo "page_test: skipped: $(tail -n 1 <<<"$said")"
  exit 0
fi
[ "$status" -eq 0 ] || printf '%s\n' "$said"
expect "status of the committed page" "$status" 0

# A source that was changed and not built. The lock holds no address of a registry.
mkdir -p "$work/clone/scripts" "$work/clone/apps/view"
cp "$page" "$root/scripts/npm_packages" "$work/clone/scripts/"
(cd "$root/apps/view" && tar -c --exclude=node_modules page) | tar -x -C "$work/clone/apps/view"
cp -r "$root/apps/view/page/node_modules" "$work/clone/apps/view/page/"
echo 'body { margin: 1px; }' >>"$work/clone/apps/view/page/page.css"
status=0; run "$work/clone/scripts/page" --check || status=$?
expect "status where the page is older than its sources" "$status" 1
expect "it says what to do" "$(grep -c 'run scripts/renew page' <<<"$said")" 1
expect "addresses in package-lock.json" "$(grep -c '"resolved"' "$root/apps/view/page/package-lock.json" || true)" 0
finish
