"""Kernels in the cache, and who must not compile one."""

import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]
TRY = """
import numpy as np
from solvers.jit import NotCompiled, compiled_only
from solvers.numerics.polynomials import value

def found():
    return value(np.array([1.0, 2.0]), 1, 3.0)

try:
    with compiled_only():
        print(found())
except NotCompiled as wanted:
    print(wanted)
    print(found())
"""


def test_a_kernel_is_refused_until_it_is_in_the_cache(tmp_path):
    def answers() -> list[str]:
        call = [sys.executable, "-c", TRY]
        where = os.environ | {"NUMBA_CACHE_DIR": str(tmp_path)}
        return subprocess.run(call, cwd=ROOT, env=where, capture_output=True, text=True, check=True).stdout.split()

    assert answers() == ["value", "7.0"]
    assert answers() == ["7.0"]
