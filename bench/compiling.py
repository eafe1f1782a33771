"""Kernels from an empty cache: what the first who solves waits for, and what `impact warm` takes."""

import os
import subprocess
import sys
import tempfile
import time

from .size import of, some
from .timing import row

FIRST = ("fixed-rod", "figure-3.3", "table-8.4", "split-hopkinson")  # waves, two balls, a beam, a chain of rods


def measure() -> dict[str, object]:
    rows = [row(f"first answer to {scene}, empty cache", _cold("solve", scene), "s", "<= 6") for scene in some(FIRST)]
    return dict(rows + [row("impact warm, empty cache", _cold(word), "s", "<= 60") for word in of(["warm"], [])])


def _cold(*words: str) -> float:
    """Seconds of a command of its own, which has to compile all that it needs."""
    with tempfile.TemporaryDirectory() as folder:
        begun = time.perf_counter()
        command = [sys.executable, "-m", "app.command", *words]
        subprocess.run(command, env=os.environ | {"NUMBA_CACHE_DIR": folder}, check=True, capture_output=True)
        return time.perf_counter() - begun
