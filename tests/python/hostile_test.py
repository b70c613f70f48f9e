"""What must not bring the interpreter down: memory, threads, the end of the process, absurd numbers."""
import gc
import itertools
import os
import random
import subprocess
import sys
import textwrap
import threading
import time
import unittest
import warnings

import numpy as np

import hookpoint

FALLING = "World w { gravity = 10; deltat = 1 ms; duration = 0.5 s; " \
    "Robot ball { Base.mobile { location = 0, 0, 1; mass = 2; Shape.Sphere radius = 0.1; } } Force push { body = ball.base; } }"

WHEEL = "World w { gravity = 0; deltat = 1 ms; duration = 10 s; Robot wheel { Base.fixed; " \
    "Chain axle { Link disc { mass = 2; inertia = 1, 1, 0.25, 0, 0, 0; } } } }"


def run_python(program, limit=None):
    """A program of its own: (status, stdout, stderr). `limit`: of its address space [bytes]."""
    command = [sys.executable, "-c", textwrap.dedent(program)]
    if limit:
        command = ["/bin/sh", "-c", f"ulimit -v {limit // 1024}; exec \"$0\" \"$@\"", *command]
    done = subprocess.run(command, capture_output=True, text=True, timeout=300, env={**os.environ, "SCENE": FALLING})
    return done.returncode, done.stdout, done.stderr


class Arrays(unittest.TestCase):
    def setUp(self):
        self.batch = hookpoint.Batch(FALLING, 64, observations=["ball.base.location"], actions=["push.force"])

    def test_numpy_can_neither_resize_nor_unlock_them(self):
        batch = self.batch
        for array in (batch.observations, batch.actions, batch.done):
            self.assertFalse(array.flags.owndata)
            with self.assertRaisesRegex(ValueError, "does not own"):
                array.resize((1, 1), refcheck=False)
        for array in (batch.observations, batch.done):
            with self.assertRaises(ValueError):
                array.setflags(write=True)
        # Another memory for the array of Python is none for the worlds.
        first = batch.observations.copy()
        batch.observations.__setstate__((1, (1,), np.dtype("f8"), False, b"12345678"))
        batch.actions.__setstate__((1, (1,), np.dtype("f8"), False, b"12345678"))
        junk = [np.zeros(256) for _ in range(200)]
        for _ in range(30):
            batch.step()
        self.assertEqual(sum(each.sum() for each in junk), 0.)
        self.assertEqual((len(first), batch.time[63]), (64, 0.03))

    def test_they_outlive_their_batch(self):
        observed, actions, done = self.batch.observations, self.batch.actions, self.batch.done
        before = observed.copy()
        del self.batch
        gc.collect()
        junk = [np.ones(192) for _ in range(200)]
        np.testing.assert_array_equal(observed, before)
        actions[:] = 3.
        self.assertEqual((done.sum(), actions.sum(), len(junk)), (0, 3 * 64 * 3, 200))


class RandomCalls(unittest.TestCase):
    def test_whatever_is_called_is_done_or_refused(self):
        program = os.path.join(os.path.dirname(os.path.abspath(__file__)), "random_calls.py")
        for seed in range(4):
            done = subprocess.run([sys.executable, program, str(seed), "500"], capture_output=True, text=True, timeout=300)
            last = "\n".join(done.stdout.splitlines()[-2:])
            self.assertEqual((done.returncode, last.endswith("done")), (0, True), f"seed {seed}: {last}\n{done.stderr[-2000:]}")


class Bare(unittest.TestCase):
    def test_an_object_that_was_never_made_refuses_everything(self):
        dynamics = hookpoint.loads(FALLING).dynamics()
        batch = hookpoint.Batch(FALLING, 1)
        for made in (hookpoint.loads(FALLING), batch, dynamics):
            kind = type(made)
            bare = kind.__new__(kind)
            for name in (name for name in dir(kind) if not name.startswith("__") or name in ("__repr__", "__len__", "__getitem__")):
                with self.subTest(f"{kind.__name__}.{name}"), self.assertRaises(TypeError):
                    member = getattr(bare, name)
                    member(*arguments_of(name))
            with self.assertRaises(TypeError):
                next(iter([value.fget for value in vars(kind).values() if isinstance(value, property)]))(bare)
            del bare
            gc.collect()

    def test_as_an_argument_too(self):
        class Mine(hookpoint.Batch):
            def __init__(self):
                pass

        with self.assertRaises(TypeError):
            Mine()
        with self.assertRaises(TypeError):
            hookpoint.World.step(hookpoint.World.__new__(hookpoint.World), 3)
        with self.assertRaises(TypeError):
            hookpoint.World()


