"""The cross-entropy method (Rubinstein & Kroese 2004, The Cross-Entropy Method, chapter 5): a normal distribution that follows its best draws."""
import numpy as np


def search(score, mean, deviation, *, low=-np.inf, high=np.inf, draws, generations, seed=0, best=0.2, smoothing=0.7, least=0.02, told=None):
    """The mean of the last distribution.

    `score(candidates)`: what each row of an array of draws x parameters is worth, the more the better. `best`: the share of draws that the next
    distribution is made of. `smoothing`: how much of it is theirs. `least`: added to the deviation, as a share of the first, so that the
    search does not stop early. `told(generation, scores)` is called after each generation; the first candidate is the mean.
    """
    random = np.random.default_rng(seed)
    mean, deviation = np.array(mean, dtype=float), np.array(deviation, dtype=float)
    floor = least * deviation
    for generation in range(generations):
        candidates = np.clip(mean + deviation * random.standard_normal((draws, mean.size)), low, high)
        candidates[0] = mean
        scores = score(candidates)
        elite = candidates[np.argsort(-scores, kind="stable")[:max(2, round(best * draws))]]
        mean = (1 - smoothing) * mean + smoothing * elite.mean(axis=0)
        deviation = (1 - smoothing) * deviation + smoothing * elite.std(axis=0) + floor
        if told:
            told(generation, scores)
    return mean
