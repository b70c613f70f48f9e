#!/usr/bin/env python3
"""An engine in sixty lines: balls on planes, on springs with dampers. They do not turn."""
import json
import math
import struct
import sys

HELLO = {"type": "hello", "protocol": 1, "name": "particle", "version": "1", "precision": "double",
         "settings": [{"name": "default", "source": "this file: penalty springs, semi-implicit Euler"}],
         "gaps": [{"feature": "robots with chains", "handling": "refused", "instead": "balls have no joints"},
                  {"feature": "height fields", "handling": "refused", "instead": "balls meet planes only"},
                  {"feature": "obstacles", "handling": "refused", "instead": "balls meet planes only"},
                  {"feature": "static friction that differs from kinetic", "handling": "noticed", "instead": "the kinetic one"},
                  {"feature": "rotation", "handling": "stated", "instead": "balls do not turn"}]}


def read():
    head = sys.stdin.buffer.read(5)
    if len(head) < 5:
        sys.exit()
    length, kind = struct.unpack("<Ic", head)
    payload = sys.stdin.buffer.read(length)
    return json.loads(payload) if kind == b"J" else struct.unpack(f"<{length // 8}d", payload)


def write(message):
    is_json = isinstance(message, dict)
    payload = json.dumps(message).encode() if is_json else struct.pack(f"<{len(message)}d", *message)
    sys.stdout.buffer.write(struct.pack("<Ic", len(payload), b"J" if is_json else b"D") + payload)
    sys.stdout.buffer.flush()


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def contact(plane, material, center, radius, velocity):
    """Force of a plane on a ball: spring and damper, and a damper along the plane within Coulomb's cone."""
    normal = plane["normal"]
    depth, rate = plane["offset"] + radius - dot(normal, center), -dot(normal, velocity)
    load = max(0, material["normal_stiffness"] * depth + material["normal_damping"] * rate) if depth > 0 else 0
    slip = [v + rate * n for v, n in zip(velocity, normal)]
    speed = math.sqrt(dot(slip, slip))
    damping = min(material["tangential_damping"], material["kinetic_friction"] * load / speed if speed > 0 else 0)
    return [load * n - damping * s for n, s in zip(normal, slip)] if load > 0 else None, depth


def step(scene, bodies, loads):
    """Takes the bodies over one step, and returns its contacts."""
    contacts = []
    constants = {(pair["foot"], pair["ground"]): pair for pair in scene["contacts"]}
    for i, body in enumerate(bodies):
        force = [body["mass"] * g for g in scene["gravity"]]
        for load in loads:
            force = [f + g for f, g in zip(force, load[4:7])] if load[0] == i else force
        for j, ball in enumerate(body["colliders"]):
            center = [p + q for p, q in zip(body["position"], ball["position"])]
            for plane in scene["ground"]:
                on_ball, depth = contact(plane, constants[ball["material"], plane["material"]], center, ball["radius"], body["velocity"])
                if on_ball:
                    force = [f + g for f, g in zip(force, on_ball)]
                    contacts += [i, j, *(c - ball["radius"] * n for c, n in zip(center, plane["normal"])), *on_ball, depth]
        if body["mobile"]:
            body["velocity"] = [v + scene["deltat"] * f / body["mass"] for v, f in zip(body["velocity"], force)]
            body["position"] = [p + scene["deltat"] * v for p, v in zip(body["position"], body["velocity"])]
    return contacts


def main():
    scene = bodies = None
    while True:
        message = read()
        if isinstance(message, tuple):
            states = []
            for _ in range(int(message[0])):
                contacts = step(scene, bodies, [message[k:k + 10] for k in range(1, len(message), 10)])
                for body in bodies:
                    states += [*body["position"], *body["orientation"], *body["velocity"], *body["angular_velocity"]]
                states += [len(contacts) // 9, *contacts]
            write(states)
        elif message["type"] == "hello":
            write(HELLO)
        else:  # an experiment, or the same again after a reset
            scene = message if message["type"] == "experiment" else scene
            bodies = [dict(body) for body in scene["bodies"]]
            strange = {c["type"] for b in bodies for c in b["colliders"]} - {"sphere", "point"}
            known = scene["settings"] in [setting["name"] for setting in HELLO["settings"]]
            reason = f"balls only, no {', '.join(strange)}" if strange else "" if known else "no such settings"
            write({"type": "refused", "reason": reason} if reason else {"type": "ready"})


if __name__ == "__main__":
    main()
