"""How fast this machine is beside another: three solves, a second, by which stored times are scaled."""

import json
from collections.abc import Mapping
from contextlib import suppress
from functools import cache
from hashlib import sha256
from pathlib import Path
from typing import Any

from ..jit.cache import cache_home, keep_text
from ..provenance import machine
from .measured_code import code_of
from .three_solves import SECONDS, SOLVES, Times, measured

LEAST, MOST = 0.05, 20.0  # of a factor: beyond, something else was measured

Factors = dict[str, float]  # by kind of solve: times here over those there
_known: dict[Path, Times] = {}


def calibrate(seconds: float = SECONDS) -> Times:
    """Measure this machine by three solves, and keep it in the user's cache: from then on times are scaled by it.

    Returns the time of each [s]: of Python ("python"), of kernels, of linear algebra ("algebra").
    """
    found = measured(seconds)
    path = _path()
    with suppress(OSError):  # then it has to be measured again
        keep_text(path, json.dumps(found))
    _known[path] = found
    return found


def known() -> Times | None:
    """What `calibrate` has found on this machine, by this or another process; None: nobody has asked it."""
    path = _path()
    if path not in _known and path.exists():
        with suppress(OSError, ValueError):  # none, or half a one
            found = json.loads(path.read_text(encoding="utf-8"))
            if _whole(found):
                _known[path] = found
    return _known.get(path)


def factors(there: Mapping[str, float] | None, here: Mapping[str, float] | None = None) -> Factors | None:
    """Times here, which is this machine unless said otherwise, over those on the machine that took so long; None where
    either is not known.
    """
    here = known() if here is None else here
    if here is None or there is None or not _whole(there):
        return None
    return {kind: min(max(here[kind] / there[kind], LEAST), MOST) for kind in SOLVES}


def _whole(times: Any) -> bool:
    return isinstance(times, Mapping) and all(
        isinstance(times.get(kind), float) and times[kind] > 0.0 for kind in SOLVES
    )


def _path() -> Path:
    return cache_home() / _name()


@cache
def _name() -> str:
    """Of this machine and this code of the three solves."""
    code = code_of([method.NAME for method in SOLVES.values()], "errors")
    key = sha256(json.dumps([machine(), code], sort_keys=True).encode()).hexdigest()[:16]
    return f"calibration-{key}.json"
