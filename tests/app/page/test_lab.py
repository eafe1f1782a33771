"""The laboratory between the browser and the solver."""

from types import SimpleNamespace

import pytest

from app.page.lab import Lab
from app.views.whatif import EXAMPLE, POINTS


def test_what_the_server_writes_holds_up_no_change_of_the_browser():
    """Panel took an answer for a change of the browser, and kept the next one waiting 50 ms with it."""
    lab, waiting = Lab(), []
    document = SimpleNamespace(session_context=True, add_timeout_callback=lambda *given: waiting.append(given))
    for name in ("frame", "refused", "waiting"):
        lab._server_change(document, "a reference", None, name, "", "another")
    assert waiting == [] and lab._events == {}


@pytest.mark.parametrize("ends", [lambda lab: setattr(lab, POINTS, ""), Lab.leave], ids=["stopped", "left"])
def test_points_of_the_map_end_where_they_are_stopped_and_where_the_visitor_leaves(ends, monkeypatch):
    begun = []
    monkeypatch.setattr("app.page.panels.begin", begun.append)
    lab = Lab()
    runner, stopped = lab._runners[POINTS], []
    monkeypatch.setattr(runner, "stop", lambda: stopped.append(True))
    setattr(lab, POINTS, EXAMPLE)
    assert len(begun) == 1 and stopped == []
    ends(lab)
    assert len(begun) == 1 and stopped == [True]
