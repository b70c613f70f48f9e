"""Summaries beside the page (CSV), from the folders that the calibrations leave."""

import math

import numpy as np

from paper import rows_of, write_csv, text_of
from setting import BORROWERS, DEFAULTS, LAWS, PAGE, PEERS, SUBJECTS, frame_of_scene, parts_of, summary
from rotations import inverse, logarithm, product
from flights import lowest
from curves import EDGE, compare, curves_of, impacts, mean_interval
from runs import interval_of_searches, median_constants, ranges


def judged(curves, frame):
    """subject -> toss -> compare()."""
    found = {subject: {} for subject in curves.subjects}
    for number, (t, runs) in curves.tosses.items():
        for subject in curves.subjects:
            if subject in runs:
                found[subject][number] = compare(t, runs["measured"], runs[subject], frame)
    return found


METRICS = {
    "position": ("% of the edge", 100),
    "rotation": ("deg", 1),
    "rest_position": ("% of the edge", 100),
    "rest_rotation": ("deg", 1),
    "penetration": ("mm", 1e3),
    "energy": ("%", 100),
    "second_impact": ("ms", 1e3),
    "third_impact": ("ms", 1e3),
}
METRIC_COLUMNS = ["stage", "subject", "metric", "unit", "tosses", "mean", "low", "high", "spread", "median", "90 %"]


def metric_rows(results, stage):
    for subject, tosses in results.items():
        if not tosses:
            continue
        for metric, (unit, factor) in METRICS.items():
            values = factor * np.array([one[metric] for one in tosses.values()])
            values = values[~np.isnan(values)]
            if len(values) == 0:
                continue
            mean, low, high = mean_interval(values)
            yield [stage, subject, metric, unit, len(values), *(text_of(x) for x in (mean, low, high, values.std(), np.median(values), np.quantile(values, 0.9)))]


def impact_rows(results, stage):
    for subject, tosses in results.items():
        counts = {}
        for one in tosses.values():
            for n, errors in one["by_impacts"].items():
                counts.setdefault(n, []).append(errors)
        for n, errors in sorted(counts.items()):
            if len(errors) >= 20:
                means = np.mean(errors, 0)
                yield [stage, subject, n, len(errors), text_of(100 * means[0]), text_of(means[1])]


def floor_of(curves, frame):
    """subject -> toss -> compare() of the run from the moved state with the run from the state itself."""
    still, moved = curves
    found = {subject: {} for subject in still.subjects}
    for number, (t, runs) in still.tosses.items():
        for subject in still.subjects:
            if subject in runs and number in moved.tosses and subject in moved.tosses[number][1]:
                one = compare(t, runs[subject], moved.tosses[number][1][subject], frame)
                hits = impacts(t, runs["measured"][0], frame["gravity"])
                so_far = np.searchsorted(hits, np.arange(len(t)), side="right")
                (p, q), (pm, qm) = runs[subject], moved.tosses[number][1][subject]
                far = np.linalg.norm(pm - p, axis=1) / EDGE
                turned = np.degrees(np.linalg.norm(logarithm(product(qm, inverse(q))), axis=1))
                one["by_impacts"] = {int(n): (far[so_far == n].mean(), turned[so_far == n].mean()) for n in np.unique(so_far)}
                found[subject][number] = one
    return found


def merged(out, stage="identified", name="curves.csv"):
    """Judged curves of all calibrations of a stage."""
    frame, found = frame_of_scene(), {}
    for part in parts_of(out, stage):
        found.update(judged(curves_of(part / name), frame))
    return {subject: found[subject] for subject in [*SUBJECTS, *DEFAULTS, *BORROWERS] if found.get(subject)}


