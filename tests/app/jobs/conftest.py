"""What answers in place of the page's own workers."""

import pytest

from app.jobs import spread as spread_room

from .threads import start


@pytest.fixture
def own(monkeypatch):
    """Questions that the page's own workers have had."""
    had = []

    class Answers:
        def start(self, work, question, **how):
            had.append(question)
            return start(lambda _, cancelled: "of its own", question, **how)

    monkeypatch.setattr(spread_room, "Answers", Answers)
    return had
