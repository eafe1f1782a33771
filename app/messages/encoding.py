"""The layout of a message to the browser, and what messages of all kinds share.

Length of the header (4 bytes, little endian), header (JSON), zeros up to a multiple of four, then float32 arrays in the
order and shape that the header states, last index fastest; where it states a unit besides, whole numbers of two bytes
of that unit, filled up with zeros to a multiple of four bytes.
"""

import json
import math
import os
from typing import Any

import numpy as np

from solvers import Balance, QuasiStatic, RigidImpulse, Scene, Solution, Waves
from solvers.contact import PlasticPower
from solvers.methods.modal.motion import ModalMotion
from solvers.numerics.modal_drawn import early_instant
from solvers.numerics.waves.drawn import BEYOND
from solvers.solution.touch import pressing
from solvers.text.notes import Note

from ..choices.choices import SOLVED_BY
from .schema import check

FORCE_POINTS = 1_200  # of a contact force
LARGEST_MASS = 1e12  # [kg] sent for what has none or is infinite
SHOWN = (
    "name",
    "duration",
    "modes",
    "elements",
    "restitution",
    "model",
    "frame",
)  # keys of a method that the page sets, or shows
CHECKED = bool(os.environ.get("IMPACT_CHECK_MESSAGES"))  # set by the tests: takes a twelfth of making a message
MEASURED = "wall_time", "compile_time"  # [s]
CYCLE_POINTS, IMPACT_POINTS = 60, 300  # of the contact law's cycle, and of the impact in it


Stretch = tuple[float, float] | None  # of time that is looked at closely [s]; None: all of it
_USUAL = {name: method() for name, method in SOLVED_BY.items()}


def coded(notes: list[Note]) -> list[dict[str, Any]]:
    """As the browser takes notes, which has the words."""
    return [note.table() for note in notes]


def figures_of(solution: Solution) -> dict[str, Any]:
    """What every solution says of itself, whatever its units, and what its method takes into account."""
    name = solution.method["name"]
    sudden = name == RigidImpulse.NAME
    return {
        "sudden": sudden,
        "waves": not sudden and name != QuasiStatic.NAME,
        "travelling": name == Waves.NAME,
        "byLaw": not sudden and name != Balance.NAME,
        "stillTouching": bool(solution.contacts[-1].end >= solution.duration * (1.0 - 1e-9)),
        "peakForce": solution.peak_force,
        "peakIndentation": solution.peak_indentation,
        "residualIndentation": solution.residual_indentation,
        "restitution": solution.restitution,
        "energy": solution.energy,
        "diagnostics": _with_short_times(solution.diagnostics),
        "notes": coded(solution.notes),
    }


def _with_short_times(diagnostics: dict[str, Any]) -> dict[str, Any]:
    """With measured times of a few digits: how long a message is does not hang on the clock."""
    times = {key: float(f"{diagnostics[key]:.4g}") for key in MEASURED if diagnostics.get(key) is not None}
    return diagnostics | times


def refusals(scene: Scene) -> dict[str, dict[str, Any] | None]:
    """Of every method why it cannot solve the scene, or None."""
    found = {name: method.refusal(scene) for name, method in _USUAL.items()}
    return {name: note and note.table() for name, note in found.items()}


def unshown(scene: Scene) -> list[str]:
    """Keys of its method that the page has no control for."""
    return [f"method.{key}" for key in scene.method if key not in SHOWN]


