#!/usr/bin/env python3
"""Writes configs/data/drop.csv: a drop that nobody measured, for configs/tunings/floor_from_drop.hook.

    configs/data/make_drop.py > configs/data/drop.csv

The box of configs/scenes/dropped_box.hook, 1 kg on four corners, falls 50 mm onto a floor of Hunt & Crossley's law,
m z'' = -m g + 4 k d^n (1 + alpha d') with d = -(z - 50 mm) where that is > 0, integrated here by Runge and Kutta's method of fourth order in steps of
10 us; its height, read 200 times a second with errors of 0.5 mm (normal, seed 1) to a tenth of a millimetre.
"""

import random

MASS, GRAVITY, CORNERS, HALF_HEIGHT, FALL = 1.0, 9.81, 4, 0.05, 0.05
STIFFNESS, EXPONENT, HYSTERESIS = 200e3, 1.5, 0.5  # N/m^1.5, -, s/m
STEP, STEPS_A_SAMPLE, SAMPLES, NOISE = 1e-5, 500, 100, 0.5e-3


def acceleration(z, v):
    depth = HALF_HEIGHT - z
    if depth <= 0.0:
        return -GRAVITY
    force = STIFFNESS * depth**EXPONENT * (1.0 - HYSTERESIS * v)
    return CORNERS * max(0.0, force) / MASS - GRAVITY


def step(z, v):
    h = STEP
    a1 = acceleration(z, v)
    v2 = v + 0.5 * h * a1
    a2 = acceleration(z + 0.5 * h * v, v2)
    v3 = v + 0.5 * h * a2
    a3 = acceleration(z + 0.5 * h * v2, v3)
    v4 = v + h * a3
    a4 = acceleration(z + h * v3, v4)
    return z + h / 6.0 * (v + 2.0 * v2 + 2.0 * v3 + v4), v + h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4)


def main():
    noise = random.Random(1)
    z, v = HALF_HEIGHT + FALL, 0.0
    print("time [s],z [m]")
    for sample in range(SAMPLES + 1):
        print(f"{sample * STEPS_A_SAMPLE * STEP:.3f},{z + noise.gauss(0.0, NOISE):.4f}")
        for _ in range(STEPS_A_SAMPLE):
            z, v = step(z, v)


main()
