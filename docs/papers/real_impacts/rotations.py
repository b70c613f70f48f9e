"""Rotations as matrices (n, 3, 3), rotation vectors (n, 3) and quaternions w, x, y, z (n, 4)."""

import math

import numpy as np


def matrices(q):
    w, x, y, z = (q / np.linalg.norm(q, axis=-1, keepdims=True)).T
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    ).transpose(2, 0, 1)


def product(p, q):
    w, x, y, z = np.moveaxis(np.broadcast_arrays(p, q)[0], -1, 0)
    a, b, c, d = np.moveaxis(np.broadcast_arrays(p, q)[1], -1, 0)
    return np.stack(
        [w * a - x * b - y * c - z * d, w * b + x * a + y * d - z * c, w * c - x * d + y * a + z * b, w * d + x * c - y * b + z * a], -1
    )


def inverse(q):
    return q * np.array([1.0, -1.0, -1.0, -1.0])


def exponential(u):
    angle = np.linalg.norm(u, axis=-1, keepdims=True)
    return np.concatenate([np.cos(angle / 2), u * np.sinc(angle / 2 / np.pi) / 2], -1)


def logarithm(q):
    q = q * np.where(q[..., :1] < 0, -1.0, 1.0)
    sine = np.linalg.norm(q[..., 1:], axis=-1, keepdims=True)
    angle = 2 * np.arctan2(sine, q[..., :1])
    return q[..., 1:] * np.where(sine > 1e-12, angle / np.maximum(sine, 1e-12), 2.0)


def skew(u):
    x, y, z = u
    return np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])


def left_jacobian(u):
    """d exp(u) = exp(J(u) du) exp(u)."""
    angle, s = np.linalg.norm(u), skew(u)
    if angle < 1e-6:
        return np.eye(3) + s / 2
    return np.eye(3) + (1 - math.cos(angle)) / angle**2 * s + (angle - math.sin(angle)) / angle**3 * s @ s
