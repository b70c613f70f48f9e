"""import hookpoint: closed forms, the command's own bytes, and what is refused."""
import copy
import csv
import gc
import json
import multiprocessing
import os
import pathlib
import pickle
import re
import signal
import subprocess
import sys
import tempfile
import threading
import time
import types
import unittest
import unittest.mock
import warnings

import numpy as np

import hookpoint

SOURCE = pathlib.Path(os.environ["HOOKPOINT_SOURCE_DIR"])
PROGRAM = os.environ["HOOKPOINT_PROGRAM"]
CONFIGS = SOURCE / "configs"

FALLING = """Param height = 1 m;
World w {
  gravity = 10; deltat = 1 ms; duration = 0.5 s;
  Robot ball { Base.mobile { location = 0, 0, height; mass = 2; Shape.Sphere radius = 0.1; } }
}
"""

WHEEL = """World w {
  gravity = 0; deltat = 1 ms; duration = 10 s;
  Robot wheel {
    Base.fixed;
    Chain axle { Link disc { mass = 2; inertia = 1, 1, 0.25, 0, 0, 0; } }
  }
}
"""

STIFF = """World w {
  gravity = 0; deltat = 1 ms; duration = 10 s; integrator = explicit_euler;
  Robot wheel {
    Base.fixed;
    Chain axle { Link disc { mass = 2; inertia = 1, 1, 0.25, 0, 0, 0; angle = 1; stiffness = 1e9; } }
  }
}
"""


def stepped_by_100(world):
    world.step(100)
    return world


def interrupt_once(holds):
    """Ctrl-C, from another thread, soon after `holds` returns true."""
    def wait_and_interrupt():
        while not holds():
            time.sleep(0.001)
        for _ in range(100):
            time.sleep(0)
        os.kill(os.getpid(), signal.SIGINT)

    threading.Thread(target=wait_and_interrupt, daemon=True).start()


def read_csv(path):
    return list(csv.reader(path.read_text().splitlines()))

# A record of every format and two movies, of a ball that falls onto a slope and slides.
LOGGED = """World w {
  deltat = 1 ms; duration = 0.3 s;
  Material clay { normal_stiffness = 1e5; normal_damping = 100; }
  Terrain.Slope hill { angle = 20 deg; size = 4; material = clay; }
  Robot ball { Base.mobile { location = 0, 0, 0.12; mass = 2; Shape.Sphere radius = 0.1; } }
  Record fall { trails = ball.base.velocity, time; rate = 50 Hz; }
  Record spots { trails = ball.base.location; format = wl; }
  Record table { trails = ball.base.location.z; format = mat5; rate = 300 Hz; }
  Record deep { trails = ball.base.contact.force; format = hdf5; }
  Record lanes { trails = ball.base.contact.force.z; format = mcap; }
  Movie film { rate = 100 Hz; }
}
"""


def files_of(folder):
    """Every file of a folder of results; of its list of files what does not tell which program it was, or where its text stood."""
    files = {str(file.relative_to(folder)): file.read_bytes()
             for file in sorted(pathlib.Path(folder).rglob("*")) if file.is_file()}
    for name in files:
        if pathlib.PurePath(name).name == "files.json":
            told = json.loads(files[name])
            files[name] = {key: told.get(key) for key in ("experiment", "hookpoint", "engine", "files")}
    return files


