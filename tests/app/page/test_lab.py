"""The laboratory between the browser and the solver."""

from types import SimpleNamespace

from app.page.lab import Lab


def test_what_the_server_writes_holds_up_no_change_of_the_browser():
    """Panel took an answer for a change of the browser, and kept the next one waiting 50 ms with it."""
    lab, waiting = Lab(), []
    document = SimpleNamespace(session_context=True, add_timeout_callback=lambda *given: waiting.append(given))
    for name in ("frame", "refused", "waiting"):
        lab._server_change(document, "a reference", None, name, "", "another")
    assert waiting == [] and lab._events == {}
