"""Many solves at once: one key of a scene over a range, and all blows of a mass on a rod by their mass ratio."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from . import checks, read_method
from .checks import SceneError
from .jit import kernel
from .numerics import rigid_waves
from .numerics.processors import all_processors
from .scene import Scene
from .solution import Solution

MOST_VALUES = 2_000
RATIO_RANGE = (1e-6, 1e6)  # beyond it the lighter body does not feel the heavier one within doubles' reach
MOST_CONTACTS = 16
PIECES, TERMS = (400, 4_000), 40  # of a history, tried in turn; 1 600 are needed at a mass ratio of 1e-6


@dataclass(frozen=True)
class MassRatioSweep:
    """What becomes of every blow of a rigid mass on a uniform rod, by mass ratio alone; all arrays (ratios,).

    Time in round trips T, velocity in the impact speed, stress in v sqrt(E rho); compression positive.
    """

    support: str
    mass_ratio: np.ndarray  # target over impactor
    contacts: np.ndarray  # how many periods of contact
    periods: np.ndarray  # (ratios, most contacts, 2) start and end of each; NaN where there is none
    rebound_velocity: np.ndarray  # of the mass
    peak_stress: np.ndarray
    restitution: np.ndarray  # by centre-of-mass velocities and by impulses: one number, as momentum is conserved
    restitution_at_contact: np.ndarray  # by the touching surfaces, as they part for the last time


def mass_ratio_sweep(support: str = "fixed", ratios: np.ndarray | None = None) -> MassRatioSweep:
    """St. Venant's problem for many mass ratios; 200 from 1/1000 to 1000 if none are given.

    Error: rounding; every ratio is solved by the event-exact kernel of `waves`. Neither the rebound nor the number of
    contacts is monotone.
    Cost: 10 to 100 microseconds a ratio on one core. `stepped_waves` with 128 steps a round trip is six times cheaper
    and counts the contacts as well, but misses the rebound from heavy rods by up to 0.27 of the speed.
    Source: thesis 4.4, 4.5 for ratios other than 1.
    """
    reflection = {"fixed": 1.0, "free": -1.0}[checks.choice("support", support, ("fixed", "free"))]
    ratios = np.geomspace(1e-3, 1e3, 200) if ratios is None else np.asarray(ratios, float)
    low, high = RATIO_RANGE
    wrong = ratios[~((ratios >= low) & (ratios <= high))] if ratios.ndim == 1 else ratios.ravel()
    if wrong.size or not ratios.size:
        got = float(wrong[0]) if wrong.size else None
        raise SceneError("ratios", got, f"a list of mass ratios from {low:g} to {high:g}")
    for pieces in PIECES:
        complete, count, contacts = _blows(reflection, ratios, pieces)
        if complete:
            break
    last = np.take_along_axis(contacts, (count - 1)[:, None, None], axis=1)[:, 0]
    rebound, end_speed = last[:, 3], last[:, 6]
    target = 0.0 if support == "fixed" else (1.0 - rebound) / ratios
    return MassRatioSweep(
        support=support,
        mass_ratio=ratios,
        contacts=count,
        periods=contacts[:, : count.max(), :2].copy(),
        rebound_velocity=rebound,
        peak_stress=np.nanmax(contacts[:, :, 4], axis=1),
        restitution=target - rebound,
        restitution_at_contact=end_speed - rebound,
    )


@kernel
def _blows(reflection, ratios, pieces):
    """Every blow until the bodies part for good: whether all were followed so far, and their contacts, NaN-padded."""
    count = np.zeros(ratios.size, np.int64)
    contacts = np.full((ratios.size, MOST_CONTACTS, 7), np.nan)
    complete = True
    for i in range(ratios.size):
        found = rigid_waves.strike(ratios[i], reflection, rigid_waves.FOREVER, pieces, TERMS, MOST_CONTACTS)
        complete = complete and found[0] == rigid_waves.PARTED
        count[i] = found[6].shape[0]
        contacts[i, : count[i]] = found[6]
    return complete, count, contacts


def spaced(low: float, high: float, count: int = 21, spacing: str | None = None) -> np.ndarray:
    """`count` values from `low` to `high`; evenly, or by a constant factor if `spacing` is "log".

    Without `spacing`: "log" where the range is a hundredfold or more.
    """
    checks.whole_number("count", count, 2, MOST_VALUES)
    if not (np.isfinite(low) and np.isfinite(high) and low < high):
        raise SceneError("range", (low, high), "two finite numbers, the smaller one first")
    if spacing is None:
        spacing = "log" if low > 0.0 and high / low >= 100.0 else "linear"
    checks.choice("spacing", spacing, ("linear", "log"))
    if spacing == "log":
        if low <= 0.0:
            raise SceneError("range", low, "a number above zero, where the spacing is 'log'")
        return np.geomspace(low, high, count)
    return np.linspace(low, high, count)


def sweep(
    scene: Scene,
    key: str,
    values: Sequence[float],
    workers: int | None = None,
    cancel: Callable[[], bool] | None = None,
) -> list[dict[str, object]]:
    """The scene solved with each of the values for one of its keys, by the method it names.

    One row each: value, number of contacts, impulse [N s], peak_force [N], impactor velocity [m/s], restitution,
    energy_error, estimated_error; None where undefined. Keys that take whole numbers get rounded ones, once each.
    Raises SceneError with the first value that cannot be solved. `cancel()` true: what has not begun is left out.
    Cost: the solves, shared by `workers` threads (as many as there are processors); kernels run side by side.
    """
    checks.whole_number("number of values", len(values), 1, MOST_VALUES)
    values = [checks.number(key, float(value), -math.inf, math.inf) for value in values]
    if _takes_whole_numbers(scene, key, values[0]):
        values = list(dict.fromkeys(round(value) for value in values))
    scenes = [_with(scene, key, value) for value in values]  # all are read before any is solved
    rows = [_row(values[0], _solved(scenes[0]))]  # alone: if kernels must be compiled, then once

    def row(value: float, changed: Scene) -> dict[str, object] | None:
        return None if cancel is not None and cancel() else _row(value, _solved(changed))

    with all_processors(workers) as pool:
        rows += filter(None, pool.map(row, values[1:], scenes[1:]))
    return rows


def _solved(scene: Scene) -> Solution:
    """As it says itself; nobody reads the notes."""
    method, duration = read_method(scene.method, scene)
    return method.solve(scene, duration)


def _with(scene: Scene, key: str, value: float) -> Scene:
    changed = scene.replace({key: value})
    read_method(changed.method, changed)
    return changed


def _takes_whole_numbers(scene: Scene, key: str, value: float) -> bool:
    """Whether the key refuses a fraction and takes the whole number next to it."""
    for tried, refused in ((value, True), (round(value), False)):
        try:
            _with(scene, key, tried)
        except SceneError:
            if not refused:
                return False
        else:
            if refused:
                return False
    return True


def _row(value: float, solution: Solution) -> dict[str, object]:
    found: Mapping[str, object] = solution.diagnostics
    velocity = solution.impactor_velocity
    return {
        "value": value,
        "contacts": len(solution.contacts),
        "impulse": solution.impulse,
        "peak_force": solution.peak_force,
        "impactor": {"final_velocity": list(velocity) if isinstance(velocity, tuple) else velocity},
        "restitution": solution.restitution,
        "energy_error": found["energy_error"],
        "estimated_error": found["estimated_error"],
    }