class World(unittest.TestCase):
    def test_falls_as_its_integrator_must(self):
        world = hookpoint.loads(FALLING)
        self.assertEqual((world.name, world.engine, world.time, world.steps), ("w", "dts", 0.0, 0))
        trace = world.run(record=["w.ball.base.location.z", "ball.base.velocity.z"])
        self.assertEqual(list(trace), ["time", "w.ball.base.location.z", "ball.base.velocity.z"])
        n = np.arange(501)
        self.assertEqual(trace["time"].dtype, np.float64)
        np.testing.assert_allclose(trace["time"], n * 1e-3, atol=1e-12)
        np.testing.assert_allclose(trace["ball.base.velocity.z"], -10 * n * 1e-3, atol=1e-12)
        # Semi-implicit Euler: the velocity first, then the position by the new one.
        np.testing.assert_allclose(trace["w.ball.base.location.z"], 1 - 10e-6 * n * (n + 1) / 2, atol=1e-12)
        self.assertEqual(world.steps, 500)
        self.assertIs(world.recorded["time"], trace["time"])

    def test_goes_on_where_it_was_and_thins_its_rows(self):
        world = hookpoint.loads(FALLING)
        world.step(3)
        self.assertAlmostEqual(world.time, 0.003)
        trace = world.run(0.02, record=["ball.base.velocity.z"], every=5)
        np.testing.assert_allclose(trace["time"], [0.003, 0.008, 0.013, 0.018, 0.023], atol=1e-12)
        np.testing.assert_allclose(trace["ball.base.velocity.z"], -10 * trace["time"], atol=1e-12)
        self.assertEqual(len(world.run(0.0)["time"]), 1)

    def test_a_written_torque_turns_the_wheel(self):
        world = hookpoint.loads(WHEEL)
        world["w.wheel.axle.disc.torque"] = 0.5
        world.step(1000)
        self.assertAlmostEqual(world["wheel.axle.disc.rate"], 0.5 / 0.25 * 1.0, places=12)
        world.write("wheel.axle.disc.torque", 0)
        world.step(1000)
        self.assertAlmostEqual(world.read("wheel.axle.disc.rate"), 2.0, places=12)

    def test_only_inputs_that_no_wire_drives_can_be_written(self):
        world = hookpoint.loads(WHEEL)
        with self.assertRaisesRegex(hookpoint.Error, "can be read, not written"):
            world["wheel.axle.disc.rate"] = 1
        with self.assertRaisesRegex(hookpoint.Error, "did you mean|nearest|torque"):
            world["wheel.axle.disc.torqe"] = 1
        with self.assertRaisesRegex(hookpoint.Error, "finite"):
            world["wheel.axle.disc.torque"] = float("nan")
        wired = hookpoint.loads(WHEEL + "Signal.Step push { Wire TO w.wheel.axle.disc.torque; }")
        with self.assertRaisesRegex(hookpoint.Error, "driven by a wire from `push"):
            wired["w.wheel.axle.disc.torque"] = 1
        self.assertIn(("w.wheel.axle.disc.torque", "N.m", True), world.ports())
        self.assertIn(("w.wheel.axle.disc.rate", "rad/s", False), world.ports())

    def test_settings_are_text_numbers_or_lists(self):
        world = hookpoint.loads(
            FALLING,
            set={"height": "25 cm", "w.gravity": (0, 0, -5), "w.deltat": 2e-3, "w.seed": 7,
                 "w.ball.base.velocity": np.array([1.5, 0, 0])})
        self.assertEqual(world["ball.base.location.z"], 0.25)
        self.assertEqual(world.deltat, 2e-3)
        world.step()
        self.assertAlmostEqual(world["ball.base.velocity.z"], -0.01, places=15)
        self.assertEqual(world["ball.base.velocity.x"], 1.5)
        self.assertIn("seed = 7;", world.text)

    def test_another_engine_runs_the_same_file(self):
        for engine in ("ode", "bullet"):
            world = hookpoint.loads(FALLING, engine=engine)
            self.assertEqual(world.engine, engine)
            world.run(0.1)
            self.assertAlmostEqual(world["ball.base.velocity.z"], -1.0, places=3)

    def test_wrong_files_say_where(self):
        with self.assertRaises(hookpoint.FileError) as caught:
            hookpoint.loads("World w {\n  deltat = 3 kg;\n  gravty = 9.81;\n}", name="bad.hook")
        self.assertIn("bad.hook:2:12: error:", str(caught.exception))
        first, second = caught.exception.diagnostics
        self.assertEqual((first["severity"], first["file"], first["line"], first["column"]), ("error", "bad.hook", 2, 12))
        self.assertIn("did you mean `gravity`", second["message"])
        self.assertTrue(issubclass(hookpoint.FileError, hookpoint.Error))
        with self.assertRaisesRegex(hookpoint.FileError, "no such file"):
            hookpoint.load("nowhere.hook")
        with self.assertRaisesRegex(hookpoint.FileError, "no Param `hight`"):
            hookpoint.loads(FALLING, set={"hight": 3})

    def test_a_run_that_diverges_keeps_what_it_recorded(self):
        world = hookpoint.loads(STIFF)
        with self.assertRaises(hookpoint.RunError) as caught:
            world.run(record=["wheel.axle.disc.angle"])
        self.assertGreater(caught.exception.time, 0.05)
        self.assertIn("wheel", caught.exception.body)
        angles = world.recorded["wheel.axle.disc.angle"]
        self.assertGreater(len(angles), 50)
        # Explicit Euler of a spring: a complex eigenvalue 1 + i omega dt.
        self.assertAlmostEqual(angles[2], (1 + 1j * np.sqrt(1e9 / 0.25) * 1e-3).__pow__(2).real)

    def test_ctrl_c_stops_a_run_and_keeps_what_it_recorded(self):
        world = hookpoint.loads(FALLING)
        handler = signal.getsignal(signal.SIGINT)
        interrupt_once(lambda: world.time > 0)
        with self.assertRaises(KeyboardInterrupt):
            world.run(1e6, record=["w.time"])
        self.assertEqual(world.recorded["w.time"][-1], world.recorded["time"][-1])
        self.assertAlmostEqual(world.time, world.recorded["time"][-1])
        self.assertIs(signal.getsignal(signal.SIGINT), handler)

    def test_other_threads_run_meanwhile(self):
        # Nothing but the other thread ends these steps.
        world = hookpoint.loads(FALLING)
        began = threading.Event()
        interrupt_once(began.is_set)
        with self.assertRaises(KeyboardInterrupt):
            began.set()
            world.step(10**12)

    def test_gives_the_bytes_of_the_command(self):
        scene = CONFIGS / "scenes" / "sloped_block.hook"
        trails = ["world.block.base.location.x", "world.block.base.contact.force.z"]
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([PROGRAM, "run", scene, "--set", "slope=15 deg", "--for", "0.2 s", "--out", folder,
                            "--record", ",".join(trails)], check=True, capture_output=True)
            rows = read_csv(pathlib.Path(folder) / "trace.csv")
        trace = hookpoint.load(scene, set={"slope": "15 deg"}).run(0.2, record=trails)
        table = np.array(rows[1:], dtype=float)
        for column, values in enumerate(trace.values()):
            np.testing.assert_array_equal(table[:, column], values)

    def test_leaves_the_files_of_the_command(self):
        trails = ["w.ball.base.location.x", "w.time"]
        for duration, wanted in ((None, []), (0.2, ["--for", "0.2 s"])):
            with tempfile.TemporaryDirectory() as folder:
                place = pathlib.Path(folder)
                scene = place / "scene.hook"
                scene.write_text(LOGGED)
                subprocess.run([PROGRAM, "run", scene, "--out", place / "command", "--record", ",".join(trails), "--movie",
                                *wanted], check=True, capture_output=True)
                world = hookpoint.load(scene)
                trace = world.run(duration, record=trails, every=10, output=place / "python", movie=place / "movie.h5")
                (place / "movie.h5").rename(place / "python" / "movie.h5")
                self.assertEqual(len(trace["time"]), world.steps / 10 + 1)
                written, expected = files_of(place / "python"), files_of(place / "command")
            self.assertEqual(list(written), list(expected))
            # Python wrote its movie beside the folder.
            del expected["files.json"]["files"]["movie.h5"]
            for name in ("trace.csv", "experiment.hook", "fall.csv", "spots.wl", "table.mat", "deep.h5", "lanes.mcap", "film.h5"):
                self.assertIn(name, written)
            for name, content in expected.items():
                self.assertEqual(written[name], content, name)
            self.assertEqual(len(written["trace.csv"].splitlines()), world.steps + 2)

    def test_a_run_that_goes_on_writes_the_rows_of_the_whole_run(self):
        with tempfile.TemporaryDirectory() as folder:
            place = pathlib.Path(folder)
            hookpoint.loads(LOGGED).run(output=place / "whole")
            world = hookpoint.loads(LOGGED)
            world.run(0.105)
            world.run(output=place / "rest")
            whole, rest = read_csv(place / "whole" / "fall.csv"), read_csv(place / "rest" / "fall.csv")
            # 0, 20, ... 300 ms; from 105 ms on the first is at 120.
            self.assertEqual(rest, whole[:1] + whole[7:])
            self.assertEqual(float(rest[1][0]), 0.12)
            moment = ["--at", "0.27 s", "--json"]
            states = [json.loads(subprocess.run([PROGRAM, "replay", place / name / "film.h5", *moment], check=True,
                                                capture_output=True, text=True).stdout) for name in ("whole", "rest")]
            self.assertEqual(states[0], states[1])

    def test_files_stay_when_a_run_ends_early(self):
        stiff = STIFF[:STIFF.rindex("}")] + "Record swing { trails = wheel.axle.disc.angle; }\n}\n"
        with tempfile.TemporaryDirectory() as folder:
            place = pathlib.Path(folder)
            with self.assertRaises(hookpoint.RunError):
                hookpoint.loads(stiff).run(output=place / "python")
            (place / "stiff.hook").write_text(stiff)
            command = subprocess.run([PROGRAM, "run", place / "stiff.hook", "--out", place / "command"], capture_output=True)
            self.assertEqual(command.returncode, 1)
            self.assertGreater(len(read_csv(place / "python" / "swing.csv")), 50)
            self.assertEqual(files_of(place / "python"), files_of(place / "command"))

    def test_files_that_cannot_be_are_exceptions(self):
        with tempfile.TemporaryDirectory() as folder:
            place = pathlib.Path(folder)
            (place / "taken").write_text("")
            with self.assertRaisesRegex(OSError, "taken"):
                hookpoint.loads(LOGGED).run(output=place / "taken")
            with self.assertRaisesRegex(hookpoint.Error, "goes with `output`"):
                hookpoint.loads(LOGGED).run(movie=True)
            with self.assertRaisesRegex(hookpoint.Error, "nearest|did you mean"):
                hookpoint.loads(FALLING).run(record=["ball.base.locatoin.z"], output=place / "none")
            with self.assertRaisesRegex(hookpoint.Error, "another name"):
                hookpoint.loads(LOGGED.replace("Movie film { ", "Movie movie { ")).run(movie=True, output=place / "none")
            self.assertEqual(list(place.iterdir()), [place / "taken"])

    def test_a_plugin_brings_its_class_if_it_may(self):
        plugin = os.environ["HOOKPOINT_PLUGIN"]
        text = f'Plugin "{plugin}";\n' + FALLING + \
            "Test.Doubler twice { Wire FROM w.ball.base.location.z TO in; }"
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "doubled.hook"
            file.write_text(text)
            with self.assertRaisesRegex(hookpoint.FileError, "is refused"):
                hookpoint.load(file)
            world = hookpoint.load(file, allow_plugins=True)
        world.step(10)
        self.assertEqual(world["twice.output"], 2 * world["ball.base.location.z"])


