"""What of a document a client may change; the guard rests on details of Bokeh, and notices when they change."""

import inspect

import pytest
from panel.reactive import Syncable

from app.choices.choices import Choices
from app.page.lab import Lab
from app.page.questions import Questions
from app.serving import guard

OWN = "p1"
CHANGE = {"kind": "ModelChanged", "model": {"id": OWN}, "attr": "speed", "new": 2.0}
READY = {"type": "event", "name": "document_ready", "values": {"type": "map"}}
SAID = {"kind": "MessageSent", "msg_type": "bokeh_event", "msg_data": READY}


def taken(*events, kind="PATCH-DOC"):
    decision = guard.decide(kind, {"events": list(events)}, OWN, guard.SETTABLE)
    return None if decision.reason else decision.events


def test_choices_and_what_is_opened_and_asked_are_taken_and_nothing_else_of_the_same_model():
    for name in (*Choices.CHOSEN, *Questions.ASKED):
        assert taken(CHANGE | {"attr": name}) == [CHANGE | {"attr": name}]
    for name in set(Lab.param) - guard.SETTABLE:
        assert taken(CHANGE | {"attr": name}) is None, name


@pytest.mark.parametrize(
    "event",
    [
        CHANGE | {"model": {"id": "p2"}},
        CHANGE | {"model": {"id": OWN, "type": "object"}},
        CHANGE | {"model": OWN},
        CHANGE | {"attr": ["speed"]},
        CHANGE | {"new": {"type": "object", "name": "Div"}},
        CHANGE | {"new": {"type": "number", "value": {"a": 1}}},
        CHANGE | {"new": [1.0]},
        CHANGE | {"new": "x" * (guard.LONGEST_VALUE + 1)},
        CHANGE | {"hint": 1},
        {"kind": "RootAdded", "model": {"type": "object", "name": "Div", "id": "p9"}},
        {"kind": "RootRemoved", "model": {"id": OWN}},
        {"kind": "TitleChanged", "title": "x"},
        {"kind": "ColumnDataChanged", "model": {"id": OWN}, "attr": "data", "data": {}},
        {"kind": ["ModelChanged"]},
        SAID | {"msg_type": "custom"},
        SAID | {"msg_data": READY | {"name": "button_click"}},
        SAID | {"msg_data": READY | {"values": {"type": "map", "entries": [["model", {"id": OWN}]]}}},
        SAID | {"x": []},  # of which Bokeh would make whatever it says
        SAID | {"model": {"id": OWN}},
        SAID | {"msg_data": READY | {"x": [{"type": "object", "name": "Div", "id": "A\nB"}]}},
        SAID | {"msg_data": READY | {"values": {"type": "map", "x": 1}}},
        {},
        None,
        7,
    ],
    ids=str,
)
def test_no_other_event_is_taken(event):
    assert taken(event) is None
    assert taken(CHANGE, event) is None  # nor anything in the same message


def test_plain_values_and_the_one_event_are_taken():
    for value in (1.0, 7, True, None, "waves", "x" * guard.LONGEST_VALUE, {"type": "number", "value": "nan"}):
        assert taken(CHANGE | {"new": value})
    scene = CHANGE | {"attr": "scene", "new": "own." + "x" * (guard.LONGEST_SCENE - 4)}
    assert taken(scene) == [scene] and taken(scene | {"new": scene["new"] + "x"}) is None
    assert taken(SAID) == [SAID]
    assert taken(*[CHANGE] * guard.MAX_EVENTS) and taken(*[CHANGE] * (guard.MAX_EVENTS + 1)) is None


def test_what_panel_reports_by_itself_is_dropped_without_a_word():
    reported = CHANGE | {"model": {"id": "p77"}, "attr": "dark_mode", "new": True}
    assert taken(reported) == [] and taken(CHANGE, reported) == [CHANGE]
    assert not guard.REPORTED & set(Lab.param)


@pytest.mark.parametrize("kind", ["PUSH-DOC", "SERVER-INFO-REQ", "ACK", "OK", "nonsense"])
def test_no_other_message_is_taken(kind):
    assert guard.decide(kind, {"events": []}, OWN, guard.SETTABLE).reason
    for content in ([], {}, {"events": [], "x": [{"type": "object", "name": "Div", "id": "A"}]}):
        assert guard.decide("PATCH-DOC", content, OWN, guard.SETTABLE).reason


def test_of_choices_that_are_set_again_only_the_newest_is_kept():
    first, other = CHANGE | {"new": 1.0}, CHANGE | {"attr": "law"}
    run = CHANGE | {"attr": "tradeoff_running", "new": True}
    assert guard.newest_only([first, other, run, SAID], [CHANGE, run]) == [other, run, SAID]


def test_the_sliders_wait_for_no_debounce():
    """Panel holds a change back for 50 ms unless its name is on this list of its own."""
    assert set(Lab._priority_changes) >= set(Lab.CHOSEN)
    assert "_priority_changes" in vars(Lab)
    assert "_priority_changes" in inspect.getsource(Syncable._server_change)
