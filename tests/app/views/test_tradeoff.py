"""The stored table on the page: where its times are from, and that a visitor may have them scaled."""

import json

import pytest
from pytest import approx

import solvers
from app.choices.choices import Choices
from app.text.catalogues import page
from app.views import tradeoff as view
from app.views.tradeoff import SCALED, stored_data
from solvers.accuracy import calibration, store
from solvers.text.catalogue import SOURCE

THERE = {"python": 1e-3, "kernels": 2e-2, "algebra": 3e-2}


@pytest.fixture(autouse=True)
def shipped(tmp_path, monkeypatch):
    """A table of another machine."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    table = store.shipped(solvers.load("fixed-rod")) | {"calibration": THERE}
    table["machine"] = table["machine"] | {"processor": "Some processor"}
    monkeypatch.setattr(store, "shipped", lambda scene: table)
    return table


def shown(**asked) -> dict:
    return json.loads(stored_data(Choices().chosen() | {SCALED: False} | asked))


def words(found: dict) -> str:
    """The sentence above the figure."""
    names = "shipped", "scaled", "elsewhere", "changed", "seconds", "date"
    values = {name: found[name] for name in names} | found["machine"]
    rest = {"points": len(found["points"]), "state": "whole", "stopped": "", "reference": "exact"}
    return page(SOURCE).text("tradeoff.measured", **values, **rest)


def test_a_table_of_another_machine_says_so_and_may_be_scaled():
    found = shown()
    assert (found["shipped"], found["scaled"], found["scalable"], found["elsewhere"]) == (True, False, True, True)
    assert "Measured on Some processor (" in words(found) and "another machine than this" in words(found)
    assert "on this machine" not in words(found) and "scaled" not in words(found)


def test_asked_to_it_calibrates_once_and_scales(monkeypatch, shipped):
    calls = []
    monkeypatch.setattr(view, "calibrate", lambda: calls.append(calibration.calibrate(0.01)))
    found = shown(**{SCALED: True})
    assert found["scaled"] and found["chosen"][SCALED]
    assert "another machine than this; times are scaled to this machine" in words(found)
    again = shown(**{SCALED: True})
    assert len(calls) == 1 and again["points"] == found["points"]
    assert shown()["scaled"]  # for whoever comes then, too
    modal = [row for row in found["points"] if row["label"] == "modal modes=3200"]
    raw = [point for point in shipped["points"] if point["size"] == 3200 and point["method"]["name"] == "modal"]
    factors = calibration.factors(THERE).values()
    for row, point in zip(modal, raw, strict=True):
        assert min(factors) < row["wall_time"] / point["wall_time"] < max(factors)


def test_the_same_processor_is_still_not_this_machine(monkeypatch, shipped):
    monkeypatch.setattr(view, "machine", lambda: shipped["machine"])
    found = shown()
    assert not found["elsewhere"]
    assert "on this machine" not in words(found) and "for this release" in words(found)


def test_methods_that_have_changed_since_are_told(shipped):
    shipped["code"] = {"modal": "of before"}
    assert "Methods have changed since." in words(shown())
    shipped["code"] = {}
    assert "Methods have changed" not in words(shown())


def test_a_table_that_cannot_be_scaled_offers_nothing(shipped):
    shipped["calibration"] = None
    assert not shown()["scalable"]


def test_what_was_measured_here_says_so(monkeypatch):
    brick = solvers.load("brick-off-centre")
    monkeypatch.setattr(view, "_scene", lambda asked: brick)
    solvers.tradeoff(brick)
    found = shown()
    assert not found["shipped"] and not found["scalable"]
    assert words(found).startswith("Measured on this machine: 1 point")
    assert found["points"][0]["wall_time"] == approx(solvers.stored_tradeoff(brick).points[0].wall_time)
