"""Parts of the bench that call kernels by themselves: a changed kernel is noticed here, not by who measures next."""

import json

import pytest

from app.views.registry import VIEWS
from bench import __main__ as bench
from bench import kernels, states_listed, sweep, waves


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


def test_the_states_of_the_page_have_every_analysis():
    listed = {state.name for state in states_listed.STATES} | {"analysis-record"}  # of which there are several
    assert {f"analysis-{view.key}" for view in VIEWS} <= listed