def arguments_of(name):
    return {"view": ("x",), "read": ("x",), "write": ("x", 1.), "__getitem__": ("x",), "set_state": (b"",), "jacobian": ("base",)}.get(name, ())


class End(unittest.TestCase):
    PROGRAM = """
        import os, threading, time, hookpoint
        text = os.environ["SCENE"]
        class Slow:
            def __del__(self):
                time.sleep(0.3)
        slow = Slow()
        world = hookpoint.loads(text)
        batch = hookpoint.Batch(text, 4, threads=2)
        def work():
            {work}
        for _ in range({threads}):
            threading.Thread(target=work, daemon=True).start()
        time.sleep(0.1)
        {last}
    """

    def check(self, work, threads=1, last="print('last')"):
        for _ in range(3):
            status, out, err = run_python(self.PROGRAM.format(work=work, threads=threads, last=last))
            self.assertEqual((status, out, err), (0, "last\n", ""), work)

    def test_a_thread_that_steps_with_a_callback_does_not_abort_it(self):
        self.check("world.step(10**9, callback=lambda each: None)")
        self.check("world.step(10**9, callback=lambda each: [i * i for i in range(1000)] and None, every=3)")

    def test_threads_that_run_without_one_do_not_either(self):
        self.check("world.run(1e6)")
        self.check("batch.step(count=10**9)")
        self.check("hookpoint.loads(text).step(10**9, callback=lambda each: time.sleep(0))", threads=8)
        self.check("hookpoint.Batch(text, 3).step(count=10**9)", threads=3)

    def test_the_thread_that_ends_it_can_still_step(self):
        self.check("pass", last="import atexit; atexit.register(lambda: (world.step(10), batch.step(), print('last')))")

    def test_a_child_process_ends_while_its_parent_steps(self):
        status, out, _ = run_python("""
            import os, threading, warnings, hookpoint
            warnings.simplefilter("ignore")
            text = os.environ["SCENE"]
            for _ in range(4):
                threading.Thread(target=hookpoint.loads(text).step, args=(10**9,), kwargs={"callback": lambda each: None}, daemon=True).start()
            for _ in range(20):
                child = os.fork()
                if child == 0:
                    world = hookpoint.loads(text)
                    world.step(3)
                    raise SystemExit(7)
                assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 7
            print("last")
        """)
        self.assertEqual((status, out), (0, "last\n"))


class Threads(unittest.TestCase):
    def test_one_thread_at_a_time_steps_a_world(self):
        for make in (lambda: hookpoint.loads(FALLING), lambda: hookpoint.Batch(FALLING, 2)):
            made, stop, refused = make(), threading.Event(), []

            def disturb(made=made, stop=stop, refused=refused):
                while not stop.is_set():
                    for ask in (made.reset, lambda: made.step(1) if isinstance(made, hookpoint.World) else made.step(None, 1)):
                        try:
                            ask()
                        except hookpoint.Error as error:
                            refused.append(str(error))
                        time.sleep(1e-3)

            thread = threading.Thread(target=disturb)
            thread.start()
            done = 0
            while done < 20:
                try:
                    made.step(2000) if isinstance(made, hookpoint.World) else made.step(None, 2000)
                    done += 1
                except hookpoint.Error as error:
                    refused.append(str(error))
            stop.set()
            thread.join()
            self.assertTrue(all("it is being stepped" in text for text in refused))