def summaries(out):
    frame = frame_of_scene()
    tuned = merged(out)
    untuned = merged(out, name="own_curves.csv")
    default = merged(out, "default")
    floor = {}
    for part in parts_of(out, "floor"):
        floor.update(floor_of((curves_of(part / "curves.csv"), curves_of(part / "curves.csv", "moved")), frame))
    stages = (("identified", tuned), ("untuned", untuned), ("default", default), ("source_cube", merged(out, "source_cube")), ("floor", floor))
    path = lambda name: PAGE.parent / f"{name}.csv"
    write_csv(
        path("metrics"),
        METRIC_COLUMNS,
        [row for stage, results in stages for row in metric_rows(results, stage)],
    )
    write_csv(
        path("by_impacts"),
        ["stage", "subject", "impacts", "tosses", "position [%]", "rotation [deg]"],
        [row for stage, results in stages for row in impact_rows(results, stage)],
    )
    constants, medians, within_range = [], median_constants(out), ranges()
    folds = []
    for part in parts_of(out):
        of_folds = rows_of(part / "folds.csv")
        for row in rows_of(part / "calibration.csv"):
            subject, constant = row["subject"], row["constant"]
            if subject not in tuned or constant not in medians[subject]:
                continue
            title = next(title for title in of_folds[0] if title.split(" [")[0] == constant)
            low, high, reason = interval_of_searches([float(fold[title]) for fold in of_folds if fold["subject"] == subject], *within_range[constant])
            constants.append([subject, constant, row["unit"], medians[subject][constant], text_of(low), text_of(high), reason, row["low"], row["high"]])
        for subject in dict.fromkeys(row["subject"] for row in of_folds if row["subject"] in tuned):
            rows = [row for row in of_folds if row["subject"] == subject]
            mean = lambda title: text_of(np.mean([float(row[title]) for row in rows]))
            held = [float(row["held_out_error"]) for row in rows]
            within = sum(float(row["promised_low"]) <= error <= float(row["promised_high"]) for row, error in zip(rows, held))
            folds.append([subject, *(mean(title) for title in ("training_error", "promised_error", "promised_low", "promised_high", "held_out_error")), text_of(min(held)), text_of(max(held)), f"{within}/{len(rows)}"])
    order = {subject: i for i, subject in enumerate(SUBJECTS)}
    write_csv(path("constants"), ["subject", "constant", "unit", "value", "low", "high", "untold", "one_search_low", "one_search_high"], sorted(constants, key=lambda row: order[row[0]]))
    write_csv(path("folds"), ["subject", "training", "promised", "low", "high", "held_out", "least", "largest", "within"], sorted(folds, key=lambda row: order[row[0]]))
    correlations = [[row["subject"], row["constant"], row["other"], text_of(float(row["correlation"]), 2)] for part in parts_of(out) for row in rows_of(part / "correlations.csv") if row["constant"] < row["other"] and row["subject"] in tuned]
    write_csv(path("correlations"), ["subject", "constant", "other", "correlation"], sorted(correlations, key=lambda row: order[row[0]]))
    write_csv(path("pairs"), ["ours", "other", "metric", "unit", "difference", "low", "high"], pair_rows(tuned))
    write_nearer(out)
    write_borrowed(out)
    write_csv(path("rebounds"), ["subject", "rebound_from [mm]", "rebound_to [mm]", "tosses", "position [%]", "low", "high", "rotation [deg]", "rise [mm]"], rebound_rows(out, frame))
    shown_toss(out, frame)


def pairs_of(results, ours=None):
    """The best law (or `ours`) against the best peer and then all others: (ours, other, metric, unit, differences toss by toss)."""
    error = lambda subject: np.mean([one["position"] + 0.5 * math.radians(one["rotation"]) for one in results[subject].values()])
    ours = ours or min((s for s in results if s in LAWS), key=error)
    peers = sorted((s for s in results if s in PEERS), key=error)
    laws = sorted((s for s in results if s in LAWS and s != ours), key=error)
    for other in (*peers[:1], *laws, *peers[1:]):
        for metric in ("position", "rotation"):
            unit, factor = METRICS[metric]
            both = [n for n in results[ours] if n in results[other]]
            yield ours, other, metric, unit, factor * np.array([results[ours][n][metric] - results[other][n][metric] for n in both])


def pair_rows(results):
    return [[*names, *(text_of(x, 3) for x in mean_interval(differences))] for *names, differences in pairs_of(results)]


def share_interval(count, total):
    """Share and its 95 % interval (Wilson, "Probable inference", 1927)."""
    z, share = 1.95996, count / total
    middle, reach = share + z * z / (2 * total), z * math.sqrt(share * (1 - share) / total + z * z / (4 * total * total))
    return share, (middle - reach) / (1 + z * z / total), (middle + reach) / (1 + z * z / total)


