#!/usr/bin/env bash
# scripts/site: the manual becomes a site without a dead link, and what is wrong or missing is reported.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/support.sh"
site=$root/scripts/site

status=0; said=$("$site" --chekc 2>&1) || status=$?
expect "status of a wrong argument" "$status" 2
mkdir -p "$work/other" && echo precious >"$work/other/file"
status=0; said=$("$site" "$work/other" 2>&1) || status=$?
expect "status where a folder holds something else" "$status" 2
expect "what it holds stays" "$(cat "$work/other/file")" precious
status=0; said=$("$site" "" 2>&1) || status=$?
expect "status of an empty name" "$status" 2
mkdir -p "$work/tools"
status=0; said=$(PATH="$work/tools" /usr/bin/python3 "$site" "$work/site" 2>&1) || status=$?
expect "status without mkdocs" "$status" 3
expect "it says what to install" "$(grep -c mkdocs-material <<<"$said")" 1

# What GitHub reads, and where links lead, on pages that are made up.
mkdir -p "$work/pages"
printf '# The `other` page\n' >"$work/pages/other.md"
printf '<h1 id="here">x</h1><a href="#here">a</a><a href="#there">b</a><a href="no.html">c</a>' >"$work/pages/index.html"
expect "of pages that are made up" "$(/usr/bin/python3 - "$site" "$work/pages" <<'PYTHON'
import importlib.machinery, importlib.util, pathlib, sys
sys.dont_write_bytecode = True
loader = importlib.machinery.SourceFileLoader("site_script", sys.argv[1])
site = importlib.util.module_from_spec(importlib.util.spec_from_loader("site_script", loader))
loader.exec_module(site)
pages = pathlib.Path(sys.argv[2])
assert site.as_python_markdown("[gone.md](gone.md)", pages) == "[gone.md](gone.md)"
text = site.as_python_markdown("see [other.md](other.md#x):\n- one\n  - two\n```cpp a.cpp\n- no item\n```", pages)
assert text == 'see [The other page](other.md#x):\n\n- one\n    - two\n```cpp title="a.cpp"\n- no item\n```', text
assert list(site.dead_links(pages)) == ["index.html: #there: no such heading", "index.html: no.html: no such file"]
assert "docs/faq.md: not in the navigation of docs/site/mkdocs.yml" in site.unlisted("docs/README.md")
entries = [{"location": "docs/faq.html"}, {"location": "docs/decisions/0001.html"}, {"location": "CHANGELOG.html#x"}]
assert site.without_history({"config": 1, "docs": entries}) == {"config": 1, "docs": entries[:1]}
print("right")
PYTHON
)" right
[ "$failures" -eq 0 ] || exit 1

status=0; said=$("$site" "$work/site" 2>&1) || status=$?
if [ "$status" -eq 3 ]; then
  echo "site_test: skipped: $(tail -n 1 <<<"$said")"
  exit 0
fi
[ "$status" -eq 0 ] || printf '%s\n' "$said"
expect "status of the manual" "$status" 0
expect "it has a first page" "$(grep -c '<h1 id="hookpoint">' "$work/site/index.html")" 1
status=0; said=$("$site" "$work/site" 2>&1) || status=$?
expect "status of a second time" "$status" 0
expect "it can be searched" "$(grep -c creep "$work/site/search/search_index.json")" 1
[ "$failures" -eq 0 ] || exit 1
