"""Numbers that stand in modules, and so in compiled kernels, are the same whatever computes them."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.machines import dispatched

from ..patience import SECONDS

ROOT = Path(__file__).parents[2]
CODE = """
import importlib, json, pkgutil
from hashlib import sha256
import numpy as np
import solvers

def written(value):
    if isinstance(value, (float, complex)):
        return repr(value)
    if isinstance(value, np.ndarray):
        return value.dtype.str + str(value.shape) + value.tobytes().hex()
    if isinstance(value, (tuple, list)):
        return repr([written(each) for each in value])
    if isinstance(value, dict):
        return repr([(str(key), written(each)) for key, each in value.items()])
    return ""

found = {}
for each in pkgutil.walk_packages(solvers.__path__, "solvers."):
    module = importlib.import_module(each.name)
    for name, value in vars(module).items():
        if not name.startswith("__") and written(value):
            found[each.name + "." + name] = written(value)
print(json.dumps(found))
"""
# Variables that have the libraries choose other instructions, each of a processor that all of them run. Both change
# together: what either does is seen, at half the processes.
MACHINES = (
    {"OPENBLAS_CORETYPE": "Prescott", "NPY_DISABLE_CPU_FEATURES": " ".join(dispatched())},
    {"OPENBLAS_CORETYPE": "Haswell"},
)


def constants(more: dict[str, str]) -> dict[str, str]:
    done = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", CODE], cwd=ROOT, env=os.environ | more, capture_output=True, text=True,
        timeout=SECONDS,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


@pytest.mark.slow
def test_constants_are_the_same_on_machines_that_compute_with_other_instructions():
    """Compiled into kernels, which are kept: one machine once gave two answers, by who had filled its cache."""
    first, second = (constants(machine) for machine in MACHINES)
    assert len(first) > 100 and "solvers.numerics.waves.collocation.INTEGRATE" in first
    assert {name for name in first if first[name] != second[name]} == set()
