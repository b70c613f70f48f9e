"""Summary of the study's runs, and the tables of the page from it and from the prediction."""

import math
import pathlib

from paper import rows_of, write_csv

HERE = pathlib.Path(__file__).resolve().parent
PAGE, SUMMARY, PREDICTED = HERE / "page.md", HERE / "summary.csv", HERE / "predicted.csv"
GROUNDS = ["concrete", "ice", "clay", "rubble"]  # the study's numbers 1 to 4
SUBJECTS = ["hookpoint", "fixed_step", "nominal"]
GAITS = ["tripods", "Cruse"]
METRICS = ["fell", "hook_losses", "stance_slip", "stance_depth", "stance_lift", "foot_slip", "walking_speed", "cost_of_transport"]
HEADER = ["subject", "cruse", "ground", "stiffness [kN/m]", "walks", "fell", "hook_losses", "hook_losses_error", "stance_slip [m]", "stance_slip_error [m]",
          "stance_depth [m]", "stance_lift [m]", "foot_slip", "walking_speed [m/s]", "cost_of_transport"]
WITH_ERROR = ("hook_losses", "stance_slip")


def untitled(row):
    """A row by the titles of its columns without their units."""
    return {title.split(" [")[0]: value for title, value in row.items()}


def mean(values):
    return f"{sum(values) / len(values):.5g}" if values else ""


def standard_error(values):
    """Standard error of the mean over the seeds."""
    n = len(values)
    if n < 2:
        return ""
    variance = (sum(x * x for x in values) - sum(values) ** 2 / n) / (n - 1)
    return f"{math.sqrt(max(variance, 0) / n):.3g}"


def write_summary(results):
    """A row a cell (subject, gait, ground, stiffness), from the study's results.csv."""
    cells = {}
    for row in map(untitled, rows_of(results)):
        if row["status"] == "ok":
            cells.setdefault(tuple(row[name] for name in ("subject", "cruse", "ground", "stiffness")), []).append(row)
    rows = []
    for cell in sorted(cells, key=lambda cell: (cell[0], *map(float, cell[1:]))):
        line = [*cell, len(cells[cell])]
        for metric in METRICS:
            values = [float(row[metric]) for row in cells[cell] if row[metric] != ""]
            line.append(mean(values))
            if metric in WITH_ERROR:
                line.append(standard_error(values))
        rows.append(line)
    write_csv(SUMMARY, HEADER, rows)


def number(x, factor=1.0):
    """Two significant digits; "" for a number that is missing."""
    return "" if x in ("", None) else f"{factor * float(x):.2g}"


class Cells:
    """The summary by subject, gait (0 or 1), ground (1 to 4), stiffness (as written) and column."""

    def __init__(self):
        self.at, self.stiffnesses = {}, []
        for row in map(untitled, rows_of(SUMMARY)):
            self.at[row["subject"], int(row["cruse"]), int(row["ground"]), row["stiffness"]] = row
            if row["stiffness"] not in self.stiffnesses:
                self.stiffnesses.append(row["stiffness"])

    def get(self, subject, cruse, ground, stiffness, title):
        return self.at.get((subject, cruse, ground, stiffness), {}).get(title, "")

    def over_grounds(self, subject, cruse, stiffness, title):
        values = [float(x) for ground in range(1, 5) if (x := self.get(subject, cruse, ground, stiffness, title)) != ""]
        return sum(values) / len(values) if values else ""

    def by_gait(self):
        return [(cruse, stiffness) for cruse in (0, 1) for stiffness in self.stiffnesses]


def predictions():
    """(gait, stiffness [kN/m]) -> row of the prediction."""
    return {(int(row["cruse"]), float(row["stiffness [N/m]"]) / 1000): untitled(row) for row in rows_of(PREDICTED)}


def heading(*cells):
    yield "| " + " | ".join(cells) + " |"
    yield "|" + "---|" * len(cells)


def line_of(*cells):
    return "| " + " | ".join(cells) + " |"


def table_walks():
    rows = rows_of(SUMMARY)
    walks = lambda subject: sum(int(row["walks"]) for row in rows if subject in (row["subject"], "all"))
    yield from heading("walks", *SUBJECTS, "hunt_crossley")
    yield line_of(*(str(walks(subject)) for subject in ("all", *SUBJECTS, "hunt_crossley")))


def table_losses():
    cells, predicted = Cells(), predictions()
    yield from heading("stiffness [kN/m]", "gait", "depth [mm]: predicted", "on concrete", "losses a stance: predicted", *GROUNDS, "lift on concrete [um]")
    for cruse, k in cells.by_gait():
        foretold = predicted.get((cruse, float(k)), {})
        yield line_of(
            k, GAITS[cruse], number(foretold.get("stance_depth"), 1e3), number(cells.get("hookpoint", cruse, 1, k, "stance_depth"), 1e3),
            number(foretold.get("hook_losses")), *(number(cells.get("hookpoint", cruse, ground, k, "hook_losses")) for ground in range(1, 5)),
            number(cells.get("hookpoint", cruse, 1, k, "stance_lift"), 1e6))


def by_subject(title, factor, subjects):
    cells = Cells()
    for cruse, k in cells.by_gait():
        yield line_of(k, GAITS[cruse], *(number(cells.get(subject, cruse, ground, k, title), factor) for subject in subjects for ground in range(1, 5)))


def table_step():
    yield from heading("stiffness [kN/m]", "gait", "losses a stance at one step of 0.5 ms: concrete", *GROUNDS[1:], "nominal: concrete", *GROUNDS[1:])
    yield from by_subject("hook_losses", 1, SUBJECTS[1:])


def table_slip():
    yield from heading("stiffness [kN/m]", "gait", "hookpoint: concrete", *GROUNDS[1:], "one step of 0.5 ms: concrete", *GROUNDS[1:], "nominal: concrete", *GROUNDS[1:])
    yield from by_subject("stance_slip", 1e3, SUBJECTS)


def table_friction():
    cells = Cells()
    yield from heading("stiffness [kN/m]", "gait", "ground", "depth [mm]: hookpoint", "hunt_crossley", "losses a stance: hookpoint", "hunt_crossley",
                       "slip a stance [mm]: hookpoint", "hunt_crossley")
    for k in cells.stiffnesses:
        for cruse in (0, 1):
            for ground in range(1, 5):
                if cells.get("hunt_crossley", cruse, ground, k, "walks") == "":
                    continue
                yield line_of(k, GAITS[cruse], GROUNDS[ground - 1],
                              *(number(cells.get(subject, cruse, ground, k, title), factor)
                                for title, factor in (("stance_depth", 1e3), ("hook_losses", 1), ("stance_slip", 1e3)) for subject in ("hookpoint", "hunt_crossley")))


def table_cost():
    cells = Cells()
    yield from heading("stiffness [kN/m]", "gait", "hookpoint: fell", "speed [m/s]", "cost of transport", "one step: fell", "speed", "cost", "nominal: fell", "speed", "cost")
    for cruse, k in cells.by_gait():
        line = []
        for subject in SUBJECTS:
            line += [f"{100 * (cells.over_grounds(subject, cruse, k, 'fell') or 0):.0f} %",
                     *(number(cells.over_grounds(subject, cruse, k, title)) for title in ("walking_speed", "cost_of_transport"))]
        yield line_of(k, GAITS[cruse], *line)


TABLES = {"walks": table_walks, "losses": table_losses, "step": table_step, "slip": table_slip, "friction": table_friction, "cost": table_cost}
