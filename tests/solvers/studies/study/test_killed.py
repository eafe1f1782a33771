"""200 000 points on a cluster of separate processes, killed twice, are those of a study that nobody has disturbed."""

import json
import os
import signal
import subprocess
import sys
from contextlib import suppress
from pathlib import Path

import numpy as np
import pytest

from solvers import study
from solvers.notebook.datasets import read_study
from solvers.studies.study.parts import Parts
from solvers.studies.study.stored import receipts

from ....patience import SECONDS
from .test_cluster import ROOT, by_hand, children_of, solver_of, until
from .test_study import runs

MANY = 200_000
VARY = {"impactor.mass": "40..60:400", "impactor.velocity": "0.5..3:500"}  # with some contacts each
FIGURES = ["peak_force", "contact_time", "impulse"]

__all__ = ["by_hand"]  # the fixture


def begun(path: Path, *more: str) -> subprocess.Popen:
    """`impact study` of all of them."""
    call = [sys.executable, "-m", "app.command", "study", "fixed-rod", "--no-notes", "--out", str(path), *more]
    call += [word for key, values in VARY.items() for word in ("--vary", f"{key}={values}")]
    call += [word for name in FIGURES for word in ("--figure", name)]
    return subprocess.Popen(call, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def kept(folder: Path) -> list[tuple[int, int]]:
    """What is there: blocks with a receipt, and parts of others."""
    blocks = sorted(receipts(folder))
    parts = [each for each in Parts(folder).spans() if not any(start <= each[0] < stop for start, stop in blocks)]
    return sorted([*blocks, *parts])


def count(folder: Path) -> int:
    return sum(stop - start for start, stop in kept(folder))


def written(store: Path) -> dict[str, int]:
    """When each chunk of the figures was."""
    paths = (path for name in FIGURES for path in (store / name / "c").rglob("*") if path.is_file())
    return {str(path.relative_to(store)): path.stat().st_mtime_ns for path in paths if path.suffix != ".partial"}


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="by /proc")
def test_killed_twice_it_ends_complete_and_equal(tmp_path, by_hand):
    path, folder = tmp_path / "map.zarr", tmp_path / "map.zarr.parts"
    first = begun(path, "--cluster", by_hand.all())
    by_hand.processes.append(first)
    until(lambda: count(folder) > MANY // 20 or first.poll() is not None)
    assert first.poll() is None
    os.kill(solver_of(by_hand.processes[1]), signal.SIGKILL)
    before = count(folder)
    until(lambda: count(folder) > before + MANY // 20 or first.poll() is not None)
    assert first.poll() is None
    solving = [int(pid) for nanny in by_hand.processes[1:3] for pid in children_of(nanny)]
    by_hand.kill()
    for number in solving:
        with suppress(ProcessLookupError):
            os.kill(number, signal.SIGKILL)
    until(lambda: not any(runs(str(number)) for number in solving))
    there, chunks = count(folder), written(folder / "store.zarr")
    assert MANY // 10 < there < MANY and not path.exists() and len(receipts(folder)) > 3
    again = begun(path, "--cluster", by_hand.all(), "--resume", "--json")
    by_hand.processes.append(again)
    out, err = again.communicate(timeout=SECONDS)
    assert (again.returncode, err) == (0, "")
    known = json.loads(out)
    assert (known["resumed"], known["points"], known["solved"]) == (there, MANY, MANY) and not folder.exists()
    changed = {name for name, at in written(path).items() if chunks.get(name, at) != at}
    assert len(changed) <= 3 * len(FIGURES)  # of blocks without a receipt: one under way at each worker, one of parts
    found, whole = read_study(path), study("fixed-rod", VARY, figures=FIGURES, notes=False, workers=2)
    for name in (*FIGURES, *VARY):
        assert found[name].values.tobytes() == whole[name].values.tobytes()
    assert (found.refused == "").all() and np.isfinite(found.peak_force).all()
