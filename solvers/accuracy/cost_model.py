"""What a solve costs before it is done: measured constants of every method, from bench/automatic.py."""

import json
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any

UNMEASURED = "modal"  # as which a method counts that `python -m bench --only automatic` has not measured yet
STORED = Path(__file__).parent / "costs.json"


@cache
def _constants() -> dict[str, list[float]]:
    return json.loads(STORED.read_text(encoding="utf-8"))["seconds"]


def expected_time(method: Mapping[str, Any], steps: int, law: Any) -> float:
    """Time of a warm solve [s] on the machine that costs.json names: a + b steps + c steps size + d size^3.

    `method` as in a scene file; size: its number of modes or elements, whatever it has; `law` of the contact.
    Error: within a factor of two for most solves there, see bench/results.json; elsewhere only the order of methods is
    worth something.
    """
    known = _constants()
    start, per_step, per_step_and_size, cubic = next(
        known[kind] for kind in (*kinds(method, law), UNMEASURED) if kind in known
    )
    size = work_size(method)
    return start + steps * (per_step + per_step_and_size * size) + cubic * size**3


def kinds(method: Mapping[str, Any], law: Any) -> tuple[str, str]:
    """What a solve has its constants of: method, model and kind of law; the method alone, where these are not known.

    To `waves` rigid faces are a kind of their own: a step between them costs nanoseconds, with any law microseconds.
    """
    name, model = str(method["name"]), str(method.get("model", ""))
    kind = "plastic" if law.PLASTIC else "lossy" if law.LOSSY else "elastic"
    if name == "waves" and law.NAME == "rigid":
        kind = "rigid"
    return " ".join(f"{name} {model} {kind}".split()), name


def work_size(method: Mapping[str, Any]) -> int:
    """How many unknowns a step, or an eigenvalue problem, deals with: elements or modes."""
    return int(method.get("elements") or method.get("modes") or 0)
