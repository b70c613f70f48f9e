"""Curves of a calibration as arrays, and how far a simulated toss is from the measured one."""

import csv
import functools
import math

import numpy as np

from rotations import inverse, logarithm, product
from flights import MASS, centre_of_mass, lowest, velocity_changes

EDGE = 0.1048  # m, of the source's cube; errors are parts of it


class Curves:
    """toss -> (times, {"measured" or a subject: (positions, quaternions)}); of a run that broke off there is none."""

    def __init__(self, path, cases="toss"):
        self.tosses, self.subjects = {}, []
        with open(path, newline="") as file:
            rows = csv.reader(file)
            header = next(rows)
            self.subjects = header[5:]
            columns = {}
            for row in rows:
                name, _, _ = row[0].rpartition("_")
                prefix, _, number = name.rpartition("_")
                if prefix != cases:
                    continue
                part = row[1].rpartition(".")
                key = (int(number), "q" if part[0].endswith("orientation") else "p", part[2])
                columns.setdefault(key, []).append([float(x) if x else math.nan for x in row[3:]])
        numbers = sorted({key[0] for key in columns})
        for number in numbers:
            block = lambda kind, parts: np.stack([np.array(columns[number, kind, part]) for part in parts], 2)
            p, q = block("p", "xyz"), block("q", "wxyz")
            curves = {}
            for i, name in enumerate(["measured", *self.subjects]):
                if not np.isnan(p[:, i + 1]).any():
                    curves[name] = (p[:, i + 1], q[:, i + 1])
            self.tosses[number] = (p[:, 0, 0], curves)


@functools.cache
def curves_of(path, cases="toss"):
    return Curves(path, cases)


def impacts(t, p, gravity, least=0.12):
    """Samples at which the velocity of the centre jumps: local maxima above `least` [m/s], two samples apart or more."""
    jump = velocity_changes(t, p, gravity)
    found = []
    for k in range(1, len(jump) - 1):
        if jump[k] >= least and jump[k] >= jump[k - 1] and jump[k] > jump[k + 1] and (not found or k - found[-1] > 2):
            found.append(k)
    return np.array(found, int)


def energies(t, p, q, frame):
    """Kinetic and gravitational energy at the samples but the first and last [J]."""
    span, c = (t[2:] - t[:-2])[:, None], centre_of_mass(p, q, frame["offset"])
    v = (c[2:] - c[:-2]) / span
    w = logarithm(product(q[2:], inverse(q[:-2]))) / span
    return 0.5 * MASS * (v**2).sum(1) + 0.5 * frame["inertia"] * (w**2).sum(1) + MASS * frame["gravity"] * c[1:-1, 2]


def compare(t, measured, model, frame):
    """What is told of one toss: errors of one subject's run against what was measured (or another run)."""
    (p, q), (pm, qm) = measured, model
    far = np.linalg.norm(pm - p, axis=1) / EDGE
    turned = np.degrees(np.linalg.norm(logarithm(product(qm, inverse(q))), axis=1))
    hits, model_hits = impacts(t, p, frame["gravity"]), impacts(t, pm, frame["gravity"])
    e, em = energies(t, p, q, frame), energies(t, pm, qm, frame)
    later = [abs(t[hits[i]] - t[model_hits[i]]) if i < min(len(hits), len(model_hits)) else math.nan for i in (1, 2)]
    so_far = np.searchsorted(hits, np.arange(len(t)), side="right")
    return {
        "position": far.mean(),
        "rotation": turned.mean(),
        "rest_position": far[-1],
        "rest_rotation": turned[-1],
        "penetration": max(0.0, -lowest(pm, qm, frame["half"], frame["table"]).min()),
        "energy": np.abs(em - e).mean() / (e[1] - e[-1]),
        "second_impact": later[0],
        "third_impact": later[1],
        "by_impacts": {int(n): (far[so_far == n].mean(), turned[so_far == n].mean()) for n in np.unique(so_far)},
    }


def mean_interval(values, seed=1, draws=2000):
    """Mean with its 95 % interval by bootstrap over tosses."""
    values = np.asarray(values)
    random = np.random.default_rng(seed)
    means = values[random.integers(0, len(values), (draws, len(values)))].mean(1)
    return values.mean(), *np.quantile(means, [0.025, 0.975])
