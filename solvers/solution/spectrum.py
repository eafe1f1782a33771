"""Amplitude over frequency of any history of a solution: of the contact force, of a place, of a body."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..notebook.figures import fields_of, histories_of
from ..numerics import spectra
from ..validation import SceneError, allowed, choice, number
from .motion import ShowsModes

LINES = 100  # periods in all of the time solved, of the highest frequency that is usual
FINER = 4  # lines that are usual, in the width of one
PER_PERIOD = 16  # samples of the highest frequency
LEAST, MOST = 2_000, 200_000  # samples
WINDOWS = {"none": spectra.transform, "hann": spectra.hann}


@dataclass(frozen=True, eq=False)
class Spectrum:
    """What a history holds of each frequency; arrays (frequencies,).

    `density` is the size of the Fourier integral of the history under the window, nought before and after it: what is
    asked of a single pulse, of which it is the impulse at no frequency. `amplitude` is that of a steady vibration which
    fills all of the time: it shows each of its sines as high as it is.
    """

    what: str
    place: float | None  # [m]
    window: str
    duration: float  # of the history [s]
    unit: str  # of the history
    frequency: np.ndarray  # [Hz]
    density: np.ndarray  # [unit s]
    modes: np.ndarray  # (modes,) natural frequencies of the target that the method kept [Hz]; of other methods none

    @property
    def amplitude(self) -> np.ndarray:
        """[unit]; at no frequency the mean."""
        return self.density * np.where(self.frequency > 0.0, 2.0, 1.0) / self.duration


def spectrum(solution: Any, what: str, place: float | None, window: str, frequency: ArrayLike | None) -> Spectrum:
    """See `Solution.spectrum`."""
    motion, scene, duration = solution.known_motion, solution.scene, solution.duration
    histories, fields = histories_of(scene), fields_of(scene) if scene.target.length else {}
    choice("what", what, [*histories, *fields])
    choice("window", window, WINDOWS)
    usual = np.linspace(0.0, LINES / duration, FINER * LINES + 1)
    asked = usual if frequency is None else np.atleast_1d(np.asarray(frequency, float))
    highest = MOST / (PER_PERIOD * duration)
    for end in (asked.min(initial=highest), asked.max(initial=0.0)):
        number("frequency", end, 0.0, highest, "Hz")
    samples = int(np.clip(PER_PERIOD * duration * asked.max(initial=0.0), LEAST, MOST))
    time = np.linspace(0.0, duration, samples + 1)
    if what in fields:
        place = number("place", 0.0 if place is None else place, 0.0, scene.target.length, "m")
        values = fields[what].of(motion, time, np.array([place]))[:, 0]
    elif what == "contact_force":
        if solution.contacts and solution.peak_force is None:
            raise SceneError("what", what, allowed("lasting-force"))
        time, values = solution.time, solution.force
    else:
        values = histories[what].of(motion, time)
    return Spectrum(
        what=what,
        place=place if what in fields else None,
        window=window,
        duration=duration,
        unit=(fields | histories)[what].unit,
        frequency=asked,
        density=np.abs(WINDOWS[window](time, values, asked)),
        modes=solution.target_modes.frequencies if _has_modes(solution) else np.empty(0),
    )


def _has_modes(solution: Any) -> bool:
    return isinstance(solution.motion, ShowsModes) and bool(solution.scene.target.length)
