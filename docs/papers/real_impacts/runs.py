"""Calibrations and predictions that the page needs: their files, their processes, and the constants that they find."""

import csv
import math
import os
import subprocess
import sys
import time

import numpy as np

from paper import ROOT, program, rows_of
from setting import BORROWERS, CONSTANTS, DATA, FOLDS, GIVEN, LATE, LAWS, LEAST, MOVED, POWERS, RATE, SUBJECTS, TRACKING_ANGLE, TRACKING_PLACE, parts_of, summary
from rotations import exponential, product


def subject_block(name, constants):
    fields, fixes = [], [f"Fix {key} {{ value = {value} {CONSTANTS[key]}; }}" for key, value in constants.items()]
    if name in LAWS:
        fields.append(f"engine = dts; contact = {name};")
        if name in POWERS:
            fixes.append("Fix powers { value = 31.6; }")
    else:
        engine, _, settings = name.rpartition("_")
        fields.append(f"engine = {engine}; settings = {settings};")
        if engine == "simbody":
            fixes.append(f"Fix dt {{ value = 1 s / {RATE:.0f}; }}")  # within it Simbody chooses its steps by their error
    return f"  Subject {name} {{ {' '.join(fields + fixes)} }}\n"


def cases_block(name, states, only):
    traces = ""
    for trace, columns, port, weight in (
        ("position", "x, y, z", "position", "1 / (104.8 mm)"),
        ("attitude", "qw, qx, qy, qz", "orientation", "0.5 / (1 rad)"),
    ):
        traces += f"    Trace {trace} {{ file = \"data/cube_tosses/tosses.csv\"; column = {columns}; time = \"t\"; of = world.cube.{port}; weight = {weight}; }}\n"
    return f"  Cases {name} {{\n    file = \"{states}\";\n    case = toss;\n    Only toss {{ {only} }}\n{traces}  }}\n"


def held_against(name, title, cases, subjects):
    """A Calibrate that fits nothing: these subjects with these constants against the measurements."""
    text = f"Calibrate {name} {{\n  title = \"{title}\";\n  scene = \"scenes/tossed_cube.hook\";\n  method = cmaes;\n  folds = 0;\n{cases}"
    return text + "".join(subject_block(subject, constants) for subject, constants in subjects.items()) + "}\n"


def tune_all(files, out):
    """Runs files in as many processes as there are cores, the first first, since some engines let one thread at a time work; each into a folder of its name."""
    out.mkdir(parents=True, exist_ok=True)
    began, waiting, running, done = time.monotonic(), list(files), {}, 0
    while waiting or running:
        while waiting and len(running) < (os.cpu_count() or 1):
            file = waiting.pop(0)
            log = open(out / f"{file.stem}.log", "w")
            command = [program(), "tune", file, "--out", out / file.stem, "--resume", "--jobs", "1"]
            running[subprocess.Popen(command, stdout=log, stderr=subprocess.STDOUT)] = file, log
        time.sleep(0.2)
        for process in [one for one in running if one.poll() is not None]:
            file, log = running.pop(process)
            log.close()
            if process.returncode != 0:
                for other in running:
                    other.terminate()
                sys.exit(f"real_impacts: hookpoint tune {file} gave {process.returncode}; {log.name} says why")
            done += 1
            print(f"{out.name}: {file.stem} ({done} of {len(files)}, {time.monotonic() - began:.0f} s)", flush=True)


def median_constants(out):
    """Of each subject and constant the median of the folds, to four digits: five searches, of which one may have ended in another valley."""
    found = {}
    for part in parts_of(out):
        for row in rows_of(part / "folds.csv"):
            for title, value in row.items():
                constant = title.split(" [")[0]
                if constant in CONSTANTS and value:
                    found.setdefault(row["subject"], {}).setdefault(constant, []).append(float(value))
    whole = [subject for subject in SUBJECTS if found.get(subject) and all(len(values) == FOLDS for values in found[subject].values())]
    return {subject: {constant: f"{np.median(values):.4g}" for constant, values in found[subject].items()} for subject in whole}