def force_history(solution: Solution, stretch: Stretch = None) -> tuple[np.ndarray, np.ndarray]:
    """Times [s] and contact forces [N], thinned so that every part keeps its highest and lowest."""
    time, force = solution.known_motion.force_history()
    start, end = stretch or (0.0, solution.duration)
    inside = (time >= start) & (time <= min(end, solution.duration))
    time, force = time[inside], force[inside]
    if time.size <= FORCE_POINTS:
        return time, force
    part = -(-2 * time.size // FORCE_POINTS)
    starts = np.arange(0, time.size, part)
    padded = np.pad(force, (0, starts.size * part - time.size), "edge").reshape(starts.size, part)
    extremes = starts + padded.argmin(axis=1), starts + padded.argmax(axis=1)
    rows = np.unique(np.concatenate((*extremes, [0, time.size - 1])))
    return time[rows], force[rows]


def cycle(exact: Solution, samples: int = IMPACT_POINTS) -> dict[str, Any]:
    """The contact law's cycle, slowly to the depth of this impact and back, and what this impact did [m, N]."""
    law, deepest = exact.scene.contact, exact.peak_indentation
    if deepest is None or deepest <= 0.0:
        return {}
    time = np.linspace(0.0, min(exact.duration, BEYOND * exact.contacts[-1].end), samples)
    if isinstance(exact.motion, ModalMotion):  # its force is constant over each step: given in the middle
        step = exact.motion.step
        time = (np.minimum(np.floor(time / step), np.floor(exact.duration / step) - 1.0) + 0.5) * step
    depth = exact.known_motion.impactor_position(time) - exact.known_motion.end_position(time)
    force = exact.known_motion.force(time)
    force[depth <= law.dent(0.0)] = 0.0
    down = np.linspace(0.0, deepest, CYCLE_POINTS)
    return {
        "cycleDepth": down,
        "cycleLoading": np.array([law.force(a, 0.0, 0.0) for a in down.tolist()]),
        "cycleUnloading": np.array([law.force(a, 0.0, deepest) for a in down.tolist()]),
        "blowDepth": whole_numbers(depth),
        "blowForce": whole_numbers(force),
        **_touch(exact, time),
        **_pressing(exact.scene.struck, deepest),
    }


def _touch(exact: Solution, time: np.ndarray) -> dict[str, Any]:
    """The circle on which two smooth bodies touch in it, and the pressure there; nothing by other laws."""
    if (found := exact.touch(time)) is None:
        return {}
    pressure = found.pressure if found.greatest is None else found.greatest
    flows = found.greatest is None and found.strength
    flow = {"touchFlow": whole_numbers(found.pressure / found.strength)} if flows else {}
    circle = {"touchRadius": whole_numbers(found.radius), "touchPressure": whole_numbers(pressure)}
    return {"touchTime": whole_numbers(time), **circle, **flow}


def _pressing(scene: Scene, deepest: float) -> dict[str, Any]:
    """How far a contact by Tabor's law flows, up to full flow where this impact is at least half as deep [m]."""
    law = scene.contact
    if not isinstance(law, PlasticPower):
        return {}
    reach = max(deepest, min(2.0 * deepest, law.full_indentation))
    corners = [depth for depth in (law.yield_indentation, law.full_indentation) if depth <= reach]
    found = pressing(scene, np.union1d(reach * np.linspace(0.0, 1.0, CYCLE_POINTS) ** 2, corners))
    if found is None:
        return {}
    tested = np.isfinite(found.tests)
    return {
        "flowDepth": found.indentation,
        "flowPressure": found.pressure,
        "flowRadius": found.radius,
        "flowElastic": found.elastic,
        "testsDepth": found.indentation[tested],
        "testsPressure": found.tests[tested],
        "testsForce": found.tested[tested],
    }


def packed(header: dict[str, Any], arrays: dict[str, Any]) -> bytes:
    """One message from a header and its arrays: float32, or whole numbers of two bytes given as (numbers, unit).

    Raises ValueError where they are not as app.messages.schema says, if messages are `CHECKED`.
    """
    entries, parts = [], []
    for name, values in arrays.items():
        if isinstance(values, tuple):
            numbers, unit = values
            entries.append([name, list(numbers.shape), unit])
            parts.append(numbers.astype("<i2").tobytes() + b"\0" * (2 * (numbers.size % 2)))
        else:
            entries.append([name, list(values.shape)])
            parts.append(values.astype("<f4").tobytes())
    if CHECKED:
        check(header, {name: tuple(shape) for name, shape, *_ in entries})
    text = json.dumps(header | {"arrays": entries}, allow_nan=False, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    return len(text).to_bytes(4, "little") + text + b"".join(parts)


def read_header(message: bytes) -> dict[str, Any]:
    """The header of a message."""
    length = int.from_bytes(message[:4], "little")
    return json.loads(message[4 : 4 + length])


def arrays_of(message: bytes) -> dict[str, np.ndarray]:
    """The arrays of a message, in the shapes that its header states.

    Raises AssertionError if there is more than these.
    """
    offset, found = 4 + int.from_bytes(message[:4], "little"), {}
    for name, shape, *unit in read_header(message)["arrays"]:
        size = math.prod(shape)
        if unit:
            found[name] = unit[0] * np.frombuffer(message, "<i2", size, offset).reshape(shape)
            offset += 2 * (size + size % 2)
        else:
            found[name] = np.frombuffer(message, "<f4", size, offset).reshape(shape)
            offset += 4 * size
    assert offset == len(message)
    return found


def instants(duration: float, count: int, stretch: Stretch = None) -> np.ndarray:
    """Times [s] from 0 to the end, closer together at first; evenly over a stretch that is looked at closely."""
    if stretch:
        return over(stretch, duration, count)
    return early_instant(np.arange(count), count, duration)


def over(stretch: Stretch, duration: float, count: int) -> np.ndarray:
    """Times [s] spread evenly over a stretch, as far as the solution reaches; over all of it without one."""
    start, end = stretch or (0.0, duration)
    return np.linspace(min(start, duration), min(end, duration), count)


def around(time: np.ndarray, edges: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Instants with edges among them, at which values may jump: each edge twice; and which are after the jump."""
    edges = edges[(edges >= time[0]) & (edges <= time[-1])]
    time = np.setdiff1d(time, edges)
    both, after = np.concatenate((time, edges, edges)), np.repeat((True, False, True), (time.size, *2 * [edges.size]))
    order = np.argsort(both, kind="stable")
    return both[order], after[order]


def whole_numbers(values: np.ndarray) -> tuple[np.ndarray, float]:
    """Two bytes a number, and their unit."""
    unit = float(np.abs(values).max(initial=0.0)) / 32_767 or 1.0
    return np.rint(values / unit).astype("<i2"), unit
