"""What scripts/real_impacts finds of frame and cube, against throws that are made of it: free flight, one impulse at the lowest corner, free flight.

    /usr/bin/python3 tests/python/real_impacts_test.py
"""

import importlib.machinery
import importlib.util
import pathlib
import sys
import unittest

import numpy as np

sys.dont_write_bytecode = True
SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts/real_impacts"
loader = importlib.machinery.SourceFileLoader("real_impacts", str(SCRIPT))
script = importlib.util.module_from_spec(importlib.util.spec_from_loader("real_impacts", loader))
loader.exec_module(script)

GRAVITY, HALF, INERTIA, REBOUND, FRICTION = 9.7, 0.05, 9e-4, 0.3, 0.2
OFFSET = np.array([1e-3, -2e-3, 5e-3])  # of the centre of mass from the tracked one


def unit(random, size):
    vector = random.normal(size=size)
    return vector / np.linalg.norm(vector)


def thrown(random):
    """A throw whose first impact is that of one corner, (p, q) at the samples; None where it is not."""
    q1, w1 = unit(random, 4), 5 * unit(random, 3)
    v1 = np.array([*random.uniform(-1, 1, 2), -random.uniform(0.8, 1.5)])
    corners = script.matrices(q1[None])[0] @ (HALF * script.CORNERS - OFFSET).T
    order = np.argsort(corners[2])
    if corners[2, order[1]] - corners[2, order[0]] < 0.02:
        return None
    arm = corners[:, order[0]]
    slip = v1 + np.cross(w1, arm)
    if slip[2] > -0.3:
        return None
    # J = N (z - mu slip's direction), so much that the corner comes back with REBOUND of its speed.
    along = np.array([*(-FRICTION * slip[:2] / np.linalg.norm(slip[:2])), 1.0])
    answer = along / script.MASS + np.cross(np.cross(arm, along) / INERTIA, arm)
    impulse = -(1 + REBOUND) * slip[2] / answer[2] * along
    v2, w2 = v1 + impulse / script.MASS, w1 + np.cross(arm, impulse) / INERTIA
    when = 14.4 / script.RATE  # between two samples
    t = np.arange(30) / script.RATE - when
    before = (t < 0)[:, None]
    height = np.array([0, 0, -corners[2, order[0]]])
    c = height + np.where(before, v1, v2) * t[:, None] - np.outer(t * t / 2, [0, 0, GRAVITY])
    q = script.product(script.exponential(np.where(before, w1, w2) * t[:, None]), q1)
    low = (c[:, None, :] + np.einsum("nij,kj->nki", script.matrices(q), HALF * script.CORNERS - OFFSET))[:, :, 2].min(1)
    if low.min() < -0.02:
        return None  # another corner would have touched: only its own is to tell
    return c - script.matrices(q) @ OFFSET, q


class Cube(unittest.TestCase):
    def setUp(self):
        random = np.random.default_rng(3)
        tosses = [thrown(random) for _ in range(800)]
        self.tosses = [toss for toss in tosses if toss]
        self.assertGreater(len(self.tosses), 60)

    def test_flights_tell_gravity_and_the_centre_of_mass(self):
        flight = slice(0, 14)
        found, _ = script.fit_flights([(np.arange(14) / script.RATE, p[flight], q[flight]) for p, q in self.tosses])
        np.testing.assert_allclose(found[:3], OFFSET, atol=1e-9)
        self.assertAlmostEqual(found[3], GRAVITY, delta=1e-8)

    def test_lone_impacts_tell_inertia_centre_of_mass_rebound_and_friction(self):
        bias = script.Bias.__new__(script.Bias)
        bias.gravity, bias.half, bias.offset, bias.offset_error = GRAVITY, HALF, np.zeros(3), np.zeros(3)
        bias.weigh(self.tosses)
        self.assertGreater(bias.impacts, 40)
        np.testing.assert_allclose(bias.offset, OFFSET, atol=0.1e-3)
        self.assertAlmostEqual(bias.inertia, INERTIA, delta=0.01 * INERTIA)
        self.assertAlmostEqual(bias.rebound[1], REBOUND, delta=0.01)
        self.assertAlmostEqual(bias.friction[1], FRICTION, delta=0.005)
        self.assertLess(bias.unbalanced, 0.02)


if __name__ == "__main__":
    unittest.main()
