"""What a solve costs before it is done: measured constants of every method, from bench/automatic.py."""

import json
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any

from ..scene import Scene
from . import calibration
from .three_solves import SOLVES

UNMEASURED = "modal"  # as which a method counts that `make tables` has not measured yet
STORED = Path(__file__).parent / "costs.json"
AS_MEASURED = dict.fromkeys(SOLVES, 1.0)


@cache
def stored_costs() -> dict[str, Any]:
    """`seconds`: constants by kind of solve; `machine`, `date`, `calibration` and `code` say where they are from."""
    return json.loads(STORED.read_text(encoding="utf-8"))


def expected_time(method: Mapping[str, Any], steps: int, scene: Scene) -> float:
    """Processor time of a warm solve [s]: a + b steps + c steps size + d size^3.

    On this machine, where it has been calibrated (`solvers.calibrate`), else on the one that costs.json names. `method`
    as in a scene file; size: its number of modes or elements, whatever it has.
    Error: within a factor of two for most solves, see bench/results.json.
    """
    return expected_of(kinds(method, scene), steps, work_size(method))


def expected_of(known_as: tuple[str, ...], steps: int, size: int) -> float:
    """The same of a solve of these kinds, the first that is known."""
    scale = calibration.factors(stored_costs().get("calibration")) or AS_MEASURED
    start, per_step, per_step_and_size, cubic = _constants(known_as)
    march = steps * (per_step + per_step_and_size * size)
    return scale["python"] * start + scale["kernels"] * march + scale["algebra"] * cubic * size**3


def scaled_time(seconds: float, method: Mapping[str, Any], scene: Scene, there: Mapping[str, float]) -> float:
    """What a solve of so many seconds takes on this machine; where it was done, a calibration took as long as `there`.

    Of its time, what every such solve costs besides goes by one of the three solves, linear algebra by another, and
    the rest by that of kernels. As it is, where either machine is not calibrated.
    """
    scale, own = calibration.factors(there), calibration.factors(stored_costs().get("calibration"), there)
    if scale is None:
        return seconds
    start, _, _, cubic = _constants(kinds(method, scene))
    own = own or AS_MEASURED
    python = min(seconds, own["python"] * start)
    algebra = min(seconds - python, own["algebra"] * cubic * work_size(method) ** 3)
    parts = {"python": python, "algebra": algebra, "kernels": seconds - python - algebra}
    return sum(scale[kind] * part for kind, part in parts.items())


def _constants(known_as: tuple[str, ...]) -> list[float]:
    known = stored_costs()["seconds"]
    return next(known[kind] for kind in (*known_as, UNMEASURED) if kind in known)


def kinds(method: Mapping[str, Any], scene: Scene) -> tuple[str, ...]:
    """What a solve has its constants of, the first that is known: method, model, kind of law, and whether bodies bend;
    the method with that alone; the method.

    To `waves` rigid faces are a kind of their own: a step between them costs nanoseconds, with any law microseconds.
    """
    name, model, law = str(method["name"]), str(method.get("model", "")), scene.contact
    kind = "plastic" if law.PLASTIC else "lossy" if law.LOSSY else "elastic"
    if name == "waves" and law.NAME == "rigid":
        kind = "rigid"
    body = "bending" if scene.impactor.bends or scene.target.bends else "axial"
    return " ".join(f"{name} {model} {kind} {body}".split()), f"{name} {body}", name


def work_size(method: Mapping[str, Any]) -> int:
    """How many unknowns a step, or an eigenvalue problem, deals with: elements or modes."""
    return int(method.get("elements") or method.get("modes") or 0)
