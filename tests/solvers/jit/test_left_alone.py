"""Who imports the library has Numba as it was: for his own kernels, and those of others."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from ...patience import SECONDS

ROOT = Path(__file__).parents[3]
pytestmark = pytest.mark.slow

STATE = """
import json, os, sys, types, warnings
import numba, numba.extending, scipy.linalg, llvmlite.binding
from numba.core import caching, codegen, compiler, cpu, errors, event, registry, targetconfig
from llvmlite.binding import ffi

registry.cpu_target.target_context, numba.njit(lambda x: x)(1)  # what Numba makes of itself when it is first used


def state():
    "All that modules of Numba and their classes are made of, by what it is."
    found = {}
    for name, module in list(sys.modules.items()):
        if name.split(".")[0] in ("numba", "llvmlite") and isinstance(module, types.ModuleType):
            for key, value in vars(module).items():
                found[name, key] = value
                if isinstance(value, type) and value.__module__.split(".")[0] in ("numba", "llvmlite"):
                    found |= {(name, key, part): each for part, each in vars(value).items()}
    config = {key: value for key, value in vars(numba.config).items() if key.isupper()}
    return found, config, list(warnings.filters), dict(os.environ), list(ffi.lib._lock._cblist), \\
        {kind: list(each) for kind, each in event._registered.items() if kind != "numba:compiler_lock"}


before = state()
import solvers, solvers.jit.shortcuts
{more}
after = state()
changed = [" ".join(key) for key, value in before[0].items() if after[0].get(key) is not value]
names = "config filters environment lock events".split()
changed += [name for name, a, b in zip(names, before[1:], after[1:]) if a != b]
print(json.dumps(changed))
"""


def in_child(code: str, **more: str) -> str:
    where = {key: value for key, value in os.environ.items() if key != "NUMBA_CACHE_DIR"} | more
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, env=where, capture_output=True, text=True, timeout=SECONDS
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_nothing_of_numba_is_another_thing_after_the_import():
    solved = "solvers.solve(solvers.load('fixed-rod'))"
    assert json.loads(in_child(STATE.replace("{more}", solved))) == []


def test_the_programs_own_processes_do_change_it():
    """So that the test above sees what it should."""
    changed = json.loads(in_child(STATE.replace("{more}", "solvers.jit.shortcuts.shorten()")))
    expected = ("numba.core.targetconfig TargetConfig __eq__", "numba.core.codegen JITCPUCodegen set_env", "events")
    assert set(expected) <= set(changed)
    assert "numba.core.caching IndexDataCacheFile" not in changed


FOREIGN = """
from typing import NamedTuple
import numba

class Push(NamedTuple):
    force: float
    mean: float
    corner: float

@numba.njit(cache=True)
def of_fields(push):
    return push.force + push.mean + push.corner
"""
USE = """
import json, sys
sys.path.insert(0, {folder!r})
if {ours}:
    import solvers
    solvers.solve(solvers.load("fixed-rod"))
import foreign
from numba.core import errors
answer = foreign.of_fields(foreign.Push(1.0, 2.0, 4.0))
cache = foreign.of_fields._cache
try:
    import numba
    numba.njit(lambda x: x.nothing)(1.0)
except errors.TypingError as refusal:
    said = str(refusal)
print(json.dumps([
    answer, sum(foreign.of_fields.stats.cache_hits.values()), foreign.of_fields.stats.cache_path,
    [cache._impl.locator.get_source_stamp().hex(), type(cache).__name__, type(cache._cache_file).__name__],
    repr(list(foreign.of_fields.overloads.values())[0].library.__class__), said,
]))
"""


def test_a_kernel_of_another_library_is_compiled_and_kept_as_without_this_one(tmp_path):
    """Its fields are fields, even those with the names of methods of contact laws; both find it where it was kept."""
    (tmp_path / "foreign.py").write_text(FOREIGN, encoding="utf-8")

    def answer(ours: bool) -> list:
        code = USE.format(folder=str(tmp_path), ours=ours)
        return json.loads(in_child(code, NUMBA_COLOR_SCHEME="dark_bg"))

    value, hits, place, *made = answer(ours=True)
    assert (value, hits) == (7.0, 0)
    assert Path(place).is_relative_to(tmp_path) and list(Path(place).glob("foreign.of_fields*.nbi"))
    assert answer(ours=False) == [7.0, 1, place, *made]
