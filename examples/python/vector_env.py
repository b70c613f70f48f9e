"""Many worlds as a vector environment in the manner of Gymnasium, over `hookpoint.Batch`.

Gymnasium is not needed; where it is installed, `VectorEnv` is a gymnasium.vector.VectorEnv with its spaces. `learn_to_hop.py` and
`tune_trot.py` use it.
"""
import numpy as np

import hookpoint

try:
    import gymnasium
except ImportError:
    gymnasium = None


class VectorEnv(gymnasium.vector.VectorEnv if gymnasium else object):
    """`num_envs` worlds of one file. A step writes the actions and takes `period` seconds.

    An action is in [-1, 1]; the ports `actions` receive center + scale * action. An observation is what `observe` makes of the ports
    `observations` (an array of worlds x numbers), by default the ports themselves. `reward(observation, action, next_observation)` is the
    reward of each world. An episode terminates where `fell(next_observation)` is true, or the world itself has ended, and is truncated
    after `steps` steps; the world then starts again in the same step, and the last observation is in `infos["final_obs"]`, as of
    gymnasium.vector.AutoresetMode.SAME_STEP.

    `start(random, count)` gives initial states as Batch.reset takes them, `settings(random, count)` the settings of each new episode, a list
    of dicts: domain randomisation. The same seed gives the same episodes, whatever the number of threads.
    """

    def __init__(self, file, num_envs, *, observations, actions, scale, center=0., period, steps, reward, fell, observe=None, start=None,
                 settings=None, threads=0):
        self.batch = hookpoint.Batch(file, num_envs, observations=observations, actions=actions, threads=threads)
        self.num_envs, self.steps = num_envs, steps
        self.scale, self.center = np.asarray(scale, dtype=float), np.asarray(center, dtype=float)
        self.count = round(period / self.batch.deltat)
        self._reward, self._fell, self._observe = reward, fell, observe or np.copy
        self._start, self._settings = start, settings
        self._random = np.random.default_rng()
        self._taken = np.zeros(num_envs, dtype=int)
        self._last = self._observe(self.batch.observations)
        if gymnasium:
            size, moves = self._last.shape[1], self.batch.actions.shape[1]
            self.metadata = {"autoreset_mode": gymnasium.vector.AutoresetMode.SAME_STEP}
            self.single_action_space = gymnasium.spaces.Box(-1., 1., (moves,), np.float64)
            self.single_observation_space = gymnasium.spaces.Box(-np.inf, np.inf, (size,), np.float64)
            self.action_space = gymnasium.vector.utils.batch_space(self.single_action_space, num_envs)
            self.observation_space = gymnasium.vector.utils.batch_space(self.single_observation_space, num_envs)

    def reset(self, *, seed=None, options=None):
        """All worlds at the beginning of new episodes; returns (observations, infos)."""
        if seed is not None:
            self._random = np.random.default_rng(seed)
        self._begin(np.ones(self.num_envs, dtype=bool))
        return self._last.copy(), {}

    def step(self, actions):
        """Returns (observations, rewards, terminations, truncations, infos)."""
        actions = np.clip(np.asarray(actions, dtype=float), -1., 1.)
        before = self._last
        ports, ended = self.batch.step(self.center + self.scale * actions, self.count)
        after = self._observe(ports)
        self._taken += 1
        rewards = self._reward(before, actions, after)
        terminated = ended | self._fell(after)
        truncated = ~terminated & (self._taken >= self.steps)
        over = terminated | truncated
        infos = {"final_obs": after.copy(), "_final_obs": over.copy()} if over.any() else {}
        self._last = after
        if over.any():
            self._begin(over)
        return self._last.copy(), rewards, terminated, truncated, infos

    def close(self, **ignored):
        """Nothing is held beyond memory."""

    def _begin(self, mask):
        new = {}
        if self._start:
            new["state"] = self._start(self._random, self.num_envs)
        if self._settings:
            new["set"] = self._settings(self._random, self.num_envs)
        self._last = self._observe(self.batch.reset(mask, **new))
        self._taken[mask] = 0
