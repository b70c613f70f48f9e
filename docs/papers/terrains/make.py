#!/usr/bin/env python3
"""Tuned materials of the seven grounds, the table about them in page.md, and docs/figures/terrains.png.

HOOKPOINT names the program (default: build/release/hookpoint). Needs gnuplot (scripts/setup).
"""

import argparse
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(1, str(pathlib.Path(__file__).resolve().parents[1]))

from paper import FIGURES, ROOT, check_page, gnuplot, page_with_tables, program, rows_of, write_csv

HERE = pathlib.Path(__file__).resolve().parent
PAGE, SUMMARY, MATERIALS = HERE / "page.md", HERE / "tuned.csv", ROOT / "configs/materials"
GROUNDS = ["concrete", "clay", "sand", "moss", "ice", "rubble", "gym_mat"]
TITLES = ["ground", "material", "normal_stiffness [N/m]", "damping_ratio", "foot_slip", "foot_slip_own", "foot_slip_verdict", "penetration_max [m]",
          "penetration_max_own [m]", "penetration_max_verdict", "own_missed"]


def tune(ground, folder):
    """recommended.json of a ground's tuning; a tuning that is finished in `folder` is taken as it is."""
    result = folder / ground / "recommended.json"
    if not result.exists():
        tuning = ROOT / f"configs/tunings/{ground}_for_hexapod.hook"
        subprocess.run([program(), "tune", tuning, "--out", folder / ground, "--resume"], check=True)
    return json.loads(result.read_text())


def row_of(ground, found):
    own = found["compared_with"]["own"]["objectives"]
    row = [ground, found["material"], 1000 * found["constants"]["normal_stiffness"]["value"], found["constants"]["damping_ratio"]["value"]]
    for objective in ("foot_slip", "penetration_max"):
        row += [own[objective]["recommended"], own[objective]["own"], own[objective]["verdict"]]
    return ["" if cell is None else cell for cell in row] + ["no" if found["compared_with"]["own"]["feasible"] else "yes"]


def rounded(text, factor=1.0):
    return "none" if text == "" else f"{factor * float(text):.3g}"


def table_tuned():
    yield "| ground | stiffness [kN/m] | damping ratio | slip, of the way: tuned | the file's own | | depth [mm]: tuned | the file's own | | own constants bear the step |"
    yield "|---|---|---|---|---|---|---|---|---|---|"
    for row in rows_of(SUMMARY):
        cells = [row["ground"].replace("_", " "), rounded(row["normal_stiffness [N/m]"], 1e-3), rounded(row["damping_ratio"])]
        for objective, unit, factor in (("foot_slip", "", 1.0), ("penetration_max", " [m]", 1e3)):
            cells += [rounded(row[objective + unit], factor), rounded(row[objective + "_own" + unit], factor), row[objective + "_verdict"]]
        yield "| " + " | ".join(cells + ["no" if row["own_missed"] == "yes" else "yes"]) + " |"


TABLES = {"tuned": table_tuned}


def check():
    check_page(PAGE, TABLES)
    for row in rows_of(SUMMARY):
        file = MATERIALS / f"{row['material']}_tuned.hook"
        found = re.search(r"^ *normal_stiffness = (\S+) N/m;", file.read_text(), flags=re.M)
        if not found or abs(float(found[1]) / float(row["normal_stiffness [N/m]"]) - 1) > 1e-9:
            sys.exit(f"terrains: {file} has not the stiffness of {SUMMARY}")


def tune_all(folder):
    rows = []
    for ground in GROUNDS:
        found = tune(ground, folder)
        rows.append(row_of(ground, found))
        shutil.copy(folder / ground / "materials" / f"{found['material']}_tuned.hook", MATERIALS)
    write_csv(SUMMARY, TITLES, rows)
    PAGE.write_text(page_with_tables(PAGE, TABLES))


def heights(name, columns, rows):
    """x, y, z [m] of a grid of points that `rest_on` lays on the ground, over x from -0.5 to 2.5 and y from -1.5 to 1.5, a block a row, for gnuplot."""
    text = f"""World probe {{
  deltat = 1 us;
  Include "terrains/{name}.hook";
  For row in 0..{rows} {{
    For column in 0..{columns} {{
      Robot point[row * {columns + 1} + column] {{
        Base.mobile {{
          rest_on = ground;
          at = -0.5 + 3 * column / {columns}, -1.5 + 3 * row / {rows};
          mass = 1 g;
          inertia = 1e-6, 1e-6, 1e-6, 0, 0, 0;
          ContactPoint tip {{ }}
        }}
      }}
    }}
  }}
}}
"""
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / f"{name}.hook"
        file.write_text(text)
        said = subprocess.run([program(), "run", file, "--for", "1 us"], check=True, capture_output=True, text=True).stdout
    points = [" ".join(line.split()[2:5]) for line in said.splitlines() if "location" in line]
    blocks = [points[first : first + columns + 1] for first in range(0, len(points), columns + 1)]
    return "\n\n".join("\n".join(block) for block in blocks) + "\n"


def draw():
    """configs/terrains/rough.hook and steps.hook as points find them."""
    gnuplot(f"""set terminal pngcairo size 1400,520 font "sans,11"
set output "{FIGURES}/terrains.png"
$rough << EOD
{heights("rough", 60, 60)}EOD
$steps << EOD
{heights("steps", 150, 12)}EOD
set multiplot layout 1,2
set view 55,330
set xyplane at -0.05
set view equal xy
set palette defined (0 "#2b4c6f", 0.5 "#d9d2c0", 1 "#8a4b2a")
unset colorbox
unset key
set xlabel "x, m"
set ylabel "y, m"
set zlabel "z, m" rotate
set pm3d depthorder border linecolor "#40404040" linewidth 0.3
set zrange [-0.05:0.3]
set ztics 0.1
set title "Terrain.Rough: 30 mm amplitude, 0.5 m wavelength, flat within 0.5 m (heights enlarged)"
set cbrange [-0.03:0.03]
splot $rough using 1:2:3 with pm3d
set title "Terrain.Steps: five of 40 mm, run 0.3 m (heights enlarged)"
set cbrange [0:0.2]
splot $steps using 1:2:3 with pm3d
""")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    what = parser.add_mutually_exclusive_group(required=True)
    what.add_argument("--tune", metavar="FOLDER", type=pathlib.Path,
                      help="tune configs/tunings/NAME_for_hexapod.hook into FOLDER/NAME, copy each material to configs/materials/, write tuned.csv and the table")
    what.add_argument("--figure", action="store_true", help="draw docs/figures/terrains.png")
    what.add_argument("--check", action="store_true", help="change nothing; status 1 if the table is not that of tuned.csv, or a material has other constants")
    chosen = parser.parse_args()
    if chosen.check:
        check()
    elif chosen.figure:
        draw()
    else:
        tune_all(chosen.tune)


if __name__ == "__main__":
    main()
