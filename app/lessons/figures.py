"""Figures of the impact that a step shows, in SI units, which the answer to a question can be made of."""

import math
from collections.abc import Callable, Iterable
from typing import Any

from .events import is_event, times_of
from .formula import Formula, Quantity
from .solving import QUANTITIES, Shown
from .units import NONE, Dimension

LENGTH, MASS, TIME, SPEED = (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 0, -1)
FORCE, IMPULSE, ENERGY, RATE = (1, 1, -2), (1, 1, -1), (2, 1, -2), (0, 0, -1)
GRAVITY = 9.80665  # [m/s2]

OF_RESULTS: dict[str, Dimension] = {
    "contacts": NONE,
    "peak_force": FORCE,
    "impulse": IMPULSE,
    "restitution": NONE,
    "contact_time": TIME,
    "impactor_velocity": SPEED,
    "target_velocity": SPEED,
    "peak_indentation": LENGTH,
    "energy_lost": NONE,
    "impactor_spin": RATE,
    "target_spin": RATE,
    "sticks": NONE,
}
OF_SCENES: dict[str, tuple[Dimension, Callable[[Any], Any]]] = {
    "impactor_mass": (MASS, lambda scene: scene.impactor.mass),
    "target_mass": (MASS, lambda scene: scene.target.mass),
    "length": (LENGTH, lambda scene: scene.target.length),
    "wave_speed": (SPEED, lambda scene: scene.target.wave_speed),
    "impedance": ((0, 1, -1), lambda scene: scene.target.impedance),
    "time_unit": (TIME, lambda scene: scene.time_unit),
    "initial_energy": (ENERGY, lambda scene: scene.initial_energy),
    "gravity": ((1, 0, -2), lambda scene: GRAVITY),
}
OF_SETTINGS: dict[str, Dimension] = {"speed": SPEED, "mass_ratio": NONE, "friction": NONE}  # of others it is not known


def names(kind: str, settings: Iterable[str]) -> list[str]:
    """Of the figures of a kind of scene: results, the bodies, then settings. Events have theirs besides."""
    return [*dict.fromkeys((*QUANTITIES[kind], *OF_SCENES, *settings))]


def is_figure(name: str, known: Iterable[str]) -> bool:
    """Whether a formula may have it; the time of an event is one."""
    return name in known or is_event(name)


def of_formula(given: Formula, shown: Shown) -> Quantity | None:
    """What a formula is in this impact; None where a figure of it is not there. Raises `formula.Mixed`."""
    found: dict[str, Quantity] = {}
    for name in given.figures:
        quantity = figure(name, shown)
        if quantity is None:
            return None
        found[name] = quantity
    result = given.of(found)
    return result if math.isfinite(result.value) else None


def figure(name: str, shown: Shown) -> Quantity | None:
    """None where there is nothing of it."""
    if name in QUANTITIES[shown.kind]:
        return _quantity(QUANTITIES[shown.kind][name](shown), OF_RESULTS[name])
    if name in OF_SCENES:
        dimension, read = OF_SCENES[name]
        try:
            return _quantity(read(shown.solution.scene), dimension)
        except (AttributeError, ValueError):  # of another kind of body
            return None
    if is_event(name):
        time = times_of(shown.solution).get(name)
        return None if time is None else _quantity(time * shown.solution.scene.time_unit, TIME)
    return _quantity(shown.request.chosen.get(name), OF_SETTINGS.get(name))


def _quantity(value: Any, dimension: Dimension | None) -> Quantity | None:
    if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
        return None
    return Quantity(float(value), dimension)
