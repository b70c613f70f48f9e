"""World.dynamics against closed forms and against how the world moves."""
import os
import pathlib
import unittest

import numpy as np

import hookpoint

CONFIGS = pathlib.Path(os.environ["HOOKPOINT_SOURCE_DIR"]) / "configs"

# A point of 2 kg on a massless rod of 0.5 m, with a spring and a damper in the joint.
PENDULUM = """World w {
  gravity = 10; deltat = 1 ms; duration = 1 s;
  Robot pendulum {
    Base.fixed;
    Chain arm {
      Link rod {
        dhtwist = 90 deg; mass = 2; center_of_mass = 0.5, 0, 0; inertia = 0, 0, 0, 0, 0, 0;
        angle = -90 deg; stiffness = 3; rest_angle = -90 deg; damping = 0.4;
      }
    }
  }
}
"""

TWO_BODIES = """World w {
  gravity = 9.81; deltat = 0.1 ms; duration = 1 s;
  Robot robot {
    Base.mobile { location = 0.1, 0.2, 3; mass = 4; inertia = 0.2, 0.3, 0.4, 0, 0, 0; velocity = 1, 2, 3; angular_velocity = 0.3, -0.2, 0.5; }
    Chain arm {
      hip_distance = 0.2, 0.1, 0;
      Link upper { dhtwist = 30 deg; mass = 1; center_of_mass = 0.2, 0, 0; inertia = 0.01, 0.02, 0.02, 0, 0, 0; angle = 20 deg; rate = 1; }
      Link fore { dhlength = 0.4; mass = 0.5; center_of_mass = 0.1, 0, 0; inertia = 0.01, 0.02, 0.02, 0, 0, 0; angle = 40 deg; rate = -2; }
    }
  }
}
"""


class Pendulum(unittest.TestCase):
    def test_is_that_of_the_textbook(self):
        dynamics = hookpoint.loads(PENDULUM).dynamics()
        m, l, g = 2.0, 0.5, 10.0
        self.assertEqual(dynamics.coordinates, [("pendulum.arm.rod.rate", "rad/s")])
        self.assertEqual(dynamics.bodies, ["base", "arm.rod"])
        np.testing.assert_allclose(dynamics.mass_matrix, [[m * l * l]], rtol=1e-12)
        np.testing.assert_allclose(dynamics.gravity_forces, [0], atol=1e-12)
        np.testing.assert_allclose(dynamics.center_of_mass, [0, 0, -l], atol=1e-12)
        A, B = dynamics.linearise()
        np.testing.assert_allclose(A, [[0, 1], [-g / l - 3 / (m * l * l), -0.4 / (m * l * l)]], rtol=1e-8, atol=1e-8)
        np.testing.assert_allclose(B, [[0], [1 / (m * l * l)]], rtol=1e-12)

    def test_held_sideways_takes_its_weight(self):
        world = hookpoint.loads(PENDULUM, set={"w.pendulum.arm.rod.angle": 0})
        np.testing.assert_allclose(world.dynamics().gravity_forces, [2 * 10 * 0.5], rtol=1e-12)


class Free(unittest.TestCase):
    def setUp(self):
        self.world = hookpoint.loads(TWO_BODIES)

    def test_jacobians_tell_how_its_points_move(self):
        dynamics = self.world.dynamics("robot")
        v = np.array([self.world["w." + trail] for trail, _ in dynamics.coordinates])
        point = np.array([0.1, 0.2, 0.3])
        spatial = dynamics.jacobian("arm.fore", point) @ v
        trail = "w.robot.arm.fore."
        w = [self.world[trail + "angular_velocity." + axis] for axis in "xyz"]
        np.testing.assert_allclose(spatial[:3], w, rtol=1e-12)
        at_origin = dynamics.jacobian("arm.fore") @ v
        q = np.array([self.world[trail + "orientation." + part] for part in "wxyz"])
        arm = point + 2 * np.cross(q[1:], np.cross(q[1:], point) + q[0] * point)
        np.testing.assert_allclose(spatial[3:], at_origin[3:] + np.cross(w, arm), rtol=1e-12)

    def test_without_forces_falls_as_bias_forces_say(self):
        world = hookpoint.loads(TWO_BODIES.replace("deltat", "integrator = explicit_euler; deltat", 1))
        dynamics = world.dynamics()
        names = [trail for trail, _ in dynamics.coordinates]
        before = np.array([world["w." + name] for name in names])
        predicted = np.linalg.solve(dynamics.mass_matrix, -dynamics.bias_forces)
        world.step()
        after = np.array([world["w." + name] for name in names])
        # Explicit Euler: v + dt v' of the state before.
        np.testing.assert_allclose((after - before) / world.deltat, predicted, rtol=1e-8, atol=1e-8)

    def test_its_centre_of_mass_falls_freely(self):
        start = self.world.dynamics()
        v = np.array([self.world["w." + trail] for trail, _ in start.coordinates])
        velocity = start.center_of_mass_jacobian @ v
        self.assertAlmostEqual(start.mass, 5.5)
        self.world.step(1000)
        t = self.world.time
        expected = start.center_of_mass + velocity * t + [0, 0, -9.81 * t * t / 2]
        np.testing.assert_allclose(self.world.dynamics().center_of_mass, expected, atol=1e-3)

    def test_linear_motion_is_the_tangent_of_the_nonlinear_one(self):
        dynamics = self.world.dynamics()
        A, B = dynamics.linearise([0.5, -0.2])
        n = len(dynamics.coordinates)
        self.assertEqual((A.shape, B.shape), ((2 * n, 2 * n), (2 * n, 2)))
        # Of a joint's rate: two worlds that differ in it alone.
        d = 1e-5
        accelerations = []
        for rate in (1 - d, 1 + d):
            other = hookpoint.loads(TWO_BODIES, set={"w.robot.arm.upper.rate": rate}).dynamics()
            tau = np.array([0] * 6 + [0.5, -0.2])
            accelerations.append(np.linalg.solve(other.mass_matrix, tau - other.bias_forces))
        np.testing.assert_allclose(A[n:, n + 6], (accelerations[1] - accelerations[0]) / (2 * d), rtol=1e-6, atol=1e-6)

    def test_a_name_that_is_none_is_refused(self):
        with self.assertRaisesRegex(hookpoint.Error, "did you mean `arm.fore`"):
            self.world.dynamics().jacobian("arm.for")
        with self.assertRaisesRegex(hookpoint.Error, "no robot `robo`; did you mean `robot`"):
            self.world.dynamics("robo")
        with self.assertRaisesRegex(hookpoint.Error, "2 joints: 1 torques"):
            self.world.dynamics().linearise([1])


class Engines(unittest.TestCase):
    def test_a_peers_robot_has_them_too(self):
        ours = hookpoint.loads(TWO_BODIES).dynamics()
        theirs = hookpoint.loads(TWO_BODIES, engine="bullet").dynamics()
        np.testing.assert_allclose(theirs.mass_matrix, ours.mass_matrix, rtol=1e-9, atol=1e-9)

    def test_a_hexapods_feet_carry_its_weight(self):
        world = hookpoint.load(CONFIGS / "scenes/standing_hexapod.hook")
        dynamics = world.dynamics()
        np.testing.assert_allclose(dynamics.gravity_forces[3:6], [0, 0, dynamics.mass * 9.81], rtol=1e-10, atol=1e-9)
        self.assertTrue(np.all(np.linalg.eigvalsh(dynamics.mass_matrix) > 0))


if __name__ == "__main__":
    unittest.main()
