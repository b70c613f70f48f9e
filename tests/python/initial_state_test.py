"""Initial states, settings and seeds of single worlds, and the notices that the command prints."""
import os
import pathlib
import subprocess
import tempfile
import unittest
import warnings

import numpy as np

import hookpoint

SOURCE = pathlib.Path(os.environ["HOOKPOINT_SOURCE_DIR"])
PROGRAM = os.environ["HOOKPOINT_PROGRAM"]
PRECISION = {each["name"]: each["precision"] for each in hookpoint.engines()["engines"] if each["found"]}
ENGINES = list(PRECISION)

FALLING = """World w {
  gravity = 10; deltat = 1 ms; duration = 0.5 s;
  Robot ball { Base.mobile { location = 0, 0, 1; mass = 2; Shape.Sphere radius = 0.1; } }
}
"""

# A hexapod's worth of kinds: a mobile base with two chains, one of them prismatic, a planar base, a fixed one, a filter that starts at
# its input, a noisy delayed wire, ground that is touched.
ZOO = """World w {
  deltat = 0.2 ms; duration = 1 s;
  Material soil { normal_stiffness = 2 kN/m; normal_damping = 20 N.s/m; tangential_stiffness = 2 kN/m; tangential_damping = 20 N.s/m; }
  Terrain.Flat ground { material = soil; }
  Robot r {
    Base.mobile trunk {
      location = 0, 0, 0.3; mass = 2; inertia = 0.02, 0.02, 0.02, 0, 0, 0;
      ContactPoint a { location = 0.1, 0.1, -0.3; } ContactPoint b { location = -0.1, 0.1, -0.3; } ContactPoint c { location = 0, -0.1, -0.3; }
    }
    Chain arm { Link upper { dhlength = 0.1; mass = 0.2; inertia = 1e-3, 1e-3, 1e-3, 0, 0, 0; damping = 0.01; friction = 0.02; lower_limit = -1; upper_limit = 1; }
                Link lower { dhlength = 0.2; mass = 0.1; inertia = 1e-3, 1e-3, 1e-3, 0, 0, 0; stiffness = 0.5; damping = 0.01; } }
    Chain slide { Link rod { joint = prismatic; mass = 0.1; inertia = 1e-3, 1e-3, 1e-3, 0, 0, 0; stiffness = 50; damping = 1; } }
  }
  Robot hopper { Base.planar { plane = xz; location = 1, 0, 0.5; mass = 1; inertia = .01, .01, .01, 0, 0, 0; ContactPoint tip { location = 0, 0, -0.2; } } }
  Robot door { Base.fixed { location = 2, 0, 1; } Chain c { Link wing { mass = 1; inertia = .1, .1, .1, 0, 0, 0; center_of_mass = 0.2, 0, 0; } } }
  Controller.PD pd {
    goal = 0.2; pconstant = 0.5; dconstant = 0.01;
    Wire FROM r.arm.upper.angle TO current { noise = 0.02; delay = 3 ms; }
    Wire FROM r.arm.upper.rate TO rate_in;
    Wire FROM output TO r.arm.upper.torque;
  }
}
"""

STATE = {"r.trunk.location": [0.1, -0.2, 0.29], "w.r.trunk.orientation": [0.1, 0.2, -0.3], "r.trunk.velocity": (0.3, 0, -0.5),
         "r.trunk.angular_velocity": np.array([0.1, 0.2, 0.3]), "r.arm.upper.angle": 0.4, "r.arm.upper.rate": -1.0, "r.arm.lower.angle": -0.3,
         "r.slide.rod.angle": 0.01, "w.r.slide.rod.rate": 0.2, "hopper.base.location": [1.5, 0.5, 0.21], "hopper.base.velocity": [1, 0, 0.5],
         "hopper.base.angular_velocity": [0, 2, 0], "door.base.location": [3, 1, 2], "door.base.orientation": [2, 0, 0, 2], "door.c.wing.rate": 1.5}