def ranges():
    """constant -> (lower end, upper end, whether its scale is logarithmic) of the search."""
    found = {}
    for line in (ROOT / "configs/tunings/cube_tosses.hook").read_text().splitlines():
        if line.startswith("Vary "):
            end = lambda which: float(line.split(f"{which} = ")[1].split(";")[0].split()[0])
            found[line.split()[1]] = (end("from"), end("to"), "scale = log" in line)
    return found


STUDENT = 2.776  # 95 % either way, four degrees of freedom


def interval_of_searches(values, lower, upper, logarithmic):
    """Interval of 95 % of the mean of five searches over tosses of their own, within the range; and why the data do not tell the constant, or ""."""
    to, back = (np.log, np.exp) if logarithmic else (np.asarray, np.asarray)
    share = (to(np.array(values)) - to(lower)) / (to(upper) - to(lower))
    reach = STUDENT * np.std(share, ddof=1) / math.sqrt(len(share))
    low, high = np.clip([share.mean() - reach, share.mean() + reach], 0, 1)
    ends = [float(back(to(lower) + x * (to(upper) - to(lower)))) for x in (low, high)]
    if high - low > 0.5:
        return *ends, f"spans {100 * (high - low):.0f} % of its range"
    return *ends, "reaches the lower end of its range" if low < 2e-3 else "reaches the upper end of its range" if high > 1 - 2e-3 else ""


def write_materials(constants):
    for subject, values in constants.items():
        powers = {"powers": "31.6"} if subject in POWERS else {}
        arguments = ", ".join(f"{name} = {value} {CONSTANTS.get(name, '')}".rstrip() for name, value in {**values, **powers}.items())
        path = ROOT / f"configs/materials/acrylic_on_wood_{subject}.hook"
        path.write_text(f"// Acrylic on wood as {subject} has it: identified on 400 throws of a cube, docs/papers/real_impacts/page.md.\nInclude \"materials/acrylic_on_wood.hook\" ({arguments});\n")
        subprocess.run([program(), "fmt", path], check=True, capture_output=True)


STUDY = ROOT / "configs/studies/tossed_cube.hook"
OF_STUDY = {"hookpoint": "hookpoint", "hunt_crossley": "hunt_crossley", "impulse": "impulse", "bullet": "bullet_recommended", "mujoco": "mujoco_matched"}


def write_study(constants):
    """The constants of its subjects into the study of twenty throws."""
    text = STUDY.read_text()
    for name, subject in OF_STUDY.items():
        block = text[text.index(f"  Subject {name} {{") :]
        kept = block[: block.index("}\n  Subject") + 1 if "}\n  Subject" in block else None]
        fixes = "".join(f" Fix {key} {{ value = {value} {CONSTANTS[key]}; }}" for key, value in constants[subject].items())
        powers = " Fix powers { value = 31.6; }" if subject in POWERS else ""
        fields = f"contact = {name};" if subject in LAWS else "engine = {}; settings = {};".format(*subject.split("_"))
        text = text.replace(kept, f"  Subject {name} {{ {fields}{fixes}{powers} }}")
    STUDY.write_text(text)
    subprocess.run([program(), "fmt", STUDY], check=True, capture_output=True)


def borrowed(constants):
    """subject -> constants of each that takes those of another."""
    return {subject: constants[lender] for subject, lender in BORROWERS.items()}


