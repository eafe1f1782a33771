"""The Fourier transform of a history that is straight between its samples."""

import numpy as np

SMALL = 1e-3  # of a phase, below which its power series is as exact as rounding
SAME = 1e-9  # by which steps of an even grid differ
AT_ONCE = 2_000_000  # values of frequencies times samples


def transform(time: np.ndarray, values: np.ndarray, frequency: np.ndarray) -> np.ndarray:
    """Integral of x(t) exp(-2 pi i f t) over all of the samples, by frequency (frequencies,), complex.

    time, values (samples,): x is straight between them, nought before and after; where a time stands twice, it jumps.
    Error: rounding, at any frequency: each stretch is integrated in closed form.
    """
    step = np.diff(time)
    there = (step > 0.0) & ((values[1:] != 0.0) | (values[:-1] != 0.0))
    step, middle = step[there], (0.5 * (time[1:] + time[:-1]))[there]
    mean, half = (0.5 * (values[1:] + values[:-1]))[there], (0.5 * np.diff(values))[there]
    if not step.size:
        return np.zeros(frequency.size, complex)
    width = step[:1] if np.ptp(step) <= SAME * step[0] else step  # what is even takes a third of the time
    found = np.empty(frequency.size, complex)
    rows = max(1, AT_ONCE // max(step.size, 1))
    for start in range(0, frequency.size, rows):
        turns = frequency[start : start + rows, None]
        even, odd = np.sinc(turns * width), _odd(np.pi * turns * width)  # of half the phase of a stretch
        turned = np.exp(-2j * np.pi * turns * middle)
        found[start : start + rows] = np.sum(width * (mean * even - 1j * half * odd) * turned, axis=1)
    return found


def _odd(phase: np.ndarray) -> np.ndarray:
    """(sin z - z cos z) / z^2, what a slope gives where a constant gives sin z / z."""
    small = np.abs(phase) < SMALL
    z = np.where(small, 1.0, phase)
    return np.where(small, phase / 3.0, (np.sin(z) - z * np.cos(z)) / z**2)


def hann(time: np.ndarray, values: np.ndarray, frequency: np.ndarray) -> np.ndarray:
    """The same of the history under a window 1 - cos(2 pi (t - t0) / T) over all of it, whose mean is 1."""
    whole = time[-1] - time[0]
    side = np.exp(-2j * np.pi * time[0] / whole)
    beside = [transform(time, values, frequency + sign / whole) for sign in (1.0, -1.0)]
    return transform(time, values, frequency) - 0.5 * (beside[0] / side + beside[1] * side)
