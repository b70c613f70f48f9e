"""Tables of the page, from the summaries beside it."""

import numpy as np

from paper import short
from setting import BORROWERS, ENGINES, frame_of_scene, summary
from summaries import lead


def metric_of(rows, stage, subject, metric):
    return next((row for row in rows if (row["stage"], row["subject"], row["metric"]) == (stage, subject, metric)), None)


def subjects_by_error(rows):
    position = {row["subject"]: float(row["mean"]) for row in rows if row["stage"] == "identified" and row["metric"] == "position"}
    return sorted(position, key=position.get)


def table_frame():
    yield "| | even tosses, used | odd tosses |"
    yield "|---|---|---|"
    for row in summary("frame"):
        cell = lambda which: row[which] + (f" ({row[which + '_error']})" if " to " in row[which + "_error"] else f" ± {row[which + '_error']}" if row[which + "_error"] else "")
        unit = f" [{row['unit']}]" if row["unit"] else ""
        yield f"| {row['quantity']}{unit} | {cell('even')} | {cell('odd')} |"


def scene_is_as_found():
    """Whether the scene's frame and cube are those that the tosses of even number say."""
    found, frame = {row["quantity"]: row["even"] for row in summary("frame")}, frame_of_scene()
    said = [frame["gravity"], 1e3 * frame["half"], 1e3 * frame["table"], *(1e3 * frame["offset"]), 1e3 * frame["inertia"]]
    names = ("fall", "half", "table", "centre of mass, by impacts", "moment of inertia")
    return np.allclose(said, [float(x) for name in names for x in found[name].split()], rtol=1e-9)


def table_accuracy():
    rows = summary("metrics")
    yield "| subject | position [% of the edge]: mean (95 %) | median | 90 % | rotation [deg]: mean (95 %) | median | at rest: position, median [%] | rotation, median [deg] | untuned: position, mean [%] | rotation, mean [deg] |"
    yield "|---|---|---|---|---|---|---|---|---|---|"
    for subject in subjects_by_error(rows):
        get = lambda metric, stage="identified": metric_of(rows, stage, subject, metric)
        position, rotation = get("position"), get("rotation")
        interval = lambda row: f"{short(row['mean'])} ({short(row['low'])} to {short(row['high'])})"
        untuned = [get(metric, "untuned") for metric in ("position", "rotation")]
        yield (
            f"| {subject} | {interval(position)} | {short(position['median'])} | {short(position['90 %'])} | {interval(rotation)} | {short(rotation['median'])}"
            f" | {short(get('rest_position')['median'])} | {short(get('rest_rotation')['median'])} | " + " | ".join(short(row["mean"]) if row else "" for row in untuned) + " |"
        )


def table_more():
    rows = summary("metrics")
    yield "| subject | deepest penetration, median [mm] | energy [% of what the toss loses] | second impact [ms] | third impact [ms] |"
    yield "|---|---|---|---|---|"
    for subject in subjects_by_error(rows):
        get = lambda metric: metric_of(rows, "identified", subject, metric)
        yield f"| {subject} | {short(get('penetration')['median'])} | {short(get('energy')['mean'])} | {short(get('second_impact')['mean'])} | {short(get('third_impact')['mean'])} |"


def table_impacts():
    rows = summary("by_impacts")
    counts = sorted({int(row["impacts"]) for row in rows if row["stage"] == "identified"})
    yield "| subject | " + " | ".join(f"after {n}" for n in counts) + " |"
    yield "|---|" + "---|" * len(counts)
    cell = lambda stage, subject, n: next((f"{short(row['position [%]'], 2)} %, {short(row['rotation [deg]'], 2)}" for row in rows if (row["stage"], row["subject"], int(row["impacts"])) == (stage, subject, n)), "")
    for subject in subjects_by_error(summary("metrics")):
        yield f"| {subject} | " + " | ".join(cell("identified", subject, n) for n in counts) + " |"
        if any(cell("floor", subject, n) for n in counts):
            yield "| its floor | " + " | ".join(cell("floor", subject, n) for n in counts) + " |"


def table_constants():
    rows = summary("constants")
    yield "| subject | constant | value | 95 %, five searches | 95 %, one search | identifiable |"
    yield "|---|---|---|---|---|---|"
    for row in rows:
        unit = f" {row['unit']}" if row["unit"] else ""
        # An interval without a width says that the samples of the bootstrap did not move the constant, not how well it is known.
        moves = float(row["one_search_high"]) - float(row["one_search_low"]) > 1e-9
        one_search = f"{short(row['one_search_low'])} to {short(row['one_search_high'])}" if moves else "did not vary"
        yield f"| {row['subject']} | {row['constant']} | {short(row['value'])}{unit} | {short(row['low'])} to {short(row['high'])} | {one_search} | {row['untold'] or 'yes'} |"


def table_correlations():
    yield "| subject | constants | correlation |"
    yield "|---|---|---|"
    for row in summary("correlations"):
        # Of a constant that did not vary rounding is left.
        correlation = row["correlation"] if abs(float(row["correlation"])) > 1e-9 else "one did not vary"
        yield f"| {row['subject']} | {row['constant']}, {row['other']} | {correlation} |"


def table_folds():
    yield "| subject | training | predicted (95 %) | held out, mean of the folds | least | largest | folds inside |"
    yield "|---|---|---|---|---|---|---|"
    for row in summary("folds"):
        yield f"| {row['subject']} | {short(row['training'])} | {short(row['promised'])} ({short(row['low'])} to {short(row['high'])}) | {short(row['held_out'])} | {short(row['least'])} | {short(row['largest'])} | {row['within']} |"


