"""Pulses carried along a bar in which each frequency runs at its own speed."""

import numpy as np

from ...numerics.pochhammer import highest, phase_speed
from ...validation import SceneError, allowed
from .bars import GaugedBar

MOST_ABOVE = 0.01  # of a pulse's energy at frequencies of higher modes
PADDED = 4  # times the length: what runs out at one end must not come in at the other


def carried(strain: np.ndarray, step: float, bar: GaugedBar, distance: float) -> np.ndarray:
    """A pulse, (n,) at even steps [s], after `distance` [m], or before it where that is negative.

    The time that a long wave takes is left out.

    By the first mode of Pochhammer and Chree, in phase alone: strain at the surface is taken as that of the section.
    """
    count = PADDED * strain.size
    phase = np.fft.rfft(strain, count)
    omega = 2.0 * np.pi * np.fft.rfftfreq(count, step)
    lag = (1.0 / phase_speed(_scaled(omega, bar), bar.poisson or 0.0) - 1.0) * distance / bar.wave_speed
    return np.fft.irfft(phase * np.exp(-1j * omega * lag), count)[: strain.size]


def check_content(strain: np.ndarray, step: float, bar: GaugedBar, noise: float) -> None:
    """Raises SceneError where a pulse has frequencies at which bars carry more than the first mode."""
    power = np.abs(np.fft.rfft(strain)) ** 2
    omega = 2.0 * np.pi * np.fft.rfftfreq(strain.size, step)
    top = highest(bar.poisson or 0.0)
    above = _scaled(omega, bar) > top
    own = np.maximum(power - strain.size * noise**2, 0.0)  # white noise has as much at each
    share = float((power[above] - strain.size * noise**2).sum() / max(own.sum(), 1e-300))
    if share > MOST_ABOVE:
        frequency = top * bar.wave_speed / (np.pi * bar.diameter)
        raise SceneError("dispersion", "pochhammer", allowed("first-mode", share=share, frequency=frequency / 1e3))


def _scaled(omega: np.ndarray, bar: GaugedBar) -> np.ndarray:
    return 0.5 * omega * bar.diameter / bar.wave_speed