def settings_of(state):
    """The same as a file states it: a fixed base and a joint's angle are fields of their objects."""
    return {(trail if trail.startswith("w.") else "w." + trail): value for trail, value in state.items()}


def ports_of(world, leave_out=()):
    return {trail: np.float64(world[trail]).tobytes() for trail, _, _ in world.ports() if not trail.endswith(tuple(leave_out))}


def without_warnings(test):
    def quiet(*arguments):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return test(*arguments)
    return quiet


# Ports that only a step computes, and the values of the file.
OF_STEPS = (".acceleration", ".total_torque", "acceleration.x", "acceleration.y", "acceleration.z", "hip_force.x", "hip_force.y", "hip_force.z",
            "hip_moment.x", "hip_moment.y", "hip_moment.z", "reaction_force.x", "reaction_force.y", "reaction_force.z",
            "reaction_moment.x", "reaction_moment.y", "reaction_moment.z")


class InitialState(unittest.TestCase):
    @without_warnings
    def test_a_written_state_is_that_of_a_file_bit_for_bit(self):
        listed = hookpoint.engines()
        settings = [{"w.contact": each["name"]} for each in listed["laws"]] + [{"w.integrator": each["name"]} for each in listed["integrators"]]
        for own in settings:
            law = str(own)
            # An impulse law wants its points above the ground.
            above = {"r.trunk.location": [0.1, -0.2, 0.45], "hopper.base.location": [1.5, 0.5, 0.3]} if "impulse" in law else {}
            state = {**STATE, **above}
            stated = hookpoint.loads(ZOO, set={**own, **settings_of(state)})
            world = hookpoint.loads(ZOO, set=own)
            start = ports_of(world)
            # From now on both work out what is only computed for a reader.
            self.assertEqual(len(ports_of(stated)), len(start))
            for _ in range(2):
                world.reset(state=state)
                self.assertEqual((world.time, world.steps), (0., 0))
                self.assertEqual(ports_of(world, OF_STEPS), ports_of(stated, OF_STEPS), law)
                world.step(150)
            stated.step(150)
            self.assertEqual(ports_of(world), ports_of(stated), law)
            world.reset()
            self.assertEqual(ports_of(world, OF_STEPS), {trail: value for trail, value in start.items() if not trail.endswith(OF_STEPS)}, law)
            fresh = hookpoint.loads(ZOO, set=own)
            # Numerical energy counts from when it is read first.
            ports_of(fresh)
            for each in (world, fresh):
                each.step(150)
            self.assertEqual(world.state(), fresh.state(), law)

    @without_warnings
    def test_every_engine_starts_there_and_again(self):
        text = FALLING.replace("Robot ball", "Terrain.Flat ground { }\n  Robot ball")
        state = {"ball.base.location": [0.5, 0, 3], "ball.base.velocity": [1, 0, 2], "ball.base.angular_velocity": [0, 0, 4],
                 "ball.base.orientation": [1, 0, 0, 1]}
        self.assertGreater(len(ENGINES), 1)
        for engine in ENGINES:
            with self.subTest(engine):
                world = hookpoint.loads(text, engine=engine)
                world.run(0.4)
                world.reset(state=state)
                self.assertEqual((world.time, world.steps, world["ball.base.location.z"]), (0., 0, 3.))
                ports_of(world)
                np.testing.assert_allclose(world["ball.base.orientation"], np.array([1, 0, 0, 1]) / np.sqrt(2), atol=1e-15)
                world.run(0.3)
                # Thrown: first order in the step whatever the engine.
                rounding = 2e-6 if PRECISION[engine] == "double" else 1e-4
                np.testing.assert_allclose(world["ball.base.velocity"], [1, 0, 2 - 10 * 0.3], atol=rounding)
                np.testing.assert_allclose(world["ball.base.location"], [0.5 + 0.3, 0, 3 + 2 * 0.3 - 5 * 0.09], atol=2e-3)
                # About its axis: the quaternion of a turn by pi/2 + 4 * 0.3.
                turn = (np.pi / 2 + 4 * 0.3) / 2
                np.testing.assert_allclose(world["ball.base.orientation"], [np.cos(turn), 0, 0, np.sin(turn)], atol=2e-3)
                stated = hookpoint.loads(text, engine=engine, set=settings_of(state))
                self.assertEqual(len(ports_of(stated)), len(world.ports()))
                stated.run(0.3)
                self.assertEqual(ports_of(world, OF_STEPS), ports_of(stated, OF_STEPS))

    @without_warnings
    def test_a_reset_of_every_engine_repeats_bit_for_bit(self):
        scene = SOURCE / "configs" / "scenes" / "sloped_block.hook"
        for engine in ENGINES:
            with self.subTest(engine):
                world, fresh = hookpoint.load(scene, engine=engine), hookpoint.load(scene, engine=engine)
                place = world.view("block.base.location")
                world.run(0.3)
                world.reset()
                self.assertEqual(ports_of(world, OF_STEPS), ports_of(hookpoint.load(scene, engine=engine), OF_STEPS))
                ports_of(fresh, OF_STEPS)
                for each in (world, fresh):
                    each.run(0.2)
                self.assertEqual(ports_of(world), ports_of(fresh))
                # Views stay.
                np.testing.assert_array_equal(place, world["block.base.location"])

    def test_contacts_begin_without_memory(self):
        # A unit mass pushed along the ground stretches its hook; put back, it starts at a new one.
        text = """World w { gravity = 10; deltat = 0.1 ms; duration = 1 s;
          Material m { normal_stiffness = 1e4; normal_damping = 200; tangential_stiffness = 1e4; tangential_damping = 200; static_friction = 1; kinetic_friction = 1; }
          Terrain.Flat g { material = m; }
          Robot p { Base.mobile { rest_on = g; mass = 1; inertia = 1, 1, 1, 0, 0, 0; ContactPoint tip { location = 0, 0, 0; } } }
          Force push { body = p.base; } }"""
        world = hookpoint.loads(text)
        world["push.force.x"] = 5.
        world.run(0.5)
        self.assertAlmostEqual(world["p.base.location.x"], 5e-4, places=8)  # F / k_t
        start = world["p.base.location"]
        world.reset(state={"p.base.location": start})
        world.run(0.5)
        # Nothing pulls it back, and the push is the file's: none.
        self.assertEqual(world["push.force.x"], 0.)
        self.assertAlmostEqual(world["p.base.location.x"], start[0], places=12)

    def test_what_cannot_be_a_start_is_refused_and_changes_nothing(self):
        world = hookpoint.loads(ZOO)
        world.step(100)
        before, state = ports_of(world), world.state()
        for state_given, words in (({"r.arm.upper.angle": 1.2}, "above its upper_limit of 1"), ({"door.base.velocity": [1, 0, 0]}, "Base.fixed does not move"),
                                   ({"hopper.base.velocity": [0, 1, 0]}, "leads out of the plane xz"),
                                   ({"hopper.base.angular_velocity": [1, 1, 0]}, "turns about y alone"),
                                   ({"r.trunk.location": [0, 0, np.nan]}, "finite numbers"), ({"r.trunk.orientation": [0, 0, 0, 0]}, "zero quaternion"),
                                   ({"r.trunk.orientation.w": 1}, "part of an orientation"), ({"r.trunk.location": [1, 2]}, "takes 3 numbers"),
                                   ({"r.trunk.location": "here"}, "takes numbers"), ({"r.arm.upper.angle": [1, 2]}, "takes one number"),
                                   ({"r.trunk.locatoin": [0, 0, 0]}, "did you mean"), ({"pd.goal": 1}, "not part of an initial state"),
                                   ({"r.arm.upper.location": [0, 0, 0]}, "not part of an initial state"), ({"w.time": 1}, "not part of an initial state"),
                                   ({"r.trunk.location": [[0, 0, 1], [0, 0, 2]]}, "2 x 3")):
            with self.subTest(words), self.assertRaisesRegex(hookpoint.Error, words):
                world.reset(state=state_given)
            self.assertEqual(ports_of(world), before)
        self.assertEqual(world.state(), state)

    def test_an_element_of_a_vector_is_a_number(self):
        world = hookpoint.loads(FALLING)
        world.reset(state={"ball.base.location.z": 4, "ball.velocity.x": 2.5})
        np.testing.assert_array_equal(world["ball.base.location"], [0, 0, 4])
        np.testing.assert_array_equal(world["ball.base.velocity"], [2.5, 0, 0])


