"""How a rigid body turns that nothing touches: Euler's equations, to draw bodies before and after a blow."""

import numpy as np

from .impulses import principal


def rotations(inertia: np.ndarray, spin: np.ndarray, duration: np.ndarray | float, steps: int) -> np.ndarray:
    """Rotation matrices (steps + 1, ..., 3, 3) at even times from 0, where they are 1, to `duration` [s].

    inertia (..., 3, 3) [kg m2] and spin (..., 3) [rad/s] at time 0, in world axes. The angular momentum is kept; about
    an axis without moment of inertia the body goes on turning as it did. A negative `duration` (...) goes back in time.
    Error: fourth order in the angle turned per step; some 1e-9 rad at 0.02 rad a step.
    """
    moments, axes = principal(inertia)
    axes = axes * np.linalg.det(axes)[..., None, None]  # right-handed
    momentum = (inertia @ spin[..., None])[..., 0]
    inverse = np.where(moments > 0.0, 1.0 / np.where(moments > 0.0, moments, 1.0), 0.0)
    free = np.where(moments > 0.0, 0.0, _across(axes, spin))
    turned, step = np.empty((steps + 1, *axes.shape)), np.asarray(duration)[..., None, None] / steps
    turned[0] = axes

    def rate(frame):
        """Q' = Q [w]x, w being the spin in body axes."""
        return np.cross(frame, (inverse * _across(frame, momentum) + free)[..., None, :])

    for k in range(steps):
        frame = turned[k]
        first = rate(frame)
        second = rate(frame + 0.5 * step * first)
        third = rate(frame + 0.5 * step * second)
        fourth = rate(frame + step * third)
        turned[k + 1] = frame + step / 6.0 * (first + 2.0 * second + 2.0 * third + fourth)
    return turned @ np.swapaxes(axes, -1, -2)


def _across(axes: np.ndarray, vector: np.ndarray) -> np.ndarray:
    """Components of a vector along the columns of `axes`."""
    return (np.swapaxes(axes, -1, -2) @ vector[..., None])[..., 0]