def write_given(constants):
    known = [int(row["toss"]) for row in rows_of(DATA / "states.csv")]
    chosen = known[:: len(known) // 20][:20]
    only = f"values = {', '.join(map(str, chosen))};"
    text = "// Twenty throws of a real cube under constants that were identified from others: what continuous integration runs. Written by docs/papers/real_impacts/make.py.\n"
    text += held_against("given", "Acrylic on wood: constants that are given", cases_block("toss", "data/cube_tosses/states.csv", only), {**constants, **borrowed(constants)})
    GIVEN.write_text(text)
    subprocess.run([program(), "fmt", GIVEN], check=True, capture_output=True)


def write_moved(path):
    """Initial states drawn from their errors: that of the fit, whose position and velocity, angle and rate go together, and the tracker's own."""
    random = np.random.default_rng(1)
    rows = rows_of(DATA / "states.csv")[:: len(rows_of(DATA / "states.csv")) // MOVED][:MOVED]
    for row in rows:
        value = lambda *titles: np.array([float(row[title]) for title in titles])
        count = max(round(float(row["flight [s]"]) * RATE) - LATE, LEAST)
        t = LATE / RATE + np.arange(count) / RATE
        a = np.stack([np.ones_like(t), t], 1)
        root = np.linalg.cholesky(np.linalg.inv(a.T @ a))
        scale = root / np.linalg.norm(root, axis=1, keepdims=True)
        place = scale @ random.normal(size=(2, 3)) * np.array([[value("position_error [mm]")[0]], [value("velocity_error [mm/s]")[0]]]) * 1e-3
        turn = np.radians(scale @ random.normal(size=(2, 3)) * np.array([[value("angle_error [deg]")[0]], [value("rate_error [deg/s]")[0]]]))
        place[0] += TRACKING_PLACE * random.normal(size=3)
        turn[0] += np.radians(TRACKING_ANGLE) * random.normal(size=3)
        q = product(exponential(turn[0]), value("qw", "qx", "qy", "qz"))
        moved = dict(zip(("x [m]", "y [m]", "z [m]"), value("x [m]", "y [m]", "z [m]") + place[0]))
        moved.update(zip(("qw", "qx", "qy", "qz"), q))
        moved.update(zip(("vx [m/s]", "vy [m/s]", "vz [m/s]"), value("vx [m/s]", "vy [m/s]", "vz [m/s]") + place[1]))
        moved.update(zip(("wx [rad/s]", "wy [rad/s]", "wz [rad/s]"), value("wx [rad/s]", "wy [rad/s]", "wz [rad/s]") + turn[1]))
        row.update({title: f"{x:.7f}" for title, x in moved.items()})
    with open(path, "w", newline="") as file:
        writer = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    return f"values = {', '.join(row['toss'] for row in rows)};"


ROOMS = ("simbody", "dart", "ode_quickstep", "laws", "mujoco", "bullet", "ode")  # whose subjects are fitted by one process; the longest first


def room_of(subject):
    return "laws" if subject in LAWS else subject.rpartition("_")[0]


def hold_all(out, title, cases, constants):
    """Subjects with these constants against the measurements of these cases, a file a room."""
    out.mkdir(parents=True, exist_ok=True)
    files = []
    others = dict.fromkeys(room_of(subject) for subject in constants if room_of(subject) not in ROOMS)
    for room in (*ROOMS, *others):
        subjects = {subject: values for subject, values in constants.items() if room_of(subject) == room}
        if subjects:
            files.append(out / f"{room}.hook")
            files[-1].write_text(held_against(room, title, cases, subjects))
    tune_all(files, out)


def published_constants():
    """subject -> constant -> value, of the page's table."""
    constants = {}
    for row in summary("constants"):
        constants.setdefault(row["subject"], {})[row["constant"]] = row["value"]
    return constants


def hold_shipped(out, constants):
    hold_all(out / "shipped", "Acrylic on wood: published constants", cases_block("toss", "data/cube_tosses/states.csv", "from = 0;"), constants)


def hold_borrowers(out, constants):
    """Those that take constants, and their lenders, on all tosses."""
    lenders = {lender: constants[lender] for lender in BORROWERS.values()}
    title = "Acrylic on wood: constants that another subject identified"
    hold_all(out / "borrowed", title, cases_block("toss", "data/cube_tosses/states.csv", "from = 0;"), {**lenders, **borrowed(constants)})