class Vectors(unittest.TestCase):
    def test_are_read_written_and_recorded_as_a_whole(self):
        world = hookpoint.loads(FALLING[:FALLING.rindex("}")] + "Force push { body = ball.base; } }\n")
        place = world["ball.base.location"]
        np.testing.assert_array_equal(place, [0, 0, 1])
        place[:] = 7
        np.testing.assert_array_equal(world["w.ball.base.location"], [0, 0, 1])
        self.assertEqual(world["ball.base.orientation"].tolist(), [1, 0, 0, 0])
        self.assertIs(type(world["ball.base.location.z"]), float)
        world["push.force"] = [2, 0, 4.]
        np.testing.assert_array_equal(world["push.force"], [2, 0, 4])
        with self.assertRaisesRegex(hookpoint.Error, "takes 3 numbers"):
            world["push.force"] = 1.
        with self.assertRaisesRegex(hookpoint.Error, "read, not written"):
            world["ball.base.location"] = [0, 0, 0]
        trace = world.run(0.1, record=["ball.base.velocity", "ball.base.location.z"], every=10)
        self.assertEqual((trace["ball.base.velocity"].shape, trace["ball.base.location.z"].shape), ((11, 3), (11,)))
        np.testing.assert_allclose(trace["ball.base.velocity"], np.outer(trace["time"], [1, 0, 2 - 10]), atol=1e-12)
        one = world.run(0.1, record="ball.base.velocity")
        self.assertEqual(list(one), ["time", "ball.base.velocity"])

    def test_a_recorded_vector_is_written_as_the_command_writes_it(self):
        with tempfile.TemporaryDirectory() as folder:
            place = pathlib.Path(folder)
            (place / "scene.hook").write_text(FALLING)
            subprocess.run([PROGRAM, "run", place / "scene.hook", "--out", place / "command", "--record", "ball.base.location"], check=True,
                           capture_output=True)
            hookpoint.load(place / "scene.hook").run(record="ball.base.location", output=place / "python")
            self.assertEqual((place / "python" / "trace.csv").read_bytes(), (place / "command" / "trace.csv").read_bytes())

    def test_a_port_is_listed_once(self):
        trails = [trail for trail, _, _ in hookpoint.loads(ZOO).ports()]
        self.assertEqual(len(trails), len(set(trails)))
        self.assertIn("w.r.trunk.location.x", trails)

    def test_what_is_shown_of_an_object_says_what_it_is(self):
        world = hookpoint.loads(FALLING)
        world.step(100)
        self.assertEqual(repr(world), "<hookpoint.World w: engine dts, 1 robot, deltat 0.001 s, at 0.1 s of 0.5 s>")
        batch = hookpoint.Batch(FALLING, 3, threads=2, observations="ball.base.location")
        self.assertEqual(repr(batch), "<hookpoint.Batch of 3 worlds: world w, engine dts, deltat 0.001 s, 3 observations, 0 actions, 2 threads>")
        self.assertEqual(repr(world.dynamics()), "<hookpoint.RobotDynamics of 1 bodies, 6 coordinates, 2 kg>")

    def test_unknown_names_are_errors_of_hookpoint(self):
        world = hookpoint.loads(FALLING)
        for ask in (lambda: world["nobody.base.location"], lambda: world.dynamics("bal"), lambda: world.dynamics().jacobian("bas")):
            with self.assertRaises(hookpoint.Error):
                ask()


