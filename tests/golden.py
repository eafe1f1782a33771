"""What every built-in scene shows, kept: so that what only moves code can be seen to change nothing.

`python -m tests.golden` keeps what they show now, where a change is meant. Numbers are kept to nine digits, arrays by
their shapes, sizes and sums with weights that are drawn once.
"""

import json
import lzma
import math
import re
import zlib
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from app.choices.choices import SCENES
from app.messages.encoding import arrays_of, read_header

from .app.messages.own import own_message

KEPT = Path(__file__).with_name("golden.json.xz")
CLOSE = 1e-6  # relative, far above rounding and what it is magnified by in all scenes but SENSITIVE
NOTHING = 1e-9  # of what is 1 in units of its own; residuals of balances are less
# In which the last bits of a processor show: many contacts that magnify, and instants that are chosen as it is solved.
# Of these keys and words are compared.
SENSITIVE = {
    "bent-rods", "newtons-cradle", "figure-5.12", "figure-5.19", "figure-5.20", "figure-6.3", "figure-6.4",
    "figure-6.5", "figure-6.7", "figure-6.8", "figure-6.9", "figure-6.10", "figure-6.11", "figure-8.9", "figure-8.10",
    "table-6.1", "table-6.2", "table-6.3", "table-6.6", "table-6.8",
}  # fmt: skip
SUMS, OF_SUMS = 3, 2e-5  # of an array; of its largest value: some are sent in two bytes
# Measured, or by how many steps something was found.
UNSTEADY = {"wall_time", "compile_time", "steps", "energy_error", "momentum_error", "raw_contacts", "raw_peak_force"}
OF_MODES = re.compile(r"(amounts|moment|shape|shear)(Rows|Of\d)|modalAtContact|.*\.atContact\[")  # of either sign
ELSEWHERE = {"own", "head", "arrays", "cost"}  # the same again, the source, what is kept as shapes


def shown(name: str) -> dict[str, Any]:
    """Figures, notes, events and arrays of a scene as it is when it is chosen."""
    message = own_message(name)
    header = {key: value for key, value in read_header(message).items() if key not in ELSEWHERE}
    arrays = {
        key: _digest(np.abs(values) if OF_MODES.match(key) else values) for key, values in arrays_of(message).items()
    }
    return {"header": _rounded(header), "arrays": arrays}


def differences(name: str, now: dict[str, Any]) -> list[str]:
    """Between what is kept of a scene and what it shows now: where, and both values."""
    was, sensitive = kept()[name], name in SENSITIVE
    pairs = _pairs("", was["header"], now["header"])
    found = [f"{where}: {a!r}, now {b!r}" for where, a, b in pairs if not _alike(where, a, b, sensitive)]
    for key in sorted(was["arrays"].keys() | now["arrays"].keys()):
        a, b = (each["arrays"].get(key) for each in (was, now))
        if a is None or b is None or (a[0] != b[0] and not sensitive):
            found.append(f"{key}: {a and a[0]}, now {b and b[0]}")
        elif not sensitive and not np.allclose(a[1:], b[1:], rtol=CLOSE, atol=OF_SUMS * max(abs(a[1]), NOTHING)):
            found.append(f"{key}: {a[1:]}, now {b[1:]}")
    return found


@cache
def kept() -> dict[str, Any]:
    return json.loads(lzma.decompress(KEPT.read_bytes()))


def _digest(values: np.ndarray) -> list[Any]:
    """Shape, largest value, and means with weights."""
    flat = values.astype(float).ravel()
    weights = np.random.default_rng(flat.size).standard_normal((SUMS, flat.size)) / math.sqrt(max(flat.size, 1))
    return [list(values.shape), *map(_digits, [np.abs(flat).max(initial=0.0), *(weights @ flat)])]


def _rounded(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _rounded(each) for key, each in value.items() if key not in UNSTEADY}
    if isinstance(value, list):
        return [_rounded(each) for each in value]
    if isinstance(value, str) and len(value) > 200:
        return zlib.crc32(value.encode())
    return _digits(value) if isinstance(value, float) else value


def _digits(value: float) -> float:
    return float(f"{value:.9g}")


def _pairs(where: str, a: Any, b: Any) -> Iterator[tuple[str, Any, Any]]:
    """What stands at the same place of two nested tables."""
    if isinstance(a, dict) and isinstance(b, dict):
        for key in sorted(a.keys() | b.keys()):
            yield from _pairs(f"{where}.{key}", a.get(key), b.get(key))
    elif isinstance(a, list) and isinstance(b, list) and len(a) == len(b):
        for number, both in enumerate(zip(a, b, strict=True)):
            yield from _pairs(f"{where}[{number}]", *both)
    else:
        yield where, a, b


def _alike(where: str, a: Any, b: Any, sensitive: bool) -> bool:
    if not all(isinstance(each, (int, float)) and not isinstance(each, bool) for each in (a, b)):
        return a == b or (sensitive and isinstance(a, list) and isinstance(b, list))  # of other lengths
    a, b = (abs(a), abs(b)) if OF_MODES.match(where) else (a, b)
    return sensitive or math.isclose(a, b, rel_tol=CLOSE, abs_tol=NOTHING)


if __name__ == "__main__":
    found = {name: shown(name) for name in SCENES}
    KEPT.write_bytes(lzma.compress(json.dumps(found, separators=(",", ":"), sort_keys=True).encode()))
    print(f"{len(found)} scenes, {KEPT.stat().st_size / 1e3:.0f} kB")
