"""An environment in the manner of Gymnasium: the hexapod is steered over level ground.

    python3 walking_env.py

steers to a goal with a proportional controller. Gymnasium is not needed; where it is installed, `WalkingEnv` is a gymnasium.Env with its
spaces, and may be wrapped and checked as any other.
"""
import math
import pathlib

import numpy as np

import hookpoint

try:
    import gymnasium
except ImportError:
    gymnasium = None

SCENE = pathlib.Path(__file__).resolve().parents[2] / "configs" / "scenes" / "walking_hexapod.hook"


class WalkingEnv(gymnasium.Env if gymnasium else object):
    """Walk to a goal: one step is `period` seconds of walking.

    Action: forward speed and turn rate of the gait, as parts of their largest values, each in [-1, 1].
    Observation: the goal in the base's axes [m] (x ahead, y left), the base's forward speed [m/s] and its turn rate [rad/s].
    Reward: by how much the base came nearer to the goal [m]. An episode terminates within `reach` of the goal, or when the base has tipped
    by more than 60 deg, and is truncated after `steps` steps.
    """

    metadata = {"render_modes": []}
    largest_speed = 0.1  # m/s
    largest_turn = 0.5  # rad/s

    def __init__(self, scene=SCENE, period=0.1, steps=100, reach=0.05):
        self.world = hookpoint.load(scene)
        self.stride = round(period / self.world.deltat)
        self.steps, self.reach = steps, reach
        view = self.world.view
        self._place, self._velocity = view("hexapod.base.location"), view("hexapod.base.velocity")
        self._orientation, self._spin = view("hexapod.base.orientation"), view("hexapod.base.angular_velocity")
        self._forward, self._turn = view("world.gait.forward"), view("world.gait.turn")
        self._random = np.random.default_rng()
        self.goal = np.zeros(2)
        if gymnasium:
            self.action_space = gymnasium.spaces.Box(-1., 1., (2,), np.float64)
            self.observation_space = gymnasium.spaces.Box(-np.inf, np.inf, (4,), np.float64)

    def reset(self, *, seed=None, options=None):
        """Puts the hexapod back and draws a goal; `options={"goal": (x, y)}` gives one. The same seed gives the same goals."""
        if gymnasium:
            super().reset(seed=seed)
        if seed is not None:
            self._random = np.random.default_rng(seed)
        self.world.reset()
        angle = self._random.uniform(-math.pi / 3, math.pi / 3)
        self.goal = np.array((options or {}).get("goal", (0.4 * math.cos(angle), 0.4 * math.sin(angle))), dtype=float)
        self._taken = 0
        self._distance = self._distance_left()
        return self._observe(), {}

    def step(self, action):
        forward, turn = np.clip(np.asarray(action, dtype=float), -1., 1.)
        self._forward[()], self._turn[()] = forward * self.largest_speed, turn * self.largest_turn
        self.world.step(self.stride)
        self._taken += 1
        before, self._distance = self._distance, self._distance_left()
        _, x, y, _ = self._orientation
        tipped = 1 - 2 * (x * x + y * y) < math.cos(math.radians(60))
        arrived = self._distance < self.reach
        return (self._observe(), before - self._distance, bool(arrived or tipped), self._taken >= self.steps,
                {"arrived": bool(arrived), "distance": self._distance})

    def _distance_left(self):
        return math.hypot(*(self.goal - self._place[:2]))

    def _observe(self):
        w, x, y, z = self._orientation
        heading = math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))
        cos, sin = math.cos(heading), math.sin(heading)
        ahead, left = self.goal - self._place[:2]
        vx, vy, _ = self._velocity
        return np.array([cos * ahead + sin * left, cos * left - sin * ahead, cos * vx + sin * vy, self._spin[2]])


def steer(observation):
    """Turns towards the goal, and walks the faster the more it lies ahead."""
    bearing = math.atan2(observation[1], observation[0])
    return np.array([max(0., math.cos(bearing)), np.clip(2 * bearing, -1, 1)])


def main():
    env = WalkingEnv()
    observation, _ = env.reset(seed=1)
    total, over = 0., False
    while not over:
        observation, reward, terminated, truncated, told = env.step(steer(observation))
        total += reward
        over = terminated or truncated
    print(f"goal {env.goal[0]:.2f}, {env.goal[1]:.2f} m; {'arrived' if told['arrived'] else 'not there'} after {env.world.time:.1f} s, {total:.3f} m nearer")


if __name__ == "__main__":
    main()