# Each of its 2 seeds has another height.
SEEDED = """Param seed = 1;
World w {
  gravity = 10; deltat = 1 ms; duration = 0.5 s;
  Robot ball { Base.mobile { location = 0, 0, seed; mass = 2; Shape.Sphere radius = 0.1; } }
}
"""

SOIL = """Param k = 10 kN/m;
World w {
  gravity = 10; deltat = 0.5 ms; duration = 2 s;
  Terrain.Flat ground { material = soil; }
  Robot p { Base.mobile { location = 0, 0, 0; mass = 1; inertia = 1, 1, 1, 0, 0, 0; ContactPoint tip { location = 0, 0, 0; } } }
}
Material soil { normal_stiffness = k; normal_damping = 200; }
"""


class BatchOfDifferentWorlds(unittest.TestCase):
    def test_each_world_has_its_own_constants(self):
        stiffness = [4e3, 1e4, 2e4, 4e4]
        columns = ["p.base.location", "p.base.velocity.z"]
        batch = hookpoint.Batch(SOIL, 4, set=[{"k": k} for k in stiffness], observations=columns, threads=2)
        for _ in range(10):
            observed, _ = batch.step(count=300)
        # At rest a spring k carries m g.
        np.testing.assert_allclose(observed[:, 2], [-10 / k for k in stiffness], rtol=1e-6)
        for i, k in enumerate(stiffness):
            world = hookpoint.loads(SOIL, set={"k": k})
            world.step(3000)
            self.assertEqual(batch.state(i), world.state())

    def test_a_reset_gives_others(self):
        batch = hookpoint.Batch(SOIL, 3, observations="p.base.location.z", set={"w.deltat": 4e-4})
        batch.step(count=2000)
        rows = batch.reset([True, False, True], set=[{"soil.normal_stiffness": 2e4}, {"soil.normal_stiffness": 7}, {"w.gravity": 5}],
                           state={"p.base.location": [[0, 0, 0.02], [0, 0, 9], [0, 0, 0.03]]})
        np.testing.assert_allclose(rows[:, 0], [0.02, -1e-3, 0.03], rtol=1e-6)
        np.testing.assert_allclose(batch.time, [0, 0.8, 0])
        batch.step(count=5000)
        np.testing.assert_allclose(batch.observations[:, 0], [-10 / 2e4, -10 / 1e4, -5 / 1e4], rtol=1e-6)
        # What was changed stays, and the state of time 0 is the file's again.
        self.assertEqual(batch.reset()[0, 0], 0.)
        batch.step(count=5000)
        np.testing.assert_allclose(batch.observations[:, 0], [-10 / 2e4, -10 / 1e4, -5 / 1e4], rtol=1e-6)
        world = hookpoint.loads(SOIL, set={"w.deltat": 4e-4, "soil.normal_stiffness": 2e4})
        world.step(5000)
        self.assertEqual(batch.state(0), world.state())

    def test_each_world_starts_where_it_is_put(self):
        rows = np.array([[0, 0, 1.], [0, 1, 2], [1, 0, 3]])
        speeds = np.array([0.5, -0.5, 2])
        for engine in [None, *ENGINES]:
            # In single precision each of 100 steps rounds by up to two units in the last place of a speed of 2 m/s.
            rounding = 1e-6 if PRECISION.get(engine, "double") == "double" else 100 * 2 * 2.4e-7
            batch = hookpoint.Batch(FALLING, 3, observations=["ball.base.location", "ball.base.velocity"], threads=2, engine=engine)
            observed = batch.reset(state={"ball.base.location": rows, "ball.base.velocity.z": speeds, "ball.base.angular_velocity": [0, 0, 1]})
            np.testing.assert_array_equal(observed[:, :3], rows)
            np.testing.assert_array_equal(observed[:, 5], speeds)
            observed, _ = batch.step(count=100)
            np.testing.assert_allclose(observed[:, 5], speeds - 1, atol=rounding)
            np.testing.assert_allclose(observed[:, 2], rows[:, 2] + 0.1 * speeds - 5 * 0.01, atol=2e-3)
            if engine is None:
                for i in range(3):
                    world = hookpoint.loads(FALLING)
                    world.reset(state={"ball.base.location": rows[i], "ball.base.velocity.z": speeds[i], "ball.base.angular_velocity": [0, 0, 1]})
                    world.step(100)
                    self.assertEqual(batch.state(i), world.state())
            observed = batch.reset([False, True, False])
            np.testing.assert_allclose(batch.time, [0.1, 0, 0.1])
            np.testing.assert_array_equal(observed[1, :3], [0, 0, 1])

    def test_seeds_drive_the_param_of_that_name(self):
        batch = hookpoint.Batch(SEEDED, 3, seeds=[3, 5, 3], observations="ball.base.location.z")
        self.assertEqual(batch.observations[:, 0].tolist(), [3, 5, 3])
        self.assertEqual(batch.seeds.tolist(), [3, 5, 3])
        self.assertEqual(batch.reset(seeds=[3, 6, 7], mask=[True, True, False])[:, 0].tolist(), [3, 6, 3])
        self.assertEqual(batch.state(1), hookpoint.loads(SEEDED, set={"seed": 6, "w.seed": 6}).state())
        # One that is set stays.
        self.assertEqual(hookpoint.Batch(SEEDED, 2, seeds=[3, 5], set={"seed": 9}, observations="ball.base.location.z").observations[:, 0].tolist(), [9, 9])

    def test_what_cannot_be_is_refused_and_changes_nothing(self):
        batch = hookpoint.Batch(SOIL, 2, observations="p.base.location.z")
        batch.step(count=100)
        before = [batch.state(i) for i in range(2)]
        for changes, words in (({"set": [{"k": 1e4}]}, "one entry a world: 2, not 1"), ({"seeds": [1, 2, 3]}, "one entry a world: 2, not 3"),
                             ({"set": [{"k": 1e4}, {"kk": 1}]}, "no Param `kk`"), ({"set": {"k": "3 kg"}}, "error"),
                             ({"set": {"w.gravity": "x"}}, "error"), ({"state": {"p.base.location": np.zeros((3, 3))}}, "3 x 3"),
                             ({"state": {"p.base.velocity": [[0, 0, 0], [0, 0, np.inf]]}}, "finite"), ({"mask": [True]}, "one value a world"),
                             ({"set": {"w.p.name": 3}}, "error")):
            with self.subTest(words), self.assertRaisesRegex(hookpoint.Error, words):
                batch.reset(**changes)
            self.assertEqual([batch.state(i) for i in range(2)], before)
        for wrong in (5, "x", [5, 6]):
            with self.assertRaises(TypeError):
                batch.reset(set=wrong)
        many = "Param n = 1;\n" + FALLING.replace("Robot ball {", "For i in 1..n { Robot ball[i] {").replace("radius = 0.1; } }", "radius = 0.1; } } }")
        with self.assertRaisesRegex(hookpoint.Error, "the same bodies"):
            hookpoint.Batch(many, 2, set=[{"n": 1}, {"n": 2}])

    def test_a_param_without_a_default_is_given_to_each(self):
        required = SOIL.replace("Param k = 10 kN/m;", "Param k;")
        batch = hookpoint.Batch(required, 2, set=[{"k": 1e4}, {"k": 2e4}], observations="p.base.location.z", engine="dts")
        batch.step(count=4000)
        np.testing.assert_allclose(batch.observations[:, 0], [-1e-3, -5e-4], rtol=1e-6)
        self.assertEqual(hookpoint.loads(required, set={"k": 1e4}, engine="ode").engine, "ode")

    def test_steps_of_different_length_are_a_notice(self):
        with self.assertWarnsRegex(UserWarning, "steps of different length, from 0.0002 s to 0.0005 s"):
            batch = hookpoint.Batch(SOIL, 3, set=[{}, {"w.deltat": "0.2 ms"}, {}])
        self.assertEqual(len(batch.notices), 1)
        batch.step(count=10)
        np.testing.assert_allclose(batch.time, [5e-3, 2e-3, 5e-3])
        batch.reset(set={"w.deltat": "0.3 ms"})
        self.assertEqual(batch.notices, [])

    def test_the_first_wrong_world_is_named(self):
        with self.assertRaises(hookpoint.FileError) as caught:
            hookpoint.Batch(SOIL, 40, set=[{"k": 1e4 if i < 35 else f"{i} kg"} for i in range(40)], threads=2)
        self.assertIn("35 kg", str(caught.exception))


