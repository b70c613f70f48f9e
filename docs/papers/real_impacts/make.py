#!/usr/bin/python3
"""Data, numbers and figures of page.md: 400 throws of a real cube. Without an option: calibrations, predictions, materials, tables and figures.

Needs numpy and gnuplot (scripts/setup), and Node and Chromium for the picture of the window.
"""

import argparse
import pathlib
import sys

import numpy as np

sys.dont_write_bytecode = True
sys.path.insert(1, str(pathlib.Path(__file__).resolve().parents[1]))

from paper import ROOT, check_page, page_with_tables
from setting import ENGINES, GIVEN, PAGE, SCENE, TUNINGS, frame_of_scene
from tosses import write_data
from curves import curves_of
from runs import ROOMS, cases_block, hold_all, hold_borrowers, hold_shipped, median_constants, published_constants, tune_all, write_given, write_materials, write_moved, write_study
from summaries import judged, summaries, write_borrowed, write_nearer
from tables import TABLES, scene_is_as_found
from figures import draw_constants, draw_errors, draw_impacts, draw_toss
from window import window_picture


def write_page():
    PAGE.write_text(page_with_tables(PAGE, TABLES))
    draw_errors()
    draw_impacts()
    draw_constants()
    draw_toss()
    window_picture()


def run(out):
    tune_all([TUNINGS / f"{room}.hook" for room in ROOMS], out / "identified")
    constants = median_constants(out)
    write_given(constants)
    write_study(constants)
    write_materials(constants)
    default = {f"{engine}_default": constants[f"{engine}_recommended"] for engine in ENGINES if f"{engine}_recommended" in constants}
    tune_all([TUNINGS / "source_cube.hook"], out / "source_cube")
    hold_shipped(out, constants)
    hold_borrowers(out, constants)
    hold_all(out / "default", "Acrylic on wood: engines at their defaults", cases_block("toss", "data/cube_tosses/states.csv", "from = 0;"), default)
    only = write_moved(out / "moved.csv")
    still = cases_block("toss", "data/cube_tosses/states.csv", only)
    moved = cases_block("moved", (out / "moved.csv").resolve(), only)
    hold_all(out / "floor", "Acrylic on wood: initial states moved within their errors", still + moved, constants)


def quick(out):
    """Twenty tosses under constants that are given; writes into `out` only."""
    tune_all([GIVEN], out)
    for subject, tosses in judged(curves_of(out / GIVEN.stem / "curves.csv"), frame_of_scene()).items():
        position, rotation = (np.mean([one[metric] for one in tosses.values()]) for metric in ("position", "rotation"))
        print(f"{subject}: position {100 * position:.1f} % of the edge, rotation {rotation:.1f} deg, {len(tosses)} tosses")


def check():
    check_page(PAGE, TABLES)
    if not scene_is_as_found():
        sys.exit(f"real_impacts: frame and cube of {SCENE} are not those of frame.csv")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    what = parser.add_mutually_exclusive_group()
    what.add_argument("--out", metavar="FOLDER", type=pathlib.Path, default=ROOT / "runs/real_impacts", help="folder of the calibrations (default: runs/real_impacts)")
    what.add_argument("--data", metavar="TOSSES.csv", type=pathlib.Path, help="write configs/data/cube_tosses/ from the source's table (configs/data/README.md)")
    what.add_argument("--page", metavar="FOLDER", type=pathlib.Path, nargs="?", const=False, help="tables and figures from the summaries beside the page; with FOLDER the summaries from its results first")
    what.add_argument("--nearer", metavar="FOLDER", type=pathlib.Path, help="all subjects under the published constants on all tosses, some five minutes: who is nearer, toss by toss")
    what.add_argument("--borrowed", metavar="FOLDER", type=pathlib.Path, help="engines that nobody identified, under the published constants of others, on all tosses, some minutes")
    what.add_argument("--quick", metavar="FOLDER", type=pathlib.Path, nargs="?", const=pathlib.Path("runs/real_impacts_quick"), help="twenty tosses under constants that are given, reported on the terminal; writes into FOLDER only")
    what.add_argument("--check", action="store_true", help="change nothing; status 1 if the page's tables are not those of the summaries beside it")
    chosen = parser.parse_args()
    if chosen.data:
        write_data(chosen.data)
    elif chosen.check:
        check()
    elif chosen.page is not None:
        if chosen.page:
            summaries(chosen.page)
        write_page()
    elif chosen.nearer:
        hold_shipped(chosen.nearer, published_constants())
        write_nearer(chosen.nearer)
    elif chosen.borrowed:
        hold_borrowers(chosen.borrowed, published_constants())
        write_borrowed(chosen.borrowed)
    elif chosen.quick:
        quick(chosen.quick)
    else:
        run(chosen.out)
        summaries(chosen.out)
        write_page()


if __name__ == "__main__":
    main()
