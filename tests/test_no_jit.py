"""The kernels as plain Python give what the compiled ones give."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from pytest import approx

import solvers
from solvers import Modal, Waves
from solvers.methods.waves.chain_grid import GridHistory
from solvers.methods.waves.chain_scene import ChainScene
from solvers.stability.runs import INTEGRATORS, problem_of, run
from tests.catalog import T, contact_table, struck_rod

from .patience import SECONDS

ROOT = Path(__file__).parents[1]


def answers() -> dict[str, list[float]]:
    """Small impacts by every kernel."""
    impacts = {
        "exact": Waves().solve(solvers.load("fixed-rod")),
        "stepped": Waves(steps=120).solve(struck_rod(1.0, "fixed"), 3.0 * T),
        "modal rigid": Modal(modes=3, steps=150).solve(struck_rod(1.0, "fixed"), 3.0 * T),
        "modal hertz": Modal(modes=3, steps=60).solve(struck_rod(1.0, "free", contact_table("hertz")), 2.0 * T),
        "modal kelvin-voigt": Modal(modes=3, steps=60).solve(
            struck_rod(1.0, "free", contact_table("kelvin-voigt")), 2.0 * T
        ),
        "modal plastic-power": Modal(modes=3, steps=60).solve(
            struck_rod(1.0, "free", contact_table("plastic-power")), 2.0 * T
        ),
        "waves linear": Waves(tolerance=1e-5).solve(struck_rod(1.0, "free", contact_table("linear")), 1.2 * T),
    }
    few = problem_of(struck_rod(1.0, "fixed"), {}, 3)
    steps = {"integrators": [run(name, few, 0.3 * few.step_unit).velocity for name in INTEGRATORS]}
    steps["grid"] = GridHistory(ChainScene(solvers.load("rod-with-gap")), 2.0, 2.0, 2e-3).force[1].tolist()
    return steps | {
        name: [
            impact.impactor_velocity,
            impact.impulse / impact.scene.impactor.mass,
            impact.contacts[0].end / T,
            impact.energy["target_vibration"] / impact.energy["initial"],
            len(impact.contacts),
        ]
        for name, impact in impacts.items()
    }


@pytest.mark.slow
def test_plain_python_gives_the_same():
    call = "import json, numba; assert numba.config.DISABLE_JIT; from tests import test_no_jit as here; "
    call += "print(json.dumps(here.answers()))"
    done = subprocess.run(
        [sys.executable, "-c", call], cwd=ROOT, capture_output=True, text=True, timeout=SECONDS,
        env=os.environ | {"NUMBA_DISABLE_JIT": "1"},
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    plain = json.loads(done.stdout)
    for name, compiled in answers().items():
        # compilers may reorder sums: rounding over some hundred steps
        assert plain[name] == approx(compiled, abs=1e-12), name
