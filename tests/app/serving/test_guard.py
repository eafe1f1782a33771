"""The guard rests on details of Bokeh; these tests notice when they change."""

from bokeh.server.connection import ServerConnection
from bokeh.server.protocol_handler import ProtocolHandler

from app.lab import Lab
from app.serving import guard


def test_the_guard_is_installed_once_and_around_what_it_needs():
    guard.install()
    first = ProtocolHandler.handle, ServerConnection.error
    guard.install()
    assert (ProtocolHandler.handle, ServerConnection.error) == first
    assert ProtocolHandler.handle.guarded


def test_only_plain_values_and_events_pass():
    change = {"kind": "ModelChanged", "model": {"id": "p1"}, "attr": "speed", "new": 2.0}
    assert guard.allowed(change)
    assert guard.allowed(change | {"new": {"type": "number", "value": "nan"}})
    assert guard.allowed({"kind": "MessageSent", "msg_type": "bokeh_event", "msg_data": {}})
    for event in (
        {"kind": "RootAdded"},
        {"kind": "TitleChanged", "title": "x"},
        change | {"new": {"type": "object", "name": "Div"}},
        change | {"new": [{"type": "object"}]},
        {"kind": "ColumnDataChanged"},
        {"kind": ["ModelChanged"]},
        {},
        None,
        7,
    ):
        assert not guard.allowed(event)


def test_the_sliders_wait_for_no_debounce():
    """Panel holds a change back for 50 ms unless its name is on this list of its own."""
    assert set(Lab._priority_changes) >= set(Lab.CHOSEN)
    assert "_priority_changes" in vars(Lab)
    import inspect

    from panel.reactive import Syncable

    assert "_priority_changes" in inspect.getsource(Syncable._server_change)