def table_pairs():
    rows = summary("pairs")
    yield f"| {rows[0]['ours']} less | position [% of the edge] (95 %) | rotation [deg] (95 %) |"
    yield "|---|---|---|"
    for other in dict.fromkeys(row["other"] for row in rows):
        cells = [f"{row['difference']} ({row['low']} to {row['high']})" for row in rows if row["other"] == other]
        yield f"| {other} | {' | '.join(cells)} |"


def table_nearer():
    rows = summary("nearer")
    yield f"| {rows[0]['ours']} less | position [% of the edge]: mean (95 %) | median | nearer in [% of tosses] (95 %) | | rotation [deg]: mean (95 %) | median | nearer in [% of tosses] (95 %) | |"
    yield "|---|---|---|---|---|---|---|---|---|"
    for other in dict.fromkeys(row["other"] for row in rows):
        cells = []
        for row in (row for row in rows if row["other"] == other):
            cells += [f"{row['difference']} ({row['low']} to {row['high']})", row["median"], f"{short(row['nearer [%]'], 2)} ({short(row['nearer_low'], 2)} to {short(row['nearer_high'], 2)})"]
            cells.append(lead(*(float(row[key]) for key in ("low", "high", "nearer_low", "nearer_high"))))
        yield f"| {other} | {' | '.join(cells)} |"


def table_borrowed():
    rows = summary("borrowed")
    yield "| subject | constants of | position [% of the edge]: mean (95 %) | median | rotation [deg]: mean (95 %) | median |"
    yield "|---|---|---|---|---|---|"
    lenders = dict.fromkeys(BORROWERS.values())
    for subject in (name for lender in lenders for name in (lender, *(one for one in BORROWERS if BORROWERS[one] == lender))):
        cells = []
        for metric in ("position", "rotation"):
            row = metric_of(rows, "borrowed", subject, metric)
            cells += [f"{short(row['mean'])} ({short(row['low'])} to {short(row['high'])})", short(row["median"])]
        yield f"| {subject} | {BORROWERS.get(subject, 'its own')} | {' | '.join(cells)} |"


def table_default():
    rows = summary("metrics")
    yield "| engine | position [% of the edge]: `default` | `recommended` | `matched` | rotation [deg]: `default` | `recommended` | `matched` |"
    yield "|---|---|---|---|---|---|---|"
    for engine in ENGINES:
        cells = []
        for metric in ("position", "rotation"):
            for stage, settings in (("default", "default"), ("identified", "recommended"), ("identified", "matched")):
                row = metric_of(rows, stage, f"{engine}_{settings}", metric)
                cells.append(short(row["mean"]) if row else "")
        yield f"| {engine} | {' | '.join(cells)} |"


def table_cube():
    rows = summary("metrics")
    yield "| subject | position [% of the edge]: this cube | the source's | rotation [deg]: this cube | the source's |"
    yield "|---|---|---|---|---|"
    for subject in [s for s in subjects_by_error(rows) if metric_of(rows, "source_cube", s, "position")]:
        pairs = [metric_of(rows, stage, subject, metric) for metric in ("position", "rotation") for stage in ("identified", "source_cube")]
        yield f"| {subject} | " + " | ".join(f"{short(row['mean'])} ({short(row['low'])} to {short(row['high'])})" for row in pairs) + " |"


def table_rebounds():
    rows = summary("rebounds")
    thirds = list(dict.fromkeys((row["rebound_from [mm]"], row["rebound_to [mm]"]) for row in rows))
    yield "| subject | " + " | ".join(f"{low} to {high} mm" for low, high in thirds) + " |"
    yield "|---|" + "---|" * len(thirds)
    for subject in subjects_by_error(summary("metrics")):
        cells = [f"{short(row['position [%]'])} ({short(row['low'])} to {short(row['high'])}); {short(row['rise [mm]'], 2)}" for row in rows if row["subject"] == subject]
        yield f"| {subject} | {' | '.join(cells)} |"


# B. Acosta, W. Yang, M. Posa, RA-L 2022, as later publications quote them: position [% of the edge], rotation [deg], each mean and spread over tosses, and friction.
ANCHOR = {"Drake": ("13.5 ± 8.2", "16.5 ± 20.0", "0.10"), "Bullet": ("14.9 ± 8.9", "16.5 ± 20.2", "0.36"), "MuJoCo": ("25.1 ± 10.8", "21.7 ± 21.4", "0.22")}


def table_anchor():
    rows, constants = summary("metrics"), summary("constants")
    best = subjects_by_error(rows)[0]
    yield "| | position [% of the edge]: mean ± spread over tosses | rotation [deg] | friction |"
    yield "|---|---|---|---|"
    for name, cells in ANCHOR.items():
        yield f"| {name}, theirs | {' | '.join(cells)} |"
    for subject in dict.fromkeys((best, "bullet_recommended", "bullet_matched", "mujoco_recommended", "mujoco_matched")):
        errors = [f"{float(row['mean']):.1f} ± {float(row['spread']):.1f}" for row in (metric_of(rows, "identified", subject, metric) for metric in ("position", "rotation"))]
        friction = next(row["value"] for row in constants if (row["subject"], row["constant"]) == (subject, "friction"))
        yield f"| {subject}, here, held out | {' | '.join(errors)} | {short(friction)} |"


TABLES = {"frame": table_frame, "accuracy": table_accuracy, "more": table_more, "impacts": table_impacts, "constants": table_constants, "correlations": table_correlations, "folds": table_folds, "pairs": table_pairs, "nearer": table_nearer, "borrowed": table_borrowed, "default": table_default, "rebounds": table_rebounds, "cube": table_cube, "anchor": table_anchor}
