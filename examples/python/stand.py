"""A quadruped that stands by a controller of its whole body, at 500 Hz.

    python3 stand.py

stands, is pushed, lowers and leans its body, and prints what came of it. At each update the centre of mass and the body's turn are given
accelerations by a PD law; the velocities' rates v' that do this while the feet stay follow from the Jacobians; the six equations of the
base, whose joints are none, say what the feet's forces must be together, and non-negative least squares shares them out within friction
pyramids; the joints give what is left of M v' + h = S tau + J^T f. (Wensing et al. 2024, "Optimization-Based Control for Dynamic Legged
Robots".)
"""
import math

import numpy as np

import hookpoint

SCENE = """
World world {
  gravity = 9.81; deltat = 0.25 ms; duration = 10 s;
  Include "materials/rigid_floor.hook" (load = 30 N, allowance = 3 mm, damping_ratio = 0.5);
  Terrain.Flat ground { material = rigid_floor; }
  Robot quadruped {
    Base.mobile { rest_on = ground; Shape.Box { dimensions = 0.45, 0.2, 0.1; mass = 6 kg; } }
    Include "robots/quadruped_legs.hook";
  }
  Force push { body = quadruped.base; force = 0, 0, 0; }
}
"""
LEGS, JOINTS = 4, ("hip", "thigh", "shank")
FOOT = (0.2, 0., 0.)  # in the shank's axes [m]
MU = 0.6              # of the pyramids: some of the ground's 0.7 is kept


def non_negative_least_squares(A, b):
    """x >= 0 with the least |A x - b|: the active-set method of Lawson & Hanson (1974), chapter 23."""
    x, free = np.zeros(A.shape[1]), np.zeros(A.shape[1], dtype=bool)
    tolerance = 1e-10 * (np.abs(A).max() * np.abs(b).max() + 1e-300)
    for _ in range(3 * A.shape[1]):
        slope = A.T @ (b - A @ x)
        if free.all() or slope[~free].max() <= tolerance:
            break
        free[np.argmax(np.where(free, -np.inf, slope))] = True
        while True:
            s = np.zeros_like(x)
            s[free] = np.linalg.lstsq(A[:, free], b, rcond=None)[0]
            below = free & (s <= 0)
            if not below.any():
                break
            part = np.min(x[below] / (x[below] - s[below] + 1e-300))
            x += part * (s - x)
            free &= x > 1e-12
            x[~free] = 0
        x = s
    return x


def rotation_vector(q):
    """Of the turn that the quaternion w, x, y, z is: axis times angle [rad]."""
    q = np.asarray(q) * (1. if q[0] >= 0 else -1.)
    sine = np.linalg.norm(q[1:])
    return q[1:] * (2. * math.atan2(sine, q[0]) / sine if sine > 0 else 2.)


def product(a, b):
    """Of two quaternions."""
    w, v, s, u = a[0], a[1:], b[0], b[1:]
    return np.concatenate(([w * s - v @ u], w * u + s * v + np.cross(v, u)))