class Numbers(unittest.TestCase):
    def test_what_is_written_to_a_view_is_named(self):
        world = hookpoint.loads(FALLING)
        force = world.view("push.force")
        for wrong in (np.nan, np.inf):
            force[1] = wrong
            with self.assertRaises(hookpoint.RunError) as caught:
                world.step()
            self.assertEqual(caught.exception.body, "w.push.force.y")
            self.assertIn("takes a finite number", caught.exception.advice)
            self.assertNotIn("deltat", str(caught.exception))
            with self.assertRaisesRegex(hookpoint.RunError, "w.push.force.y"):
                world.run(0.1)
        force[1] = 2.
        world.step()
        self.assertAlmostEqual(world["ball.base.velocity.y"], 1e-3, places=15)

    def test_counts_have_bounds(self):
        for worlds in (0, -1, 10**6, 10**9, 2**63 - 1):
            with self.assertRaisesRegex(hookpoint.Error, "1 to 100000 worlds, not"):
                hookpoint.Batch(FALLING, worlds)
        for threads in (-1, 10**5, 10**6, 10**9):
            with self.assertRaisesRegex(hookpoint.Error, "`threads` is a number of threads from 0"):
                hookpoint.Batch(FALLING, 2, threads=threads)
            for ask in (hookpoint.study, hookpoint.tune):
                with self.assertRaisesRegex(hookpoint.Error, "`jobs` is a number of threads from 0"):
                    ask("nowhere.hook", jobs=threads)
        # No more threads than worlds.
        self.assertEqual(hookpoint.Batch(FALLING, 2, threads=9999).threads, 2)
        for wrong in (2**63, 1.5, "2", None):
            with self.assertRaises(TypeError):
                hookpoint.Batch(FALLING, wrong)

    def test_memory_that_is_not_there_is_said(self):
        # What Python, numpy and the module take by themselves.
        peak = run_python("""
            import hookpoint, re
            print(re.search(r"VmPeak:\\s+([0-9]+) kB", open("/proc/self/status").read())[1])
        """)[1]
        for more in (300_000_000, 550_000_000):
            limit = 1024 * int(peak) + more
            status, out, err = run_python("""
                import os, hookpoint
                try:
                    hookpoint.Batch(os.environ["SCENE"], 100000, threads=2)
                except hookpoint.Error as error:
                    print(error)
            """, limit=limit)
            self.assertEqual((status, err), (0, ""))
            self.assertRegex(out, "100000 worlds need about .* GB of memory, .*: make a Batch of fewer")


class Types(unittest.TestCase):
    def test_wrong_types_are_type_errors_in_words(self):
        endless = []
        endless.append(endless)
        for wrong in ({5: 5}, {None: 1}, [1], "w.seed=3", 7, {"w.seed": None}, {"w.seed": object()}, {"w.seed": b"3"}, {"w.gravity": endless},
                      {"w.gravity": [[[[[[1]]]]]]}):
            with self.subTest(wrong), self.assertRaises(TypeError) as caught:
                hookpoint.loads(FALLING, set=wrong)
            self.assertNotRegex(str(caught.exception), "C\\+\\+|PYBIND")
        for wrong in ({"w.seed": "\ud800"}, {"\ud800": 1}):
            with self.subTest(ascii(wrong)), self.assertRaises(ValueError):
                hookpoint.loads(FALLING, set=wrong)
        for wrong in (5, None, [5], [None], b"ball", [["ball"]]):
            with self.subTest(wrong), self.assertRaisesRegex(TypeError, "`record` takes a name"):
                hookpoint.loads(FALLING).run(record=wrong)
            with self.subTest(wrong), self.assertRaisesRegex(TypeError, "`observations` takes a name"):
                hookpoint.Batch(FALLING, 1, observations=wrong)
            with self.subTest(wrong), self.assertRaisesRegex(TypeError, "`only` takes a name"):
                hookpoint.study("nowhere.hook", only=wrong)
        for wrong in (5, [("a", 1)], {5: 1}):
            with self.subTest(wrong), self.assertRaisesRegex(TypeError, "state"):
                hookpoint.loads(FALLING).reset(state=wrong)

    def test_scalars_of_numpy_are_numbers(self):
        world = hookpoint.loads(FALLING, set={"w.seed": np.int64(7), "w.deltat": np.float64(2e-3), "w.gravity": np.array([0, 0, -5])})
        self.assertEqual(world.deltat, 2e-3)
        self.assertIn("seed = 7;", world.text)
        self.assertEqual(hookpoint.loads(FALLING, set={"w.duration": np.array(2.)}).duration, 2.)


