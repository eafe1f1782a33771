"""What is measured still runs, every part of it, and what is stored says where from."""

import json
import math
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import pytest

from app.views.registry import VIEWS
from bench import __main__ as bench
from bench import states_listed
from bench.size import of, small, some
from solvers.accuracy import calibration
from solvers.accuracy.store import SHIPPED

PAGES = ("page", "map", "visitors")  # parts that need a browser, or a server of the page


def numbers(found: Any) -> Iterator[float]:
    """All that was measured; but for shares, as one of none is no number."""
    if isinstance(found, dict):
        for value in found.values():
            yield from numbers(value) if found.get("unit") != "%" else ()
    elif isinstance(found, list):
        for value in found:
            yield from numbers(value)
    elif isinstance(found, float | int):
        yield found


@pytest.mark.slow
@pytest.mark.parametrize(
    "part", [pytest.param(name, marks=pytest.mark.browser if name in PAGES else ()) for name in bench.PARTS]
)
def test_every_part_runs(part, tmp_path, monkeypatch):
    """A little of each: what its sources have become unfit for is noticed here, not by who measures next."""
    monkeypatch.setattr(calibration, "_path", lambda: tmp_path / "calibration.json")
    monkeypatch.setattr(calibration, "_known", {})
    before = {path: path.stat().st_mtime_ns for path in (bench.RESULTS, *SHIPPED.iterdir())}
    with small(), ThreadPoolExecutor(1) as pool:  # Playwright has a loop of its own on this thread
        found = pool.submit(bench.PARTS[part].measure).result()
    told = list(numbers(found))
    assert told and all(map(math.isfinite, told))
    assert {path: path.stat().st_mtime_ns for path in (bench.RESULTS, *SHIPPED.iterdir())} == before  # nothing is kept


def test_a_small_run_is_small_until_it_ends():
    with small():
        assert (of(15, 1), some((3, 2, 1)), some({"a": 1, "b": 2}), some([4, 5, 6], 2)) == (1, (3,), {"a": 1}, [4, 5])
    assert (of(15, 1), some((3, 2, 1))) == (15, (3, 2, 1))


def test_every_stored_part_says_machine_date_and_commit():
    stored = json.loads(bench.RESULTS.read_text(encoding="utf-8"))
    assert {
        part for part, figures in stored.items() if not {"processor", "date", "commit"} <= set(figures["measured"])
    } == set()
    assert bench.written(stored) == bench.RESULTS.read_text(encoding="utf-8")


def test_the_states_of_the_page_have_every_analysis():
    listed = {state.name for state in states_listed.STATES} | {"analysis-record"}  # of which there are several
    assert {f"analysis-{view.key}" for view in VIEWS} <= listed
