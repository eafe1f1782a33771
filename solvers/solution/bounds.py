"""Where and when a motion is known: beyond its bodies and its duration it is refused, or is NaN if asked for."""

from collections.abc import Callable
from copy import copy
from functools import cache, cached_property, wraps
from inspect import getattr_static
from types import FunctionType
from typing import Any

import numpy as np

from .. import validation
from ..validation import SceneError, a_number
from .solution import Solution

HISTORIES = (
    "force", "resolved_force", "impulse", "impactor_position", "impactor_velocity", "face_velocity", "end_position",
    "end_velocity", "rigid_velocity", "energies",
)  # fmt: skip
FIELDS = "displacement", "velocity", "stress", "moment", "shear"
OUTSIDE = "refuse", "nan"
SLACK = 1e-9  # of the duration and of the length: rounding


class Bounded:
    """A motion that knows its bounds, duration [s], first and last place [m]. What its functions ask each other is not
    looked at again: they are those of `_unbounded`, the same motion without bounds."""

    _unbounded_kind: type
    _bounds: tuple[float, float, float]

    @property
    def _unbounded(self) -> Any:
        other = object.__new__(self._unbounded_kind)
        other.__dict__ = self.__dict__
        return other

    def __reduce__(self) -> tuple[Any, ...]:
        return _blank, (self._unbounded_kind,), self.__dict__


def bounded(solution: Solution) -> Solution:
    """The solution, whose motion now has the bounds of its scene and duration."""
    from ..notebook.figures import reach  # nothing of the notebook is loaded with the library

    if solution.motion is not None:
        motion = copy(solution.motion)
        motion.__class__ = _class_of(type(motion))
        scene = solution.scene
        first, last = reach(solution)
        if scene.impactor.time_unit is not None and first == 0.0:
            first = -scene.impactor.length  # a bar that swings, or a rod that strikes a beam
        motion.__dict__["_bounds"] = (solution.duration, first, last)
        object.__setattr__(solution, "motion", motion)
    return solution


def _blank(kind: type) -> Any:
    return object.__new__(_class_of(kind))


@cache
def _class_of(kind: type) -> type:
    """The kind of motion, with checked functions."""
    if issubclass(kind, Bounded):
        return kind
    own = {name: getattr_static(kind, name) for name in dir(kind) if not name.startswith("__")}
    functions = {name: _checked(name, each) for name, each in own.items() if isinstance(each, FunctionType)}
    values = {name: _passed_on(name) for name, each in own.items() if isinstance(each, (property, cached_property))}
    named = {"__doc__": kind.__doc__, "__module__": kind.__module__, "_unbounded_kind": kind}
    return type(kind.__name__, (Bounded, kind), named | functions | values)


def _passed_on(name: str) -> property:
    return property(lambda motion: getattr(motion._unbounded, name))


def _checked(name: str, function: Callable[..., Any]) -> Callable[..., Any]:
    @wraps(function)
    def passed_on(motion: Any, *given: Any, **options: Any) -> Any:
        return function(motion._unbounded, *given, **options)

    @wraps(function)
    def within(motion: Any, time: Any, *places: Any, outside: str = "refuse", **options: Any) -> Any:
        validation.choice("outside", outside, OUTSIDE)
        duration, first, last = motion._bounds
        time, known = _inside("time", time, 0.0, duration, "s", outside)
        if name in FIELDS:
            x = options.pop("x") if "x" in options else places[0]
            x, here = _inside("x", x, first, last, "m", outside) if last > first else (x, np.ones(np.shape(x), bool))
            places, known = (x, *places[1:]), np.multiply.outer(known, here)
        found = function(motion._unbounded, time, *places, **options)
        if known.all():
            return found
        if isinstance(found, dict):
            return {part: np.where(known, value, np.nan) for part, value in found.items()}
        return np.where(known, found, np.nan)

    @wraps(function)
    def cut(motion: Any) -> tuple[np.ndarray, np.ndarray]:
        """The history up to the end of the time solved, beyond which its last step may go on."""
        time, force = function(motion._unbounded)
        last = motion._bounds[0]
        if time[-1] <= last:
            return time, force
        kept = time < last
        end = np.interp(last, time, force)
        return np.append(time[kept], last), np.append(force[kept], end)

    if name == "force_history":
        return cut
    return within if name in HISTORIES + FIELDS else passed_on


def _inside(key: str, given: Any, low: float, high: float, unit: str, outside: str) -> tuple[Any, np.ndarray]:
    """What was given, moved inside where it is not, and whether it was inside. Raises SceneError where it must be."""
    values = np.asarray(given, float)
    slack = SLACK * (high - low)
    known = (values >= low - slack) & (values <= high + slack)
    if known.all():
        return given, known
    if outside == "refuse":
        raise SceneError(key, float(values[~known].flat[0]), a_number(low, high, unit))
    return np.clip(np.where(known, values, low), low, high), known
