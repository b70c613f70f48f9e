#!/usr/bin/env python3
"""An engine of balls that turn, which does as its first argument says: honest, or what an engine may do wrong."""
import os
import signal
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "examples/engines"))
sys.dont_write_bytecode = True
import particle  # noqa: E402

lie, at = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 0
translate, send = particle.step, particle.write
steps = 0
particle.HELLO["name"] = "ball"
particle.HELLO["gaps"] = [gap for gap in particle.HELLO["gaps"] if gap["feature"] != "rotation"]
if lie == "unknown_gap":
    particle.HELLO["gaps"].append({"feature": "warp drives", "handling": "refused", "instead": "none"})
if lie == "starts":
    with open(sys.argv[3], "a", encoding="utf-8") as starts:
        starts.write("started\n")


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def times(p, q):
    w, x, y, z = p
    a, b, c, d = q
    return [w * a - x * b - y * c - z * d, w * b + x * a + y * d - z * c, w * c - x * d + y * a + z * b, w * d + x * c - y * b + z * a]


def turn(body, loads, i, dt):
    q = body["orientation"]
    torque = [0, 0, 0]
    for load in loads:
        if load[0] == i:
            arm = times(times(q, [0, *load[1:4]]), [q[0], -q[1], -q[2], -q[3]])[1:]
            torque = [t + a + b for t, a, b in zip(torque, load[7:10], cross(arm, load[4:7]))]
    spin = body["angular_velocity"] = [w + dt * t / body["inertia"][0] for w, t in zip(body["angular_velocity"], torque)]
    rate = [w * (0.017453292519943295 if lie == "degrees" else 1) for w in spin]
    if lie == "order":
        q = [q[3], *q[:3]]
    half = times([0, *rate], q)
    q = [a + 0.5 * dt * b for a, b in zip(q, half)]
    norm = particle.math.sqrt(sum(x * x for x in q))
    q = [x / norm for x in q]
    body["orientation"] = [*q[1:], q[0]] if lie == "order" else q


def step(scene, bodies, loads):
    global steps
    steps += 1
    if steps == at:
        misbehave()
    contacts = translate(scene, bodies, loads)
    for i, body in enumerate(bodies):
        turn(body, loads, i, scene["deltat"])
    if lie == "nan" and steps >= at:
        bodies[0]["velocity"] = [float("nan")] * 3
    if lie == "forces":
        contacts = [x / 2 if k % 9 in (5, 6, 7) else x for k, x in enumerate(contacts)]
    return contacts


def misbehave():
    if lie == "talk":
        print("the ball is warm", file=sys.stderr, flush=True)
    if lie == "crash":
        print("first words\nno more balls", file=sys.stderr, flush=True)
        os._exit(3)
    if lie == "kill":
        os.kill(os.getpid(), signal.SIGKILL)
    if lie == "kill_once" and os.path.exists(sys.argv[3]):
        os.remove(sys.argv[3])
        os.kill(os.getpid(), signal.SIGKILL)
    if lie == "hang":
        time.sleep(1000)
    if lie == "print":
        os.write(1, b"Loading the ball, please wait\n")
    if lie == "fail":
        send({"type": "failed", "reason": "the ball is lost"})
        raise SystemExit(0)


def write(message):
    if lie == "short" and not isinstance(message, dict) and steps >= at:
        message = message[:-3]
    send(message)


def read():
    message = take()
    if lie == "exchanges" and isinstance(message, tuple):
        with open(sys.argv[3], "a", encoding="utf-8") as exchanges:
            exchanges.write(f"{int(message[0])}\n")
    return message


take = particle.read
particle.step, particle.write, particle.read = step, write, read
particle.main()
