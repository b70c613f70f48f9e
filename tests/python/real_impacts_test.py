"""What docs/papers/real_impacts finds of frame and cube, against throws that are made of it: free flight, one impulse at the lowest corner, free flight.

    /usr/bin/python3 tests/python/real_impacts_test.py
"""

import pathlib
import sys
import unittest

import numpy as np

sys.dont_write_bytecode = True
PAPERS = pathlib.Path(__file__).resolve().parents[2] / "docs/papers"
sys.path[:0] = [str(PAPERS / "real_impacts"), str(PAPERS)]

import flights
import rotations
import setting
import summaries
import tables

GRAVITY, HALF, INERTIA, REBOUND, FRICTION = 9.7, 0.05, 9e-4, 0.3, 0.2
OFFSET = np.array([1e-3, -2e-3, 5e-3])  # of the centre of mass from the tracked one


def unit(random, size):
    vector = random.normal(size=size)
    return vector / np.linalg.norm(vector)


def thrown(random):
    """A throw whose first impact is that of one corner, (p, q) at the samples; None where it is not."""
    q1, w1 = unit(random, 4), 5 * unit(random, 3)
    v1 = np.array([*random.uniform(-1, 1, 2), -random.uniform(0.8, 1.5)])
    corners = rotations.matrices(q1[None])[0] @ (HALF * setting.CORNERS - OFFSET).T
    order = np.argsort(corners[2])
    if corners[2, order[1]] - corners[2, order[0]] < 0.02:
        return None
    arm = corners[:, order[0]]
    slip = v1 + np.cross(w1, arm)
    if slip[2] > -0.3:
        return None
    # J = N (z - mu slip's direction), so much that the corner comes back with REBOUND of its speed.
    along = np.array([*(-FRICTION * slip[:2] / np.linalg.norm(slip[:2])), 1.0])
    answer = along / flights.MASS + np.cross(np.cross(arm, along) / INERTIA, arm)
    impulse = -(1 + REBOUND) * slip[2] / answer[2] * along
    v2, w2 = v1 + impulse / flights.MASS, w1 + np.cross(arm, impulse) / INERTIA
    when = 14.4 / setting.RATE  # between two samples
    t = np.arange(30) / setting.RATE - when
    before = (t < 0)[:, None]
    height = np.array([0, 0, -corners[2, order[0]]])
    c = height + np.where(before, v1, v2) * t[:, None] - np.outer(t * t / 2, [0, 0, GRAVITY])
    q = rotations.product(rotations.exponential(np.where(before, w1, w2) * t[:, None]), q1)
    low = (c[:, None, :] + np.einsum("nij,kj->nki", rotations.matrices(q), HALF * setting.CORNERS - OFFSET))[:, :, 2].min(1)
    if low.min() < -0.02:
        return None  # another corner would have touched: only its own is to tell
    return c - rotations.matrices(q) @ OFFSET, q


class Cube(unittest.TestCase):
    def setUp(self):
        random = np.random.default_rng(3)
        tosses = [thrown(random) for _ in range(800)]
        self.tosses = [toss for toss in tosses if toss]
        self.assertGreater(len(self.tosses), 60)

    def test_flights_tell_gravity_and_the_centre_of_mass(self):
        flight = slice(0, 14)
        found, _ = flights.fit_flights([(np.arange(14) / setting.RATE, p[flight], q[flight]) for p, q in self.tosses])
        np.testing.assert_allclose(found[:3], OFFSET, atol=1e-9)
        self.assertAlmostEqual(found[3], GRAVITY, delta=1e-8)

    def test_lone_impacts_tell_inertia_centre_of_mass_rebound_and_friction(self):
        bias = flights.Bias.__new__(flights.Bias)
        bias.gravity, bias.half, bias.offset, bias.offset_error = GRAVITY, HALF, np.zeros(3), np.zeros(3)
        bias.weigh(self.tosses)
        self.assertGreater(bias.impacts, 40)
        np.testing.assert_allclose(bias.offset, OFFSET, atol=0.1e-3)
        self.assertAlmostEqual(bias.inertia, INERTIA, delta=0.01 * INERTIA)
        self.assertAlmostEqual(bias.rebound[1], REBOUND, delta=0.01)
        self.assertAlmostEqual(bias.friction[1], FRICTION, delta=0.005)
        self.assertLess(bias.unbalanced, 0.02)


class Pairs(unittest.TestCase):
    """Which of two subjects leads, of differences whose answer is known."""

    def results(self, differences):
        one = lambda position: {"position": position / 100, "rotation": 1.0}
        return {
            "impulse": {n: one(5 + d) for n, d in enumerate(differences)},
            "mujoco_matched": {n: one(5) for n in range(len(differences))},
        }

    def verdict(self, differences):
        rows = list(summaries.nearer_rows(self.results(differences)))
        self.assertEqual(rows[0][:4], ["impulse", "mujoco_matched", "position", "% of the edge"])
        mean, low, high, median, nearer, nearer_low, nearer_high = map(float, rows[0][5:])
        self.assertLessEqual(low, mean)
        self.assertLessEqual(mean, high)
        return summaries.lead(low, high, nearer_low, nearer_high), median, nearer

    def test_a_mean_that_a_few_tosses_make_is_no_lead_by_share(self):
        # Of 100 tosses 10 are nearer by 20, 90 farther by 0.1: -1.91 in the mean.
        verdict, median, nearer = self.verdict([-20] * 10 + [0.1] * 90)
        self.assertEqual((verdict, nearer), ("leads in the mean only", 10))
        self.assertAlmostEqual(median, 0.1)

    def test_leads_and_differences_that_are_none(self):
        self.assertEqual(self.verdict([-1, -2, -3, 1] * 25)[0], "leads")
        self.assertEqual(self.verdict([-4, 4, 5, -5] * 25)[0], "no difference")

    def test_share_of_wilson(self):
        # 10 of 100: 5.52 to 17.44 % (Brown, Cai & DasGupta 2001, the formula with z = 1.96).
        share, low, high = summaries.share_interval(10, 100)
        self.assertEqual(share, 0.1)
        self.assertAlmostEqual(low, 0.0552, delta=1e-4)
        self.assertAlmostEqual(high, 0.1744, delta=1e-4)


class TablesOfThePage(unittest.TestCase):
    def test_an_interval_without_a_width_is_none(self):
        rows = list(tables.table_constants())
        reversal = next(row for row in rows if row.startswith("| impulse_reversal | restitution "))
        self.assertIn("did not vary", reversal)
        self.assertNotIn("0.235 to 0.235", "".join(rows))
        self.assertNotIn("e-14", "".join(tables.table_correlations()))


if __name__ == "__main__":
    unittest.main()
