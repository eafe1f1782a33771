"""What more modes, or more elements, do to each figure of an impact: whether it converges, and how fast."""

import math
import time
from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np

from .. import validation
from ..bodies import Mechanism, Rod
from ..bodies.linkage.links import Link
from ..methods import METHODS
from ..methods.base import Method, SceneNotSupported
from ..numerics.processors import all_processors
from ..scene import Scene
from ..solution.motion import Bends
from ..solution.solution import Solution
from ..solve import read_method
from ..text.notes import Note, Severity
from ..validation import SceneError, allowed
from .sensitivity import plain

COUNTS = (3, 5, 10, 20, 40, 80)
FEWEST, MOST = 3, 12  # counts
INSTANTS, PLACES = 2_000, 41  # at which largest values of fields are looked for
CLOSE = 1e-6  # relative differences below this count as none
REGULAR = 0.7  # of natural logarithms about a fitted power: a factor of two
SETTLED = 1e-3  # differences among the last three that call for no order
SLOWEST = 0.4  # order that still counts as one
NO_ORDER = "no-order"  # the code of a figure whose differences follow no power
UNBOUNDED = 0.5  # smallest power of a figure that tends to zero, or to infinity


@dataclass(frozen=True)
class Convergence:
    """One figure per count of modes or elements, and what becomes of it; arrays (counts,), SI units.

    `differences` are those to the finest count, relative to the largest value, or for the velocity to the speed of
    approach and for the energy lost to the initial energy. `order` p: the differences fall as counts^-p; None where
    they do not, or where there is nothing to fit.
    """

    method: str
    kind: str  # "modes" or "elements"
    counts: np.ndarray
    units: dict[str, str]
    values: dict[str, np.ndarray]
    differences: dict[str, np.ndarray]
    order: dict[str, float | None]
    summary: dict[str, Note]
    wall_time: float

    def table(self) -> dict[str, Any]:
        """As plain lists and numbers."""
        table = plain({option.name: getattr(self, option.name) for option in fields(self)})
        words = {name: f"{name.replace('_', ' ')}: {note}" for name, note in self.summary.items()}
        codes = {name: note.table() for name, note in self.summary.items()}
        return table | {"summary": words, "told": words, "summary_codes": codes}


def convergence(scene: Scene, modes: Sequence[int] = COUNTS, method: str | Method = "modal") -> Convergence:
    """The impact solved with each of these numbers of modes; of elements by 'fe-nodal' and 'fe-modal'.

    Bodies that say themselves how many modes they have, links and pendulums that bend, are given as many.
    All are followed for as long as the finest one. What is compared: velocity and impulse, peak force, first parting,
    contacts, deepest position of the struck point, energy lost, and of the fields the largest shear force of a beam, of
    a rod the largest stress: where it is held, and anywhere.
    Error: peaks of fields are sampled at 2 000 instants.
    Cost: the solves, side by side on all processors.
    """
    begun = time.perf_counter()
    counts = _counts(modes)
    chosen, kind, duration = _method(scene, method)
    refused = chosen.refusal(scene)
    if refused:
        raise SceneNotSupported("method.name", chosen.NAME, refused)
    counts, levels = _levels(scene, chosen, kind, counts)
    finest = _solved(levels[-1], duration)
    with all_processors() as pool:
        others = list(pool.map(lambda level: _solved(level, finest.duration), levels[:-1]))
        rows = list(pool.map(_figures, [*others, finest]))
    numbers = np.array(counts, float)
    values = {name: np.array([row[name] for row in rows]) for name in rows[-1]}
    values = {name: column for name, column in values.items() if np.isfinite(column).all() and column.any()}
    scales = {"final_velocity": scene.speed, "energy_lost": scene.initial_energy}
    rated = {
        name: _rate(name, numbers, column, scales.get(name, float(np.abs(column).max())), kind)
        for name, column in values.items()
    }
    if scene.rigid_contact and scene.bends:
        rated = {name: (*found[:2], _without_limit(found[2])) for name, found in rated.items()}
    return Convergence(
        method=chosen.NAME,
        kind=kind,
        counts=np.array(counts),
        units={name: UNITS[name] for name in values},
        values=values,
        differences={name: found[0] for name, found in rated.items()},
        order={name: found[1] for name, found in rated.items()},
        summary={name: found[2] for name, found in rated.items()},
        wall_time=time.perf_counter() - begun,
    )