VALUES = [None, True, 0, -1, 3, 2**70, 1.5, float("nan"), float("inf"), -0.0, "", "x", "ball.base.location", "push.force", "w.time", "\0", "é" * 9,
          b"", [], [1, 2, 3], [[1, 2, 3], [4, 5, 6]], [float("nan")] * 3, (0, 0, 0, 0), {}, {"ball.base.location": [0, 0, 2]}, {"x": 1}, {3: 4},
          {"ball.base.orientation": [0, 0, 0, 0]}, {"ball.base.velocity": [[1, 2, 3], [4, 5, 6]]}, {"ball.base.location": float("inf")},
          np.zeros((2, 3)), np.zeros(0), np.ones(2, bool), np.array("x"), np.array([1 + 2j]), np.zeros((1, 1, 1, 1)), object(), len, range(3),
          [{"w.gravity": 5}, {"w.gravity": 6}], [{}, {}], [{}], [1, 2], [2**64, 1]]


class Fuzz(unittest.TestCase):
    """Arguments at random, of every method: an exception or none, and the object still works."""

    def arguments(self, draw):
        names = ["state", "mask", "set", "seeds", "record", "every", "callback", "count", "duration", "trail", "value", "actions"]
        return [draw.choice(VALUES) for _ in range(draw.randrange(3))], \
            {draw.choice(names): draw.choice(VALUES) for _ in range(draw.randrange(3))}

    def disturb(self, made, names, draw, rounds):
        for _ in range(rounds):
            plain, named = self.arguments(draw)
            name = draw.choice(names)
            # Long runs are no finding.
            if any(isinstance(value, int) and value > 100 for value in [*plain, *named.values()]):
                continue
            try:
                getattr(made, name)(*plain, **named)
            except Exception as error:
                self.assertNotRegex(str(error), r"std::|bad_alloc|vector::|PYBIND|#define", (name, plain, named))

    def test_a_world_survives_arguments_at_random(self):
        draw = random.Random(1)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            for engine in ("dts", "ode"):
                world = hookpoint.loads(FALLING, engine=engine)
                self.disturb(world, ["step", "run", "reset", "state", "set_state", "copy", "view", "read", "write", "__getitem__", "__setitem__",
                                     "ports", "dynamics", "__repr__"], draw, 4000)
                world.reset()
                world.step(10)
                # Semi-implicit Euler: 1 - g dt^2 n (n + 1) / 2.
                self.assertAlmostEqual(world["ball.base.location.z"], 1 - 10e-6 * 55, places=9)

    def test_a_batch_survives_arguments_at_random(self):
        draw = random.Random(2)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            batch = hookpoint.Batch(FALLING, 2, observations="ball.base.location", actions="push.force", threads=2)
            self.disturb(batch, ["step", "reset", "state", "set_state", "__len__", "__repr__"], draw, 1500)
            batch.reset(set={"w.gravity": 10})
            batch.actions[:] = 0.
            observed, _ = batch.step(count=10)
            np.testing.assert_allclose(observed[:, 2], 1 - 10e-6 * 55, atol=1e-12)

    def test_constructors_survive_arguments_at_random(self):
        draw = random.Random(3)
        names = ["threads", "seeds", "observations", "actions", "done", "set", "engine", "allow_plugins", "allow_engines"]
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            for _ in range(400):
                named = {draw.choice(names): draw.choice(VALUES) for _ in range(draw.randrange(3))}
                try:
                    hookpoint.Batch(FALLING, 2, **named).step()
                except Exception as error:
                    self.assertNotRegex(str(error), r"std::|bad_alloc|vector::|#define", named)
            for value, ask in itertools.product(VALUES, (hookpoint.load, hookpoint.loads, hookpoint.study, hookpoint.tune)):
                try:
                    ask(value)
                except Exception as error:
                    self.assertNotRegex(str(error), r"std::|bad_alloc|vector::|#define", value)


if __name__ == "__main__":
    unittest.main()
