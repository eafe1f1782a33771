"""Of which code the stored tables hold, and what of it has changed since they were measured."""

import inspect
from collections.abc import Iterable, Mapping
from functools import cache
from pathlib import Path

from ..fingerprint import remembered
from ..methods import METHODS

HERE = Path(__file__).parent
MEASURING = {  # files whose own code says what is measured of the solutions
    "errors": ("quantities.py", "reference.py", "refinement.py", "three_solves.py"),
    "costs": ("cost_model.py", "refinement.py", "three_solves.py"),
    "regimes": ("reference.py", "../regimes/models.py"),
}


@cache
def code_now() -> dict[str, str]:
    """Fingerprints of the code of every method, by name, and of what measures them."""
    named = {name: ([Path(inspect.getfile(method)).resolve()], True) for name, method in METHODS.items()}
    named |= {name: ([(HERE / source).resolve() for source in files], False) for name, files in MEASURING.items()}
    return remembered(named)


def code_of(methods: Iterable[str], measuring: str) -> dict[str, str]:
    """What a table of these methods is to keep."""
    now = code_now()
    return {name: now[name] for name in (measuring, *sorted(set(methods)))}


def changed(code: Mapping[str, str] | None) -> list[str]:
    """Names of what has changed since a table with this code was measured; of one that does not say, all methods."""
    now = code_now()
    return list(METHODS) if code is None else [name for name in code if now.get(name) != code[name]]