UNITS = {
    "final_velocity": "m/s",
    "impulse": "N s",
    "peak_force": "N",
    "contacts": "",
    "first_parting": "s",
    "last_parting": "s",
    "peak_deflection": "m",
    "support_shear": "N",
    "peak_shear": "N",
    "support_stress": "Pa",
    "peak_stress": "Pa",
    "energy_lost": "J",
}


def _counts(given: Sequence[int]) -> list[int]:
    if isinstance(given, (str, bytes)) or not FEWEST <= len(given) <= MOST:
        raise SceneError("modes", given, allowed("list", low=FEWEST, high=MOST, of="whole"))
    counts = [validation.whole_number("modes", count, 1, 10_000) for count in given]
    if counts != sorted(set(counts)):
        raise SceneError("modes", counts, allowed("rising"))
    return counts


def _method(scene: Scene, given: str | Method) -> tuple[Method, str, float | None]:
    """The method without its estimate of the error, the option that is varied, and the duration."""
    named, duration = read_method(scene.method, scene)
    if isinstance(given, Method):
        chosen = given
    elif given == named.NAME:
        chosen = named
    else:
        chosen = METHODS[validation.choice("method.name", given, METHODS)].read({})
    options = {option.name for option in fields(chosen)}
    kind = next((name for name in ("elements", "modes") if name in options), None)
    if any(link.flexible for link in _links(scene)):  # of whose modes alone it depends how well they are known
        return chosen.without_estimate(), "modes", duration
    if kind is None:
        known = [name for name, method in METHODS.items() if {"elements", "modes"} & {f.name for f in fields(method)}]
        raise SceneError("method.name", chosen.NAME, allowed("resolved-method", names=known))
    if getattr(chosen, kind) is None:  # some, where it is left out, do without
        chosen = replace(chosen, **{kind: 1})
    return chosen.without_estimate(), kind, duration


def _links(scene: Scene) -> list[Link]:
    return [link for body in (scene.impactor, scene.target) if isinstance(body, Mechanism) for link in body.links]


def _levels(scene: Scene, method: Method, kind: str, counts: list[int]) -> tuple[list[int], list[tuple[Method, Scene]]]:
    """Method and scene by each of the counts, as far as links of finite elements have so many modes."""
    found: dict[int, tuple[Method, Scene]] = {}
    has = any(option.name == kind for option in fields(method))
    for count in counts:
        level, finer = replace(method, **{kind: count}) if has else method, scene
        bodies = {"impactor": scene.impactor.with_own_modes(count), "target": scene.target.with_own_modes(count)}
        if kind == "modes" and any(body is not getattr(scene, name) for name, body in bodies.items()):
            finer = replace(scene, **bodies, given={})
        if all(link.modes in (0, count) for link in _links(finer)):
            found[count] = level, finer
    if len(found) < FEWEST:
        raise SceneError("modes", counts, allowed("fewer-modes", low=FEWEST))
    return list(found), list(found.values())


def _solved(level: tuple[Method, Scene], duration: float | None) -> Solution:
    method, scene = level
    return method.solve(scene, duration)


def _figures(solution: Solution) -> dict[str, float]:
    """What is compared, NaN where it does not exist."""
    given: dict[str, float | None] = {
        "final_velocity": solution.impactor_velocity,
        "impulse": solution.impulse,
        "peak_force": solution.peak_force,
        "contacts": len(solution.contacts),
        "first_parting": solution.contacts[0].end,
        "last_parting": solution.contacts[-1].end,
        "energy_lost": solution.energy["dissipated"],
    }
    target, motion = solution.scene.target, solution.known_motion
    instants = np.linspace(0.0, solution.duration, INSTANTS + 1)
    given["peak_deflection"] = float(motion.end_position(instants).max())
    if target.bends or isinstance(target, Rod):
        name, held, of = "stress", PLACES - 1, motion.stress
        if target.bends and isinstance(motion, Bends):
            name, held, of = "shear", 0, motion.shear
        field = np.abs(of(instants, np.linspace(0.0, target.length, PLACES)))
        given[f"peak_{name}"] = float(field.max())
        given[f"support_{name}"] = float(field[:, held].max()) if target.held else None
    return {name: math.nan if (value := given.get(name)) is None else value for name in UNITS}


