"""One form for all sources: ruff's rules and layout, and pyright's types, as pyproject.toml sets them."""

import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]


@pytest.mark.parametrize("arguments", [["check"], ["format", "--check"]], ids=" ".join)
def test_ruff(arguments):
    call = [sys.executable, "-m", "ruff", *arguments, "--no-cache", "solvers", "app", "tests"]
    done = subprocess.run(call, cwd=ROOT, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.slow
def test_types():
    call = [sys.executable, "-m", "pyright", "--level", "warning", "--pythonpath", sys.executable]
    done = subprocess.run(call, cwd=ROOT, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stdout + done.stderr