def nearer_rows(results, ours=None):
    """Of each pair the mean difference and the median one, and in what share of the tosses ours is nearer (a tie is half)."""
    for *names, differences in pairs_of(results, ours):
        count = np.sum(differences < 0) + 0.5 * np.sum(differences == 0)
        values = [*mean_interval(differences), np.median(differences), *(100 * x for x in share_interval(count, len(differences)))]
        yield [*names, len(differences), *(text_of(x, 3) for x in values)]


def lead(low, high, share_low, share_high):
    """Whether ours leads: by the mean and in more than half of the tosses, each beyond its 95 % interval."""
    ahead, behind = high < 0, low > 0
    if not ahead and not behind:
        return "no difference"
    often = share_low > 50 if ahead else share_high < 50
    return ("leads" if ahead else "is behind") + ("" if often else " in the mean only")


def write_nearer(out):
    """Who is nearer under the published constants, from the runs of the stage `shipped`."""
    shipped = merged(out, "shipped")
    if shipped:
        ours = summary("pairs")[0]["ours"]  # which is best is decided by tosses that the constants have not seen
        header = ["ours", "other", "metric", "unit", "tosses", "difference", "low", "high", "median", "nearer [%]", "nearer_low", "nearer_high"]
        write_csv(PAGE.parent / "nearer.csv", header, nearer_rows(shipped, ours))


def write_borrowed(out):
    """Errors of those that take constants and of their lenders, from the runs of the stage `borrowed`."""
    results = merged(out, "borrowed")
    if results:
        rows = metric_rows(results, "borrowed")
        write_csv(PAGE.parent / "borrowed.csv", METRIC_COLUMNS, rows)


def rebound(t, p, q, frame):
    """How high the lowest corner comes between the first impact and the second [m]."""
    hits = impacts(t, p, frame["gravity"])
    if len(hits) == 0:
        return math.nan
    end = hits[1] if len(hits) > 1 else len(t) - 1
    return lowest(p, q, frame["half"], frame["table"])[hits[0] + 1 : end + 1].max()


def rebound_rows(out, frame):
    """Errors by thirds of the tosses, by how high the cube is seen to leave the table after its first impact."""
    for part in parts_of(out):
        curves = curves_of(part / "curves.csv")
        seen = {number: rebound(t, *runs["measured"], frame) for number, (t, runs) in curves.tosses.items()}
        cuts = np.nanquantile(list(seen.values()), [0, 1 / 3, 2 / 3, 1])
        results = judged(curves, frame)
        for subject in curves.subjects:
            for low, high in zip(cuts, cuts[1:]):
                chosen = [n for n in results[subject] if low <= seen[n] <= high]
                if not chosen:
                    continue
                mean, least, most = mean_interval([100 * results[subject][n]["position"] for n in chosen])
                rise = [1e3 * rebound(curves.tosses[n][0], *curves.tosses[n][1][subject], frame) for n in chosen]
                turned = np.mean([results[subject][n]["rotation"] for n in chosen])
                yield [subject, *(text_of(x, 3) for x in (1e3 * low, 1e3 * high)), len(chosen), *(text_of(x) for x in (mean, least, most, turned, np.nanmedian(rise)))]


def shown_toss(out, frame):
    """The curves of the toss whose error, median over subjects, is the median one."""
    everything = [curves_of(part / "curves.csv") for part in parts_of(out)]
    errors = {}
    for number in everything[0].tosses:
        errors[number] = np.median(
            [compare(c.tosses[number][0], c.tosses[number][1]["measured"], c.tosses[number][1][s], frame)["position"] for c in everything for s in c.subjects if s in c.tosses[number][1]]
        )
    number = sorted(errors, key=errors.get)[len(errors) // 2]
    rows = []
    for c in everything:
        t, runs = c.tosses[number]
        for subject in (["measured"] if c is everything[0] else []) + c.subjects:
            if subject not in runs:
                continue
            p, q = runs[subject]
            turned = np.degrees(np.linalg.norm(logarithm(product(q, inverse(runs["measured"][1]))), axis=1))
            rows += [[number, subject, text_of(1e3 * s, 6), *(text_of(1e3 * x, 5) for x in place), text_of(angle)] for s, place, angle in zip(t, p, turned)]
    write_csv(PAGE.parent / "toss.csv", ["toss", "subject", "t [ms]", "x [mm]", "y [mm]", "z [mm]", "angle [deg]"], rows)
