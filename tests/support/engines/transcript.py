#!/usr/bin/env python3
"""transcript.py FILE [any]: particle.py, which writes each frame of the protocol to FILE. `any`: it declares no gap, so that every experiment reaches it."""
import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "examples/engines"))
sys.dont_write_bytecode = True
import particle  # noqa: E402

take, give = particle.read, particle.write
if sys.argv[2:] == ["any"]:
    particle.HELLO["gaps"] = []


def text(message):
    if isinstance(message, dict):
        return "J " + json.dumps(message)
    return "D " + " ".join(f"{number:.10g}" for number in message)


def log(mark, message):
    with open(sys.argv[1], "a", encoding="utf-8") as transcript:
        transcript.write(f"{mark} {text(message)}\n")
    return message


particle.read = lambda: log(">", take())
particle.write = lambda message: give(log("<", message))
particle.main()
