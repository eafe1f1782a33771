"""Imports point one way only: the contracts of pyproject.toml, checked by import-linter."""

import subprocess
import sys
from pathlib import Path

import pytest

from ..patience import SECONDS

ROOT = Path(__file__).parents[2]


def test_import_contracts_hold():
    # its command has no `python -m`; the same call in a process of its own, as it changes sys.path and logging
    call = "import sys; from importlinter.cli import lint_imports; sys.exit(lint_imports(no_cache=True, no_logo=True))"
    done = subprocess.run([sys.executable, "-c", call], cwd=ROOT, capture_output=True, text=True, timeout=SECONDS)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "0 broken" in done.stdout
    assert "7 kept" in done.stdout


@pytest.mark.slow
def test_the_library_loads_neither_the_page_nor_anything_slow():
    call = (
        "import sys, solvers; "
        "slow = ('app', 'panel', 'param', 'bokeh', 'holoviews', 'xarray', 'tornado', 'solvers.notebook', "
        "'dask', 'distributed', 'matplotlib'); "
        "print([name for name in slow if name in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", call], cwd=ROOT, capture_output=True, text=True, timeout=SECONDS)
    assert done.stdout.strip() == "[]", done.stdout + done.stderr
