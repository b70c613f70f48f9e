#!/usr/bin/env python3
"""What Python adds to a run, as ratios; needs `import hookpoint` and the program:

    PYTHONPATH=build/release/python python3 tests/bench/python_overhead.py build/release/cli/hookpoint

Steps of the walking hexapod driven from Python beside `hookpoint run` of the same steps, and a Batch beside separate worlds stepped one
after the other; first what worlds cost before their first step. Every ratio is of the medians of several rounds, whose sides are timed in turn: steps in processor time, which other
programs on the machine do not enter, a Batch by the clock.
"""
import argparse
import pathlib
import resource
import statistics
import subprocess
import sys
import tempfile
import time

import numpy as np

import hookpoint

SCENE = pathlib.Path(__file__).resolve().parents[2] / "configs" / "scenes" / "walking_hexapod.hook"


def processor_time():
    """Of this process and of the children that have ended [s]."""
    return sum(sum(resource.getrusage(who)[:2]) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))


def seconds(work, clock):
    start = clock()
    work()
    return clock() - start


def medians(rounds, clock, **sides):
    """Median times of the sides, each timed once a round."""
    taken = {name: [] for name in sides}
    for _ in range(rounds):
        for name, work in sides.items():
            taken[name].append(seconds(work, clock))
    return {name: statistics.median(times) for name, times in taken.items()}


def resident():
    """Memory of this process [MB]."""
    pages = int(pathlib.Path("/proc/self/statm").read_text().split()[1])
    return pages * resource.getpagesize() / 2**20


def step_loop(program, steps, rounds):
    world = hookpoint.load(SCENE)
    height, forward = world.view("hexapod.base.location.z"), world.view("world.gait.forward")

    def bare():
        world.reset()
        for _ in range(steps):
            world.step()

    def read_view():
        world.reset()
        sum = 0.
        for _ in range(steps):
            world.step()
            sum += height[()]

    def write_view():
        world.reset()
        for _ in range(steps):
            forward[()] = 0.1
            world.step()

    def read_by_name():
        world.reset()
        sum = 0.
        for _ in range(steps):
            world.step()
            sum += world["hexapod.base.location.z"]

    def one_call():
        world.reset()
        world.step(steps)

    def command(count):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([program, "run", SCENE, "--for", f"{count * 0.5:g} ms", "--out", folder], check=True, capture_output=True)

    taken = medians(rounds, processor_time, start=lambda: command(1), command=lambda: command(steps), one_call=one_call, bare=bare, read_view=read_view, write_view=write_view, read_by_name=read_by_name)
    told = taken.pop("command") - taken.pop("start")
    print(f"{steps} steps, hookpoint run: {1e6 * told / steps:.1f} us a step")
    for name, time_taken in taken.items():
        print(f"  {name:<14} {1e6 * time_taken / steps:6.1f} us a step, {time_taken / told:.3f} of the command's")


def batch(worlds, count, calls, threads, rounds):
    trails = ["hexapod.base.location", "hexapod.base.orientation"]
    separate = [hookpoint.load(SCENE) for _ in range(worlds)]
    views = [[world.view(trail) for trail in trails] for world in separate]
    many = hookpoint.Batch(SCENE, worlds, threads=threads, observations=trails, actions=["world.gait.forward"])
    actions = np.full((worlds, 1), 0.1)

    def one_after_the_other():
        for world in separate:
            world.reset()
        for _ in range(calls):
            for world, viewed in zip(separate, views):
                world.step(count)
                np.concatenate(viewed)

    def together():
        many.reset()
        for _ in range(calls):
            many.step(actions, count)

    taken = medians(rounds, time.perf_counter, separate=one_after_the_other, batch=together)
    steps = worlds * count * calls
    print(f"Batch of {worlds}, {threads} threads, {count} steps a call: {steps / taken['batch']:.0f} world steps a second, "
          f"{taken['separate'] / taken['batch']:.2f} times as fast as worlds one after the other")


def starts(worlds):
    """What a world costs before its first step, in processor time of one thread."""
    stiffness = np.linspace(2e3, 3e3, worlds)
    soils = [{"world.rigid_floor.normal_stiffness": k} for k in stiffness]
    others = [{"world.rigid_floor.normal_stiffness": 1.01 * k} for k in stiffness]
    heights = {"hexapod.base.location": np.column_stack([np.zeros((worlds, 2)), np.linspace(0.2, 0.3, worlds)])}
    made = {}

    def make(name, **how):
        made[name] = hookpoint.Batch(SCENE, worlds, threads=1, **how)

    for name, work in [("load", lambda: hookpoint.load(SCENE)),
                       ("same settings", lambda: make("same")),
                       ("settings of its own", lambda: make("own", set=soils)),
                       ("reset", lambda: made["same"].reset()),
                       ("reset to a state", lambda: made["same"].reset(state=heights)),
                       ("reset to settings", lambda: made["own"].reset(set=others))]:
        taken = 1e3 * seconds(work, processor_time) / (1 if name == "load" else worlds)
        print(f"  {name:<20} {taken:8.3f} ms{'' if name == 'load' else ' a world'}")


def memory(worlds):
    hookpoint.Batch(SCENE, 1)  # what every process has once
    before = resident()
    many = hookpoint.Batch(SCENE, worlds, observations=["hexapod.base.location"])
    print(f"Batch of {len(many)}: {(resident() - before) / worlds:.2f} MB a world")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", help="hookpoint")
    parser.add_argument("--steps", type=int, default=20000)
    parser.add_argument("--worlds", type=int, default=64)
    parser.add_argument("--threads", type=int, nargs="+", default=[1, 2])
    parser.add_argument("--rounds", type=int, default=5)
    arguments = parser.parse_args()
    memory(arguments.worlds)
    starts(10 * arguments.worlds)
    step_loop(arguments.program, arguments.steps, arguments.rounds)
    for threads in arguments.threads:
        for count in (1, 20):
            batch(arguments.worlds, count, max(1, 100 // count), threads, arguments.rounds)


if __name__ == "__main__":
    sys.exit(main())
