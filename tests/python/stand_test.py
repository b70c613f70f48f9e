"""examples/python/stand.py: what the feet carry, where the body goes, and the shares of its forces against the optimum's conditions."""
import importlib.util
import os
import pathlib
import unittest

import numpy as np

SOURCE = pathlib.Path(os.environ["HOOKPOINT_SOURCE_DIR"])


def example():
    spec = importlib.util.spec_from_file_location("stand", SOURCE / "examples" / "python" / "stand.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


class NonNegativeLeastSquares(unittest.TestCase):
    def test_meets_the_conditions_of_the_optimum(self):
        random = np.random.default_rng(5)
        for rows, columns in ((6, 4), (18, 16), (5, 9)):
            A, b = random.normal(size=(rows, columns)), random.normal(size=rows)
            x = example().non_negative_least_squares(A, b)
            slope = A.T @ (b - A @ x)
            self.assertGreaterEqual(x.min(), 0)
            self.assertLess(slope.max(), 1e-8, "no part that would fall by growing")
            self.assertLess(np.abs(slope[x > 0]).max(initial=0), 1e-8, "nothing to gain from those that are there")


class Stands(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.stand = example().Stand()
        cls.stand.run(1.0)

    def test_its_feet_carry_it(self):
        """Newton and Euler: at rest the ground's forces are the weight and have no moment about the centre of mass."""
        stand = self.stand
        robot = stand.world.dynamics()
        np.testing.assert_allclose(stand.ground_force(), [0, 0, 9.81 * robot.mass], atol=1e-3 * 9.81 * robot.mass)
        moment = sum(np.cross(foot[:, 0] - robot.center_of_mass, force) for foot, force in zip(stand._feet(robot), stand._ground))
        np.testing.assert_allclose(moment, 0, atol=1e-3 * 9.81 * robot.mass * 0.3)
        np.testing.assert_allclose(stand.forces, stand._ground, atol=0.02 * 9.81 * robot.mass)
        self.assertLess(np.linalg.norm(stand.center() - stand.goal), 2e-4)

    def test_withstands_a_push_within_friction_and_follows_commands(self):
        stand = self.stand
        mass = stand.world.dynamics().mass
        stand.push[:] = 0.0, 25.0, 0.0
        farthest, friction = stand.run(0.2)
        stand.push[:] = 0.0
        # An impulse of F t on m against a spring k and a damper c, per mass, moves it by less than F/(m k).
        self.assertLess(farthest, 25.0 / (mass * stand.stiffness))
        self.assertGreater(farthest, 0.3 * 25.0 / (mass * stand.stiffness))
        self.assertLess(friction, 0.7)
        stand.command(height=-0.04, roll=0.1, pitch=-0.08)
        stand.run(1.2)
        np.testing.assert_allclose(stand.center(), stand.goal, atol=5e-4)
        np.testing.assert_allclose(stand.lean(), [0.1, -0.08], atol=2e-3)


if __name__ == "__main__":
    unittest.main()
