"""What the modes left out of an Euler-Bernoulli beam give way, where that is too little to come from a difference."""

import numpy as np

from .end_conditions import CLAMPED, ENDS, FREE, PINNED

MIN_ASYMPTOTIC_MODES = 12  # from which on exp(-z) is below rounding: with fewer, shapes are not yet sines
SUMMED_TERMS = 2000  # of the series; then phi^2 counts by its mean, 1e-6 of the sum off
DECAYING = {CLAMPED: -1.0, PINNED: 0.0, FREE: 1.0}  # wave at an end over the sine there, which has 1 / sqrt(2)


def slender_tail(support: str, place: float, count: int, end_mass: float) -> float:
    """Sum of phi^2 / z^4 at `place` over all modes above the first `count` of the unit beam.

    From MIN_ASYMPTOTIC_MODES on each shape is a sine with a wave at either end that decays before it meets the other:
    phi = sqrt(2) (sin(z x + theta) + near exp(-z x) + far exp(-z (1 - x))).
    Error: 1e-6 of the sum; past `SUMMED_TERMS` modes the square of phi is replaced by its mean.
    """
    near_end, far_end = ENDS[support]
    theta = 0.0 if near_end is PINNED else -0.25 * np.pi
    turns = np.pi * (count + np.arange(1, SUMMED_TERMS + 1) - (1.0 if support == "cantilever" else 0.0))
    angle = turns + (0.0 if far_end is PINNED else 0.25 * np.pi)  # z + theta
    for _ in range(8 if end_mass > 0.0 else 0):  # contracts by 1 / (end_mass z^2) each time
        angle = turns + np.arctan(1.0 / (1.0 + 2.0 * end_mass * (angle - theta)))
    z = angle - theta
    near, far = DECAYING[near_end] * np.sin(theta), DECAYING[far_end] * np.sin(angle)
    square = 1.0 + (near**2 + far**2) / z - (np.sin(2.0 * angle) - np.sin(2.0 * theta)) / (2.0 * z)
    square += 2.0 * far * (np.sin(angle) - np.cos(angle)) / z + 2.0 * end_mass * (np.sin(angle) + far) ** 2
    shape = np.sin(z * place + theta) + near * np.exp(-z * place) + far * np.exp(-z * (1.0 - place))
    squares = 2.0 * shape**2 / square
    beyond = float(np.mean(squares[SUMMED_TERMS // 2 :])) / (3.0 * np.pi * (z[-1] + 0.5 * np.pi) ** 3)
    return float(np.sum(squares / z**4)) + beyond
