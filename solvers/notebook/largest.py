"""What a designer asks of a beam that is struck: how far it gives way, and the largest stress by bending."""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

INSTANTS, PLACES = 400, 61  # at which a beam is looked at first
FINER, ROUNDS = 21, 3  # points around the largest, each time between the two beside it

Field = Callable[[np.ndarray, np.ndarray], np.ndarray]  # of times and places, (time, x)


class Largest(NamedTuple):
    """Size with its sign, when [s], and how far from the left end [m]."""

    value: float
    time: float
    x: float


def peak_deflection(solution: Any) -> Largest | None:
    """The largest displacement of a held beam across its length [m]; None of other bodies, and of free beams, which
    go off as wholes. Error: some 1e-4 of it, by where it is looked at.
    """
    held = _bends(solution) and solution.scene.target.held
    return _largest(solution, solution.known_motion.displacement) if held else None


def peak_bending_stress(solution: Any) -> Largest | None:
    """The largest stress by bending in the outer fibre of a beam [Pa], compression of the struck side being positive;
    None of other bodies. Error: some 1e-3 of it, by where it is looked at; near a clamp or under a hard contact modes
    and elements say less, see *How exact*.
    """
    return _largest(solution, solution.known_motion.stress) if _bends(solution) else None


def _bends(solution: Any) -> bool:
    """Whether it knows how a beam is bent."""
    return solution.scene.target.kind == "beam" and hasattr(solution.motion, "moment")


def _largest(solution: Any, field: Field) -> Largest:
    start, end, left, right = 0.0, solution.duration, 0.0, solution.scene.target.length
    times, places = np.linspace(start, end, INSTANTS), np.linspace(left, right, PLACES)
    for _ in range(ROUNDS + 1):
        values = field(times, places)
        row, column = np.unravel_index(np.abs(values).argmax(), values.shape)
        found = Largest(float(values[row, column]), float(times[row]), float(places[column]))
        start, end = times[max(row - 1, 0)], times[min(row + 1, len(times) - 1)]
        left, right = places[max(column - 1, 0)], places[min(column + 1, len(places) - 1)]
        times, places = np.linspace(start, end, FINER), np.linspace(left, right, FINER)
    return found
