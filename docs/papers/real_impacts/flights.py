"""Free flight of a tracked cube, and what flights and impacts tell of frame and cube: gravity, table, size, centre of mass."""

import copy
import math

import numpy as np

from setting import CORNERS, LATE, LEAST, RATE, SETTLED
from rotations import exponential, inverse, left_jacobian, logarithm, matrices, product, skew


def centre_of_mass(p, q, offset):
    return p + matrices(q) @ offset


def fit_centre(t, c, gravity):
    """Position and velocity of the centre of mass at t = 0 [2, 3], residuals, and (A^T A)^-1."""
    a = np.stack([np.ones_like(t), t], 1)
    fallen = c + np.outer(t * t / 2, [0, 0, gravity])
    unit = np.linalg.inv(a.T @ a)
    fitted = unit @ a.T @ fallen
    return fitted, fallen - a @ fitted, unit


def fit_turn(t, q):
    """Angular velocity and orientation at t = 0, and residuals [rad] in world axes: Gauss and Newton's method over the rotation group."""
    w = logarithm(product(q[-1], inverse(q[0]))) / (t[-1] - t[0])
    q0 = product(exponential(-w * t[0]), q[0])
    for _ in range(8):
        model = product(exponential(np.outer(t, w)), q0)
        rest = logarithm(product(q, inverse(model)))
        rows = [np.hstack([left_jacobian(w * s) * s, matrices(exponential(w * s)[None])[0]]) for s in t]
        step = np.linalg.lstsq(np.concatenate(rows), rest.ravel(), rcond=None)[0]
        w, q0 = w + step[:3], product(exponential(step[3:]), q0)
    return w, q0, logarithm(product(q, inverse(product(exponential(np.outer(t, w)), q0))))


def lowest(p, q, half, table):
    """Height over the table of the deepest corner."""
    return (p[:, None, :] + half * np.einsum("nij,kj->nki", matrices(q), CORNERS))[:, :, 2].min(1) - table


def flight_of(low):
    """The samples of the flight: those after which, as fast as the lowest corner falls, the next one is still above the table."""
    after = np.nonzero(low[1:] + np.minimum(np.diff(low), 0) <= 0)[0]
    end = int(after[0]) + 1
    return range(LATE if end - LATE >= LEAST else 0, end)


def settled_length(p, q):
    """Samples up to rest and SETTLED of it."""
    moves = (np.linalg.norm(p - p[-1], axis=1) > 1e-3) | (np.linalg.norm(logarithm(product(q, inverse(q[-1]))), axis=1) > math.radians(0.5))
    return min(len(p), int(np.nonzero(moves)[0].max()) + 1 + SETTLED)


MASS = 0.37  # kg, the source's
APART = 7  # samples before and after an impact that tell its velocities


def fit_flights(flights):
    """Gravity and the offset of the centre of mass from the tracked centre, by least squares over the flights (t, p, q) of many tosses; (offset, gravity) and
    their standard errors, which allow for residuals that hang together within a toss."""
    normal, right, each = np.zeros((4, 4)), np.zeros(4), []
    for t, p, q in flights:
        a = np.stack([np.ones_like(t), t], 1)
        free = np.eye(len(t)) - a @ np.linalg.inv(a.T @ a) @ a.T  # leaves out what a start and a velocity explain
        turned, none = matrices(q), np.zeros(len(t))
        x = np.hstack([np.concatenate([-free @ turned[:, i] for i in range(3)]), np.concatenate([none, none, -free @ (t * t / 2)])[:, None]])
        y = np.concatenate([free @ p[:, i] for i in range(3)])
        normal, right = normal + x.T @ x, right + x.T @ y
        each.append((x, y))
    found = np.linalg.solve(normal, right)
    scores = [x.T @ (y - x @ found) for x, y in each]
    inverse_normal = np.linalg.inv(normal)
    return found, np.sqrt(np.diag(inverse_normal @ sum(np.outer(z, z) for z in scores) @ inverse_normal))


def lone_impact(p, q, half, offset, gravity):
    """Of a first impact of one corner alone, with APART samples of flight on either side: the changes of angular velocity and of velocity of the centre of
    mass, the corner's arm from that, the cube's orientation, and how much of the corner's speed comes back; None where there is no such."""
    t, c = np.arange(len(p)) / RATE, centre_of_mass(p, q, offset)
    struck = np.nonzero(velocity_changes(t, c, gravity) > 0.1)[0]
    if len(struck) == 0:
        return None
    first = struck[0]
    later = struck[struck > first + 2]
    after = slice(first + 2, first + 2 + APART)
    if first < APART + 1 or (later[0] if len(later) else len(t) - 1) < after.stop + 1:
        return None
    before = slice(first - APART + 1, first)
    (c1, v1), _, _ = fit_centre(t[before], c[before], gravity)
    (c2, v2), _, _ = fit_centre(t[after], c[after], gravity)
    when = (c1[2] - c2[2]) / (v2[2] - v1[2])  # where both flights are equally high
    if not t[first - 2] < when < t[first + 3]:
        return None
    w1, q1, _ = fit_turn(t[before] - when, q[before])
    w2, _, _ = fit_turn(t[after] - when, q[after])
    corners = matrices(q1[None])[0] @ (half * CORNERS - offset).T
    order = np.argsort(corners[2])
    if corners[2, order[1]] - corners[2, order[0]] < 0.01:
        return None
    arm, fall = corners[:, order[0]], np.array([0, 0, gravity * when])
    speeds = [(v - fall + np.cross(w, arm))[2] for v, w in ((v1, w1), (v2, w2))]
    return w2 - w1, v2 - v1, arm, matrices(q1[None])[0], -speeds[1] / speeds[0]


