"""Random calls of the module with arguments that no author thought of: python random_calls.py SEED COUNT.

Every call returns or raises one of the exceptions that the module documents; whatever it did, a scene
that nobody touched then runs as it did before. A crash ends the program."""
import copy
import math
import os
import random
import re
import sys
import tempfile
import warnings

import numpy as np

import hookpoint

SCENE = "World w { gravity = 10; deltat = 1 ms; duration = 0.02 s; " \
    "Robot ball { Base.mobile { location = 0, 0, 1; mass = 2; Shape.Sphere radius = 0.1; } } Force push { body = ball.base; } }"

ALLOWED = (hookpoint.Error, TypeError, ValueError, KeyError, IndexError, AttributeError, OSError, OverflowError, BufferError, MemoryError)

NUMBERS = [0, 1, -1, 3, 0.5, -0.25, 1e-3, 1e-300, 1e300, -1e300, 2**31, 2**62, 2**63, 2**70, -2**70,
           math.nan, math.inf, -math.inf, True, False, 1 + 2j]
TEXTS = ["", " ", "x", "w", "ball", "ball.base", "ball.base.location", "ball.base.location.z", "push.force", "push.force.x", "time", "w.deltat",
         "a\0b", "\ud800", "é" * 5, "." * 40, "ball." * 30, "../..", "{}", "%s%n", SCENE, SCENE[:60], "World w { }", "1 ms", "nosuch.hook",
         "study", "dts", "ode", "bullet", "nan"]


def is_long(number):
    """A duration or a number of steps that would be simulated for hours."""
    most = {int: 2**63, float: 1e16}
    return type(number) in most and 100 < number < most[type(number)]


class Draw:
    def __init__(self, seed):
        self.random = random.Random(seed)

    def array(self):
        shape = self.random.choice([(), (0,), (1,), (3,), (2, 3), (3, 0), (1, 1, 1)])
        made = np.zeros(shape, self.random.choice(["f8", "f4", "i8", "u1", "?", "c16", "U3", "O"]))
        if made.dtype.kind in "fc" and made.size:
            made.flat[self.random.randrange(made.size)] = self.random.choice([0., 1., math.nan, math.inf, 1e300])
        return self.random.choice([made, made.T, made[::-1] if made.ndim else made])

    def value(self, depth=0):
        kind = self.random.randrange(9 if depth < 3 else 4)
        if kind == 0:
            return self.random.choice([None, None, Ellipsis, b"bytes", object(), len, hookpoint, range(3)])
        if kind == 1:
            return self.random.choice([number for number in NUMBERS if not is_long(number)])
        if kind in (2, 3):
            return self.random.choice(TEXTS)
        if kind == 4:
            return self.array()
        count = self.random.randrange(4)
        if kind == 5:
            return [self.value(depth + 1) for _ in range(count)]
        if kind == 6:
            return tuple(self.value(depth + 1) for _ in range(count))
        return {self.random.choice(TEXTS): self.value(depth + 1) for _ in range(count)}

    def arguments(self, call):
        """Of a callable: by place, or by the names that its signature says."""
        names = re.findall(r"(\w+): ", (call.__doc__ or "").split("\n")[0])
        named = [name for name in names if name != "self"]
        by_name = {name: self.value() for name in named if self.random.random() < 0.3}
        return [self.value() for _ in range(self.random.randrange(3))], by_name


def fresh(draw):
    make = draw.random.randrange(4)
    if make == 0:
        return hookpoint.loads(SCENE)
    if make == 1:
        return hookpoint.Batch(SCENE, draw.random.choice([1, 2]), observations=["ball.base.location"], actions=["push.force"])
    if make == 2:
        return hookpoint.loads(SCENE).dynamics()
    return hookpoint


def one_call(draw, target):
    """Says what it calls, so that the last line of a crash names it."""
    names = [name for name in dir(target) if not name.startswith("_") or name in ("__getitem__", "__setstate__", "__init__", "__copy__", "__eq__")]
    # A window waits for a reader, and a search runs for as long as its file says.
    name = draw.random.choice([name for name in names if name not in ("view", "study", "tune")])
    try:
        member = getattr(target, name)
        if callable(member):
            places, by_name = draw.arguments(member)
            print(getattr(type(target), "__name__", ""), name, ascii(places)[:300], ascii(by_name)[:300], flush=True)
            member(*places, **by_name)
        elif draw.random.random() < 0.5:
            setattr(target, name, draw.value())
        else:
            copy.deepcopy(member)
    except ALLOWED:
        pass


def broken_pickle(draw, target):
    """What unpickles a copy whose state somebody else wrote a part of."""
    try:
        state = list(target.__reduce_ex__(2)[2])
        place = draw.random.randrange(len(state))
        if isinstance(state[place], tuple) and draw.random.random() < 0.7:
            part = list(state[place])
            part[draw.random.randrange(len(part))] = draw.value()
            state[place] = tuple(part)
        else:
            state[place] = draw.value()
        state = state[:draw.random.choice([len(state), len(state), 1])]
        print("unpickle", type(target).__name__, ascii(state)[:300], flush=True)
        made = type(target).__new__(type(target))
        made.__setstate__(tuple(state))
        made.step()
    except ALLOWED:
        pass


def reference():
    with hookpoint.loads(SCENE) as world:
        world.run()
        return world.read("ball.base.location.z")


def main(seed, count):
    warnings.simplefilter("ignore")
    draw = Draw(seed)
    before = reference()
    target = fresh(draw)
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for _ in range(count):
            if draw.random.random() < 0.2:
                target = fresh(draw)
            if isinstance(target, (hookpoint.World, hookpoint.Batch)) and draw.random.random() < 0.1:
                broken_pickle(draw, target)
            else:
                one_call(draw, target)
        os.chdir("/")
    assert reference() == before
    print("done")


if __name__ == "__main__":
    main(int(sys.argv[1]), int(sys.argv[2]))
