"""examples/python: the vector environment keeps Gymnasium's contract, the hopper learns to hop, the quadruped is tuned to trot."""
import importlib
import os
import pathlib
import sys
import unittest
import warnings

import numpy as np

SOURCE = pathlib.Path(os.environ["HOOKPOINT_SOURCE_DIR"])
sys.path.insert(0, str(SOURCE / "examples" / "python"))

import cross_entropy  # noqa: E402
import vector_env  # noqa: E402

BALL = """World w { deltat = 1 ms; duration = 100 s;
  Robot ball { Base.mobile { location = 0, 0, 1; mass = 2; inertia = 1, 1, 1, 0, 0, 0; } }
  Force push { body = ball.base; force = 0, 0, 0; }
}"""


def balls(worlds, steps=50, **more):
    """They fall freely unless the action, a force in units of 40 N, holds them."""
    return vector_env.VectorEnv(BALL, worlds, observations=["ball.base.location.z", "ball.base.velocity.z"], actions=["push.force.z"], scale=40.,
                                period=0.01, steps=steps, reward=lambda before, action, after: after[:, 0],
                                fell=lambda after: after[:, 0] < 0.5, **more)


class Environment(unittest.TestCase):
    def test_what_falls_terminates_and_starts_again_in_the_same_step(self):
        env = balls(2)
        observation, infos = env.reset(seed=1)
        np.testing.assert_array_equal(observation, [[1, 0], [1, 0]])
        # sqrt(2 * 0.5 m/g) = 0.319 s: the 32nd step. The other one is held.
        held = 2 * 9.81 / 40
        for step in range(1, 33):
            observation, rewards, terminated, truncated, infos = env.step([[0.], [held]])
            self.assertEqual((list(terminated), list(truncated)), ([step == 32, False], [False, False]), step)
        self.assertLess(infos["final_obs"][0, 0], 0.5)
        np.testing.assert_array_equal(infos["_final_obs"], [True, False])
        np.testing.assert_array_equal(observation[0], [1, 0])
        self.assertAlmostEqual(observation[1, 0], 1, places=9)
        self.assertLess(rewards[0], 0.5)

    def test_episodes_are_truncated_and_actions_clipped(self):
        env = balls(1, steps=3)
        env.reset()
        # 40 N at most, not 400: a = 20 - 9.81 m/s^2.
        for step in range(1, 4):
            observation, _, terminated, truncated, infos = env.step([[10.]])
        self.assertEqual((terminated[0], truncated[0]), (False, True))
        self.assertAlmostEqual(infos["final_obs"][0, 1], (20 - 9.81) * 0.03, places=9)
        self.assertFalse(env.step([[0.]])[3][0])

    def test_a_seed_draws_the_same_starts_and_settings(self):
        def start(random, count):
            return {"ball.base.location": np.column_stack([np.zeros((count, 2)), random.uniform(1, 2, count)])}

        def settings(random, count):
            return [{"w.ball.base.mass": float(mass)} for mass in random.uniform(1, 3, count)]

        heights = []
        for threads in (1, 2):
            env = balls(4, threads=threads, start=start, settings=settings)
            first, _ = env.reset(seed=7)
            after = env.step(np.full((4, 1), 0.5))[0]
            # Each by its own mass: a = F/m - g.
            rates = after[:, 1] / 0.01 + 9.81
            self.assertEqual(len(set(np.round(20 / rates, 6))), 4)
            self.assertTrue(((20 / rates > 1) & (20 / rates < 3)).all())
            heights.append((first, after))
        np.testing.assert_array_equal(*[each[0] for each in heights])
        np.testing.assert_array_equal(*[each[1] for each in heights])

    @unittest.skipIf(vector_env.gymnasium is None, "gymnasium is not installed")
    def test_is_an_environment_of_gymnasium(self):
        env = balls(3)
        self.assertIsInstance(env, vector_env.gymnasium.vector.VectorEnv)
        self.assertTrue(env.observation_space.contains(env.reset()[0]))


class CrossEntropy(unittest.TestCase):
    def test_finds_the_top_of_a_hill(self):
        top = np.array([0.3, -1.2, 2.])
        found = cross_entropy.search(lambda x: -np.sum((x - top) ** 2, axis=1), np.zeros(3), np.ones(3), draws=40, generations=30, least=1e-3)
        np.testing.assert_allclose(found, top, atol=0.02)

    def test_stays_within_bounds(self):
        seen = []
        cross_entropy.search(lambda x: seen.append(x) or x[:, 0], [0.], [1.], low=-1., high=0.5, draws=10, generations=5)
        self.assertLessEqual(np.max(seen), 0.5)
        self.assertGreaterEqual(np.min(seen), -1)


class Learning(unittest.TestCase):
    def test_the_hopper_hops_from_starts_that_it_never_saw(self):
        hop = importlib.import_module("learn_to_hop")
        learned = hop.learn()
        total, heights = hop.returns(hop.environment(16), np.tile(learned, (16, 1)), seed=99)
        # A hop: the foot is off the ground by some 10 cm, and it comes down again, several times.
        self.assertGreater(np.median(heights.max(axis=0)), 0.1)
        falls = np.sum((heights[:-1] > 0) & (heights[1:] <= 0), axis=0)
        self.assertGreaterEqual(np.median(falls), 2)
        standing, _ = hop.returns(hop.environment(16), np.zeros((16, 10)), seed=99)
        self.assertGreater(np.median(total), 5 * np.median(standing))

    def test_the_quadruped_trots_on_grounds_that_it_never_saw(self):
        trot = importlib.import_module("tune_trot")
        warnings.simplefilter("ignore")  # of a drive at its limit
        gait = trot.tune(generations=10)
        ahead, aside, stands = trot.walk(trot.batch_of(16, seed=77), np.tile(gait, (16, 1)))
        self.assertTrue(stands.all())
        self.assertGreater(ahead.min() / (trot.DURATION - trot.BEGINS), 0.8)
        self.assertLess(np.abs(aside).max(), 0.3 * ahead.min())


if __name__ == "__main__":
    unittest.main()
