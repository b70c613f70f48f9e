#!/usr/bin/python3
"""Numbers and figures of page.md. Without an option: tables and figures from the summary beside the page.

Needs numpy and gnuplot (scripts/setup).
"""

import argparse
import pathlib
import sys

sys.dont_write_bytecode = True
sys.path.insert(1, str(pathlib.Path(__file__).resolve().parents[1]))

import heave_model
from figures import draw_all
from paper import check_page, page_with_tables
from tables import PAGE, PREDICTED, TABLES, write_summary

STIFFNESSES = [300, 375, 475, 600, 750, 950, 1200, 1500, 1900, 2100, 2400, 2700, 3000, 3400, 3800, 4300, 4800, 5400, 6000, 7500, 9500, 12000, 15000, 19000,
               24000, 30000, 48000, 95000, 150000, 300000]  # N/m
CHECKED = [3000, 30000]


def predicted_rows(stiffnesses):
    return [row for cruse in (0, 1) for row in heave_model.rows(cruse, stiffnesses)]


def check():
    known = PREDICTED.read_text().splitlines()
    for row in predicted_rows(CHECKED):
        if row not in known:
            sys.exit(f"low_stiffness: {PREDICTED} lacks {row}")
    check_page(PAGE, TABLES)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    what = parser.add_mutually_exclusive_group()
    what.add_argument("results", metavar="FOLDER", type=pathlib.Path, nargs="?",
                      help="results of `hookpoint study configs/studies/low_stiffness.hook --out FOLDER`: write the summary from them first")
    what.add_argument("--predict", action="store_true", help="write the prediction beside the page first, by heave_model.py")
    what.add_argument("--check", action="store_true",
                      help="change nothing; status 1 if the page's tables are not those of the summary, or the prediction has changed at some stiffness")
    chosen = parser.parse_args()
    if chosen.check:
        return check()
    if chosen.predict:
        PREDICTED.write_text("\n".join(["cruse,stiffness [N/m],hook_losses,stance_depth [m],heave [m]", *predicted_rows(STIFFNESSES)]) + "\n")
    if chosen.results:
        write_summary(chosen.results / "results.csv")
    PAGE.write_text(page_with_tables(PAGE, TABLES))
    draw_all()


if __name__ == "__main__":
    main()