WALK = CONFIGS / "scenes" / "walking_hexapod.hook"
FORWARD = "world.gait.forward"


def ports_of(world):
    """Every number of a world, by its trail, as bytes: -0 is not 0."""
    return {trail: np.float64(world[trail]).tobytes() for trail, _, _ in world.ports()}


def measure_energy(world):
    """Numerical energy, which a state has with it, counts from when it is read first."""
    for trail, _, _ in world.ports():
        if trail.endswith(".numerical_energy"):
            world[trail]


class State(unittest.TestCase):
    def test_a_state_goes_on_bit_for_bit(self):
        world = hookpoint.load(WALK)
        measure_energy(world)
        world.step(700)
        state = world.state()
        world.step(300)
        # In a world of its own, that was elsewhere meanwhile.
        other = hookpoint.load(WALK)
        other.step(41)
        other.set_state(state)
        self.assertEqual((other.steps, other.state()), (700, state))
        other.step(300)
        self.assertEqual(ports_of(other), ports_of(world))
        # And in the same.
        after = world.state()
        world.set_state(state)
        world.step(300)
        self.assertEqual(world.state(), after)

    def test_states_of_others_and_damaged_ones_are_refused(self):
        world = hookpoint.loads(FALLING)
        world.step(10)
        state, before = world.state(), ports_of(world)
        others = [hookpoint.loads(FALLING, set={"w.seed": 2}), hookpoint.loads(FALLING, set={"height": 2}), hookpoint.loads(WHEEL)]
        for other in others:
            with self.assertRaisesRegex(hookpoint.Error, "another experiment"):
                world.set_state(other.state())
        for place in range(18, len(state), 7):
            with self.assertRaisesRegex(hookpoint.Error, "damaged"):
                world.set_state(state[:place] + bytes([state[place] ^ 16]) + state[place + 1:])
        for length in (18, 40, 54, len(state) - 8, len(state) - 1):
            with self.assertRaisesRegex(hookpoint.Error, "damaged"):
                world.set_state(state[:length])
        for nothing in (b"", b"hook", b"PK" + state):
            with self.assertRaisesRegex(hookpoint.Error, "no state of a world"):
                world.set_state(nothing)
        self.assertEqual(ports_of(world), before)

    def test_a_copy_goes_on_by_itself(self):
        world = hookpoint.load(WALK)
        world.step(500)
        branch = world.copy()
        world.step(200)
        self.assertEqual((branch.steps, world.steps), (500, 700))
        branch.step(200)
        self.assertEqual(ports_of(branch), ports_of(world))
        branch[FORWARD] = 0.
        branch.step(400)
        world.step(400)
        self.assertNotEqual(branch.state(), world.state())

    def test_python_copies_and_pickles_a_world(self):
        folder = pathlib.Path.cwd()
        world = hookpoint.load(os.path.relpath(WALK), set={"world.gait.forward": 0.07})
        measure_energy(world)
        world[FORWARD] = 0.05
        world.step(300)
        pickled = pickle.dumps(world)
        copies = [copy.copy(world), copy.deepcopy({"env": [world]})["env"][0]]
        with tempfile.TemporaryDirectory() as elsewhere:
            os.chdir(elsewhere)
            try:
                copies.append(pickle.loads(pickled))
            finally:
                os.chdir(folder)
        world.step(400)
        for other in copies:
            self.assertEqual(other.steps, 300)
            other.step(400)
            self.assertEqual(other.state(), world.state())
            self.assertEqual(ports_of(other), ports_of(world))
        text = hookpoint.loads(FALLING, set={"height": 3})
        self.assertEqual(pickle.loads(pickle.dumps(text))["ball.base.location.z"], 3.)
        with self.assertRaisesRegex(hookpoint.Error, "cannot be saved"):
            pickle.dumps(hookpoint.loads(FALLING, engine="ode"))

    def test_what_was_pickled_of_a_file_is_refused_where_the_file_has_changed(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "falling.hook"
            text = FALLING
            file.write_text(text)
            world, batch = hookpoint.load(file), hookpoint.Batch(file, 2)
            world.step(10)
            pickled = [pickle.dumps(world), pickle.dumps(batch)]
            self.assertEqual([pickle.loads(one).time for one in pickled[:1]], [world.time])
            file.write_text(text.replace("mass = 2", "mass = 3"))
            for one in pickled:
                with self.assertRaisesRegex(hookpoint.Error, "the state is of another experiment"):
                    pickle.loads(one)

    def test_worlds_go_through_a_pool_of_processes(self):
        worlds = [hookpoint.loads(FALLING, set={"height": height}) for height in (1, 2, 3)]
        with multiprocessing.get_context("fork").Pool(2) as pool:
            stepped = pool.map(stepped_by_100, worlds)
        for before, after in zip(worlds, stepped):
            self.assertEqual((before.steps, after.steps), (0, 100))
            self.assertAlmostEqual(before["ball.base.location.z"] - after["ball.base.location.z"],
                                   10e-6 * 100 * 101 / 2, places=12)

    def test_a_world_is_a_context(self):
        with hookpoint.loads(FALLING) as world:
            world.step(10)
        self.assertEqual(world.steps, 10)
        with self.assertRaises(ZeroDivisionError):
            with hookpoint.Batch(FALLING, 2):
                raise ZeroDivisionError

    def test_a_reset_world_is_as_it_was_loaded(self):
        trails = ["hexapod.base.location.x", "hexapod.base.contact.force.z", "hexapod.base.linear_acceleration.z"]
        fresh, world = hookpoint.load(WALK), hookpoint.load(WALK)
        start = ports_of(fresh)
        self.assertEqual(ports_of(world), start)
        world[FORWARD] = 0.05
        world.step(300)
        self.assertNotEqual(ports_of(world), start)
        world.reset()
        self.assertEqual((world.time, world.steps), (0., 0))
        # All but what only a step computes.
        of_steps = {trail for trail in start if re.search(r"\.(acceleration|total_torque|hip_force\..|hip_moment\..|reaction_force\..|reaction_moment\..)$", trail)}
        self.assertEqual(len(of_steps), 18 + 18 + 36 + 6 * 18)
        now = ports_of(world)
        self.assertEqual([trail for trail in start if now[trail] != start[trail] and trail not in of_steps], [])
        fresh.step()
        world.step()
        self.assertEqual(ports_of(world), ports_of(fresh))
        again, first = (each.run(0.2, record=trails) for each in (world, fresh))
        for trail in ["time", *trails]:
            np.testing.assert_array_equal(again[trail], first[trail])

    def test_engines_that_cannot_be_saved_say_so(self):
        world = hookpoint.loads(FALLING, engine="ode")
        for ask in (world.state, world.copy):
            with self.assertRaisesRegex(hookpoint.Error, "cannot be saved"):
                ask()


class View(unittest.TestCase):
    def test_shows_what_is_and_costs_no_copy(self):
        world = hookpoint.loads(FALLING)
        velocity, height = world.view("ball.base.velocity"), world.view("w.ball.base.location.z")
        turned = world.view("ball.base.orientation")
        self.assertEqual((velocity.shape, height.shape, turned.shape), ((3,), (), (4,)))
        for n in range(1, 4):
            world.step()
            np.testing.assert_allclose(velocity, [0, 0, -10e-3 * n], atol=1e-15)
            self.assertEqual(height[()], world["ball.base.location.z"])
        np.testing.assert_array_equal(turned, [1, 0, 0, 0])
        world.reset()
        np.testing.assert_array_equal(velocity, [0, 0, 0])
        with self.assertRaisesRegex(ValueError, "read-only"):
            velocity[0] = 1
        with self.assertRaises(ValueError):
            velocity.setflags(write=True)

    def test_keeps_its_world_alive(self):
        height = hookpoint.loads(FALLING).view("ball.base.location.z")
        gc.collect()
        self.assertEqual(height[()], 1.)
        self.assertEqual(height.base.name, "w")

    def test_an_input_is_written_in_place(self):
        world = hookpoint.loads(WHEEL)
        torque = world.view("wheel.axle.disc.torque")
        torque[()] = 0.5
        world.step(1000)
        self.assertAlmostEqual(world["wheel.axle.disc.rate"], 0.5 / 0.25, places=12)
        torque += 0.5
        self.assertEqual(world["wheel.axle.disc.torque"], 1.)
        # The step after a force is written is the first that it acts in, written by name or in place.
        pushed = FALLING[:FALLING.rindex("}")] + "Force push { body = ball.base; } }\n"
        by_name, in_place = hookpoint.loads(pushed), hookpoint.loads(pushed)
        by_name["push.force.x"] = 2.
        in_place.view("push.force")[:] = [2., 0, 0]
        for world in (by_name, in_place):
            world.step()
            self.assertAlmostEqual(world["ball.base.velocity.x"], 1e-3, places=15)

    def test_wired_inputs_cannot_be_written_and_mistakes_are_told(self):
        wired = hookpoint.loads(WHEEL + "Signal.Step push { Wire TO w.wheel.axle.disc.torque; }")
        self.assertFalse(wired.view("w.wheel.axle.disc.torque").flags.writeable)
        with self.assertRaisesRegex(hookpoint.Error, "did you mean"):
            wired.view("wheel.axle.disc.torqe")


class Callback(unittest.TestCase):
    def test_is_called_after_every_steps_and_after_the_last(self):
        world = hookpoint.loads(FALLING)
        seen = []
        world.step(7, callback=lambda each: seen.append((each is world, each.steps)), every=3)
        self.assertEqual(seen, [(True, 3), (True, 6), (True, 7)])
        world.step(3, callback=lambda each: seen.append(each.steps))
        self.assertEqual(seen[3:], [8, 9, 10])

    def test_false_ends_the_steps_and_what_it_raises_passes(self):
        world = hookpoint.loads(FALLING)
        world.step(400, callback=lambda each: each["ball.base.location.z"] > 0.9)
        self.assertLessEqual(world["ball.base.location.z"], 0.9)
        self.assertGreater(world["ball.base.location.z"], 0.9 - 2e-3)
        with self.assertRaises(ZeroDivisionError):
            world.step(3, callback=lambda each: 1 / 0)
        with self.assertRaisesRegex(hookpoint.Error, "1 or more"):
            world.step(3, callback=print, every=0)


NOISY = """World w {
  deltat = 1 ms; duration = 0.5 s;
  Robot arm { Base.fixed; Chain c { Link l { mass = 1; inertia = .1, .1, .1, 0, 0, 0; damping = .2; } } }
  Controller.PD pd {
    goal = 1; pconstant = 2; dconstant = .1;
    Wire FROM arm.c.l.angle TO current { noise = 0.02; delay = 3 ms; }
    Wire FROM arm.c.l.rate TO rate_in;
    Wire FROM output TO arm.c.l.torque;
  }
}
"""


class Batch(unittest.TestCase):
    def test_each_world_is_a_world_by_itself_for_any_number_of_threads(self):
        seeds = [1, 2, 3, 2, 77]
        trails = ["arm.c.l.angle", "arm.c.l.location", "pd.output"]
        batches = [hookpoint.Batch(NOISY, 5, threads=threads, seeds=seeds, observations=trails) for threads in (1, 2, 5)]
        for batch in batches:
            self.assertEqual(batch.observations.shape, (5, 5))
            for count in (1, 20, 100):
                observed, _ = batch.step(count=count)
        for other in batches[1:]:
            np.testing.assert_array_equal(other.observations, batches[0].observations)
        for i, seed in enumerate(seeds):
            world = hookpoint.loads(NOISY, set={"w.seed": seed})
            world.step(121)
            self.assertEqual([world[trail] for trail in batches[0].observation_trails], observed[i].tolist())
            for batch in batches:
                self.assertEqual(batch.state(i), world.state())
        # Noise is of the seed.
        self.assertEqual(len({row.tobytes() for row in observed}), 4)

    def test_actions_are_written_as_to_a_world(self):
        batch = hookpoint.Batch(WALK, 3, threads=2, observations=["hexapod.base.location", "hexapod.base.velocity.x"],
                                actions=[FORWARD])
        self.assertEqual(batch.action_trails, [FORWARD])
        forward = np.array([[0.1], [0.05], [0.]])
        for _ in range(10):
            observed, done = batch.step(forward, 20)
            np.testing.assert_array_equal(batch.actions, forward)
        self.assertIs(observed, batch.observations)
        self.assertFalse(done.any())
        np.testing.assert_allclose(batch.time, 0.1, rtol=1e-12)
        for i in range(3):
            world = hookpoint.load(WALK)
            for _ in range(10):
                world[FORWARD] = forward[i, 0]
                world.step(20)
            self.assertEqual(batch.state(i), world.state())
            np.testing.assert_array_equal(observed[i], [world[trail] for trail in batch.observation_trails])

    def test_reset_takes_those_of_the_mask_back(self):
        batch = hookpoint.Batch(FALLING, 3, observations=["ball.base.location.z"])
        batch.step(count=100)
        state = batch.state(1)
        rows = batch.reset([True, False, True])
        np.testing.assert_allclose(rows[:, 0], [1., 1 - 10e-6 * 100 * 101 / 2, 1.], atol=1e-12)
        np.testing.assert_allclose(batch.time, [0, 0.1, 0])
        batch.set_state(2, state)
        self.assertEqual(rows[2, 0], rows[1, 0])
        self.assertEqual(batch.reset()[1, 0], 1.)
        self.assertEqual(batch.state(1), hookpoint.loads(FALLING).state())

    def test_python_copies_and_pickles_a_batch(self):
        batch = hookpoint.Batch(WALK, 3, threads=2, observations=["hexapod.base.location"], actions=[FORWARD],
                                set=[{FORWARD: 0.1}, {FORWARD: 0.05}, {}], seeds=[1, 2, 3])
        batch.step(np.array([[0.1], [0.05], [0.]]), 50)
        batch.actions[2] = 0.02
        others = [batch.copy(), copy.copy(batch), copy.deepcopy(batch), pickle.loads(pickle.dumps(batch))]
        observed, _ = batch.step(count=100)
        for other in others:
            self.assertEqual((other.threads, other.seeds.tolist(), other.action_trails), (2, [1, 2, 3], [FORWARD]))
            np.testing.assert_array_equal(other.step(count=100)[0], observed)
            for i in range(3):
                self.assertEqual(other.state(i), batch.state(i))

    def test_a_batch_of_an_engine_without_a_state_is_neither_copied_nor_pickled(self):
        batch = hookpoint.Batch(FALLING, 2, engine="ode")
        for take in (pickle.dumps, copy.copy, copy.deepcopy, lambda one: one.copy()):
            with self.assertRaisesRegex(hookpoint.Error, "cannot be saved"):
                take(batch)

    def test_a_copied_batch_has_the_failures_too(self):
        batch = hookpoint.Batch(STIFF, 2, observations=["wheel.axle.disc.angle"])
        batch.step(count=1000)
        for other in (batch.copy(), pickle.loads(pickle.dumps(batch))):
            self.assertEqual(other.failures, batch.failures)
            self.assertTrue(other.done.all())

    def test_a_world_is_done_by_its_port_by_its_end_or_by_a_failure(self):
        world = hookpoint.Batch(STIFF, 2, observations=["wheel.axle.disc.angle"])
        _, done = world.step(count=1000)
        self.assertTrue(done.all())
        self.assertRegex(world.failures[1], "wheel")
        before = world.time.copy()
        world.step(count=10)
        np.testing.assert_array_equal(world.time, before)
        world.reset([False, True])
        self.assertEqual((world.done.tolist(), list(world.failures)), ([True, False], [0]))
        # What is watched is not 0 after the first step.
        fallen = hookpoint.Batch(FALLING, 2, done="ball.base.velocity.z")
        _, done = fallen.step(count=50)
        self.assertEqual((done.tolist(), fallen.time.tolist()), ([True, True], [0.001, 0.001]))

    def test_mistakes_are_told(self):
        batch = hookpoint.Batch(WHEEL, 2, actions=["wheel.axle.disc.torque"])
        for wrong in (np.zeros((2, 2)), np.zeros(2), [[1.]]):
            with self.assertRaisesRegex(hookpoint.Error, "array of 2 x 1"):
                batch.step(wrong)
        with self.assertRaisesRegex(hookpoint.Error, "world 1 takes a finite"):
            batch.step([[0.], [np.inf]])
        with self.assertRaisesRegex(hookpoint.Error, "one entry a world: 2, not 3"):
            hookpoint.Batch(WHEEL, 2, seeds=[1, 2, 3])
        with self.assertRaisesRegex(hookpoint.Error, "1 to 100000 worlds"):
            hookpoint.Batch(WHEEL, 0)
        with self.assertRaisesRegex(hookpoint.Error, "not written"):
            hookpoint.Batch(WHEEL, 1, actions=["wheel.axle.disc.rate"])
        with self.assertRaisesRegex(hookpoint.Error, "did you mean"):
            hookpoint.Batch(WHEEL, 1, observations=["wheel.axle.disc.raet"])
        with self.assertRaisesRegex(hookpoint.Error, "one value a world"):
            batch.reset([True])
        with self.assertRaises(IndexError):
            batch.state(2)
        with self.assertRaises(hookpoint.FileError):
            hookpoint.Batch("nowhere.hook", 2)

    def test_ctrl_c_stops_a_batch(self):
        batch = hookpoint.Batch(FALLING, 4, threads=2)
        began = threading.Event()
        interrupt_once(began.is_set)
        with self.assertRaises(KeyboardInterrupt):
            began.set()
            batch.step(count=10**12)


class Study(unittest.TestCase):
    def test_the_table_is_that_of_results_csv(self):
        study = CONFIGS / "studies" / "creep.hook"
        subjects = ["hookpoint", "hunt_crossley"]
        with tempfile.TemporaryDirectory() as folder:
            result = hookpoint.study(study, quick=True, only=subjects, out=folder)["creep"]
            text = (pathlib.Path(folder) / "results.csv").read_bytes()
        table = result["table"]
        self.assert_table(table, text)
        self.assertEqual(table["slope [deg]"].dtype, np.float64)
        # A regularised law creeps by its closed form; hooks hold.
        sticks = (table["mu"] == 0.8) & (table["status"] == "ok")
        laws = sticks & (table["subject"] == "hunt_crossley")
        np.testing.assert_allclose(table["creep_speed [m/s]"][laws],
                                   table["creep_speed_predicted [m/s]"][laws], rtol=0.01)
        self.assertLess(table["creep_speed [m/s]"][sticks & (table["subject"] == "hookpoint")].max(), 1e-9)
        self.assertTrue(all(truth["failed"] == 0 for truth in result["truths"]))
        self.assertTrue(any("realtime_factor" in title for title in result["timing"]))

    def run_both(self, text, place):
        """The results of Python and the folders that the command and Python leave, but for the date and which program it was."""
        study = place / "study.hook"
        study.write_text(text)
        command = subprocess.run([PROGRAM, "study", study, "--out", place / "command"], capture_output=True, text=True)
        self.assertEqual(command.returncode, 0, command.stderr)
        result = hookpoint.study(study, out=place / "python")
        folders = [files_of(place / name) for name in ("command", "python")]
        for files in folders:
            program = re.search(rb'"program": "(\w{32})"', files["provenance.json"]).group(1)
            for name in files:
                if isinstance(files[name], dict):
                    files[name] = sorted(files[name]["files"])
                    continue
                files[name] = files[name].replace(program, b"program")
                files[name] = re.sub(rb"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ", b"date", files[name])
        return result, *folders

    def assert_table(self, table, text):
        rows = list(csv.reader(text.decode().splitlines()))
        self.assertEqual(list(table), rows[0])
        for column, title in enumerate(rows[0]):
            for row, value in zip(rows[1:], table[title], strict=True):
                if isinstance(value, str):
                    self.assertEqual(str(value), row[column])
                else:
                    self.assertEqual(repr(float(value)), repr(float(row[column] or "nan")))

    def test_a_wall_is_that_of_the_command(self):
        wall = """Wall truths {
          title = "Free fall"; question = "Does it fall?";
          Subject hookpoint; Subject lugre { contact = lugre; }
          Scene pendulum; Scene arm_at_rest;
        }
        """
        with tempfile.TemporaryDirectory() as folder:
            result, command, python = self.run_both(wall, pathlib.Path(folder))
            self.assertEqual(list(python), list(command))
            for name in command:
                # A store's pages lie as the threads came.
                if not name.startswith("store/"):
                    self.assertEqual(python[name], command[name], name)
            self.assertIn("report.html", python)
            unkept = hookpoint.study(pathlib.Path(folder) / "study.hook")
        wall = result["truths"]
        self.assert_table(wall["table"], command["results.csv"])
        self.assertEqual(wall["failed"], 0)
        self.assertEqual(wall["notices"], [])
        self.assertEqual(wall["passed"], sum(wall["table"]["ok"] == "true"))
        self.assertGreater(wall["passed"], 1)
        relative = np.abs(wall["table"]["measured"] - wall["table"]["expected"])
        np.testing.assert_array_less(relative, 0.01 * np.abs(wall["table"]["expected"]) + 1e-6)
        np.testing.assert_array_equal(unkept["truths"]["table"]["measured"], wall["table"]["measured"])

    def test_a_wall_warns_at_the_place_of_its_scene(self):
        with tempfile.TemporaryDirectory() as folder:
            place = pathlib.Path(folder)
            (place / "coarse.hook").write_text("World w { deltat = 50 ms; duration = 0.5 s; Terrain.Flat g { size = 2; }\n"
                                               "Robot ball { Base.mobile { location = 0, 0, 5; Shape.Sphere { radius = .1; mass = 1; } } }"
                                               "}\nExpect stays { of = w.ball.base.location.x; equals = 0 m; within = 1 mm; }\n")
            (place / "wall.hook").write_text("Wall walls { Subject ours;\n  Scene coarse { file = \"coarse.hook\"; } }\n")
            with self.assertWarnsRegex(UserWarning, r"wall.hook:2:3: deltat 0.05 s is above the largest stable step"):
                result = hookpoint.study(place / "wall.hook")["walls"]
        self.assertRegex(result["warnings"][0], "coarse under ours")

    def test_a_matrix_is_that_of_the_command(self):
        scene = "World w { deltat = 1 ms; duration = 0.2 s; Terrain.Slope g { size = 4; angle = 20 deg; } " \
            "Robot block { Base.mobile { rest_on = g; settled = false; Shape.Box { dimensions = .2, .2, .1; mass = 1; } } } }\n"
        study = "Study {} {{ scene = \"slide.hook\"; duration = 0.2 s; settle = 0 s; Measure slip_distance; " \
            "Subject ours {{ engine = dts; }} Subject bullet {{ engine = bullet; }} }}\n"
        with tempfile.TemporaryDirectory() as folder:
            place = pathlib.Path(folder)
            (place / "slide.hook").write_text(scene)
            for name in ("first", "second"):
                (place / (name + ".hook")).write_text(study.format(name))
            matrix = "Matrix both { Part a { file = \"first.hook\"; } Part b { file = \"second.hook\"; } }\n"
            result, command, python = self.run_both(matrix, place)
        self.assertEqual(list(python), list(command))
        for name in ("matrix.csv", "matrix.html", "experiment.hook", "provenance.json", "first/results.csv", "second/report.html"):
            self.assertEqual(python[name], command[name], name)
        self.assert_table(result["both"]["table"], command["matrix.csv"])
        self.assertEqual(list(result["both"]["studies"]), ["first", "second"])
        self.assert_table(result["both"]["studies"]["second"]["table"], command["second/results.csv"])

    def test_ctrl_c_stops_a_study(self):
        with tempfile.TemporaryDirectory() as folder:
            store = pathlib.Path(folder) / "store"

            # The store's log has a run once it is longer than its own head and its tables.
            interrupt_once(lambda: any(log.stat().st_size > 100_000 for log in store.glob("*-wal")))
            with self.assertRaises(KeyboardInterrupt):
                hookpoint.study(CONFIGS / "studies" / "creep.hook", out=folder)
            self.assertFalse((pathlib.Path(folder) / "results.csv").exists())
            self.assertTrue(any(store.iterdir()))

    def test_mistakes_are_exceptions(self):
        with self.assertRaisesRegex(hookpoint.Error, "holds no Study"):
            hookpoint.study(CONFIGS / "scenes" / "sloped_block.hook")
        with self.assertRaises(hookpoint.FileError):
            hookpoint.study(CONFIGS / "studies" / "creep.hook", only=["nobody"])


SLIDE = "World w { deltat = 1 ms; duration = 0.2 s; Terrain.Slope g { size = 4; angle = 20 deg; } " \
    "Robot block { Base.mobile { rest_on = g; settled = false; Shape.Box { dimensions = .2, .2, .1; mass = 1; } } } }\n"

TABLED = """Study slides {
  scene = "slide.hook"; duration = 0.2 s; settle = 0 s; Measure slip_distance;
  Sweep dt { values = 1 ms, 2 ms; }
  Subject ours { engine = dts; } Subject soft { contact = hunt_crossley; }
  Table slip { rows = subject; columns = dt; value = slip_distance; }
}
"""

# A unit mass on one point whose spring and damper along the ground say next to nothing.
POINT = """World world {
  gravity = 9.81; deltat = 1 ms; duration = 4 s;
  Material floor { normal_stiffness = 5 kN/m; normal_damping = 10 N.s/m; tangential_stiffness = 1 N/m; tangential_damping = 0 N.s/m; }
  Terrain.Flat ground { material = floor; }
  Robot point { Base.mobile { mass = 1; inertia = 1, 1, 1, 0, 0, 0; ContactPoint tip { location = 0, 0, 0; } } }
}
"""

TUNED = """Tune stiffest {
  scene = "scene.hook"; settle = 3 s;
  Vary normal_stiffness { from = 1 kN/m; to = 100 kN/m; scale = log; }
  Objective penetration_mean { minimise; }
  Require stable_step { above = 10 ms; }
  method = cmaes; population = 8; generations = 6; seeds = 1; samples = 0;
}
"""


class DataFrame:
    """What frames are made of, where pandas is not."""

    def __init__(self, data, index=None, columns=None):
        self.data, self.index, self.columns = data, index, columns


class Frames(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.place = pathlib.Path(folder.name)
        (self.place / "slide.hook").write_text("Param dt = 1 ms;\n" + SLIDE.replace("deltat = 1 ms", "deltat = dt"))
        (self.place / "study.hook").write_text(TABLED)
        # Its steps are coarse on purpose.
        self.enterContext(warnings.catch_warnings())
        warnings.simplefilter("ignore")

    def test_a_table_block_is_a_grid(self):
        result = hookpoint.study(self.place / "study.hook")["slides"]
        grid, table = result["tables"]["slip"], result["table"]
        self.assertEqual((grid["down"], grid["rows"], len(grid["columns"])), ("subject", ["ours", "soft"], 2))
        slipped = next(values for title, values in table.items() if title.startswith("slip_distance ["))
        step = table["dt [ms]"] if "dt [ms]" in table else table["dt [s]"]
        for i, subject in enumerate(grid["rows"]):
            for j, value in enumerate(np.unique(step)):
                self.assertEqual(grid["values"][i, j], slipped[(table["subject"] == subject) & (step == value)][0])

    def test_tables_are_frames_where_pandas_is(self):
        with unittest.mock.patch.dict(sys.modules, {"pandas": types.SimpleNamespace(DataFrame=DataFrame)}):
            framed = hookpoint.study(self.place / "study.hook", frames=True)["slides"]
        plain = hookpoint.study(self.place / "study.hook")["slides"]
        self.assertEqual(list(framed), list(plain))
        self.assertEqual(list(framed["table"].data), list(plain["table"]))
        np.testing.assert_array_equal(framed["table"].data["subject"], plain["table"]["subject"])
        slip = framed["tables"]["slip"]
        self.assertEqual((slip.index, slip.columns), (plain["tables"]["slip"]["rows"], plain["tables"]["slip"]["columns"]))
        np.testing.assert_array_equal(slip.data, plain["tables"]["slip"]["values"])
        self.assertEqual(framed["truths"], plain["truths"])

    def test_without_pandas_nothing_runs(self):
        with unittest.mock.patch.dict(sys.modules, {"pandas": None}):
            for ask in (hookpoint.study, hookpoint.tune):
                with self.assertRaisesRegex(hookpoint.Error, "needs pandas"):
                    ask(self.place / "nowhere.hook", frames=True)


class Tune(unittest.TestCase):
    def test_is_the_tuning_of_the_command(self):
        with tempfile.TemporaryDirectory() as folder:
            place = pathlib.Path(folder)
            (place / "scene.hook").write_text(POINT)
            (place / "tune.hook").write_text(TUNED)
            subprocess.run([PROGRAM, "tune", place / "tune.hook", "--out", place / "command"], capture_output=True)
            result = hookpoint.tune(place / "tune.hook", out=place / "python")["stiffest"]
            unkept = hookpoint.tune(place / "tune.hook")["stiffest"]
            for name in ("evaluations.csv", "pareto.csv", "recommended.json"):
                self.assertEqual((place / "python" / name).read_bytes(), (place / "command" / name).read_bytes(), name)
            rows = read_csv(place / "command" / "evaluations.csv")
            recommended = json.loads((place / "command" / "recommended.json").read_text())
            self.assertTrue((place / "python" / "report.html").exists())
        table = result["table"]
        self.assertEqual(list(table), rows[0])
        self.assertEqual(table["stage"].tolist(), [row[1] for row in rows[1:]])
        np.testing.assert_array_equal(table["evaluation"], np.arange(1, len(rows)))
        self.assertEqual(result["recommended"], recommended)
        self.assertEqual(unkept["recommended"], recommended)
        self.assertTrue(result["holds"])
        self.assertIn("_tuned {", result["material"])
        self.assertIn("yes", result["pareto"]["recommended"].tolist())

    def test_files_without_one_and_ctrl_c_are_told(self):
        with self.assertRaisesRegex(hookpoint.Error, "holds no Tune"):
            hookpoint.tune(CONFIGS / "studies" / "creep.hook")
        with self.assertRaises(hookpoint.FileError):
            hookpoint.tune("nowhere.hook")


class Module(unittest.TestCase):
    def test_translation_is_the_commands(self):
        said = subprocess.run([PROGRAM, "translate", "stone", "--load", "30 N", "--dt", "0.002 s", "--json"],
                              capture_output=True, check=True, text=True).stdout
        self.assertEqual(hookpoint.translate("stone", load=30, deltat=0.002), json.loads(said))
        own = hookpoint.translate(source="mujoco", parameters={"solref": np.array([0.02, 1]), "cone": "elliptic",
                                                               "impratio": 10}, load=30, to="ode")
        self.assertEqual(own["from"]["parameters"]["solref"], [0.02, 1])
        self.assertEqual([each["engine"] for each in own["targets"]], ["ode"])
        for wrong in ({"file": "stone"}, {"file": "nosuch", "load": 3}, {"source": "mujoco", "load": -3},
                      {"source": "mujoco", "load": 3, "parameters": {"solreff": 1}}):
            with self.assertRaises(hookpoint.Error):
                hookpoint.translate(**wrong)

    def test_a_robots_file_is_put_into_a_world(self):
        with tempfile.TemporaryDirectory() as folder:
            text, left_out = hookpoint.export(CONFIGS / "robots" / "quadruped.urdf", "mjcf")
            said = subprocess.run([PROGRAM, "export", CONFIGS / "robots" / "quadruped.urdf", "--to", "mjcf"],
                                  capture_output=True, check=True, text=True)
            self.assertEqual(text, said.stdout)
            self.assertIn("; ".join(left_out), said.stderr)
            file = pathlib.Path(folder) / "robot.xml"
            file.write_text(text)
            world = hookpoint.load(file)
            self.assertIn("Terrain.Flat", world.text)
            world.run(0.5)
            held = copy.deepcopy(world)
            self.assertEqual(held.text, world.text)
            answers = hookpoint.translate(file, to="drake")
            answers = answers if isinstance(answers, list) else [answers]
            self.assertEqual(answers[0]["targets"][0]["engine"], "drake")
            with self.assertRaisesRegex(hookpoint.Error, "mjcf"):
                hookpoint.export(file, "usd")

    def test_lists_what_it_has(self):
        listed = hookpoint.engines()
        self.assertIn("dts", [engine["name"] for engine in listed["engines"]])
        self.assertIn("hunt_crossley", [law["name"] for law in listed["laws"]])
        self.assertIn("rk4", [row["name"] for row in listed["integrators"]])
        command = subprocess.run([PROGRAM, "engines", "--json"], check=True, capture_output=True, text=True)
        self.assertEqual(json.loads(command.stdout), listed)


if __name__ == "__main__":
    unittest.main()
