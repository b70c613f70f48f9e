"""A planar hopper (Raibert 1986) learns to hop, and to stay upright, in about half a minute on two cores.

    python3 learn_to_hop.py

The policy has ten numbers: the leg's force is a squashed linear function of height, vertical speed, compression and its rate, the hip's torque
of forward speed, pitch, pitch rate, leg angle and its rate. The cross-entropy method finds them from nothing but the reward: how high the
body is while it lasts.
"""
import numpy as np

import cross_entropy
from vector_env import VectorEnv

SCENE = """
World world {
  deltat = 0.2 ms; duration = 100 s;
  Include "materials/rigid_floor.hook" (load = 100 N, allowance = 2 mm, damping_ratio = 0.5);
  Terrain.Flat ground { material = rigid_floor; }
  Include "robots/hopper.hook" (height = 1 cm);
}
"""
PORTS = ["hopper.base.location.z", "hopper.base.velocity.z", "hopper.base.velocity.x", "hopper.base.orientation.w",
         "hopper.base.orientation.y", "hopper.base.angular_velocity.y", "hopper.leg.thigh.angle", "hopper.leg.thigh.rate",
         "hopper.leg.foot.angle", "hopper.leg.foot.rate"]
LEG_LENGTH = 0.5  # m
HEIGHT, PITCH, LEG_TERMS, HIP_TERMS = 0, 3, [0, 1, 7, 8, 9], [2, 3, 4, 5, 6]


def observe(ports):
    """Height above the leg's length, dz/dt, dx/dt, pitch, its rate, leg angle, its rate, ten times the compression, its rate, 1."""
    z, dz, dx, w, y, spin, angle, swing, compression, rate = ports.T
    return np.stack([z - LEG_LENGTH, dz, dx, 2 * np.arctan2(y, w), spin, angle, swing, 10 * compression, rate, np.ones(len(z))], axis=1)


def policy(parameters, observation):
    """Force along the leg and torque of the hip, in [-1, 1]."""
    leg = np.sum(parameters[:, :5] * observation[:, LEG_TERMS], axis=1)
    hip = np.sum(parameters[:, 5:] * observation[:, HIP_TERMS], axis=1)
    return np.tanh(np.stack([leg, hip], axis=1))


def fell(observation):
    return (np.abs(observation[:, PITCH]) > 0.8) | (observation[:, HEIGHT] < -0.2) | ~np.isfinite(observation).all(axis=1)


def reward(before, action, after):
    return np.clip(after[:, HEIGHT], 0., 0.4)


def start(random, count):
    """A little above the ground, the leg a little aslant."""
    return {"hopper.base.location": np.column_stack([np.zeros((count, 2)), random.uniform(0.5, 0.52, count)]),
            "hopper.leg.thigh.angle": random.normal(0., 0.03, count)}


def environment(worlds):
    return VectorEnv(SCENE, worlds, observations=PORTS, actions=["hopper.leg.foot.torque", "hopper.leg.thigh.torque"], scale=[120., 60.],
                     period=0.02, steps=125, reward=reward, fell=fell, observe=observe, start=start)


def returns(env, parameters, seed):
    """The sum of rewards of each world's first episode, and its heights."""
    observation, _ = env.reset(seed=seed)
    total, alive, heights = np.zeros(env.num_envs), np.ones(env.num_envs, dtype=bool), []
    for _ in range(env.steps):
        heights.append(observation[:, HEIGHT].copy())
        observation, rewards, terminated, truncated, _ = env.step(policy(parameters, observation))
        total += np.where(alive & ~terminated, rewards, 0.)
        alive &= ~(terminated | truncated)
    return total, np.array(heights)


def learn(worlds=64, generations=30, seed=1, told=None):
    """The ten numbers of the policy."""
    env = environment(worlds)
    draws = np.random.default_rng(seed)
    return cross_entropy.search(lambda candidates: returns(env, candidates, int(draws.integers(2**31)))[0], np.zeros(10), np.full(10, 1.5),
                                draws=worlds, generations=generations, seed=seed, told=told)


def main():
    learned = learn(told=lambda generation, scores: print(f"generation {generation:2d}: mean policy {scores[0]:6.2f}, best {scores.max():6.2f}"))
    env = environment(16)
    total, heights = returns(env, np.tile(learned, (16, 1)), seed=99)
    print("leg:", np.round(learned[:5], 2), "hip:", np.round(learned[5:], 2))
    print(f"16 new starts: return {total.min():.1f} to {total.max():.1f} of at most {env.steps * 0.4:.0f}; "
          f"hops of {100 * np.median(heights.max(axis=0)):.0f} cm")


if __name__ == "__main__":
    main()
