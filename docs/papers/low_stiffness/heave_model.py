"""Prediction of when a hook survives a stance, from what configs/scenes/walking_stiffness.hook and configs/robots/leg.hook state.

The hexapod is one rigid body that heaves, pitches and rolls on six massless feet over level ground; nothing measured enters (page.md).
"""

import math

import numpy as np

GRAVITY = 9.81
FEMUR, COXA = 0.1, 0.05  # m
LIFT, SPREAD = math.radians(30), math.radians(30)
LEVER = FEMUR * math.cos(LIFT)  # of a foot's load about the femur's axis; about the knee, over an upright tibia, none
REACH = COXA + LEVER
LOAD = 13.8  # N of a foot, for the ground's damping
FORWARD, STEP_HEIGHT = 0.1, 0.05  # m/s, m

# 2 kg of base, 0.3 x 0.2 x 0.06 m, and six legs of 0.37 kg whose middle is OUT from the hip.
LEG = 0.37
MASS = 2 + 6 * LEG
OUT = (0.1 * COXA / 2 + 0.15 * (COXA + LEVER / 2) + 0.12 * (COXA + LEVER)) / LEG
PITCH_INERTIA = 2 / 12 * (0.3**2 + 0.06**2) + 4 * LEG * (0.12 + OUT * math.sin(SPREAD)) ** 2
ROLL_INERTIA = 2 / 12 * (0.2**2 + 0.06**2) + LEG * (4 * (0.1 + OUT * math.cos(SPREAD)) ** 2 + 2 * (0.1 + OUT) ** 2)

TIME_STEP = 2e-4  # s
PERIODS, FIRST_PERIOD = 10, 5  # simulated, and from which on stances count
LEGS = 6


def gait(cruse):
    """Duration of a swing and period of a step [s]. Cruse's rules settle at this speed with swings that follow each other along a side, the sides
    half a cycle apart; the other gait is alternating tripods."""
    return (0.25, 0.75) if cruse else (0.27, 0.6)


def touch_down(leg, cruse):
    """Phase of the cycle at which a leg touches down."""
    return (leg % 3) / 3 + (0 if leg < 3 else 0.5) if cruse else (leg % 2) / 2


def predict(cruse, stiffnesses, pconstant=60.0, dconstant=0.3, damping_ratio=0.1):
    """Contacts lost per stance, mean depth of a standing foot that touches [m], heave from top to bottom [m]: an array each, over `stiffnesses` [N/m].

    Semi-implicit Euler for the body; each foot between the leg's spring and damper and the ground's is a first-order equation of its own.
    """
    k = np.asarray(stiffnesses, float)
    leg_stiffness, leg_damping = pconstant / LEVER**2, dconstant / LEVER**2
    ground_damping = 2 * damping_ratio * np.sqrt(k * LOAD / GRAVITY)
    swing, period = gait(cruse)
    duty = 1 - swing / period
    rows = [leg % 3 - 1 for leg in range(LEGS)]
    foot_x = [row * (0.12 + REACH * (math.sin(SPREAD) if row else 0)) for row in rows]
    foot_y = [(-1 if leg < 3 else 1) * (0.1 + REACH * (math.cos(SPREAD) if row else 1)) for leg, row in enumerate(rows)]
    start = [touch_down(leg, cruse) for leg in range(LEGS)]

    zero = np.zeros_like(k)
    z, dz, pitch, dpitch, roll, droll = (zero.copy() for _ in range(6))
    foot_z = [zero.copy() for _ in range(LEGS)]
    stood, whole = [False] * LEGS, [False] * LEGS
    touched, was_inside = ([np.zeros(len(k), bool) for _ in range(LEGS)] for _ in range(2))
    losses, stances, depth, deep = (zero.copy() for _ in range(4))
    top, bottom = np.full(len(k), -np.inf), np.full(len(k), np.inf)
    first = FIRST_PERIOD * period / TIME_STEP
    n = 0
    while n < PERIODS * period / TIME_STEP:
        up, nose, lean = -MASS * GRAVITY, 0, 0
        for i in range(LEGS):
            clock = math.modf(n * TIME_STEP / period - start[i] + 2)[0]
            stands = clock < duty
            s = (clock - duty) / (1 - duty)
            x = foot_x[i] + FORWARD * period * (duty / 2 - clock if stands else duty * (s - 0.5))
            # Height and rate of the foot without load, s from 0 to 1 over a swing (docs/gaits.md); then the foot between both springs.
            height = 0 if stands else 64 * STEP_HEIGHT * (s * (1 - s)) ** 3
            climb = 0 if stands else 192 * STEP_HEIGHT * (s * (1 - s)) ** 2 * (1 - 2 * s) / swing
            free = z - pitch * x + roll * foot_y[i] + height
            rate = dz - dpitch * x + droll * foot_y[i] + climb
            dfoot = (-k * foot_z[i] - leg_stiffness * (foot_z[i] - free) + leg_damping * rate) / (ground_damping + leg_damping)
            inside = foot_z[i] < 0
            carried = np.where(inside, -k * foot_z[i] - ground_damping * dfoot, 0)
            pushes = carried > 0
            carried = np.where(pushes, carried, 0)
            dfoot = np.where(pushes, dfoot, rate - leg_stiffness / leg_damping * (foot_z[i] - free))
            if stands:
                if not stood[i]:
                    touched[i] = np.zeros(len(k), bool)
                    whole[i] = n > first
                touched[i] = touched[i] | inside
                if whole[i]:
                    if stood[i]:
                        losses = losses + (was_inside[i] & ~inside)
                    depth = depth - np.where(inside, foot_z[i], 0)
                    deep = deep + inside
            elif stood[i] and whole[i]:
                stances = stances + touched[i]
            stood[i], was_inside[i] = stands, inside
            foot_z[i] = foot_z[i] + TIME_STEP * dfoot
            up, nose, lean = up + carried, nose - carried * x, lean + carried * foot_y[i]
        dz = dz + TIME_STEP * up / MASS
        z = z + TIME_STEP * dz
        dpitch = dpitch + TIME_STEP * nose / PITCH_INERTIA
        pitch = pitch + TIME_STEP * dpitch
        droll = droll + TIME_STEP * lean / ROLL_INERTIA
        roll = roll + TIME_STEP * droll
        if n >= first:
            top, bottom = np.maximum(top, z), np.minimum(bottom, z)
        n += 1
    return losses / np.maximum(stances, 1), depth / np.maximum(deep, 1), top - bottom


def rows(cruse, stiffnesses):
    """Rows of predicted.csv for one gait."""
    for k, losses, depth, heave in zip(stiffnesses, *predict(cruse, stiffnesses)):
        yield f"{cruse:d},{k:g},{losses:.3g},{depth:.4g},{heave:.4g}"