UNSTABLE = """Material f { }
World w {
  gravity = 9.81; deltat = 1 ms; duration = 1 s;
  Terrain.Flat ground { material = f; }
  Robot box { Base.mobile { orientation = 0.05, 0.03, 0; location = 0, 0, 0.06; Shape.Box { dimensions = 0.2, 0.2, 0.1; mass = 1 kg; } } }
}
"""


def messages(caught):
    return [str(each.message) for each in caught]


class Notices(unittest.TestCase):
    def test_an_unstable_step_is_a_warning_as_of_the_command(self):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            world = hookpoint.loads(UNSTABLE)
            self.assertEqual(len(caught), 1)
            world.run(1)
        self.assertEqual(world.notices, messages(caught))
        self.assertTrue(all(each.category is UserWarning for each in caught))
        self.assertRegex(world.notices[0], "deltat 0.001 s is above the largest stable step")
        self.assertRegex(world.notices[1], "its energy rose by more than was put in, by .* J")
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "box.hook").write_text(UNSTABLE)
            printed = subprocess.run([PROGRAM, "run", "box.hook"], cwd=folder, capture_output=True, text=True).stderr
        self.assertEqual(printed.count("warning:"), 2)
        self.assertIn(world.notices[1], printed)
        world.reset()
        self.assertEqual(world.notices, messages(caught)[:1])

    def test_a_batch_warns_once_of_many_worlds(self):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            batch = hookpoint.Batch(UNSTABLE, 3)
            batch.step(count=1000)
        self.assertEqual(len(caught), 2)
        self.assertRegex(messages(caught)[0], "^deltat 0.001 s is above")
        self.assertRegex(messages(caught)[1], "^worlds 0, 1, 2: its energy rose by more than was put in")
        self.assertEqual(len(batch.notices), 4)
        self.assertTrue(batch.notices[3].startswith("world 2: its energy rose"))
        batch.reset([True, False, False])
        self.assertEqual(len(batch.notices), 3)
        # One world of its own constants.
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            hookpoint.Batch(SOIL, 3, set=[{"k": 1e4}, {"k": 1e8}, {"k": 1e4}])
        self.assertEqual(len(caught), 1)
        self.assertRegex(messages(caught)[0], "^world 1: deltat 0.0005 s is above")

    def test_a_stable_or_driven_world_says_nothing(self):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            hookpoint.loads(SOIL).run(1)
            hookpoint.Batch(SOIL, 2).step(count=1000)
            pushed = hookpoint.loads(FALLING[:FALLING.rindex("}")] + "Force push { body = ball.base; } }\n")
            pushed["push.force.z"] = 100.
            pushed.run(0.5)
            self.assertEqual(pushed.notices, [])

    def test_what_the_engine_says_is_a_warning(self):
        left = UNSTABLE.replace("Terrain.Flat ground {", "Terrain.Flat ground { size = 1;").replace("deltat = 1 ms", "deltat = 0.1 ms")
        world = hookpoint.loads(left)
        with self.assertWarnsRegex(UserWarning, "terrain|ground"):
            world.reset(state={"box.base.location": [0.3, 0, 0.06], "box.base.velocity": [4, 0, 0.5]})
            world.run(0.5)
        self.assertTrue(any("box" in notice for notice in world.notices))


if __name__ == "__main__":
    unittest.main()
