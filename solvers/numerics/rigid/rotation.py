"""How a rigid body turns that nothing touches: Euler's equations, to draw bodies before and after an impact."""

import numpy as np

from .impulses import principal


def rotations(inertia: np.ndarray, spin: np.ndarray, duration: np.ndarray | float, steps: int) -> np.ndarray:
    """Rotation matrices (steps + 1, ..., 3, 3) at even times from 0, where they are 1, to `duration` [s].

    inertia (..., 3, 3) [kg m2] and spin (..., 3) [rad/s] at time 0, in world axes. The angular momentum is kept; about
    an axis without moment of inertia the body goes on turning as it did. A negative `duration` (...) goes back in time.
    Error: second order in the angle turned per step, some 1e-5 rad at 0.02 rad a step; none about a principal axis.
    However coarse the steps, the matrices stay rotations.
    """
    moments, axes = principal(inertia)
    axes = axes * np.linalg.det(axes)[..., None, None]  # right-handed
    momentum = (inertia @ spin[..., None])[..., 0]
    inverse = np.where(moments > 0.0, 1.0 / np.where(moments > 0.0, moments, 1.0), 0.0)
    free = np.where(moments > 0.0, 0.0, _across(axes, spin))
    turned, step = np.empty((steps + 1, *axes.shape)), np.asarray(duration)[..., None] / steps
    turned[0] = axes

    def spinning(frame):
        """Spin in body axes."""
        return inverse * _across(frame, momentum) + free

    for k in range(steps):
        halfway = turned[k] @ _turn(0.5 * step * spinning(turned[k]))
        turned[k + 1] = turned[k] @ _turn(step * spinning(halfway))
    return turned @ np.swapaxes(axes, -1, -2)


def _turn(angle: np.ndarray) -> np.ndarray:
    """Rotation about a vector by its length [rad]: Rodrigues' formula, as 1 + sin X + 2 sin^2(half) X X."""
    size = np.sqrt(np.vecdot(angle, angle))[..., None, None]
    along = angle[..., None, :] / np.where(size > 0.0, size, 1.0)
    cross = np.cross(np.eye(3), along)
    return np.eye(3) + np.sin(size) * cross + 2.0 * np.sin(0.5 * size) ** 2 * (cross @ cross)


def _across(axes: np.ndarray, vector: np.ndarray) -> np.ndarray:
    """Components of a vector along the columns of `axes`."""
    return (np.swapaxes(axes, -1, -2) @ vector[..., None])[..., 0]
