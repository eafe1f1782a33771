"""The machine of the server is calibrated once, beside its work, whatever comes in between."""

import asyncio
import logging

import pytest

from app.jobs import calibrating
from app.jobs.answers import Kept
from app.jobs.calibrating import calibrate_machine, calibrate_once
from app.views.tradeoff import stored_data
from solvers.jit.compiling import NotCompiled

from ..socket_client import run


class Jobs:
    """In place of the processes: each answers at once, in turn, or raises."""

    def __init__(self, *answers):
        self.answers, self.asked = list(answers), []

    def start(self, work, **how):
        self.asked.append((work, how.get("compiled", True)))
        job = type("Job", (), {"answer": asyncio.get_running_loop().create_future()})()
        found = self.answers.pop(0)
        job.answer.set_exception(found) if found else job.answer.set_result(None)
        return job


@pytest.fixture
def kept(monkeypatch):
    kept = Kept()
    kept.keep(stored_data, {"scene": "fixed-rod"}, "as measured elsewhere")
    kept.keep(calibrate_once, {"scene": "fixed-rod"}, "another work")
    monkeypatch.setattr(calibrating, "KEPT", kept)
    monkeypatch.setattr(calibrating, "COMPILING_SECONDS", 0.01)
    return kept


def calibrated(monkeypatch, *answers) -> list:
    jobs = Jobs(*answers)
    monkeypatch.setattr(calibrating, "of_loop", lambda kind: jobs)
    run(calibrate_machine())
    return jobs.asked


def test_answers_of_before_are_dropped(monkeypatch, kept):
    assert calibrated(monkeypatch, None) == [(calibrate_once, True)]
    assert kept.known(stored_data, {"scene": "fixed-rod"}) is None
    assert kept.known(calibrate_once, {"scene": "fixed-rod"}) == "another work"
    assert kept._bytes == len("another work")


def test_what_is_not_compiled_yet_is_compiled_later(monkeypatch, kept):
    asked = calibrated(monkeypatch, NotCompiled("march"), None)
    assert asked == [(calibrate_once, True), (calibrate_once, False)]
    assert kept.known(stored_data, {"scene": "fixed-rod"}) is None


def test_a_failure_is_one_line_in_the_log(monkeypatch, kept, caplog):
    with caplog.at_level(logging.WARNING):
        calibrated(monkeypatch, ValueError("no time"))
    assert [record.message for record in caplog.records] == ["this machine could not be calibrated (no time)"]
    assert kept.known(stored_data, {"scene": "fixed-rod"}) == "as measured elsewhere"


def test_what_is_known_is_not_measured_again(monkeypatch):
    measured = []
    monkeypatch.setattr(calibrating, "calibrate", lambda: measured.append(True))
    for known in (None, {"python": 1.0}):
        monkeypatch.setattr(calibrating, "known", lambda known=known: known)
        calibrate_once()
    assert measured == [True]
