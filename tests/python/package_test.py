"""The module as a package: its wheel, its types, its page and its example."""
import ast
import importlib.util
import inspect
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
import zipfile

import numpy as np

import hookpoint

SOURCE = pathlib.Path(os.environ["HOOKPOINT_SOURCE_DIR"])
BUILD = os.environ["HOOKPOINT_BUILD_DIR"]
STUBS = SOURCE / "apps/python" / "hookpoint-stubs" / "__init__.pyi"


def module_from(path):
    spec = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def signature_of_stub(function):
    """[(name, kind, default)] of a function in the stubs, without self."""
    arguments = function.args
    plain = arguments.posonlyargs + arguments.args
    defaults = [None] * (len(plain) - len(arguments.defaults)) + arguments.defaults
    listed = [(each.arg, "plain", default) for each, default in zip(plain, defaults)]
    listed += [(each.arg, "keyword", default) for each, default in zip(arguments.kwonlyargs, arguments.kw_defaults)]
    return [(name, kind, default and (ast.literal_eval(default),)) for name, kind, default in listed if name != "self"]


def signature_of_module(function):
    """The same of pybind11's: the first line of the docstring is Python but for the types of C++."""
    line = function.__doc__.splitlines()[0]
    return signature_of_stub(ast.parse(f"def {line}: ...").body[0])


class Stubs(unittest.TestCase):
    def setUp(self):
        self.tree = ast.parse(STUBS.read_text())

    def functions(self):
        """(name, what the module has, the stub)."""
        for node in self.tree.body:
            if isinstance(node, ast.FunctionDef):
                yield node.name, getattr(hookpoint, node.name), node
            if isinstance(node, ast.ClassDef):
                for inner in node.body:
                    if isinstance(inner, ast.FunctionDef):
                        yield f"{node.name}.{inner.name}", getattr(getattr(hookpoint, node.name), inner.name), inner

    def test_say_what_the_module_has(self):
        for name, known, stub in self.functions():
            with self.subTest(name):
                if isinstance(known, property):
                    self.assertEqual(ast.unparse(stub.decorator_list[0]), "property")
                    self.assertTrue(known.__doc__)
                    continue
                self.assertEqual(stub.decorator_list, [])
                self.assertEqual(signature_of_stub(stub), signature_of_module(known))

    def test_leave_nothing_out(self):
        told = {name for name, _, _ in self.functions()}
        classes = {node.name for node in self.tree.body if isinstance(node, ast.ClassDef)}
        for name, value in vars(hookpoint).items():
            if name.startswith("_"):
                continue
            if inspect.isclass(value):
                self.assertIn(name, classes)
                self.assertTrue(value.__doc__)
                own = set()
                if value.__module__ == "hookpoint" and not issubclass(value, Exception):
                    # What pybind11 adds itself, since 2.12, is none of the module's.
                    own = {inner for inner in vars(value) if not inner.startswith(("__", "_pybind11_"))}
                self.assertEqual({f"{name}.{inner}" for inner in own} - told, set())
            else:
                self.assertIn(name, told)
                self.assertGreater(len(value.__doc__.splitlines()), 2, name)


class Wheel(unittest.TestCase):
    def test_has_the_module_and_its_types(self):
        with tempfile.TemporaryDirectory() as folder:
            backend = module_from(SOURCE / "apps/python" / "packaging" / "cmake_wheel.py")
            self.assertEqual(backend.version(), hookpoint.__version__)
            name = backend.build_wheel(folder, {"build-dir": BUILD})
            with zipfile.ZipFile(pathlib.Path(folder) / name) as wheel:
                self.assertEqual(wheel.read(pathlib.Path(hookpoint.__file__).name), pathlib.Path(hookpoint.__file__).read_bytes())
                self.assertEqual(wheel.read("hookpoint-stubs/__init__.pyi"), STUBS.read_bytes())

    @unittest.skipUnless(importlib.util.find_spec("pip"), "pip is not installed")
    def test_pip_installs_it_without_a_network(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([sys.executable, "-m", "pip", "install", "--no-index", "--no-build-isolation", "--no-deps", "--quiet",
                            "--config-settings", f"build-dir={BUILD}", "--target", folder, SOURCE], check=True, capture_output=True)
            there = subprocess.run([sys.executable, "-c", "import hookpoint; print(hookpoint.__file__, hookpoint.load('scene.hook').time)"],
                                   cwd=self.scene(folder), env={**os.environ, "PYTHONPATH": folder}, check=True, capture_output=True, text=True)
        self.assertEqual(there.stdout.split(), [str(pathlib.Path(folder) / pathlib.Path(hookpoint.__file__).name), "0.0"])

    @staticmethod
    def scene(folder):
        place = pathlib.Path(folder) / "elsewhere"
        place.mkdir()
        (place / "scene.hook").write_text("World w { Robot b { Base.mobile { Shape.Sphere { radius = 1; mass = 1; } } } }")
        return place


class Page(unittest.TestCase):
    def test_every_example_runs(self):
        blocks = re.findall(r"^```python\n(.*?)^```", (SOURCE / "docs" / "python.md").read_text(), re.DOTALL | re.MULTILINE)
        self.assertGreater(len(blocks), 5)
        before = os.getcwd()
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            (pathlib.Path(folder) / "configs").symlink_to(SOURCE / "configs")
            try:
                names = {}
                for number, block in enumerate(blocks):
                    exec(compile(block, f"docs/python.md, example {number + 1}", "exec"), names)
            finally:
                os.chdir(before)
        self.assertEqual((names["world"].time, names["branch"].time), (2., 2.))
        times = names["batch"].time.tolist()
        self.assertEqual((times[0], times[-1]), (2., 0.))
        self.assertTrue(names["found"]["holds"])


class Example(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.example = module_from(SOURCE / "examples" / "python" / "walking_env.py")

    def episode(self, env, steps, **reset):
        rows = [env.reset(**reset)[0]]
        for _ in range(steps):
            rows.append(env.step(self.example.steer(rows[-1]))[0])
        return np.array(rows)

    def test_steers_to_its_goal(self):
        env = self.example.WalkingEnv()
        observation, _ = env.reset(seed=1, options={"goal": (0.2, 0.1)})
        np.testing.assert_allclose(observation, [0.2, 0.1, 0, 0], atol=1e-12)
        total, over = 0., False
        while not over:
            observation, reward, terminated, truncated, told = env.step(self.example.steer(observation))
            total += reward
            over = terminated or truncated
        self.assertTrue(told["arrived"])
        # Rewards add up to the way made good.
        self.assertAlmostEqual(total, math.hypot(0.2, 0.1) - told["distance"], places=12)
        self.assertLess(told["distance"], env.reach)

    def test_an_episode_repeats(self):
        env = self.example.WalkingEnv()
        first = self.episode(env, 5, seed=3)
        again = self.episode(env, 5, seed=3)
        np.testing.assert_array_equal(again, first)
        np.testing.assert_array_equal(self.episode(self.example.WalkingEnv(), 5, seed=3), first)
        self.assertFalse(np.array_equal(self.episode(env, 5, seed=4), first))

    def test_standing_still_is_truncated(self):
        env = self.example.WalkingEnv(steps=2)
        env.reset(seed=1)
        self.assertEqual([env.step([0., 0.])[2:4] for _ in range(2)], [(False, False), (False, True)])


if __name__ == "__main__":
    unittest.main()
