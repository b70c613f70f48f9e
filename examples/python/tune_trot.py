"""A quadruped from an MJCF file is tuned to trot, on grounds of different friction, in about half a minute on two cores.

    python3 tune_trot.py

`configs/robots/quadruped.xml` has position servos; their goals are ports. The gait has six numbers: frequency, swing of the thighs, lift
of the shins, both mean angles, and the phase of the lift. Diagonal legs move together, the pairs half a period apart. The cross-entropy
method makes it go far and straight, each world on a ground of its own friction.
"""
import numpy as np

import cross_entropy
import hookpoint

SCENE = """
World world {
  deltat = 0.25 ms; duration = 100 s;
  Include "materials/rigid_floor.hook" (load = 30 N, allowance = 2 mm, damping_ratio = 0.5);
  Terrain.Flat ground { material = rigid_floor; }
  Include "robots/quadruped.xml" (name = quadruped, keyframe = home, rest_on = ground);
}
"""
LEGS = ["front_left", "front_right", "rear_left", "rear_right"]
PHASES = np.array([0., np.pi, np.pi, 0.])
GOALS = [f"quadruped.{leg}_abduction.{leg}_{part}.servo.goal" for leg in LEGS for part in ("thigh", "shin")]
LOW = np.array([1.5, 0.05, 0.1, 0.5, -1.7, -1.])  # Hz, rad
HIGH = np.array([3.5, 0.5, 0.9, 0.9, -1.1, 1.])
PERIOD, DURATION, BEGINS = 0.01, 3., 0.5  # s: of the controller, of a walk, from when it is judged


def goals(gait, time):
    """Of thigh and shin of each leg; the swing grows during the first half second."""
    frequency, swing, lift, thigh, shin, lead = gait.T[:, :, np.newaxis]
    phase = 2 * np.pi * frequency * time + PHASES
    grown = min(1., time / BEGINS)
    return np.stack([thigh + grown * swing * np.sin(phase), shin - grown * lift * np.maximum(0., -np.cos(phase + lead))],
                    axis=2).reshape(len(gait), -1)


def batch_of(worlds, seed):
    """Each world has a friction of its own, from wet stone to rubber."""
    frictions = np.random.default_rng(seed).uniform(0.5, 1., worlds)
    return hookpoint.Batch(SCENE, worlds, observations=["quadruped.base.location", "quadruped.base.orientation"], actions=GOALS,
                           set=[{"world.rigid_floor.static_friction": float(mu), "world.rigid_floor.kinetic_friction": float(mu)}
                                for mu in frictions])


def walk(batch, gaits):
    """How far each world came ahead and aside [m] while it was judged, and whether it stayed up."""
    observed = batch.reset()
    stands = np.ones(len(gaits), dtype=bool)
    steps = round(PERIOD / batch.deltat)
    for k in range(round(DURATION / PERIOD)):
        if k == round(BEGINS / PERIOD):
            begun = observed[:, :2].copy()
        observed, done = batch.step(goals(gaits, k * PERIOD), steps)
        x, y = observed[:, 4], observed[:, 5]
        stands &= ~done & (1 - 2 * (x * x + y * y) > 0.7) & (observed[:, 2] > 0.15)
    ahead, aside = (observed[:, :2] - begun).T
    return ahead, aside, stands


def tune(worlds=32, generations=20, seed=2, told=None):
    """The six numbers of the gait."""
    batch = batch_of(worlds, seed)

    def score(gaits):
        ahead, aside, stands = walk(batch, gaits)
        return np.where(stands, ahead - np.abs(aside), -1.)

    return cross_entropy.search(score, (LOW + HIGH) / 2, (HIGH - LOW) / 4, low=LOW, high=HIGH, draws=worlds, generations=generations,
                                seed=seed, best=0.25, told=told)


def main():
    gait = tune(told=lambda generation, scores: print(f"generation {generation:2d}: mean gait {scores[0]:5.2f} m, best {scores.max():5.2f} m"))
    ahead, aside, stands = walk(batch_of(16, seed=77), np.tile(gait, (16, 1)))
    speed = ahead / (DURATION - BEGINS)
    print("frequency {:.2f} Hz, swing {:.2f}, lift {:.2f}, thigh {:.2f}, shin {:.2f}, lead {:.2f} rad".format(*gait))
    print(f"16 new grounds: {stands.sum()} stay up, {speed.min():.2f} to {speed.max():.2f} m/s, at most {100 * np.abs(aside).max():.0f} cm aside")


if __name__ == "__main__":
    main()