class Stand:
    """Stands on its four feet. `command` says where; `step` runs the world for one update of the controller."""
    period = 0.002                          # s
    stiffness, damping = 120., 22.          # of the centre of mass [1/s^2, 1/s]
    turn_stiffness, turn_damping = 150., 24.  # of the body's turn
    least_force = 1e-3  # weight of the forces' own size against the base's equations, so that they are shared out evenly

    def __init__(self, scene=SCENE):
        self.world = hookpoint.loads(scene)
        self._stride = round(self.period / self.world.deltat)
        view = self.world.view
        self._torques = [view(f"world.quadruped.leg[{leg}].{joint}.torque") for leg in range(LEGS) for joint in JOINTS]
        self._ground = [view(f"world.quadruped.leg[{leg}].shank.contact.force") for leg in range(LEGS)]
        self._orientation = view("world.quadruped.orientation")
        self._velocity = [view(f"world.quadruped.{name}") for name in ("angular_velocity", "velocity")]
        self._rates = [view(f"world.quadruped.leg[{leg}].{joint}.rate") for leg in range(LEGS) for joint in JOINTS]
        self.push = view("world.push.force")
        self._last_jacobian = None
        self.forces = np.zeros((LEGS, 3))  # that the controller counts on [N]
        start = self.world.dynamics()
        feet = self._feet(start)[:, :, 0]
        self.goal = np.append(feet[:, :2].mean(axis=0), start.center_of_mass[2])
        self.goal_turn = np.array([1., 0., 0., 0.])
        self._start_height = self.goal[2]

    def command(self, height=0., roll=0., pitch=0.):
        """`height` [m] from where it started; `roll` and `pitch` [rad] of the body."""
        self.goal[2] = self._start_height + height
        about_x = np.array([math.cos(roll / 2), math.sin(roll / 2), 0., 0.])
        about_y = np.array([math.cos(pitch / 2), 0., math.sin(pitch / 2), 0.])
        self.goal_turn = product(about_y, about_x)

    def _feet(self, dynamics):
        """Of each foot its place, as a column, and the Jacobian of its velocity: LEGS x 3 x (1 + n)."""
        feet = []
        for leg in range(LEGS):
            trail = f"world.quadruped.leg[{leg}].shank."
            q, p = self.world.view(trail + "orientation"), self.world.view(trail + "location")
            arm = product(product(q, np.append(0., FOOT)), q * (1, -1, -1, -1))[1:]
            feet.append(np.column_stack((p + arm, dynamics.jacobian(f"leg[{leg}].shank", FOOT)[3:])))
        return np.array(feet)

    def control(self):
        """Writes the joints' torques for the state as it is."""
        robot = self.world.dynamics()
        v = np.concatenate([*self._velocity, [rate[()] for rate in self._rates]])
        J = np.vstack(self._feet(robot)[:, :, 1:])
        bias = np.zeros(len(J)) if self._last_jacobian is None else (J - self._last_jacobian) @ v / self.period
        self._last_jacobian = J
        Jc = robot.center_of_mass_jacobian
        lift = self.stiffness * (self.goal - robot.center_of_mass) - self.damping * Jc @ v
        left = rotation_vector(product(self.goal_turn, self._orientation * (1, -1, -1, -1)))
        turn = self.turn_stiffness * left - self.turn_damping * v[:3]
        # The feet stay, the centre of mass and the body do as they are told: as many equations as coordinates.
        turning = np.eye(len(v))[:3]
        rate = np.linalg.solve(np.vstack((J, Jc, turning)), np.concatenate((-bias, lift, turn)))
        needed = robot.mass_matrix @ rate + robot.bias_forces
        self.forces = self._share(J[:, :6], needed[:6])
        torques = needed[6:] - J[:, 6:].T @ self.forces.ravel()
        for port, torque in zip(self._torques, torques):
            port[()] = torque

    def _share(self, J, needed):
        """Forces of the feet, each a sum of its pyramid's edges, that give the base `needed` (moment, force)."""
        edges = np.array([[MU, 0, 1], [-MU, 0, 1], [0, MU, 1], [0, -MU, 1]]) / math.sqrt(1 + MU * MU)
        pyramids = np.kron(np.eye(LEGS), edges.T)
        A = np.vstack((J.T @ pyramids, self.least_force * pyramids))
        amounts = non_negative_least_squares(A, np.concatenate((needed, np.zeros(3 * LEGS))))
        return (pyramids @ amounts).reshape(LEGS, 3)

    def step(self):
        self.control()
        self.world.step(self._stride)

    def run(self, seconds):
        """Runs on; returns the greatest distance of the centre of mass from its goal [m] and the greatest share of friction
        (horizontal over vertical force of a foot on the ground)."""
        farthest = friction = 0.
        for _ in range(round(seconds / self.period)):
            self.step()
            farthest = max(farthest, np.linalg.norm(self.world.dynamics().center_of_mass - self.goal))
            for force in self._ground:
                if force[2] > 1.:
                    friction = max(friction, math.hypot(force[0], force[1]) / force[2])
        return farthest, friction

    def ground_force(self):
        """Of all feet together [N]."""
        return np.sum(self._ground, axis=0)

    def center(self):
        return self.world.dynamics().center_of_mass

    def lean(self):
        """Roll and pitch of the body [rad]."""
        w, x, y, z = self._orientation
        return math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)), math.asin(2 * (w * y - z * x))


def main():
    stand = Stand()
    weight = 9.81 * stand.world.dynamics().mass
    farthest, friction = stand.run(1.)
    print(f"stands:  the centre of mass goes {1e3 * farthest:.1f} mm to over its feet, {1e3 * np.linalg.norm(stand.center() - stand.goal):.2f} mm off; "
          f"they carry {stand.ground_force()[2]:.3f} N of {weight:.3f} N")
    stand.push[:] = 0., 25., 0.
    farthest, friction = stand.run(0.2)
    stand.push[:] = 0.
    farthest = max(farthest, stand.run(0.2)[0])
    stand.run(1.)
    print(f"pushed:  25 N for 0.2 s move it {1e3 * farthest:.1f} mm, friction used {friction:.2f}; "
          f"then {1e3 * np.linalg.norm(stand.center() - stand.goal):.2f} mm off")
    stand.command(height=-0.04, roll=0.1, pitch=-0.08)
    stand.run(1.5)
    roll, pitch = stand.lean()
    print(f"leans:   {1e3 * (stand.center()[2] - stand.goal[2]):+.2f} mm off a body 40 mm lower, roll {roll:.4f} of 0.1, pitch {pitch:.4f} of -0.08 rad")


if __name__ == "__main__":
    main()