def least_lengths(rows, right):
    """x that makes the sum of |rows[i] x - right[i]| least: one impact that is not what it was taken for does not pull. Least squares with weights, anew."""
    weights = np.ones(len(rows))
    for _ in range(50):
        roots = np.sqrt(weights)
        x = np.linalg.lstsq((rows * roots[:, None, None]).reshape(-1, rows.shape[2]), (right * roots[:, None]).ravel(), rcond=None)[0]
        weights = 1 / np.maximum(np.linalg.norm(rows @ x - right, axis=1), 1e-5)
    return x


class Bias:
    """What the frame of the measurement is off by: gravity, the height of the table, how far from the centre the cube touches; and what the source does not say
    of the cube: where its centre of mass is, and its inertia."""

    def __init__(self, tosses):
        self.gravity, self.half, self.table, self.offset = 9.81, 0.0524, 0.0, np.zeros(3)
        for _ in range(3):
            self.find(tosses)
        self.weigh(tosses)
        self.allow_for_half(tosses)

    def allow_for_half(self, tosses):
        """The moment of inertia grows with the corner's arm: the error of `half` is part of its own."""
        moved = copy.copy(self)
        moved.half, moved.offset = self.half + self.half_error, self.flight_offset
        moved.weigh(tosses)
        self.inertia_error = math.hypot(self.inertia_error, moved.inertia - self.inertia)

    def find(self, tosses):
        flights, stands, rests = [], [], []
        for p, q in tosses:
            flight = flight_of(lowest(p, q, self.half, self.table))
            if len(flight) >= 2 * LEAST:
                part = slice(flight.start, flight.stop)
                flights.append((np.array(flight) / RATE, p[part], q[part]))
            rests.append(p[-1, 2])
            stands.extend(self.standing(p, q, flight.stop + 2))
        found, errors = fit_flights(flights)
        self.offset, self.gravity, self.offset_error, self.gravity_error = found[:3], found[3], errors[:3], errors[3]
        # z = table + half s, s = 1 on a face, up to sqrt 3 on a corner.
        height, rows = np.median(rests), np.array(stands)
        self.half = np.median((rows[:, 1] - height) / (rows[:, 0] - 1))
        spread = np.std((rows[:, 1] - height) / (rows[:, 0] - 1) - self.half)
        self.half_error = 1.25 * spread / math.sqrt(len(rows))
        self.table = height - self.half
        self.rest_error = np.std(rests)

    def weigh(self, tosses):
        """Inertia and centre of mass from the balance of momentum in lone impacts, which holds under any law of contact: I dw = arm x m dv. With the centre of
        mass moved by R d the arm is less by it and dv more by dw x R d; what remains is made least, its length summed over the impacts, in steps."""
        self.flight_offset, self.flight_offset_error = self.offset, self.offset_error
        for _ in range(4):
            found = [one for one in (lone_impact(p, q, self.half, self.offset, self.gravity) for p, q in tosses) if one]
            rows = np.array([np.hstack([dw[:, None], -MASS * (skew(dv) + skew(arm) @ skew(dw)) @ turned]) for dw, dv, arm, turned, _ in found])
            torques = np.array([np.cross(arm, MASS * dv) for _, dv, arm, _, _ in found])
            solved = least_lengths(rows, torques)
            self.inertia, self.offset = solved[0], self.offset + solved[1:]
        random = np.random.default_rng(1)
        drawn = [least_lengths(rows[i], torques[i]) for i in random.integers(0, len(rows), (200, len(rows)))]
        self.inertia_error, self.offset_error = np.std(drawn, 0)[0], np.std(drawn, 0)[1:]
        self.unbalanced = np.median(np.linalg.norm(torques - rows @ solved, axis=1) / np.linalg.norm(torques, axis=1))
        self.impacts = len(found)
        self.rebound = np.quantile([one[-1] for one in found], [0.25, 0.5, 0.75])
        self.friction = np.quantile([np.hypot(*dv[:2]) / dv[2] for _, dv, _, _, _ in found], [0.25, 0.5, 0.75])

    def standing(self, p, q, first):
        """(s, z) of samples in which the lowest corner stands on the table while the cube turns about it."""
        turned = np.einsum("nij,kj->nki", matrices(q), CORNERS)
        corners = p[:, None, :] + self.half * turned
        for k in range(max(first, 1), len(p) - 1):
            low = int(np.argmin(turned[k, :, 2]))
            s = -turned[k, low, 2]
            speed = np.linalg.norm(corners[k + 1, low] - corners[k - 1, low]) * RATE / 2
            if s > 1.15 and speed < 0.12:
                yield s, p[k, 2]


def velocity_changes(t, p, gravity):
    """Change of the centre's velocity about each sample beyond what gravity does [m/s]."""
    v = np.diff(p, axis=0) / np.diff(t)[:, None]
    change = np.diff(v, axis=0)
    change[:, 2] += gravity * (t[2:] - t[:-2]) / 2
    return np.concatenate([[0], np.linalg.norm(change, axis=1), [0]])