def _rate(
    name: str, counts: np.ndarray, values: np.ndarray, scale: float, kind: str
) -> tuple[np.ndarray, float | None, Note]:
    """Relative differences to the finest, the order, and the note."""
    differences = np.abs(values - values[-1]) / scale
    own = {"resolution": kind}
    if name == "contacts":
        return differences, None, _settles(counts, values, kind)
    if differences.max() <= CLOSE:
        return differences, None, Note("same-for-all", Severity.REMARK, **own, error=differences.max())
    power, irregular, last = _power(counts, np.abs(values))
    if abs(power) >= UNBOUNDED and irregular <= 0.5 * REGULAR and last >= 0.5:
        return differences, None, Note("diverges", Severity.WARNING, **own, power=power, grows=power > 0.0)
    order, irregular = _order(counts, differences)
    if order is None or irregular > REGULAR or order < SLOWEST:
        last = differences[-3:].max()
        left_open = own | {"error": 100.0 * last, "count": round(counts[-3])}
        if last <= SETTLED:
            return differences, None, Note("converged", Severity.REMARK, **left_open)
        return differences, None, Note(NO_ORDER, Severity.WARNING, **left_open, limitless=False)
    left = differences[-2] / ((counts[-1] / counts[-2]) ** order - 1.0)
    count = round(counts[-1])
    return differences, order, Note("converges", Severity.REMARK, **own, order=order, error=left, count=count)


def _without_limit(note: Note) -> Note:
    """Of a rigid contact with a beam: where there is no order there is no limit either."""
    if note.code != NO_ORDER:
        return note
    return Note(NO_ORDER, note.severity, **note.values | {"limitless": True})


def _settles(counts: np.ndarray, values: np.ndarray, kind: str) -> Note:
    same = values == values[-1]
    first = int(np.flatnonzero(~same)[-1]) + 1 if not same.all() else 0
    if first < values.size - 1:
        contacts, count = round(values[-1]), round(counts[first])
        return Note("contacts-settle", Severity.REMARK, contacts=contacts, count=count, resolution=kind)
    return Note("contacts-scatter", Severity.WARNING, lowest=round(values.min()), highest=round(values.max()))


def _power(counts: np.ndarray, values: np.ndarray) -> tuple[float, float, float]:
    """Exponent of the power of the counts that the values follow, the scatter of their logarithms about it, and the
    exponent of the last two alone as a part of it.
    """
    if values.min() <= 0.0:
        return 0.0, math.inf, 0.0
    x, y = np.log(counts), np.log(values)
    slope, start = np.polyfit(x, y, 1)
    last = (y[-1] - y[-2]) / (x[-1] - x[-2]) / slope if slope else 0.0
    return float(slope), float(np.sqrt(np.mean((y - slope * x - start) ** 2))), float(last)


def _order(counts: np.ndarray, differences: np.ndarray) -> tuple[float | None, float]:
    """p of differences = C (counts^-p - finest^-p), which counts that the finest is not exact, and the scatter."""
    differing = differences[:-1] > CLOSE
    if differing.sum() < 2:
        return None, math.inf
    x, y = counts[:-1][differing] / counts[-1], np.log(differences[:-1][differing])
    orders = np.arange(0.1, 6.001, 0.02)
    misses = y - np.log(x[None, :] ** -orders[:, None] - 1.0)
    scatter = np.sqrt(np.mean((misses - misses.mean(axis=1, keepdims=True)) ** 2, axis=1))
    best = int(np.argmin(scatter))
    if best in (0, orders.size - 1):
        return None, math.inf
    return float(orders[best]), float(scatter[best])
