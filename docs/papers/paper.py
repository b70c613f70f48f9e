"""What every page of docs/papers/ is made with: CSV summaries, tables in a page, gnuplot, the program.

A folder holds the page (page.md), its summaries (CSV), its modules, and make.py, which makes all of it again. A table of a page stands between
the lines `<!-- table NAME -->` and `<!-- end -->`; `make.py --check` compares them with the summaries.
"""

import csv
import math
import os
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
FIGURES = ROOT / "docs/figures"


def program():
    """Path of the hookpoint program: the variable HOOKPOINT, else that of the release build."""
    return os.environ.get("HOOKPOINT", ROOT / "build/release/hookpoint")


def rows_of(path):
    """Rows of a CSV file, each a dict by the titles of its columns."""
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def write_csv(path, header, rows):
    with open(path, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(header)
        writer.writerows(rows)


def text_of(x, digits=4):
    """A number to `digits` significant digits; "" for None and NaN."""
    return "" if x is None or math.isnan(x) else f"{x:.{digits}g}"


def short(x, digits=3):
    """A number that is written as text, to fewer digits; "" stays ""."""
    return "" if x == "" else f"{float(x):.{digits}g}"


def gnuplot(text):
    subprocess.run(["gnuplot"], input=text, text=True, check=True)


def page_with_tables(page, tables):
    """Text of `page` with these tables written again: name -> function that gives its lines. Other tables stay as they are."""
    lines, inside, missing = [], False, set(tables)
    for line in page.read_text().split("\n"):
        if line == "<!-- end -->":
            inside = False
        if not inside:
            lines.append(line)
        name = line.split()[2] if line.startswith("<!-- table ") else None
        if name in tables:
            inside = True
            missing.discard(name)
            lines += tables[name]()
    if missing:
        sys.exit(f"{page}: no place for table {sorted(missing)[0]}")
    return "\n".join(lines)


def check_page(page, tables):
    """Ends the program with status 1 if a table of the page is not that of its summary."""
    if page_with_tables(page, tables) != page.read_text():
        sys.exit(f"{page}: its tables are not those of the summaries beside it; {page.parent / 'make.py'} writes them")
