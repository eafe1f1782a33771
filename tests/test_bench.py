"""Parts of the bench that call kernels by themselves: a changed kernel is noticed here, not by who measures next."""

import json

import pytest

from bench import __main__ as bench
from bench import kernels, sweep, waves


@pytest.mark.slow
@pytest.mark.parametrize("measure", [kernels._waves, sweep.measure, waves.measure], ids=lambda each: each.__module__)
def test_a_part_runs(measure, monkeypatch):
    monkeypatch.setattr(sweep, "MANY", 2_000)
    rows = dict(measure())
    assert rows and all(row["value"] == row["value"] for row in rows.values())


def test_every_stored_part_says_machine_date_and_commit():
    stored = json.loads(bench.RESULTS.read_text(encoding="utf-8"))
    assert {
        part for part, figures in stored.items() if not {"processor", "date", "commit"} <= set(figures["measured"])
    } == set()
    assert bench.written(stored) == bench.RESULTS.read_text(encoding="utf-8")
