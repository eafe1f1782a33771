"""A chain of rods: exactly while that is affordable, then to a coarser tolerance, then on a grid."""

import math

import numpy as np

from ..numerics.wave_record import IMPULSE
from ..scene import Scene
from .chain_grid import COARSER, GridHistory
from .chain_scene import ChainHistory, ChainScene
from .wave_chain import ExactHistory

COARSE_TOLERANCES = (1e-7, 1e-5)  # with each the echoes that count are some times fewer
LOOSER = 10.0  # what is found with a tolerance this many times larger tells its error
FIRST_LOOK = 20.0  # round trips of the longest rod: how far a grid looks at first for when the bodies part


def follow(scene: Scene, until: float, tolerance: float) -> ChainHistory:
    """Solve up to `until` [T], or until the impactor has parted for good if that is infinite.

    An impactor that is a prescribed force parts from nothing: then to two round trips after its end.
    """
    given = ChainScene(scene)
    if scene.impactor.kind == "pulse" and not math.isfinite(until):
        until = scene.impactor.end / given.trip + 2.0
    history = ExactHistory(given, until, tolerance)
    for coarser in COARSE_TOLERANCES:
        if not history.gave_up:
            return history
        if coarser > tolerance:
            history = ExactHistory(given, until, coarser)
            if not history.gave_up:
                return _compared(history, ExactHistory(given, until, LOOSER * coarser))
    horizon = max(2.0 * history.reach, FIRST_LOOK * max(rod.round_trip_time for rod in history.rods) / given.trip)
    grid = GridHistory(given, until, horizon)
    return _compared(grid, GridHistory(given, until, grid.reach, COARSER))


def _compared(history: ChainHistory, coarse: ChainHistory) -> ChainHistory:
    """The history, with an error by what the coarser solve says of the impulse of the blow and its time."""
    at_end = [each.sampled(each.contact, IMPULSE, np.array([each.reach]))[0] for each in (history, coarse)]
    mass = history.given.masses[-1] if math.isfinite(history.given.masses[-1]) else 1.0
    history.error = max(history.error, abs(float(at_end[0] - at_end[1])) / mass)
    return history
